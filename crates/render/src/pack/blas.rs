//! Bottom-level acceleration structures (BLAS): the topology over a mesh is built once in object space, and
//! refitted to the position at which the mesh is baked.

use super::{
    divided::Divided,
    features::OutsideTree,
    geometry::{self, Flat, PlacedMesh},
    nodes::{self, Children, Offsets},
    shape_pieces,
    topology::{Fit, PIECES, Topology, build, leaf_range},
    triangle_pieces,
};
use crate::{
    bvh::{Aabb, Child, StackNeed, threads},
    layout::{
        LEAF, MOVING, PackedNode, PackedShape, PackedTangent, PackedTriangle, PackedVertex, SHAPE,
        leaf_reference,
    },
};
use std::{collections::BinaryHeap, sync::Arc};

/// Maximum number of parts into which one BVH is opened.
pub const MAX_PARTS: usize = 64;

/// A BLAS with its offsets in the arrays of a scene.
#[derive(Clone, Debug)]
pub struct Blas {
    pub offsets: Offsets,
    pub nodes: Arc<[PackedNode]>,
    /// In leaf order, then those in several leaves or in none.
    pub triangles: Arc<[PackedTriangle]>,
    /// Shapes in leaf order, then those in several leaves or in none.
    pub shapes: Arc<[PackedShape]>,
    /// In mesh order.
    pub vertices: Arc<[PackedVertex]>,
    /// One for each vertex; empty if there is none.
    pub tangents: Arc<[PackedTangent]>,
    /// The most entries on the stack of a walk.
    pub stack_need: StackNeed,
    /// Whether its topology is a draft.
    pub is_draft: bool,
    /// How often each node is in `nodes`, in a row: more than once if the mesh moves between several positions.
    key_count: u32,
    /// The children of nodes near the root, with exact boxes, by node index in the BLAS.
    top: Vec<(u32, Children)>,
}

impl Blas {
    /// The BLAS of one mesh, with boxes for its position.
    pub fn refitted(topology: &Topology, placed: PlacedMesh, offsets: Offsets) -> Self {
        let triangles = topology.triangles(&placed);
        let fit = Fit::new(topology, &triangles);
        Self::of(&[fit], (placed.vertices, placed.tangents), offsets)
    }

    /// The BLAS of one mesh, with the triangles of the first of several positions between which it moves; each
    /// node is there with its boxes at each of them. Triangles move linearly from one position to the next, so
    /// that they are inside the interpolated boxes.
    pub fn of(
        fits: &[Fit],
        (vertices, tangents): (Arc<[PackedVertex]>, Arc<[PackedTangent]>),
        offsets: Offsets,
    ) -> Self {
        let topology = fits[0].topology;
        let key_count = fits.len() as u32;
        let node = |index: u32| match key_count {
            1 => offsets.node + index,
            _ => (offsets.node + key_count * index) | MOVING,
        };
        let zero = Offsets::default();
        let leaf = |reference: u32| match reference & SHAPE {
            0 => offsets.moved(reference, &zero),
            _ => {
                let piece = &topology.pieces[leaf_range(reference).start];
                leaf_reference(offsets.triangle + piece.triangle, 1, false)
            }
        };
        let swept = |index: usize| {
            let keys = fits.iter().map(|fit| fit.children(index, node, leaf));
            keys.reduce(|all, key| all.union(&key))
                .unwrap_or(Children::NONE)
        };
        let count = topology.children.len() * fits.len();
        let mut blas = Self {
            offsets,
            key_count,
            nodes: threads::collect_shared(count, |place| {
                let (index, key) = (place / fits.len(), place % fits.len());
                nodes::quantize(fits[key].children(index, node, leaf).as_slice())
            }),
            top: Vec::new(),
            shapes: Arc::default(),
            vertices,
            tangents,
            stack_need: topology.stack_need,
            is_draft: topology.is_draft,
            triangles: fits[0].triangles.clone(),
        };
        blas.top = top_of(|reference| blas.index_of(reference), swept);
        blas
    }

    /// One BLAS over several meshes and shapes, excluding those of the kind `apart`.
    pub fn joint(
        flat: Flat,
        outside_tree: OutsideTree,
        stack_size: usize,
        offsets: Offsets,
    ) -> Self {
        let corners = |triangle: u32| geometry::corners(&flat.triangles[triangle as usize]);
        let boxes = flat.triangles.iter().map(geometry::triangle_box);
        let triangles = match outside_tree {
            OutsideTree::Triangles => Divided::apart(flat.triangles.len()),
            _ => triangle_pieces::divide_all(boxes.collect(), corners),
        };
        let boxes = flat.bounded.iter().map(|(_, bounds)| *bounds);
        let shapes = match outside_tree {
            OutsideTree::Shapes => Divided::apart(flat.bounded.len()),
            _ => shape_pieces::divide_all(boxes.collect(), flat.pieces),
        };
        let bvh = build(&triangles, &shapes, stack_size);
        let pieces = &bvh.order[usize::from(PIECES)];
        let reference = |child: &Child| match *child {
            Child::Leaf { group, first, .. } if group == PIECES => {
                let place = pieces[first as usize] as usize;
                match place.checked_sub(triangles.boxes.len()) {
                    None => {
                        let piece = &triangles.pieces[triangles.piece(place)];
                        leaf_reference(offsets.triangle + piece.triangle, 1, false)
                    }
                    Some(place) => {
                        let piece = &shapes.pieces[shapes.piece(place)];
                        leaf_reference(offsets.shape + piece.shape, 1, true)
                    }
                }
            }
            _ => offsets.reference(child),
        };
        let children_of = |index: usize| {
            let children = bvh.nodes[index].children.iter();
            Children::new(children.map(|(aabb, child)| (*aabb, reference(child))))
        };
        let boxes_of = |group: u8| bvh.order[usize::from(group)].iter().copied();
        let triangle_order = triangles.order(boxes_of(nodes::TRIANGLES));
        let first_shape = triangles.boxes.len() as u32;
        let shape_order = shapes.order(boxes_of(nodes::SHAPES).map(|place| place - first_shape));
        Self {
            offsets,
            nodes: (0..bvh.nodes.len())
                .map(|index| nodes::quantize(children_of(index).as_slice()))
                .collect(),
            triangles: (triangle_order.iter().map(|&i| flat.triangles[i as usize])).collect(),
            shapes: (shape_order.iter().map(|&i| flat.bounded[i as usize].0)).collect(),
            vertices: flat.vertices.into(),
            tangents: flat.tangents.into(),
            stack_need: bvh.stack_need,
            is_draft: false,
            key_count: 1,
            top: top_of(|reference| reference - offsets.node, children_of),
        }
    }

    /// The BLAS moved to other offsets.
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

    /// Whether its BVH has no primitives.
    pub fn is_empty(&self) -> bool {
        self.top[0].1.as_slice().is_empty()
    }

    /// Child reference to its root.
    pub fn root(&self) -> u32 {
        match self.top[0].1.as_slice() {
            [(_, only)] => *only,
            _ if self.key_count > 1 => self.offsets.node | MOVING,
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

    /// The index in the BLAS of the node that a reference leads to.
    fn index_of(&self, reference: u32) -> u32 {
        (reference & !MOVING).wrapping_sub(self.offsets.node) / self.key_count
    }

    /// The children of a node near the root; `None` for nodes further down.
    fn children(&self, reference: u32) -> Option<&Children> {
        let index = self.index_of(reference);
        let known = self.top.iter().find(|(known, _)| *known == index);
        known.map(|(_, children)| children)
    }
}

/// The children of the root, and of the nodes that are opened until there are [`MAX_PARTS`] parts.
fn top_of(
    index_of: impl Fn(u32) -> u32,
    children_of: impl Fn(usize) -> Children,
) -> Vec<(u32, Children)> {
    let root = children_of(0);
    let mut top = vec![(0, root)];
    let mut parts = Parts::new(MAX_PARTS);
    root.as_slice().iter().for_each(|part| parts.add(0, *part));
    parts.open_all(|_, reference| {
        let index = index_of(reference);
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
