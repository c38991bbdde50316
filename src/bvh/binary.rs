//! Binary trees with one box in every leaf.

use super::Aabb;
use glam::Vec3;
use obvhs::{
    Boundable, BvhBuildParams, bvh2::reinsertion::ReinsertionOptimizer, ploc::PlocBuilder,
};

/// A node of a binary tree: a box and what is below it. Children come after their parent.
#[derive(Clone, Copy, Debug)]
pub struct BinaryNode {
    pub aabb: Aabb,
    pub kind: BinaryKind,
}

#[derive(Clone, Copy, Debug)]
pub enum BinaryKind {
    /// Index of a box.
    Leaf(u32),
    /// Indices of two nodes.
    Inner(usize, usize),
}

impl Boundable for Aabb {
    fn aabb(&self) -> obvhs::aabb::Aabb {
        obvhs::aabb::Aabb::new(self.min.into(), self.max.into())
    }
}

/// A tree of good quality: PLOC (Meister and Bittner 2018) with reinsertion (Meister and Bittner
/// 2017), both by `obvhs`. Empty for no boxes; node 0 is the root.
pub fn build(boxes: &[Aabb]) -> Vec<BinaryNode> {
    if boxes.is_empty() {
        return Vec::new();
    }
    let params = BvhBuildParams::medium_build();
    let mut tree = PlocBuilder::with_capacity(boxes.len()).build(
        params.ploc_search_distance,
        boxes,
        (0..boxes.len() as u32).collect(),
        params.sort_precision,
        params.search_depth_threshold,
    );
    ReinsertionOptimizer::default().run(&mut tree, params.reinsertion_batch_ratio, None);

    // obvhs may leave nodes in any order; ours puts children after parents.
    let mut nodes = Vec::with_capacity(tree.nodes.len());
    let mut open = vec![(0usize, None)];
    while let Some((source, parent)) = open.pop() {
        let node = &tree.nodes[source];
        let index = nodes.len();
        let aabb = Aabb {
            min: node.aabb().min.into(),
            max: node.aabb().max.into(),
        };
        let first = node.first_index as usize;
        let kind = if node.is_leaf() {
            BinaryKind::Leaf(tree.primitive_indices[first])
        } else {
            open.push((first + 1, Some((index, 1))));
            open.push((first, Some((index, 0))));
            BinaryKind::Inner(usize::MAX, usize::MAX)
        };
        nodes.push(BinaryNode { aabb, kind });
        attach(&mut nodes, parent, index);
    }
    nodes
}

/// A tree whose depth is the logarithm of the number of boxes, by halving along the longest axis
/// of their centres. For inputs on which the good builder digs too deep.
pub fn build_balanced(boxes: &[Aabb]) -> Vec<BinaryNode> {
    let mut indices: Vec<u32> = (0..boxes.len() as u32).collect();
    let mut nodes = Vec::with_capacity(2 * boxes.len());
    let mut open = Vec::new();
    if !boxes.is_empty() {
        open.push((0..indices.len(), None));
    }
    while let Some((range, parent)) = open.pop() {
        let part = &mut indices[range.clone()];
        let index = nodes.len();
        let of = |i: &u32| boxes[*i as usize];
        let aabb = part[1..].iter().fold(of(&part[0]), |a, i| a.union(of(i)));
        let kind = if part.len() == 1 {
            BinaryKind::Leaf(part[0])
        } else {
            let axis = longest_axis_of_centers(part.iter().map(of));
            let middle = part.len() / 2;
            let center = |i: &u32| of(i).min[axis] + of(i).max[axis];
            part.select_nth_unstable_by(middle, |a, b| center(a).total_cmp(&center(b)));
            let split = range.start + middle;
            open.push((split..range.end, Some((index, 1))));
            open.push((range.start..split, Some((index, 0))));
            BinaryKind::Inner(usize::MAX, usize::MAX)
        };
        nodes.push(BinaryNode { aabb, kind });
        attach(&mut nodes, parent, index);
    }
    nodes
}

fn longest_axis_of_centers(boxes: impl Iterator<Item = Aabb>) -> usize {
    let (min, max) = boxes.map(|b| b.min * 0.5 + b.max * 0.5).fold(
        (Vec3::INFINITY, Vec3::NEG_INFINITY),
        |(min, max), center| (min.min(center), max.max(center)),
    );
    (max - min).max_position()
}

/// Tells the parent, if there is one, where its left (0) or right (1) child is.
fn attach(nodes: &mut [BinaryNode], parent: Option<(usize, u8)>, child: usize) {
    if let Some((parent, side)) = parent
        && let BinaryKind::Inner(left, right) = &mut nodes[parent].kind
    {
        *(if side == 0 { left } else { right }) = child;
    }
}
