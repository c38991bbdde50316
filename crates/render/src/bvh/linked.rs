//! Binary trees under construction: siblings are neighbours, and every node knows its parent.

use bytemuck::Zeroable;
use glam::{Vec3, Vec3A};

/// In [`Node::link`]: the node is a leaf, and the other bits are the index of its box.
pub const LEAF: u32 = 1 << 31;

/// A node. Node 0 is the root; its parent is 0.
#[derive(Clone, Copy, Debug, Default, Zeroable)]
#[repr(C, align(16))]
pub struct Node {
    min: Vec3,
    /// The first of its two children, or [`LEAF`] with the index of a box.
    pub link: u32,
    max: Vec3,
    pub parent: u32,
}

/// A box in SIMD registers.
#[derive(Clone, Copy, Debug, Default, Zeroable)]
pub struct Box4 {
    pub min: Vec3A,
    pub max: Vec3A,
}

impl Box4 {
    #[inline(always)]
    pub fn union(&self, other: &Self) -> Self {
        Self {
            min: self.min.min(other.min),
            max: self.max.max(other.max),
        }
    }

    /// Half of the surface area, at most the largest finite number.
    #[inline(always)]
    pub fn half_area(&self) -> f32 {
        let d = self.max - self.min;
        (d.x * d.y + d.y * d.z + d.z * d.x).min(f32::MAX)
    }
}

impl PartialEq for Box4 {
    fn eq(&self, other: &Self) -> bool {
        (self.min, self.max) == (other.min, other.max)
    }
}

impl Node {
    #[inline(always)]
    pub fn new(aabb: &Box4, link: u32) -> Self {
        Self {
            min: aabb.min.into(),
            link,
            max: aabb.max.into(),
            parent: 0,
        }
    }

    #[inline(always)]
    pub fn aabb(&self) -> Box4 {
        Box4 {
            min: self.min.into(),
            max: self.max.into(),
        }
    }

    pub fn set_aabb(&mut self, aabb: &Box4) {
        (self.min, self.max) = (aabb.min.into(), aabb.max.into());
    }

    #[inline(always)]
    pub fn is_leaf(&self) -> bool {
        self.link & LEAF != 0
    }
}

/// The sibling of a node that is not the root. Left siblings have odd indices.
#[inline(always)]
pub fn sibling(node: u32) -> u32 {
    ((node + 1) ^ 1) - 1
}

/// Sets the parents of all nodes.
pub fn link_parents(nodes: &mut [Node]) {
    for index in 0..nodes.len() {
        if !nodes[index].is_leaf() {
            let first = nodes[index].link as usize;
            nodes[first].parent = index as u32;
            nodes[first + 1].parent = index as u32;
        }
    }
}
