//! Bottom-level acceleration structures (BLAS): the topology over a mesh is built once in object space, and
//! refitted to the position at which the mesh is baked.

use super::{
    geometry::{self, Flat},
    nodes::{self, Children, Offsets},
};
use crate::{
    bvh::{self, Aabb},
    layout::{
        LEAF, LEAF_COUNT_MASK, LEAF_COUNT_SHIFT, LEAF_FIRST_MASK, PackedNode, PackedShape,
        PackedTriangle, PackedVertex,
    },
    scene::Mesh,
};
use std::{collections::BinaryHeap, sync::Arc};

/// Maximum number of primitives in a leaf.
const LEAF_SIZE: u32 = 4;

/// Stack limit of BVHs below another one, which leaves room for it.
pub const STACK_BELOW: usize = 60;

/// Maximum number of parts into which one BVH is opened.
pub const MAX_PARTS: usize = 64;

/// The assignment of the triangles of a mesh to leaves, without boxes, which depend on the position.
#[derive(Debug)]
pub struct Topology {
    /// Child references of each node, for offsets of 0. Children come after their parents.
    children: Vec<[u32; 4]>,
    /// Triangles of the mesh in leaf order.
    order: Vec<u32>,
    stack_need: usize,
}

impl Topology {
    pub fn build(mesh: &Mesh) -> Self {
        // Scaling by a power of two does not change the BVH, but keeps areas in range.
        let largest =
            (mesh.positions.iter()).fold(0.0, |most: f32, p| most.max(p.abs().max_element()));
        let scale = (-largest.log2().floor()).clamp(-126.0, 126.0).exp2();
        let corner = |i: u32| mesh.positions[i as usize] * scale;
        let boxes: Vec<_> = (mesh.triangles.iter())
            .map(|&[a, b, c]| Aabb::of([corner(a), corner(b), corner(c)]))
            .collect();
        let bvh = bvh::build(&boxes, &vec![nodes::TRIANGLES; boxes.len()], 1, limits());
        let offsets = Offsets::default();
        let references = |node: &bvh::WideNode| {
            let mut references = [0; 4];
            for (slot, (_, child)) in references.iter_mut().zip(&node.children) {
                *slot = offsets.reference(child);
            }
            references
        };
        Self {
            children: bvh.nodes.iter().map(references).collect(),
            order: bvh.order.into_iter().next().unwrap_or_default(),
            stack_need: bvh.stack_need,
        }
    }
}

fn limits() -> bvh::Limits {
    bvh::Limits {
        leaf_size: LEAF_SIZE,
        stack_size: STACK_BELOW,
    }
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
    /// The BLAS of one mesh, whose geometry is in `flat`, with refitted boxes.
    pub fn refitted(topology: &Topology, flat: Flat, offsets: Offsets) -> Self {
        let triangles: Arc<[_]> = (topology.order.iter())
            .map(|&i| flat.triangles[i as usize])
            .collect();
        let boxes: Vec<_> = triangles.iter().map(geometry::triangle_box).collect();
        let mut bounds = vec![Aabb::EMPTY; topology.children.len()];
        let mut packed = vec![PackedNode::default(); topology.children.len()];
        let zero = Offsets::default();
        let children_of = |bounds: &[Aabb], index: usize| {
            let references = topology.children[index].iter().filter(|r| **r != 0);
            Children::new(references.map(|&reference| {
                let aabb = match reference & LEAF {
                    0 => bounds[reference as usize],
                    _ => boxes[leaf_range(reference)]
                        .iter()
                        .fold(Aabb::EMPTY, |all, one| all.union(*one)),
                };
                (aabb, offsets.moved(reference, &zero))
            }))
        };
        for index in (0..packed.len()).rev() {
            let children = children_of(&bounds, index);
            bounds[index] = children.bounds();
            packed[index] = nodes::quantize(children.as_slice());
        }
        Self {
            offsets,
            nodes: packed.into(),
            triangles,
            shapes: Arc::default(),
            vertices: flat.vertices.into(),
            stack_need: topology.stack_need,
            top: top_of(&offsets, |index| children_of(&bounds, index)),
        }
    }

    /// One BLAS over several meshes and shapes.
    pub fn joint(flat: Flat, stack_size: usize, offsets: Offsets) -> Self {
        let boxes: Vec<_> = (flat.triangles.iter().map(geometry::triangle_box))
            .chain(flat.bounded.iter().map(|(_, bounds)| *bounds))
            .collect();
        let count = flat.triangles.len();
        let mut groups = vec![nodes::TRIANGLES; count];
        groups.resize(boxes.len(), nodes::SHAPES);
        let limits = bvh::Limits {
            stack_size,
            ..limits()
        };
        let bvh = bvh::build(&boxes, &groups, nodes::GROUP_COUNT, limits);
        let order = |group: u8| bvh.order[group as usize].iter().map(|&i| i as usize);
        let children_of = |index: usize| Children::of(&bvh.nodes[index], &offsets);
        Self {
            offsets,
            nodes: (0..bvh.nodes.len())
                .map(|index| nodes::quantize(children_of(index).as_slice()))
                .collect(),
            triangles: order(nodes::TRIANGLES).map(|i| flat.triangles[i]).collect(),
            shapes: (order(nodes::SHAPES))
                .map(|i| flat.bounded[i - count].0)
                .collect(),
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
