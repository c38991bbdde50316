//! Linear BVHs (Lauterbach and others 2009, "Fast BVH Construction on GPUs"): boxes are sorted along a Morton curve,
//! and a node ends where the highest bit of the codes changes. Built in a fraction of the time of other trees, as no boxes
//! are compared; rays visit a tenth more nodes in meshes of even triangles, and far more where sizes differ.

use super::{
    Aabb, Child, StackNeed,
    morton::{CODE_BITS, Cells},
    threads,
};
use bytemuck::allocation::zeroed_vec;
use std::ops::Range;

/// Largest number of boxes in a leaf. With three, a mesh has about as many nodes as with [`super::build`].
const LEAF_SIZE: usize = 3;

/// More boxes with the same code are sorted by further bits of it.
const CROWD: usize = 16;

/// Levels above the subtrees that threads build.
const TOP_LEVELS: usize = 4;

/// A tree of four-way nodes without boxes.
#[derive(Debug)]
pub struct LinearBvh {
    /// The children of each node, from the first slot on; those that are nodes come after it. Node 0 is the root. All
    /// leaves are of group 0.
    pub nodes: Vec<[Option<Child>; 4]>,
    /// The indices of the boxes in leaf order.
    pub order: Vec<u32>,
    /// As [`super::Bvh::stack_need`].
    pub stack_need: StackNeed,
}

/// Builds a tree; `None` for less than two boxes, or if the tree needs a stack of more than `stack_size` references.
pub fn build(boxes: &[Aabb], stack_size: usize) -> Option<LinearBvh> {
    if boxes.len() < 2 {
        return None;
    }
    let keys = Keys::of(boxes);
    let mut top = vec![NO_CHILDREN];
    let below = grow(&keys, 0..boxes.len(), TOP_LEVELS, &mut top);
    let subtrees = threads::map(below, |(range, at)| {
        let mut nodes = Vec::with_capacity(1 + range.len() / LEAF_SIZE);
        nodes.push(NO_CHILDREN);
        grow(&keys, range, usize::MAX, &mut nodes);
        (nodes, at)
    });
    let nodes = joined(top, &subtrees);
    let stack_need = stack_need(&nodes);
    (stack_need.references <= stack_size).then(|| LinearBvh {
        order: threads::collect(boxes.len(), |place| keys.index(keys.list[place])),
        nodes,
        stack_need,
    })
}

/// The children of a node, from the first slot on.
type Children = [Option<Child>; 4];

const NO_CHILDREN: Children = [None; 4];

/// The boxes along the curve, in a word each, which sorts in half of the time of a code beside an index.
struct Keys<'a> {
    /// The upper bits of the Morton code of a box, and its index in `index_bits` bits.
    list: Vec<u64>,
    index_bits: u32,
    boxes: &'a [Aabb],
    cells: Cells,
}

impl<'a> Keys<'a> {
    fn of(boxes: &'a [Aabb]) -> Self {
        let index_bits = boxes.len().ilog2() + 1;
        let lost_bits = CODE_BITS + index_bits - u64::BITS;
        let cells = Cells::round(boxes);
        let mut list = zeroed_vec(boxes.len());
        threads::fill(&mut list, |index| {
            cells.code(&boxes[index]) >> lost_bits << index_bits | index as u64
        });
        threads::sort(&mut list);
        let index = |key: &u64| (key & ((1 << index_bits) - 1)) as usize;
        for crowd in list.chunk_by_mut(|a, b| a >> index_bits == b >> index_bits) {
            if crowd.len() > CROWD {
                crowd.sort_by_cached_key(|key| (cells.code(&boxes[index(key)]), *key));
            }
        }
        Self {
            list,
            index_bits,
            boxes,
            cells,
        }
    }

    /// The index of the box of a key.
    fn index(&self, key: u64) -> u32 {
        (key & ((1 << self.index_bits) - 1)) as u32
    }

    /// Where the highest bit changes in which the codes of a range differ; the middle if none does. The lower bits count in
    /// ranges of more than [`CROWD`] boxes only: smaller ones may not be sorted by them.
    fn split(&self, range: Range<usize>) -> usize {
        let upper = self.split_by(&range, |key| key >> self.index_bits);
        let whole = || {
            let code = |key| self.cells.code(&self.boxes[self.index(key) as usize]);
            self.split_by(&range, code)
        };
        let place = match range.len() > CROWD {
            true => upper.or_else(whole),
            false => upper,
        };
        place.unwrap_or(range.start.midpoint(range.end))
    }

    /// The split of a range by codes that ascend in it; `None` if all are equal.
    fn split_by(&self, range: &Range<usize>, code: impl Fn(u64) -> u64) -> Option<usize> {
        let (first, last) = (code(self.list[range.start]), code(self.list[range.end - 1]));
        let bit = (first ^ last).checked_ilog2()?;
        let least = last >> bit << bit;
        let keys = &self.list[range.clone()];
        Some(range.start + keys.partition_point(|key| code(*key) < least))
    }
}

/// Gives the last of `nodes` the boxes of a range, and adds nodes below it, at most `levels` deep: returns the ranges
/// that are left with the nodes that are to have them.
fn grow(
    keys: &Keys<'_>,
    range: Range<usize>,
    levels: usize,
    nodes: &mut Vec<Children>,
) -> Vec<(Range<usize>, usize)> {
    let mut open = vec![(range, nodes.len() - 1, 0)];
    let mut left_out = Vec::new();
    while let Some((range, at, level)) = open.pop() {
        if level == levels {
            left_out.push((range, at));
            continue;
        }
        let (parts, count) = divided(keys, range);
        for (slot, part) in parts.into_iter().take(count).enumerate() {
            nodes[at][slot] = Some(if part.len() <= LEAF_SIZE {
                Child::Leaf {
                    group: 0,
                    first: part.start as u32,
                    count: part.len() as u32,
                }
            } else {
                nodes.push(NO_CHILDREN);
                open.push((part, nodes.len() - 1, level + 1));
                Child::Node(nodes.len() as u32 - 1)
            });
        }
    }
    left_out
}

/// A range of keys in up to four parts: the longest is split until there are four, or none is too long for a leaf.
fn divided(keys: &Keys<'_>, range: Range<usize>) -> ([Range<usize>; 4], usize) {
    let (mut parts, mut count) = ([range, 0..0, 0..0, 0..0], 1);
    while count < 4 {
        let longest = (1..count).fold(0, |best, i| match parts[i].len() > parts[best].len() {
            true => i,
            false => best,
        });
        if parts[longest].len() <= LEAF_SIZE {
            break;
        }
        let Range { start, end } = parts[longest];
        let middle = keys.split(start..end);
        parts[longest] = start..middle;
        parts[count] = middle..end;
        count += 1;
    }
    (parts, count)
}

/// The nodes of a tree and of the subtrees below it, each with the node that is its root.
fn joined(mut nodes: Vec<Children>, subtrees: &[(Vec<Children>, usize)]) -> Vec<Children> {
    let added: usize = subtrees.iter().map(|(below, _)| below.len() - 1).sum();
    nodes.reserve_exact(added);
    for (below, at) in subtrees {
        let offset = nodes.len() as u32 - 1;
        nodes[*at] = moved(&below[0], offset);
        nodes.extend(below[1..].iter().map(|children| moved(children, offset)));
    }
    nodes
}

/// Children whose nodes come to lie so much further on.
fn moved(children: &Children, offset: u32) -> Children {
    children.map(|child| match child {
        Some(Child::Node(index)) => Some(Child::Node(index + offset)),
        leaf => leaf,
    })
}

/// See [`super::Bvh::stack_need`].
fn stack_need(nodes: &[Children]) -> StackNeed {
    let mut need = vec![StackNeed::default(); nodes.len()];
    for (index, children) in nodes.iter().enumerate().rev() {
        let below = children.iter().flatten().map(|child| match child {
            Child::Node(index) => need[*index as usize],
            Child::Leaf { .. } => StackNeed::default(),
        });
        need[index] = StackNeed::below(children.iter().flatten().count(), below);
    }
    need[0].with_end()
}
