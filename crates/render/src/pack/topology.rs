//! The topology of a mesh's BVH, built once in object space, and its boxes for a position of the mesh.

use super::{
    divided::Divided,
    geometry::{self, PlacedMesh},
    nodes::{self, Children, Offsets},
    shape_pieces::ShapePiece,
    triangle_pieces::{self, TrianglePiece},
};
use crate::{
    bvh::{self, Aabb, Bvh, Child, StackNeed, linear, threads},
    layout::{
        LEAF, LEAF_COUNT_MASK, LEAF_COUNT_SHIFT, LEAF_FIRST_MASK, PackedTriangle, SHAPE,
        leaf_reference,
    },
};
use bytemuck::allocation::zeroed_vec;
use glam::Vec3;
use std::{borrow::Cow, sync::Arc};

/// Maximum number of primitives in a leaf.
const LEAF_SIZE: u32 = 4;

/// Stack limit of BVHs below another one, which leaves room for it.
pub const STACK_BELOW: usize = 60;

/// The group of the pieces of triangles and shapes; see [`nodes::TRIANGLES`].
pub const PIECES: u8 = nodes::GROUP_COUNT as u8;

/// The assignment of the triangles of a mesh to leaves, without boxes, which depend on the position.
#[derive(Debug)]
pub struct Topology {
    /// Child references of each node, for offsets of 0; those to shapes stand for `pieces`. Children come after
    /// their parents.
    pub children: Vec<[u32; 4]>,
    /// Triangles of the mesh in leaf order, then those in pieces.
    order: Vec<u32>,
    /// Pieces, whose triangles are places in `order`.
    pub pieces: Vec<TrianglePiece>,
    pub stack_need: StackNeed,
    /// The cost of traversal in the position that it was built for; see [`cost_of`]. Infinite for drafts, whose meshes do
    /// not deform.
    pub cost: f64,
    /// Whether it was built by [`Topology::draft`].
    pub is_draft: bool,
}

impl Topology {
    pub fn build(positions: &[Vec3], triangles: &[[u32; 3]]) -> Self {
        let corners = scaled(positions, triangles);
        let divided = triangle_pieces::divide_all(boxes(triangles.len(), &corners), &corners);
        let bvh = build(&divided, &Divided::NONE, STACK_BELOW);
        let offsets = Offsets::default();
        let reference = |child: &Child| match *child {
            Child::Leaf { group, first, .. } if group == PIECES => {
                let place = bvh.order[usize::from(PIECES)][first as usize];
                let piece = divided.piece(place as usize);
                leaf_reference(piece as u32, 1, true)
            }
            _ => offsets.reference(child),
        };
        let references = |node: &bvh::WideNode| {
            let mut references = [0; 4];
            for (slot, (_, child)) in references.iter_mut().zip(&node.children) {
                *slot = reference(child);
            }
            references
        };
        let areas = threads::collect(bvh.nodes.len(), |index| {
            let boxes = bvh.nodes[index].children.iter().map(|(aabb, _)| *aabb);
            boxes.fold(Aabb::EMPTY, Aabb::union).half_area()
        });
        Self {
            cost: cost_of(areas),
            children: threads::collect(bvh.nodes.len(), |index| references(&bvh.nodes[index])),
            order: divided.order(bvh.order[usize::from(nodes::TRIANGLES)].iter().copied()),
            pieces: divided.pieces,
            stack_need: bvh.stack_need,
            is_draft: false,
        }
    }

    /// One that takes a fraction of the time to build, in which rays take longer; `None` if it would be too deep.
    pub fn draft(positions: &[Vec3], triangles: &[[u32; 3]]) -> Option<Self> {
        let boxes = boxes(triangles.len(), &scaled(positions, triangles));
        let bvh = linear::build(&boxes, STACK_BELOW)?;
        let reference = |child: &Option<Child>| {
            (child.as_ref()).map_or(0, |child| Offsets::default().reference(child))
        };
        Some(Self {
            children: threads::collect(bvh.nodes.len(), |index| {
                bvh.nodes[index].each_ref().map(reference)
            }),
            order: bvh.order,
            pieces: Vec::new(),
            stack_need: bvh.stack_need,
            cost: f64::INFINITY,
            is_draft: true,
        })
    }

    /// The triangles of a mesh in leaf order.
    pub fn triangles(&self, placed: &PlacedMesh) -> Arc<[PackedTriangle]> {
        threads::collect_shared(self.order.len(), |place| {
            placed.triangle(self.order[place] as usize)
        })
    }
}

/// The corners of each triangle. Scaling by a power of two does not change the BVH, but keeps areas in range.
fn scaled(positions: &[Vec3], triangles: &[[u32; 3]]) -> impl Fn(u32) -> [Vec3; 3] + Sync {
    let largest = (positions.iter()).fold(0.0, |most: f32, p| most.max(p.abs().max_element()));
    let scale = (-largest.log2().floor()).clamp(-126.0, 126.0).exp2();
    move |triangle| triangles[triangle as usize].map(|corner| positions[corner as usize] * scale)
}

/// The box of each triangle.
fn boxes(count: usize, corners: &(impl Fn(u32) -> [Vec3; 3] + Sync)) -> Vec<Aabb> {
    let mut boxes = zeroed_vec(count);
    threads::fill(&mut boxes, |triangle| Aabb::of(corners(triangle as u32)));
    boxes
}

/// The number of nodes that a ray visits that hits the root, by the surface area heuristic; `half_areas` are
/// those of the nodes, the root's first.
fn cost_of(half_areas: impl IntoIterator<Item = f32>) -> f64 {
    let mut areas = half_areas.into_iter().map(f64::from);
    let root = areas.next().unwrap_or(0.0);
    let below: f64 = areas.filter(|area| area.is_finite()).sum();
    match root > 0.0 {
        true => 1.0 + below / root,
        false => 1.0,
    }
}

/// A topology with boxes for a position of its mesh.
pub struct Fit<'a> {
    pub topology: &'a Topology,
    /// The triangles in leaf order.
    pub triangles: &'a Arc<[PackedTriangle]>,
    /// The box of each node.
    bounds: Vec<Aabb>,
}

impl<'a> Fit<'a> {
    pub fn new(topology: &'a Topology, triangles: &'a Arc<[PackedTriangle]>) -> Self {
        let mut fit = Self {
            topology,
            triangles,
            bounds: Vec::new(),
        };
        // First the leaves of each node, then the nodes below it, which come after it.
        let mut bounds = threads::collect(topology.children.len(), |index| {
            let leaves = topology.children[index].iter().filter(|r| **r & LEAF != 0);
            leaves.fold(Aabb::EMPTY, |all, &leaf| all.union(fit.leaf_box(leaf)))
        });
        for (index, children) in topology.children.iter().enumerate().rev() {
            for &node in children.iter().filter(|r| **r != 0 && **r & LEAF == 0) {
                bounds[index] = bounds[index].union(bounds[node as usize]);
            }
        }
        fit.bounds = bounds;
        fit
    }

    /// See [`cost_of`].
    pub fn cost(&self) -> f64 {
        cost_of(self.bounds.iter().map(|aabb| aabb.half_area()))
    }

    /// The boxes of the children of a node, with references that `node` and `leaf` give for those of the
    /// topology.
    pub fn children(
        &self,
        index: usize,
        node: impl Fn(u32) -> u32,
        leaf: impl Fn(u32) -> u32,
    ) -> Children {
        let references = self.topology.children[index].iter().filter(|r| **r != 0);
        Children::new(references.map(|&reference| match reference & LEAF {
            0 => (self.bounds[reference as usize], node(reference)),
            _ => (self.leaf_box(reference), leaf(reference)),
        }))
    }

    fn leaf_box(&self, reference: u32) -> Aabb {
        match reference & SHAPE {
            0 => {
                let boxes = self.triangles[leaf_range(reference)]
                    .iter()
                    .map(geometry::triangle_box);
                boxes.fold(Aabb::EMPTY, Aabb::union)
            }
            _ => {
                let piece = &self.topology.pieces[leaf_range(reference).start];
                piece.aabb(geometry::corners(&self.triangles[piece.triangle as usize]))
            }
        }
    }
}

/// A BVH over triangles and shapes.
pub fn build(
    triangles: &Divided<TrianglePiece>,
    shapes: &Divided<ShapePiece>,
    stack_size: usize,
) -> Bvh {
    let mut groups = vec![nodes::TRIANGLES; triangles.whole_count()];
    groups.resize(triangles.boxes.len(), PIECES);
    groups.resize(triangles.boxes.len() + shapes.whole_count(), nodes::SHAPES);
    groups.resize(triangles.boxes.len() + shapes.boxes.len(), PIECES);
    let boxes = match shapes.boxes[..] {
        [] => Cow::Borrowed(&triangles.boxes),
        _ => Cow::Owned([&triangles.boxes[..], &shapes.boxes].concat()),
    };
    let limits = bvh::Limits {
        leaf_size: LEAF_SIZE,
        alone: Some(PIECES),
        stack_size,
    };
    bvh::build(&boxes, &groups, nodes::GROUP_COUNT + 1, limits)
}

/// The primitives of a leaf, for offsets of 0.
pub fn leaf_range(reference: u32) -> std::ops::Range<usize> {
    let first = (reference & LEAF_FIRST_MASK) as usize;
    first..first + ((reference & LEAF_COUNT_MASK) >> LEAF_COUNT_SHIFT) as usize + 1
}
