//! Finished binary trees with one box in every leaf.

use super::{Aabb, linked, linked::LEAF, ploc, reinsertion, threads};
use bytemuck::{Zeroable, allocation::zeroed_vec};
use glam::Vec3;
use std::ops::Range;

/// Nodes of a tree that is not divided into parts.
const LEAST: usize = 1 << 15;

/// Parts of a tree have their roots this many steps below its root, so that there are some for every core.
const STEPS: u32 = 8;

/// A tree, in depth-first order.
#[derive(Debug)]
pub struct Tree {
    /// The root is the first.
    pub nodes: Vec<Node>,
    /// Subtrees that several threads can work on: disjoint, in order, and the same on every machine.
    pub parts: Vec<Range<usize>>,
}

impl Tree {
    fn undivided(nodes: Vec<Node>) -> Self {
        Self {
            nodes,
            parts: Vec::new(),
        }
    }
}

/// A node of a tree in depth-first order: an inner node is followed by its left subtree.
#[derive(Clone, Copy, Debug, PartialEq, Zeroable)]
pub struct Node {
    pub aabb: Aabb,
    /// The right child, or [`LEAF`] with the index of a box.
    link: u32,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// Index of a box.
    Leaf(u32),
    /// Index of the right child. The left one comes next after the node.
    Inner(u32),
}

impl Node {
    fn new(aabb: Aabb, kind: Kind) -> Self {
        let link = match kind {
            Kind::Leaf(index) => LEAF | index,
            Kind::Inner(right) => right,
        };
        Self { aabb, link }
    }

    #[inline(always)]
    pub fn kind(&self) -> Kind {
        match self.link & LEAF {
            0 => Kind::Inner(self.link),
            _ => Kind::Leaf(self.link & !LEAF),
        }
    }
}

/// A tree of good quality, and the number of pairs of boxes that were compared to build it.
pub fn build(boxes: &[Aabb]) -> (Tree, u64) {
    match boxes.len() {
        0 | 1 => return (balanced(boxes), 0),
        _ => {}
    }
    let (mut linked, compared) = ploc::build(boxes);
    linked::link_parents(&mut linked);
    let tried = reinsertion::optimize(&mut linked);
    (depth_first(&linked), compared + tried)
}

/// A linked tree in depth-first order.
fn depth_first(linked: &[linked::Node]) -> Tree {
    let roots = match linked.len() < LEAST {
        true => Vec::new(),
        false => roots_below(linked, STEPS),
    };
    let lens = threads::map(roots.clone(), |root| len_below(linked, root));
    let mut nodes: Vec<Node> = zeroed_vec(linked.len());
    // The nodes above the parts, and room for these.
    let (mut parts, mut len) = (Vec::with_capacity(roots.len()), 0);
    let mut open = vec![(0, None)];
    while let Some((source, parent)) = open.pop() {
        attach(&mut nodes, parent, len as u32);
        if roots.get(parts.len()) == Some(&source) {
            let end = len + lens[parts.len()];
            parts.push(len..end);
            len = end;
        } else {
            copy(linked, source, &mut nodes, len as u32, &mut open);
            len += 1;
        }
    }
    let mut rest = &mut nodes[..];
    let mut before = 0;
    let jobs = (parts.iter().zip(roots)).map(|(part, root)| {
        let own = std::mem::take(&mut rest)
            .split_at_mut(part.start - before)
            .1;
        let (own, others) = own.split_at_mut(part.len());
        (rest, before) = (others, part.end);
        (root, part.start as u32, own)
    });
    threads::map(jobs.collect(), |(root, first, own)| {
        copy_subtree(linked, root, first, own);
    });
    Tree { nodes, parts }
}

/// The inner nodes at this many steps from the root, left to right.
fn roots_below(linked: &[linked::Node], steps: u32) -> Vec<u32> {
    let mut roots = vec![0];
    for _ in 0..steps {
        let inner = (roots.into_iter()).filter(|&root: &u32| !linked[root as usize].is_leaf());
        let children = inner.flat_map(|root| [0, 1].map(|i| linked[root as usize].link + i));
        roots = children.collect();
    }
    roots.retain(|&root| !linked[root as usize].is_leaf());
    roots
}

/// The number of nodes of a subtree.
fn len_below(linked: &[linked::Node], root: u32) -> usize {
    let (mut len, mut open) = (0, vec![root]);
    while let Some(source) = open.pop() {
        len += 1;
        let node = &linked[source as usize];
        if !node.is_leaf() {
            open.extend([node.link, node.link + 1]);
        }
    }
    len
}

/// Copies a subtree to where it has room; the first of its nodes gets the index `first`.
fn copy_subtree(linked: &[linked::Node], root: u32, first: u32, nodes: &mut [Node]) {
    // Nodes to copy, and the parents of right children.
    let mut open = vec![(root, None)];
    for index in 0..nodes.len() as u32 {
        let Some((source, parent)) = open.pop() else {
            return;
        };
        copy(linked, source, nodes, index, &mut open);
        if let Some(parent) = parent {
            let parent: &mut Node = &mut nodes[parent as usize];
            parent.link = first + index;
        }
    }
}

/// Copies a node, and leaves its children open.
#[inline(always)]
fn copy(
    linked: &[linked::Node],
    source: u32,
    nodes: &mut [Node],
    index: u32,
    open: &mut Vec<(u32, Option<u32>)>,
) {
    let node = &linked[source as usize];
    if !node.is_leaf() {
        open.push((node.link + 1, Some(index)));
        open.push((node.link, None));
    }
    let aabb = node.aabb();
    nodes[index as usize] = Node {
        aabb: Aabb {
            min: aabb.min.into(),
            max: aabb.max.into(),
        },
        // The link of an inner node, until its right child has a place.
        link: node.link,
    };
}

/// Records the right child of a node.
fn attach(tree: &mut [Node], parent: Option<u32>, right: u32) {
    if let Some(parent) = parent {
        tree[parent as usize].link = right;
    }
}

/// A tree of logarithmic height, by halving along the longest axis of the boxes' centres.
fn balanced(boxes: &[Aabb]) -> Tree {
    let mut tree = Vec::with_capacity(2 * boxes.len());
    let mut indices: Vec<u32> = (0..boxes.len() as u32).collect();
    if !indices.is_empty() {
        halve(boxes, &mut indices, &mut tree);
    }
    Tree::undivided(tree)
}

/// Appends a balanced tree over some of the boxes, at least one.
fn halve(boxes: &[Aabb], indices: &mut [u32], tree: &mut Vec<Node>) {
    let of = |i: &u32| boxes[*i as usize];
    let mut open: Vec<(Range<usize>, _)> = vec![(0..indices.len(), None)];
    while let Some((range, parent)) = open.pop() {
        let part = &mut indices[range.clone()];
        let index = tree.len() as u32;
        let aabb = part.iter().fold(Aabb::EMPTY, |all, i| all.union(of(i)));
        let kind = if part.len() == 1 {
            Kind::Leaf(part[0])
        } else {
            let axis = longest_axis_of_centers(part.iter().map(of));
            let middle = part.len() / 2;
            let center = |i: &u32| of(i).min[axis] + of(i).max[axis];
            part.select_nth_unstable_by(middle, |a, b| center(a).total_cmp(&center(b)));
            let split = range.start + middle;
            open.push((split..range.end, Some(index)));
            open.push((range.start..split, None));
            Kind::Inner(u32::MAX)
        };
        tree.push(Node::new(aabb, kind));
        attach(tree, parent, index);
    }
}

fn longest_axis_of_centers(boxes: impl Iterator<Item = Aabb>) -> usize {
    let (min, max) = boxes.map(|b| b.min * 0.5 + b.max * 0.5).fold(
        (Vec3::INFINITY, Vec3::NEG_INFINITY),
        |(min, max), center| (min.min(center), max.max(center)),
    );
    (max - min).max_position()
}

/// The tree with subtrees replaced by balanced ones as far down as possible, such that no leaf is more than
/// `height` steps below the root; or a balanced tree where that is impossible.
pub fn limit_height(boxes: &[Aabb], tree: &[Node], height: u32) -> Tree {
    // For each subtree, the number of steps to its deepest leaf and the index after its last node.
    let mut shapes = vec![(0u32, 0u32); tree.len()];
    for (index, node) in tree.iter().enumerate().rev() {
        shapes[index] = match node.kind() {
            Kind::Leaf(_) => (0, index as u32 + 1),
            Kind::Inner(right) => {
                let (left, right) = (shapes[index + 1], shapes[right as usize]);
                (1 + left.0.max(right.0), right.1)
            }
        };
    }
    // The least height of a tree over the leaves of a subtree.
    let least = |index: u32| {
        let count = (shapes[index as usize].1 - index).div_ceil(2);
        count.next_power_of_two().ilog2()
    };
    let mut limited = Vec::with_capacity(tree.len());
    let mut open = vec![(0u32, height, None)];
    while let Some((source, left, parent)) = open.pop() {
        let index = limited.len() as u32;
        let (tall, end) = shapes[source as usize];
        let part = &tree[source as usize..end as usize];
        match part[0].kind() {
            _ if tall <= left => limited.extend(part.iter().map(|node| {
                let kind = match node.kind() {
                    Kind::Inner(right) => Kind::Inner(right - source + index),
                    leaf => leaf,
                };
                Node::new(node.aabb, kind)
            })),
            Kind::Inner(right) if least(source + 1).max(least(right)) < left => {
                limited.push(part[0]);
                open.push((right, left - 1, Some(index)));
                open.push((source + 1, left - 1, None));
            }
            _ => {
                let mut leaves: Vec<_> = (part.iter())
                    .filter_map(|node| match node.kind() {
                        Kind::Leaf(index) => Some(index),
                        Kind::Inner(_) => None,
                    })
                    .collect();
                halve(boxes, &mut leaves, &mut limited);
            }
        }
        attach(&mut limited, parent, index);
    }
    Tree::undivided(limited)
}
