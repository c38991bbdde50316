//! Bottom-level acceleration structures (BLAS): the topology over a mesh is built once in object space, and
//! refitted to the position at which the mesh is baked.

use super::{
    geometry::{self, Flat, PlacedMesh},
    nodes::{self, Children, Offsets},
    pieces::{Divided, Piece},
};
use crate::{
    bvh::{self, Aabb, Bvh, Child, threads},
    layout::{
        LEAF, LEAF_COUNT_MASK, LEAF_COUNT_SHIFT, LEAF_FIRST_MASK, PackedNode, PackedShape,
        PackedTriangle, PackedVertex, SHAPE, leaf_reference,
    },
};
use glam::Vec3;
use std::{borrow::Cow, collections::BinaryHeap, sync::Arc};

/// Maximum number of primitives in a leaf.
const LEAF_SIZE: u32 = 4;

/// Stack limit of BVHs below another one, which leaves room for it.
pub const STACK_BELOW: usize = 60;

/// Maximum number of parts into which one BVH is opened.
pub const MAX_PARTS: usize = 64;

/// The group of the pieces of triangles; see [`nodes::TRIANGLES`].
const PIECES: u8 = nodes::GROUP_COUNT as u8;

/// The assignment of the triangles of a mesh to leaves, without boxes, which depend on the position.
#[derive(Debug)]
pub struct Topology {
    /// Child references of each node, for offsets of 0; those to shapes stand for `pieces`. Children come after
    /// their parents.
    children: Vec<[u32; 4]>,
    /// Triangles of the mesh in leaf order, then those in pieces.
    order: Vec<u32>,
    /// Their triangles are places in `order`.
    pieces: Vec<Piece>,
    stack_need: usize,
    /// The cost of traversal in the position that it was built for; see [`cost_of`].
    pub cost: f64,
}

impl Topology {
    pub fn build(positions: &[Vec3], triangles: &[[u32; 3]]) -> Self {
        // Scaling by a power of two does not change the BVH, but keeps areas in range.
        let largest = (positions.iter()).fold(0.0, |most: f32, p| most.max(p.abs().max_element()));
        let scale = (-largest.log2().floor()).clamp(-126.0, 126.0).exp2();
        let corners = |triangle: u32| {
            triangles[triangle as usize].map(|corner| positions[corner as usize] * scale)
        };
        let boxes = threads::collect(triangles.len(), |triangle| {
            Aabb::of(corners(triangle as u32))
        });
        let divided = Divided::new(boxes, corners);
        let bvh = build(&divided, &[], STACK_BELOW);
        let offsets = Offsets::default();
        let reference = |child: &Child| match *child {
            Child::Leaf { group, first, .. } if group == PIECES => {
                let piece = divided.piece(bvh.order[usize::from(PIECES)][first as usize]);
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
        let bounds = bvh.nodes.iter().map(|node| {
            let boxes = node.children.iter().map(|(aabb, _)| *aabb);
            boxes.fold(Aabb::EMPTY, Aabb::union)
        });
        Self {
            cost: cost_of(bounds),
            children: bvh.nodes.iter().map(references).collect(),
            order: divided.order(&bvh.order[usize::from(nodes::TRIANGLES)]),
            pieces: divided.pieces,
            stack_need: bvh.stack_need,
        }
    }

    /// The triangles of a mesh in leaf order.
    pub fn triangles(&self, placed: &PlacedMesh) -> Arc<[PackedTriangle]> {
        threads::collect_shared(self.order.len(), |place| {
            placed.triangle(self.order[place] as usize)
        })
    }
}

/// The number of nodes that a ray visits that hits the root, by the surface area heuristic; `bounds` are those
/// of the nodes, the root's first.
fn cost_of(bounds: impl IntoIterator<Item = Aabb>) -> f64 {
    let mut areas = bounds.into_iter().map(|aabb| f64::from(aabb.half_area()));
    let root = areas.next().unwrap_or(0.0);
    let below: f64 = areas.filter(|area| area.is_finite()).sum();
    match root > 0.0 {
        true => 1.0 + below / root,
        false => 1.0,
    }
}

/// A topology with boxes for the position of a mesh, or for several between which it moves: then the boxes hold
/// at all times, since a triangle moves linearly from each to the next.
pub struct Fit<'a> {
    topology: &'a Topology,
    /// The triangles in leaf order, at each position.
    keys: &'a [Arc<[PackedTriangle]>],
    /// The box of each node.
    bounds: Vec<Aabb>,
}

impl<'a> Fit<'a> {
    pub fn new(topology: &'a Topology, keys: &'a [Arc<[PackedTriangle]>]) -> Self {
        let mut fit = Self {
            topology,
            keys,
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
        cost_of(self.bounds.iter().copied())
    }

    fn leaf_box(&self, reference: u32) -> Aabb {
        let keys = self.keys.iter();
        let boxes = keys.map(|triangles| match reference & SHAPE {
            0 => {
                let boxes = triangles[leaf_range(reference)]
                    .iter()
                    .map(geometry::triangle_box);
                boxes.fold(Aabb::EMPTY, Aabb::union)
            }
            _ => {
                let piece = &self.topology.pieces[leaf_range(reference).start];
                piece.aabb(geometry::corners(&triangles[piece.triangle as usize]))
            }
        });
        boxes.fold(Aabb::EMPTY, Aabb::union)
    }
}

/// A BVH over triangles and the boxes of shapes.
fn build(triangles: &Divided, shapes: &[Aabb], stack_size: usize) -> Bvh {
    let mut groups = vec![nodes::TRIANGLES; triangles.whole_count()];
    groups.resize(triangles.boxes.len(), PIECES);
    groups.resize(triangles.boxes.len() + shapes.len(), nodes::SHAPES);
    let boxes = match shapes {
        [] => Cow::Borrowed(&triangles.boxes),
        _ => Cow::Owned([&triangles.boxes, shapes].concat()),
    };
    let limits = bvh::Limits {
        leaf_size: LEAF_SIZE,
        alone: Some(PIECES),
        stack_size,
    };
    bvh::build(&boxes, &groups, nodes::GROUP_COUNT + 1, limits)
}

/// A BLAS with its offsets in the arrays of a scene.
#[derive(Clone, Debug)]
pub struct Blas {
    pub offsets: Offsets,
    pub nodes: Arc<[PackedNode]>,
    /// In leaf order.
    pub triangles: Arc<[PackedTriangle]>,
    /// In leaf order.
    pub shapes: Arc<[PackedShape]>,
    /// In mesh order.
    pub vertices: Arc<[PackedVertex]>,
    /// Maximum number of stack entries during traversal.
    pub stack_need: usize,
    /// The children of nodes near the root, with exact boxes, by node index in the BLAS.
    top: Vec<(u32, Children)>,
}

impl Blas {
    /// The BLAS of one mesh, with boxes for its position.
    pub fn refitted(topology: &Topology, placed: PlacedMesh, offsets: Offsets) -> Self {
        let keys = [topology.triangles(&placed)];
        Self::of(&Fit::new(topology, &keys), placed.vertices, offsets)
    }

    /// The BLAS of one mesh, with the triangles of the first position.
    pub fn of(fit: &Fit, vertices: Arc<[PackedVertex]>, offsets: Offsets) -> Self {
        let Fit {
            topology, bounds, ..
        } = fit;
        let zero = Offsets::default();
        let packed_leaf = |reference: u32| match reference & SHAPE {
            0 => offsets.moved(reference, &zero),
            _ => {
                let piece = &topology.pieces[leaf_range(reference).start];
                leaf_reference(offsets.triangle + piece.triangle, 1, false)
            }
        };
        let children_of = |index: usize| {
            let references = topology.children[index].iter().filter(|r| **r != 0);
            Children::new(references.map(|&reference| match reference & LEAF {
                0 => (bounds[reference as usize], offsets.moved(reference, &zero)),
                _ => (fit.leaf_box(reference), packed_leaf(reference)),
            }))
        };
        Self {
            offsets,
            nodes: threads::collect_shared(topology.children.len(), |index| {
                nodes::quantize(children_of(index).as_slice())
            }),
            top: top_of(&offsets, children_of),
            shapes: Arc::default(),
            vertices,
            stack_need: topology.stack_need,
            triangles: fit.keys[0].clone(),
        }
    }

    /// One BLAS over several meshes and shapes.
    pub fn joint(flat: Flat, stack_size: usize, offsets: Offsets) -> Self {
        let corners = |triangle: u32| geometry::corners(&flat.triangles[triangle as usize]);
        let boxes = flat.triangles.iter().map(geometry::triangle_box);
        let divided = Divided::new(boxes.collect(), corners);
        let shapes: Vec<_> = flat.bounded.iter().map(|(_, bounds)| *bounds).collect();
        let bvh = build(&divided, &shapes, stack_size);
        let reference = |child: &Child| match *child {
            Child::Leaf { group, first, .. } if group == PIECES => {
                let piece = divided.piece(bvh.order[usize::from(PIECES)][first as usize]);
                leaf_reference(offsets.triangle + divided.pieces[piece].triangle, 1, false)
            }
            _ => offsets.reference(child),
        };
        let children_of = |index: usize| {
            let children = bvh.nodes[index].children.iter();
            Children::new(children.map(|(aabb, child)| (*aabb, reference(child))))
        };
        let triangles = divided.order(&bvh.order[usize::from(nodes::TRIANGLES)]);
        let shapes = bvh.order[usize::from(nodes::SHAPES)].iter();
        Self {
            offsets,
            nodes: (0..bvh.nodes.len())
                .map(|index| nodes::quantize(children_of(index).as_slice()))
                .collect(),
            triangles: (triangles.iter().map(|&i| flat.triangles[i as usize])).collect(),
            shapes: (shapes.map(|&i| flat.bounded[i as usize - divided.boxes.len()].0)).collect(),
            vertices: flat.vertices.into(),
            stack_need: bvh.stack_need,
            top: top_of(&offsets, children_of),
        }
    }

    /// The same BLAS at other offsets.
    pub fn moved_to(self: &Arc<Self>, offsets: Offsets) -> Arc<Self> {
        let from = self.offsets;
        if from == offsets {
            return self.clone();
        }
        let reference = |reference: u32| offsets.moved(reference, &from);
        let mut moved = Self::clone(self);
        moved.offsets = offsets;
        if (from.node, from.triangle, from.shape) != (offsets.node, offsets.triangle, offsets.shape)
        {
            let node = |node: &PackedNode| {
                let mut node = *node;
                node[12..].iter_mut().for_each(|r| *r = reference(*r));
                node
            };
            moved.nodes = self.nodes.iter().map(node).collect();
            for (_, children) in &mut moved.top {
                children.map_references(reference);
            }
        }
        if from.vertex != offsets.vertex {
            let vertex = |index: u32| index - from.vertex + offsets.vertex;
            let triangle = |triangle: &PackedTriangle| PackedTriangle {
                i0: vertex(triangle.i0),
                i1: vertex(triangle.i1),
                i2: vertex(triangle.i2),
                ..*triangle
            };
            moved.triangles = self.triangles.iter().map(triangle).collect();
        }
        Arc::new(moved)
    }

    /// The offsets of what follows it.
    pub fn end(&self) -> Offsets {
        Offsets {
            node: self.offsets.node + self.nodes.len() as u32,
            triangle: self.offsets.triangle + self.triangles.len() as u32,
            shape: self.offsets.shape + self.shapes.len() as u32,
            vertex: self.offsets.vertex + self.vertices.len() as u32,
        }
    }

    /// Whether it has no primitives.
    pub fn is_empty(&self) -> bool {
        self.triangles.is_empty() && self.shapes.is_empty()
    }

    /// Child reference to its root.
    pub fn root(&self) -> u32 {
        match self.top[0].1.as_slice() {
            [(_, only)] => *only,
            _ => self.offsets.node,
        }
    }

    /// The bounding box.
    pub fn bounds(&self) -> Aabb {
        self.top[0].1.bounds()
    }

    /// Boxes that together bound it; none if it is empty.
    pub fn boxes(&self) -> Vec<Aabb> {
        match self.is_empty() {
            true => Vec::new(),
            false => (opened([self], MAX_PARTS).into_iter().map(|(aabb, _)| aabb)).collect(),
        }
    }

    /// The children of a node near the root; `None` for nodes further down.
    fn children(&self, reference: u32) -> Option<&Children> {
        let index = reference.wrapping_sub(self.offsets.node);
        let known = self.top.iter().find(|(known, _)| *known == index);
        known.map(|(_, children)| children)
    }
}

/// The primitives of a leaf, for offsets of 0.
fn leaf_range(reference: u32) -> std::ops::Range<usize> {
    let first = (reference & LEAF_FIRST_MASK) as usize;
    first..first + ((reference & LEAF_COUNT_MASK) >> LEAF_COUNT_SHIFT) as usize + 1
}

/// The children of the root, and of the nodes that are opened until there are [`MAX_PARTS`] parts.
fn top_of(offsets: &Offsets, children_of: impl Fn(usize) -> Children) -> Vec<(u32, Children)> {
    let root = children_of(0);
    let mut top = vec![(0, root)];
    let mut parts = Parts::new(MAX_PARTS);
    root.as_slice().iter().for_each(|part| parts.add(0, *part));
    parts.open_all(|_, reference| {
        let index = reference - offsets.node;
        let children = children_of(index as usize);
        top.push((index, children));
        Some(children)
    });
    top
}

/// The boxes near the roots of several BVHs, with their references: the largest node is opened repeatedly,
/// until there are `limit` parts.
pub fn opened<'a>(trees: impl IntoIterator<Item = &'a Blas>, limit: usize) -> Vec<(Aabb, u32)> {
    let trees: Vec<_> = trees.into_iter().collect();
    let mut parts = Parts::new(limit);
    for (index, tree) in trees.iter().enumerate() {
        parts.add(index, (tree.bounds(), tree.root()));
    }
    parts.open_all(|tree, reference| trees[tree].children(reference).copied());
    parts.into_list()
}

/// Parts of BVHs, some of which are replaced by their children.
struct Parts {
    /// Index of the BVH, box and reference of each part; `None` once it is opened.
    list: Vec<Option<(usize, Aabb, u32)>>,
    /// Areas of nodes, as ordered bits, and their list indices.
    nodes: BinaryHeap<(u32, usize)>,
    count: usize,
    limit: usize,
}

impl Parts {
    fn new(limit: usize) -> Self {
        Self {
            list: Vec::new(),
            nodes: BinaryHeap::new(),
            count: 0,
            limit,
        }
    }

    fn add(&mut self, tree: usize, (aabb, reference): (Aabb, u32)) {
        if reference & LEAF == 0 {
            (self.nodes).push((aabb.half_area().to_bits(), self.list.len()));
        }
        self.list.push(Some((tree, aabb, reference)));
        self.count += 1;
    }

    /// Opens the largest node repeatedly. Nodes unknown to `children` stay closed.
    fn open_all(&mut self, mut children: impl FnMut(usize, u32) -> Option<Children>) {
        while let Some((_, index)) = self.nodes.pop() {
            let Some((tree, _, reference)) = self.list[index] else {
                continue;
            };
            let Some(children) = children(tree, reference) else {
                continue;
            };
            let children = children.as_slice();
            if self.count + children.len() > self.limit {
                break;
            }
            self.list[index] = None;
            self.count -= 1;
            children.iter().for_each(|child| self.add(tree, *child));
        }
    }

    fn into_list(self) -> Vec<(Aabb, u32)> {
        let kept = self.list.into_iter().flatten();
        kept.map(|(_, aabb, reference)| (aabb, reference)).collect()
    }
}
