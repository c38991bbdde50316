//! Deforming meshes: for each view their triangles, vertices and boxes in the pose of its frames. The topology of
//! a BLAS is kept and its boxes are refitted, unless that would make it slow. A view depends on nothing but the
//! scene and its frames: whether a BLAS is rebuilt never depends on earlier views.

use super::{
    PackError, PackedScene, PackedView,
    blas::Blas,
    geometry::PlacedMesh,
    instance::{InstancedBlas, Plan, tree_origin},
    mesh::CachedMesh,
    nodes::Offsets,
    topology::{Fit, Topology},
    trees::Trees,
};
use crate::{
    bvh::StackNeed,
    layout::{PackedNode, PackedShape, PackedTangent, PackedTriangle, PackedVertex},
};
use bytemuck::cast_slice;
use glam::{DVec3, Vec3};
use glimray_scene::{Deformation, Frame, Pose, Scene};
use std::sync::Arc;

/// A BLAS is rebuilt if its cost exceeds that of the mesh at rest by this factor.
const POOR: f64 = 2.0;

/// The shutter interval has at most this many keys: a power of two, and one.
const MAX_KEYS: usize = 17;

/// Keys together take at most this many bytes, if two suffice for that.
const MAX_KEY_BYTES: usize = 256 << 20;

/// Rows of 16 bytes of a triangle and of a shape.
const TRIANGLE_ROWS: usize = size_of::<PackedTriangle>() / 16;
const SHAPE_ROWS: usize = size_of::<PackedShape>() / 16;

/// A mesh that deforms.
#[derive(Clone, Debug)]
pub struct DeformingMesh {
    /// Index of its deformation in the scene.
    index: usize,
    deformation: Deformation,
    mesh: Arc<CachedMesh>,
    /// Index among the instanced BLASes.
    tree: usize,
    /// Offsets of the rest-pose triangles and vertices; a view overrides them.
    offsets: Offsets,
    /// The origin of the space of its BLAS.
    origin: DVec3,
    /// Rows of each vertex of later keys: with its tangent if the scene has tangents.
    key_stride: usize,
}

/// The deforming meshes of a view.
#[derive(Debug, Default)]
pub struct Deformed {
    pub trees: Vec<Arc<DeformedTree>>,
    /// Number of keys over the shutter interval; 1 if no mesh deforms meanwhile.
    pub key_count: u32,
}

/// The BLAS of a deforming mesh.
#[derive(Debug)]
pub struct DeformedTree {
    /// Index among the instanced BLASes.
    tree: usize,
    /// One pose, or one for each key.
    poses: Vec<Pose>,
    /// The BLAS, with node references and vertex indices of the view.
    blas: Blas,
    pub instanced: InstancedBlas,
    /// The triangles of later keys, and the rows of their vertices.
    key_triangles: Vec<Arc<[PackedTriangle]>>,
    key_rows: Vec<Arc<[Row]>>,
    /// See [`crate::layout::PackedInstance::next_key`].
    pub next_key: u32,
    /// The first later key in the arrays of the view.
    starts: Starts,
    /// Whether its topology was built for this view.
    pub is_rebuilt: bool,
}

/// A [`PackedVertex`] or a [`PackedTangent`].
type Row = [u32; 4];

/// Indices of the next triangle and vertex of later keys.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
struct Starts {
    triangle: usize,
    vertex: usize,
}

/// The deforming meshes of a scene that have visible instances.
pub fn meshes(
    scene: &Scene,
    origin: DVec3,
    plan: &Plan,
    trees: &Trees,
    has_tangents: bool,
) -> Arc<[DeformingMesh]> {
    let deforming = scene.deformations.iter().enumerate();
    let deforming = deforming.filter_map(|(index, deformation)| {
        let mut meshes = plan.instanced_meshes.iter();
        let tree = meshes.position(|mesh| *mesh == deformation.mesh)?;
        let at_rest = &trees.instanced[tree];
        Some(DeformingMesh {
            index,
            deformation: deformation.clone(),
            mesh: at_rest.mesh.clone(),
            tree,
            offsets: at_rest.blas.offsets,
            origin: tree_origin(deformation, origin),
            key_stride: 1 + usize::from(has_tangents),
        })
    });
    deforming.collect()
}

impl PackedScene {
    /// The deforming meshes in the frames of a shutter interval; reuses what is the same in `previous`.
    pub(super) fn deformed(
        &self,
        frames: &[Frame],
        previous: Option<&PackedView>,
    ) -> Result<Arc<Deformed>, PackError> {
        if self.deforming.is_empty() {
            return Ok(Arc::default());
        }
        let frames = self.deformation_keys(frames);
        let mut node = self.first_view_node();
        let triangle_rows = TRIANGLE_ROWS * self.triangles.len() + SHAPE_ROWS * self.shapes.len();
        let mut starts = Starts {
            triangle: triangle_rows.div_ceil(TRIANGLE_ROWS),
            vertex: self.vertices.len() + self.uvs.len() + self.tangents.len() + self.colors.len(),
        };
        let before = previous.map(|previous| &previous.deformed);
        let mut deformed = Deformed {
            trees: Vec::with_capacity(self.deforming.len()),
            key_count: 1,
        };
        for (place, mesh) in self.deforming.iter().enumerate() {
            let poses = mesh.poses(&frames);
            if poses.len() > 1 {
                deformed.key_count = frames.len() as u32;
            }
            let offsets = Offsets {
                node,
                ..mesh.offsets
            };
            let is_same = |tree: &&Arc<DeformedTree>| {
                tree.poses == poses && tree.blas.offsets == offsets && tree.starts == starts
            };
            let known = before.and_then(|before| before.trees.get(place));
            let tree = match known.filter(is_same) {
                Some(tree) => tree.clone(),
                None => Arc::new(DeformedTree::new(mesh, poses, offsets, starts)?),
            };
            node = tree.blas.end().node;
            starts.triangle += tree
                .key_triangles
                .iter()
                .map(|key| key.len())
                .sum::<usize>();
            starts.vertex += tree.key_rows.iter().map(|key| key.len()).sum::<usize>();
            deformed.trees.push(tree);
        }
        match before.filter(|before| ***before == deformed) {
            Some(before) => Ok(before.clone()),
            None => Ok(Arc::new(deformed)),
        }
    }

    /// The frames at the keys of deforming meshes: all, or evenly spaced ones from the first to the last.
    fn deformation_keys<'a>(&self, frames: &'a [Frame]) -> Vec<&'a Frame> {
        let bytes = self.deforming.iter().map(|mesh| {
            let (mesh, key_stride) = (&mesh.mesh.mesh, mesh.key_stride);
            // A packed triangle with its share of the nodes, and the rows of a vertex.
            72 * mesh.triangles.len() + 16 * key_stride * mesh.positions.len()
        });
        let bytes = bytes.sum::<usize>();
        let mut step = 1;
        let count = |step: usize| (frames.len() - 1) / step + 1;
        while count(step) > MAX_KEYS || count(step) > 2 && bytes * count(step) > MAX_KEY_BYTES {
            step *= 2;
        }
        frames.iter().step_by(step).collect()
    }
}

impl PartialEq for Deformed {
    fn eq(&self, other: &Self) -> bool {
        let is_same = |(a, b): (&Arc<_>, &Arc<_>)| Arc::ptr_eq(a, b) || a == b;
        self.key_count == other.key_count
            && self.trees.len() == other.trees.len()
            && self.trees.iter().zip(&other.trees).all(is_same)
    }
}

/// Compares the packed data.
impl PartialEq for DeformedTree {
    fn eq(&self, other: &Self) -> bool {
        self.blas.nodes == other.blas.nodes
            && self.blas.triangles == other.blas.triangles
            && self.blas.vertices == other.blas.vertices
            && self.key_triangles == other.key_triangles
            && self.blas.tangents == other.blas.tangents
            && self.key_rows == other.key_rows
    }
}

impl Deformed {
    /// Whether both are shared, or empty.
    pub fn is_same(self: &Arc<Self>, other: &Arc<Self>) -> bool {
        Arc::ptr_eq(self, other) || self.trees.is_empty() && other.trees.is_empty()
    }

    /// Number of nodes of all trees.
    pub fn node_count(&self) -> u32 {
        let counts = self.trees.iter().map(|tree| tree.blas.nodes.len() as u32);
        counts.sum()
    }

    /// The most entries on the stack of a walk through a tree.
    pub fn stack_need(&self) -> StackNeed {
        let needs = self.trees.iter().map(|tree| tree.blas.stack_need);
        needs.fold(StackNeed::default(), StackNeed::max)
    }

    /// The tree that replaces an instanced BLAS.
    pub fn tree(&self, blas: usize) -> Option<&DeformedTree> {
        let mut trees = self.trees.iter();
        trees.find(|tree| tree.tree == blas).map(|tree| &**tree)
    }

    /// The tree whose triangles replace those of the scene from an index on.
    pub fn starting_at(&self, triangle: u32) -> Option<&DeformedTree> {
        let mut trees = self.trees.iter();
        (trees.find(|tree| tree.instanced.first == triangle)).map(|tree| &**tree)
    }

    /// The nodes of all trees.
    pub fn nodes(&self) -> impl Iterator<Item = &[PackedNode]> {
        self.trees.iter().map(|tree| &tree.blas.nodes[..])
    }

    /// The triangles that replace those of the scene from an index on.
    pub fn triangles(&self, first: usize) -> Option<&[PackedTriangle]> {
        let tree = self.starting_at(first as u32)?;
        Some(&tree.blas.triangles)
    }

    /// The vertices that replace those of the scene from an index on.
    pub fn vertices(&self, first: usize) -> Option<&[PackedVertex]> {
        let mut trees = self.trees.iter().map(|tree| &tree.blas);
        let tree = trees.find(|blas| blas.offsets.vertex as usize == first)?;
        Some(&tree.vertices)
    }

    /// The tangents that replace those of the scene from an index on.
    pub fn tangents(&self, first: usize) -> Option<&[PackedTangent]> {
        let mut trees = self.trees.iter().map(|tree| &tree.blas);
        let tree = trees.find(|blas| blas.offsets.vertex as usize == first)?;
        (!tree.tangents.is_empty()).then_some(&tree.tangents)
    }

    /// The triangles of later keys, after the shapes of the scene at the next multiple of a triangle.
    pub fn key_triangles(&self) -> impl Iterator<Item = &[PackedTriangle]> {
        let keys = self.trees.iter().flat_map(|tree| &tree.key_triangles);
        keys.map(|key| &key[..])
    }

    /// The vertices of later keys, after the tangents and colours of the scene, each followed by its tangent if there are any.
    pub fn key_rows(&self) -> impl Iterator<Item = &[Row]> {
        let keys = self.trees.iter().flat_map(|tree| &tree.key_rows);
        keys.map(|key| &key[..])
    }
}

impl DeformingMesh {
    /// One pose for each frame; a single one if all are the same.
    fn poses(&self, frames: &[&Frame]) -> Vec<Pose> {
        let pose = |frame: &&Frame| {
            let weights = &frame.weights[self.index];
            self.deformation.pose(&frame.nodes, weights)
        };
        let mut poses: Vec<Pose> = frames.iter().map(pose).collect();
        if poses.iter().all(|pose| *pose == poses[0]) {
            poses.truncate(1);
        }
        poses
    }
}

impl DeformedTree {
    /// The bytes of its nodes, triangles, vertices and tangents.
    pub fn parts(&self) -> [&[u8]; 4] {
        let Blas {
            nodes,
            triangles,
            vertices,
            tangents,
            ..
        } = &self.blas;
        [
            cast_slice(nodes),
            cast_slice(triangles),
            cast_slice(vertices),
            cast_slice(tangents),
        ]
    }

    /// The tree's triangles with their index and their vertices.
    pub fn triangles(&self) -> impl Iterator<Item = (u32, &PackedTriangle, [&PackedVertex; 3])> {
        let Offsets {
            triangle, vertex, ..
        } = self.blas.offsets;
        let triangles = (triangle..).zip(&*self.blas.triangles);
        let vertex = move |index: u32| &self.blas.vertices[(index - vertex) as usize];
        triangles.map(move |(index, own)| (index, own, [own.i0, own.i1, own.i2].map(vertex)))
    }

    /// The corners of a triangle at all later keys.
    pub fn later_corners(&self, index: u32) -> Vec<DVec3> {
        let place = (index - self.blas.offsets.triangle) as usize;
        let own = self.key_triangles.iter().map(|key| &key[place]);
        own.flat_map(|own| [own.v0, own.v1, own.v2].map(|corner| Vec3::from(corner).as_dvec3()))
            .collect()
    }

    fn new(
        mesh: &DeformingMesh,
        poses: Vec<Pose>,
        offsets: Offsets,
        starts: Starts,
    ) -> Result<Self, PackError> {
        let source = &*mesh.mesh.mesh;
        let mut placed = Vec::with_capacity(poses.len());
        for (key, pose) in poses.iter().enumerate() {
            let rows = mesh.key_stride * source.positions.len();
            let place = match key {
                0 => (offsets.vertex as usize, 1),
                _ => (starts.vertex + (key - 1) * rows, mesh.key_stride),
            };
            let posed = mesh.deformation.posed(source, pose);
            placed.push(PlacedMesh::posed(source, &posed, mesh.origin, place)?);
        }
        let triangles = |topology: &Topology| -> Vec<_> {
            placed
                .iter()
                .map(|placed| topology.triangles(placed))
                .collect()
        };
        let at_rest = &*mesh.mesh.topology(&mut 0);
        let mut keys = triangles(at_rest);
        let is_rebuilt = Fit::new(at_rest, &keys[0]).cost() > POOR * at_rest.cost;
        let built;
        let topology = match is_rebuilt {
            true => {
                built = Topology::build(placed[0].positions(), &source.triangles);
                keys = triangles(&built);
                &built
            }
            false => at_rest,
        };
        let own = (placed[0].vertices.clone(), placed[0].tangents.clone());
        let fits: Vec<_> = keys.iter().map(|key| Fit::new(topology, key)).collect();
        let blas = Blas::of(&fits, own, offsets);
        drop(fits);
        Ok(Self {
            tree: mesh.tree,
            instanced: InstancedBlas {
                root: blas.root(),
                first: offsets.triangle,
                count: blas.triangles.len() as u32,
                boxes: blas.boxes(),
                shape: None,
            },
            next_key: match poses.len() {
                1 => 0,
                _ => (starts.triangle as u32).wrapping_sub(offsets.triangle),
            },
            key_triangles: keys.split_off(1),
            key_rows: placed[1..]
                .iter()
                .map(|it| rows(it, mesh.key_stride))
                .collect(),
            blas,
            poses,
            starts,
            is_rebuilt,
        })
    }
}

/// The rows of a later key: its vertices, each with its tangent if there are two rows for it.
fn rows(placed: &PlacedMesh, stride: usize) -> Arc<[Row]> {
    let vertices: &[Row] = cast_slice(&placed.vertices);
    let tangents: &[Row] = cast_slice(&placed.tangents);
    let row = |i: usize| match i % stride {
        0 => vertices[i / stride],
        _ => tangents.get(i / stride).copied().unwrap_or_default(),
    };
    (0..stride * vertices.len()).map(row).collect()
}
