//! Nodes as the shader's `decode_node` reads them: 64 bytes, box planes as 8-bit steps from a
//! common corner (after Ylitie, Karras, Laine, Efficient Incoherent Ray Traversal on GPUs Through
//! Compressed Wide BVHs, 2017).

use crate::{
    bvh::{Child, WideNode},
    layout::{PackedNode, leaf_reference},
};
use glam::Vec3;

/// The groups of boxes that do not share leaves.
pub const TRIANGLES: u8 = 0;
pub const SHAPES: u8 = 1;
pub const GROUP_COUNT: usize = 2;

/// Planes move outwards by this share of the node's size, which is more than the shader's slab test
/// rounds off when the ray starts inside the node.
const SLACK: f64 = 1.0 / (1 << 20) as f64;

/// Packs one node, whose children get the references that the function gives. Every quantised box
/// contains its exact one.
pub fn quantize(node: &WideNode, reference: impl Fn(&Child) -> u32) -> PackedNode {
    let (lo, hi) = node.children.iter().fold(
        (Vec3::INFINITY, Vec3::NEG_INFINITY),
        |(lo, hi), (aabb, _)| (lo.min(aabb.min), hi.max(aabb.max)),
    );
    let mut words = [0; 16];
    if node.children.is_empty() {
        return words;
    }
    for axis in 0..3 {
        let (base, scale, planes) = quantize_axis(node, axis, lo[axis], hi[axis]);
        words[axis] = base.to_bits();
        words[3 + axis] = scale.to_bits();
        words[6 + 2 * axis] = u32::from_le_bytes(planes.map(|[min, _]| min));
        words[7 + 2 * axis] = u32::from_le_bytes(planes.map(|[_, max]| max));
    }
    for (i, (_, child)) in node.children.iter().enumerate() {
        words[12 + i] = reference(child);
    }
    words
}

/// The reference to a leaf whose group's primitives begin at `offset`.
pub fn leaf(leaf: &Child, offset: u32) -> u32 {
    match *leaf {
        Child::Leaf {
            group,
            first,
            count,
        } => leaf_reference(offset + first, count, group == SHAPES),
        Child::Node(index) => index,
    }
}

/// Corner, step and for each child the numbers of its lower and upper plane.
fn quantize_axis(node: &WideNode, axis: usize, lo: f32, hi: f32) -> (f32, f32, [[u8; 2]; 4]) {
    let slack = f64::from(hi - lo) * SLACK;
    let base = ((f64::from(lo) - slack) as f32).next_down();
    let scale = (((f64::from(hi) + slack - f64::from(base)) / 255.0) as f32).next_up();
    let mut planes = [[0; 2]; 4];
    for (i, (aabb, _)) in node.children.iter().enumerate() {
        let steps = |plane: f64| (plane - f64::from(base)) / f64::from(scale);
        // Both lie in 0..=255 by the choice of base and scale.
        planes[i] = [
            steps(f64::from(aabb.min[axis]) - slack).floor() as u8,
            steps(f64::from(aabb.max[axis]) + slack).ceil() as u8,
        ];
    }
    (base, scale, planes)
}
