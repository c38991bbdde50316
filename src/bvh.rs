//! Bounding volume hierarchies over boxes, for four-way traversal.
//!
//! The builder knows boxes and the group that each belongs to, but not the primitives in them: the caller
//! reorders its primitives by the order in [`Bvh`]. `obvhs` builds a binary tree (PLOC, then
//! reinsertion), and `wide` collapses it.

mod binary;
mod wide;

pub use wide::{Child, WideNode};

use glam::Vec3;

/// An axis-aligned box; `min` ≤ `max` in every component, both finite, except for [`Aabb::EMPTY`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Aabb {
    /// Lower corner.
    pub min: Vec3,
    /// Upper corner.
    pub max: Vec3,
}

impl Aabb {
    /// The empty box, the identity of the union.
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

    /// Half of the surface area, which is proportional to the probability that a ray hits the box.
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
    /// The largest number of entries on a traversal's stack when children are pushed far to near.
    pub stack_need: usize,
}

/// Constraints on the tree.
#[derive(Clone, Copy, Debug)]
pub struct Limits {
    /// Largest number of boxes in a leaf; all of them belong to one group.
    pub leaf_size: u32,
    /// Bound on [`Bvh::stack_need`]. A tree that exceeds it is rebuilt as a balanced tree.
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
