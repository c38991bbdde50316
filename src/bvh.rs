//! Bounding volume hierarchies over boxes, for four-way traversal.
//!
//! The builder knows boxes and the group that each belongs to, not what is in them: the caller
//! arranges its primitives in the order that [`Bvh`] gives back. `obvhs` makes a binary tree
//! (PLOC, then reinsertion), `wide` collapses it.

mod binary;
mod wide;

pub use wide::{Child, WideNode};

use glam::Vec3;

/// An axis-aligned box; `min` ≤ `max` in every component, both finite, but for [`Aabb::EMPTY`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Aabb {
    /// Lower corner.
    pub min: Vec3,
    /// Upper corner.
    pub max: Vec3,
}

impl Aabb {
    /// The box round nothing, which adds nothing to a union.
    pub const EMPTY: Self = Self {
        min: Vec3::INFINITY,
        max: Vec3::NEG_INFINITY,
    };

    /// The smallest box round three points.
    pub fn of([a, b, c]: [Vec3; 3]) -> Self {
        Self {
            min: a.min(b).min(c),
            max: a.max(b).max(c),
        }
    }

    /// The smallest box round both.
    pub fn union(self, other: Self) -> Self {
        Self {
            min: self.min.min(other.min),
            max: self.max.max(other.max),
        }
    }

    /// Half of the surface area; a ray's chance to meet the box is in proportion to it.
    pub fn half_area(self) -> f32 {
        let d = self.max - self.min;
        d.x * d.y + d.y * d.z + d.z * d.x
    }
}

/// A tree of four-way nodes. Node 0 is the root; without boxes it has no children.
#[derive(Clone, Debug)]
pub struct Bvh {
    /// At least one.
    pub nodes: Vec<WideNode>,
    /// For each group, the indices of its boxes in leaf order.
    pub order: Vec<Vec<u32>>,
    /// The most entries that a traversal's stack can hold at a time, children pushed far to near.
    pub stack_need: usize,
}

/// What the tree is to look like.
#[derive(Clone, Copy, Debug)]
pub struct Limits {
    /// Most boxes in a leaf; all of them are of one group.
    pub leaf_size: u32,
    /// Bound on [`Bvh::stack_need`]. A tree that would exceed it is built again, balanced.
    pub stack_size: usize,
}

/// Builds a tree over `boxes`; `groups[i]` < `group_count` is the group of box i.
///
/// # Panics
/// If the two slices differ in length.
pub fn build(boxes: &[Aabb], groups: &[u8], group_count: usize, limits: Limits) -> Bvh {
    assert_eq!(boxes.len(), groups.len());
    let bvh = wide::collapse(&binary::build(boxes), groups, group_count, limits.leaf_size);
    if bvh.stack_need <= limits.stack_size {
        return bvh;
    }
    wide::collapse(
        &binary::build_balanced(boxes),
        groups,
        group_count,
        limits.leaf_size,
    )
}
