//! Binary trees with one box in every leaf.

use super::Aabb;
use glam::Vec3;
use obvhs::{
    Boundable, BvhBuildParams, bvh2::reinsertion::ReinsertionOptimizer, ploc::PlocBuilder,
};

/// PLOC does not handle longer runs well; see [`longest_run`].
const LONGEST_RUN: usize = 256;

/// A node of a binary tree: a box and the contents. Children come after their parent.
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

/// A tree of good quality: PLOC (Meister and Bittner 2018) followed by reinsertion (Meister and Bittner
/// 2017), both by `obvhs`. Empty for no boxes; node 0 is the root.
pub fn build(boxes: &[Aabb]) -> Vec<BinaryNode> {
    if boxes.is_empty() {
        return Vec::new();
    }
    if longest_run(boxes) > LONGEST_RUN {
        return build_balanced(boxes);
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

    // obvhs may order nodes arbitrarily; here children come after parents.
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

/// Length of the longest sequence of neighbours along the Morton curve whose joint boxes all have the
/// same area, or monotonically growing (or shrinking) areas. PLOC merges pairs that are each other's
/// nearest neighbours, and such a sequence has only one: PLOC takes as many passes as the sequence is
/// long and produces a chain. Equal boxes, boxes in a row and nested boxes cause this.
fn longest_run(boxes: &[Aabb]) -> usize {
    let all = boxes[1..].iter().fold(boxes[0], |a, b| a.union(*b));
    let extent = (all.max - all.min).max(Vec3::splat(f32::MIN_POSITIVE));
    let code = |aabb: &Aabb| {
        let center = (aabb.min * 0.5 + aabb.max * 0.5 - all.min) / extent;
        let [x, y, z] = (center * 1023.0).to_array().map(|c| spread_bits(c as u32));
        x | y << 1 | z << 2
    };
    let mut order: Vec<_> = (0u32..)
        .zip(boxes)
        .map(|(i, aabb)| (code(aabb), i))
        .collect();
    order.sort_unstable();
    let areas = order.windows(2).map(|pair| {
        let [a, b] = [pair[0], pair[1]].map(|(_, i)| boxes[i as usize]);
        a.union(b).half_area()
    });
    let (mut rising, mut falling, mut longest, mut last) = (0, 0, 0, 0.0);
    for area in areas {
        rising = if area >= last { rising + 1 } else { 0 };
        falling = if area <= last { falling + 1 } else { 0 };
        longest = longest.max(rising).max(falling);
        last = area;
    }
    longest
}

/// Spreads ten bits out to every third bit.
fn spread_bits(x: u32) -> u32 {
    let x = (x | x << 16) & 0x0300_00ff;
    let x = (x | x << 8) & 0x0300_f00f;
    let x = (x | x << 4) & 0x030c_30c3;
    (x | x << 2) & 0x0924_9249
}

/// A tree of logarithmic depth, by halving along the longest axis of the boxes' centres. For inputs on
/// which PLOC produces a tree that is too deep.
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

/// Records in the parent, if there is one, the index of its left (0) or right (1) child.
fn attach(nodes: &mut [BinaryNode], parent: Option<(usize, u8)>, child: usize) {
    if let Some((parent, side)) = parent
        && let BinaryKind::Inner(left, right) = &mut nodes[parent].kind
    {
        *(if side == 0 { left } else { right }) = child;
    }
}
