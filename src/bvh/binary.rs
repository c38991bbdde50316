//! Finished binary trees with one box in every leaf.

use super::{Aabb, linked, ploc, reinsertion};
use glam::Vec3;
use std::ops::Range;

/// A node of a tree in depth-first order: an inner node is followed by its left subtree.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Node {
    pub aabb: Aabb,
    pub kind: Kind,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// Index of a box.
    Leaf(u32),
    /// Index of the right child. The left one comes next after the node.
    Inner(u32),
}

/// A tree of good quality, and the number of pairs of boxes that were compared to build it.
pub fn build(boxes: &[Aabb]) -> (Vec<Node>, u64) {
    match boxes.len() {
        0 => return (Vec::new(), 0),
        1 => return (balanced(boxes), 0),
        _ => {}
    }
    let (mut linked, compared) = ploc::build(boxes);
    linked::link_parents(&mut linked);
    let tried = reinsertion::optimize(&mut linked);
    (depth_first(&linked), compared + tried)
}

fn depth_first(linked: &[linked::Node]) -> Vec<Node> {
    let mut tree = Vec::with_capacity(linked.len());
    // Nodes to add, and the parents of right children.
    let mut open = vec![(0, None)];
    while let Some((source, parent)) = open.pop() {
        let node: &linked::Node = &linked[source as usize];
        let index = tree.len() as u32;
        let kind = match node.is_leaf() {
            true => Kind::Leaf(node.link & !linked::LEAF),
            false => {
                open.push((node.link + 1, Some(index)));
                open.push((node.link, None));
                Kind::Inner(u32::MAX)
            }
        };
        let aabb = node.aabb();
        tree.push(Node {
            aabb: Aabb {
                min: aabb.min.into(),
                max: aabb.max.into(),
            },
            kind,
        });
        attach(&mut tree, parent, index);
    }
    tree
}

/// Records the right child of a node.
fn attach(tree: &mut [Node], parent: Option<u32>, right: u32) {
    if let Some(parent) = parent {
        tree[parent as usize].kind = Kind::Inner(right);
    }
}

/// A tree of logarithmic height, by halving along the longest axis of the boxes' centres.
pub fn balanced(boxes: &[Aabb]) -> Vec<Node> {
    let mut tree = Vec::with_capacity(2 * boxes.len());
    let mut indices: Vec<u32> = (0..boxes.len() as u32).collect();
    if !indices.is_empty() {
        halve(boxes, &mut indices, &mut tree);
    }
    tree
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
        tree.push(Node { aabb, kind });
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

/// The same tree with subtrees replaced by balanced ones as far down as possible, such that no leaf is more than
/// `height` steps below the root; or a balanced tree where that is impossible.
pub fn limit_height(boxes: &[Aabb], tree: &[Node], height: u32) -> Vec<Node> {
    // Of each subtree, the number of steps to its deepest leaf and the index after its last node.
    let mut shapes = vec![(0u32, 0u32); tree.len()];
    for (index, node) in tree.iter().enumerate().rev() {
        shapes[index] = match node.kind {
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
        match part[0].kind {
            _ if tall <= left => limited.extend(part.iter().map(|node| Node {
                kind: match node.kind {
                    Kind::Inner(right) => Kind::Inner(right - source + index),
                    leaf => leaf,
                },
                ..*node
            })),
            Kind::Inner(right) if least(source + 1).max(least(right)) < left => {
                limited.push(part[0]);
                open.push((right, left - 1, Some(index)));
                open.push((source + 1, left - 1, None));
            }
            _ => {
                let mut leaves: Vec<_> = (part.iter())
                    .filter_map(|node| match node.kind {
                        Kind::Leaf(index) => Some(index),
                        Kind::Inner(_) => None,
                    })
                    .collect();
                halve(boxes, &mut leaves, &mut limited);
            }
        }
        attach(&mut limited, parent, index);
    }
    limited
}
