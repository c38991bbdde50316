//! Moves nodes of a finished tree to better places (Meister and Bittner 2017, "Parallel Reinsertion for
//! Bounding Volume Hierarchy Optimization").

use super::{
    linked::{Box4, Node, sibling},
    threads,
};

/// The share of all nodes that the first round tries to move.
const SHARE: f32 = 0.1;

/// Nodes that the first round tries to move at most. Beyond, a larger share would cost more time than it saves: for a
/// million boxes it makes rays 1 % cheaper.
const MOST: f32 = 65536.0;

/// Rounds; round i tries 1 / (2 i + 1) as many nodes as the first, and always the largest.
const ROUNDS: usize = 16;

/// Places tried for a node. Most nodes need some dozens; among nearly equal boxes every place seems good.
const MOST_PLACES: usize = 256;

/// A move of a subtree.
#[derive(Clone, Copy, Debug, Default)]
struct Move {
    /// The decrease of the sum of all areas; 0 if there is no better place.
    gain: f32,
    from: u32,
    /// The node that becomes its sibling.
    to: u32,
}

/// Reduces the sum of the areas of all nodes; returns the number of places tried. Parents must be set.
pub fn optimize(nodes: &mut [Node]) -> u64 {
    let mut touched = vec![0u8; nodes.len()];
    let mut work = 0;
    for round in 0..ROUNDS {
        let first = (nodes.len() as f32 * SHARE).min(MOST);
        let count = ((first / (2 * round + 1) as f32) as usize).clamp(1, nodes.len() - 1);
        let mut moves: Vec<_> = (candidates(nodes, count).into_iter())
            .map(|from| {
                (
                    Move {
                        from,
                        ..Move::default()
                    },
                    0,
                )
            })
            .collect();
        threads::for_chunks(&mut moves, |_, moves| {
            let mut open = Vec::new();
            for (found, tried) in moves {
                (*found, *tried) = best_move(nodes, found.from, &mut open);
            }
        });
        work += moves.iter().map(|(_, tried)| *tried as u64).sum::<u64>();
        let mut moves: Vec<_> = moves.into_iter().map(|(found, _)| found).collect();
        moves.retain(|found| found.gain > 0.0);
        moves.sort_unstable_by(|a, b| b.gain.total_cmp(&a.gain).then(a.from.cmp(&b.from)));
        for Move { from, to, .. } in moves {
            let parent = |node: u32| nodes[node as usize].parent;
            let involved = [from, to, sibling(from), parent(from), parent(to)].map(|i| i as usize);
            let is_free = involved.iter().all(|&node| touched[node] <= round as u8);
            if is_free && !is_below(nodes, to, from) {
                involved
                    .iter()
                    .for_each(|&node| touched[node] = round as u8 + 1);
                reinsert(nodes, from, to);
            }
        }
    }
    work
}

/// Whether a node is in the subtree of another one, where an earlier move of the round may have put it.
fn is_below(nodes: &[Node], mut node: u32, root: u32) -> bool {
    while node != root && node != 0 {
        node = nodes[node as usize].parent;
    }
    node == root
}

/// The `count` largest of the first 2 `count` nodes, which are the top of the tree when it was built.
fn candidates(nodes: &[Node], count: usize) -> Vec<u32> {
    let considered = 1..nodes.len().min(2 * count + 1);
    let mut all: Vec<_> = considered
        .map(|index| (nodes[index].aabb().half_area().to_bits(), index as u32))
        .collect();
    if count < all.len() {
        all.select_nth_unstable_by(count, |a, b| b.cmp(a));
        all.truncate(count);
    }
    all.into_iter().map(|(_, index)| index).collect()
}

/// The best new sibling for a node, and the number of places tried. `open` is working memory.
fn best_move(nodes: &[Node], from: u32, open: &mut Vec<(f32, u32)>) -> (Move, usize) {
    let aabb = nodes[from as usize].aabb();
    let area = aabb.half_area();
    let parent = nodes[from as usize].parent;
    let mut best = Move {
        from,
        ..Move::default()
    };
    // Without the node, its sibling takes the place of its parent, and the boxes above shrink.
    let mut gain = nodes[parent as usize].aabb().half_area();
    let mut beside = sibling(from);
    let mut shrunk = nodes[beside as usize].aabb();
    let mut pivot = parent;
    let mut tried = 0;
    while tried < MOST_PLACES {
        open.push((gain, beside));
        while let Some((gain, place)) = open.pop() {
            if gain - area <= best.gain {
                continue;
            }
            if tried == MOST_PLACES {
                open.clear();
                break;
            }
            tried += 1;
            let node = &nodes[place as usize];
            let there = node.aabb();
            let left = gain - there.union(&aabb).half_area();
            if left > best.gain {
                (best.to, best.gain) = (place, left);
            }
            if !node.is_leaf() {
                let below = left + there.half_area();
                open.extend([(below, node.link), (below, node.link + 1)]);
            }
        }
        if pivot != parent {
            shrunk = shrunk.union(&nodes[beside as usize].aabb());
            gain += nodes[pivot as usize].aabb().half_area() - shrunk.half_area();
        }
        if pivot == 0 {
            break;
        }
        beside = sibling(pivot);
        pivot = nodes[pivot as usize].parent;
    }
    if best.to == sibling(from) || best.to == parent {
        best.gain = 0.0;
    }
    (best, tried)
}

/// Makes two nodes siblings. The node that `to` was moves to the place of the sibling of `from`.
fn reinsert(nodes: &mut [Node], from: u32, to: u32) {
    let beside = sibling(from);
    let parent = nodes[from as usize].parent;
    let remaining = nodes[beside as usize];
    let joined = nodes[to as usize];
    nodes[to as usize].link = from.min(beside);
    place(nodes, joined, beside);
    place(nodes, remaining, parent);
    nodes[beside as usize].parent = to;
    nodes[from as usize].parent = to;
    refit(nodes, to);
    if parent != 0 {
        refit(nodes, nodes[parent as usize].parent);
    }
}

/// Gives a place the box and the children of a node, but not its parent.
fn place(nodes: &mut [Node], node: Node, at: u32) {
    let parent = nodes[at as usize].parent;
    nodes[at as usize] = node;
    nodes[at as usize].parent = parent;
    if !node.is_leaf() {
        nodes[node.link as usize].parent = at;
        nodes[node.link as usize + 1].parent = at;
    }
}

/// Fits the boxes of an inner node and of those above it, up to the first that does not change.
fn refit(nodes: &mut [Node], mut index: u32) {
    loop {
        let node = &nodes[index as usize];
        let [left, right]: [Box4; 2] = [0, 1].map(|i| nodes[node.link as usize + i].aabb());
        let aabb = left.union(&right);
        if node.aabb() == aabb || index == 0 {
            nodes[index as usize].set_aabb(&aabb);
            return;
        }
        let parent = node.parent;
        nodes[index as usize].set_aabb(&aabb);
        index = parent;
    }
}
