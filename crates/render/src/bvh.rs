//! Bounding volume hierarchies over boxes, for four-way traversal.
//!
//! The builder knows boxes and the group that each belongs to, but not the primitives in them: the caller
//! reorders its primitives by the order in [`Bvh`]. A binary tree is built (`ploc`), improved (`reinsertion`)
//! and collapsed (`wide`). A tree for a first picture is built at once (`linear`).

mod binary;
pub mod linear;
mod linked;
mod morton;
mod ploc;
mod reinsertion;
mod wide;

pub use glimray_scene::threads;
pub use wide::{Child, Children, WideNode};

use binary::Tree;
use bytemuck::Zeroable;
use glam::Vec3;

/// An axis-aligned box; `min` ≤ `max` in every component, both finite, except for [`Aabb::EMPTY`].
#[derive(Clone, Copy, Debug, PartialEq, Zeroable)]
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
    /// The most entries on the stack of a walk.
    pub stack_need: StackNeed,
    /// The number of pairs of boxes that were compared to build it: a measure of time that is the same on every
    /// machine.
    pub work: u64,
}

/// The most entries on the stack of a walk in which every child of every node on the way is hit.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct StackNeed {
    /// With an entry for each child that is still to be visited, pushed far to near, and one that marks the empty stack.
    pub references: usize,
    /// With an entry for each node that has children still to be visited.
    pub nodes: usize,
}

impl StackNeed {
    /// Below a node: each of its `child_count` children may be the first.
    fn below(child_count: usize, children: impl Iterator<Item = Self>) -> Self {
        let below = children.fold(Self::default(), Self::max);
        Self {
            references: below.references + child_count.saturating_sub(1),
            nodes: below.nodes + usize::from(child_count > 1),
        }
    }

    fn with_end(self) -> Self {
        Self {
            references: self.references + 1,
            ..self
        }
    }

    /// The larger of each number.
    pub fn max(self, other: Self) -> Self {
        Self {
            references: self.references.max(other.references),
            nodes: self.nodes.max(other.nodes),
        }
    }
}

impl std::ops::Add for StackNeed {
    type Output = Self;

    fn add(self, other: Self) -> Self {
        Self {
            references: self.references + other.references,
            nodes: self.nodes + other.nodes,
        }
    }
}

/// Constraints on the tree.
#[derive(Clone, Copy, Debug)]
pub struct Limits {
    /// Largest number of boxes in a leaf; all of them belong to one group.
    pub leaf_size: u32,
    /// A group whose boxes are alone in their leaves.
    pub alone: Option<u8>,
    /// Bound on the references of [`Bvh::stack_need`]. The deepest parts of a tree that exceeds it are rebuilt as balanced ones.
    pub stack_size: usize,
}

/// Builds a tree over `boxes`; `groups[i]` < `group_count` is the group of box i.
///
/// # Panics
/// If the two slices differ in length.
pub fn build(boxes: &[Aabb], groups: &[u8], group_count: usize, limits: Limits) -> Bvh {
    assert_eq!(boxes.len(), groups.len());
    let collapsed = |tree: &Tree| wide::collapse(tree, groups, group_count, limits);
    let (tree, work) = binary::build(boxes);
    let mut bvh = collapsed(&tree);
    // Usually a step down the binary tree takes one stack entry, in the worst case three.
    let mut height = limits.stack_size as u32;
    while bvh.stack_need.references > limits.stack_size && height > 0 {
        bvh = collapsed(&binary::limit_height(boxes, &tree.nodes, height));
        height = height * 3 / 4;
    }
    Bvh { work, ..bvh }
}
