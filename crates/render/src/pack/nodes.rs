//! Packs nodes in the format of `decode_node`: 64 bytes, box planes as 8-bit steps from a common corner (after
//! Ylitie, Karras, Laine, Efficient Incoherent Ray Traversal on GPUs Through Compressed Wide BVHs, 2017).

use crate::{
    bvh::{Aabb, Child},
    layout::{FloatNode, LEAF, LEAF_FIRST_MASK, PackedNode, SHAPE, leaf_reference},
};
use glam::Vec3;

/// Groups of primitives that do not share leaves.
pub const TRIANGLES: u8 = 0;
pub const SHAPES: u8 = 1;
pub const GROUP_COUNT: usize = 2;

/// Planes are moved outwards by this fraction of the node size, which exceeds the rounding error of the slab
/// test for rays that start inside the node.
const SLACK: f64 = 1.0 / (1 << 20) as f64;

/// The offsets of the nodes, triangles, shapes and vertices of a BLAS in the arrays of the scene.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Offsets {
    pub node: u32,
    pub triangle: u32,
    pub shape: u32,
    pub vertex: u32,
}

impl Offsets {
    /// The packed reference to a child.
    pub fn reference(&self, child: &Child) -> u32 {
        match *child {
            Child::Node(index) => self.node + index,
            Child::Leaf {
                group,
                first,
                count,
            } => {
                let is_shape = group == SHAPES;
                let offset = if is_shape { self.shape } else { self.triangle };
                leaf_reference(offset + first, count, is_shape)
            }
        }
    }

    /// Converts a reference of a BLAS at the offsets `from` to these offsets.
    pub fn moved(&self, reference: u32, from: &Self) -> u32 {
        if reference == 0 {
            return 0;
        }
        if reference & LEAF == 0 {
            return reference - from.node + self.node;
        }
        let (own, other) = match reference & SHAPE {
            0 => (self.triangle, from.triangle),
            _ => (self.shape, from.shape),
        };
        let first = reference & LEAF_FIRST_MASK;
        (reference & !LEAF_FIRST_MASK) | (first - other + own)
    }
}

/// The up to four children of a node: boxes and references.
#[derive(Clone, Copy, Debug)]
pub struct Children {
    list: [(Aabb, u32); 4],
    count: usize,
}

impl Children {
    /// No children.
    pub const NONE: Self = Self {
        list: [(Aabb::EMPTY, 0); 4],
        count: 0,
    };

    pub fn new(children: impl Iterator<Item = (Aabb, u32)>) -> Self {
        let mut all = Self::NONE;
        for child in children {
            all.list[all.count] = child;
            all.count += 1;
        }
        all
    }

    /// The children, each in a box round both of its own.
    pub fn union(mut self, other: &Self) -> Self {
        for ((aabb, _), (own, _)) in self.list.iter_mut().zip(&other.list) {
            *aabb = aabb.union(*own);
        }
        self
    }

    pub fn map_references(&mut self, map: impl Fn(u32) -> u32) {
        let own = self.list[..self.count].iter_mut();
        own.for_each(|(_, reference)| *reference = map(*reference));
    }

    pub fn as_slice(&self) -> &[(Aabb, u32)] {
        &self.list[..self.count]
    }

    /// The bounding box of all children.
    pub fn bounds(&self) -> Aabb {
        let boxes = self.as_slice().iter();
        boxes.fold(Aabb::EMPTY, |all, (aabb, _)| all.union(*aabb))
    }
}

/// Packs one node. Every quantised box contains the exact one.
pub fn quantize(children: &[(Aabb, u32)]) -> PackedNode {
    let (lo, hi) = children.iter().fold(
        (Vec3::INFINITY, Vec3::NEG_INFINITY),
        |(lo, hi), (aabb, _)| (lo.min(aabb.min), hi.max(aabb.max)),
    );
    let mut words = [0; 16];
    if children.is_empty() {
        return words;
    }
    for axis in 0..3 {
        let (base, scale, planes) = quantize_axis(children, axis, lo[axis], hi[axis]);
        words[axis] = base.to_bits();
        words[3 + axis] = scale.to_bits();
        words[6 + 2 * axis] = u32::from_le_bytes(planes.map(|[min, _]| min));
        words[7 + 2 * axis] = u32::from_le_bytes(planes.map(|[_, max]| max));
    }
    for (i, (_, reference)) in children.iter().enumerate() {
        words[12 + i] = *reference;
    }
    words
}

/// Where the planes of an absent child are, beyond all coordinates: the lower ones there, the upper ones opposite, so that no
/// ray is inside.
const ABSENT: f32 = 1e16;

/// The node with planes as floats, of boxes that contain those of `node`.
pub fn with_float_planes(node: &PackedNode) -> FloatNode {
    let mut words = [0; 28];
    for axis in 0..3 {
        let [base, scale] =
            [node[axis], node[3 + axis]].map(|word| f64::from(f32::from_bits(word)));
        let [lower, upper] = [node[6 + 2 * axis], node[7 + 2 * axis]].map(u32::to_le_bytes);
        for child in 0..4 {
            let plane = |step: u8| (base + scale * f64::from(step)) as f32;
            let [low, high] = match node[12 + child] {
                0 => [ABSENT, -ABSENT],
                _ => [
                    plane(lower[child]).next_down(),
                    plane(upper[child]).next_up(),
                ],
            };
            words[8 * axis + child] = low.to_bits();
            words[8 * axis + 4 + child] = high.to_bits();
        }
    }
    words[24..].copy_from_slice(&node[12..]);
    words
}

/// The corner, the step size, and the lower and upper plane of each child. The lowest three bits of the step along x are the number
/// of children.
fn quantize_axis(
    children: &[(Aabb, u32)],
    axis: usize,
    lo: f32,
    hi: f32,
) -> (f32, f32, [[u8; 2]; 4]) {
    let slack = f64::from(hi - lo) * SLACK;
    let base = ((f64::from(lo) - slack) as f32).next_down();
    let scale = (((f64::from(hi) + slack - f64::from(base)) / 255.0) as f32).next_up();
    let scale = match axis {
        0 => f32::from_bits(scale.to_bits().next_multiple_of(8) | children.len() as u32),
        _ => scale,
    };
    let mut planes = [[0; 2]; 4];
    for (i, (aabb, _)) in children.iter().enumerate() {
        let steps = |plane: f64| (plane - f64::from(base)) / f64::from(scale);
        // Both lie in 0..=255 by the choice of base and scale.
        planes[i] = [
            steps(f64::from(aabb.min[axis]) - slack).floor() as u8,
            steps(f64::from(aabb.max[axis]) + slack).ceil() as u8,
        ];
    }
    (base, scale, planes)
}
