//! What static shapes and small static meshes have in common: one BLAS, and primitives that are in none.

use super::{
    PackError, blas::Blas, geometry::Flat, instance::Plan, light, mesh::CachedMesh, nodes::Offsets,
};
use crate::{
    layout::PackedShape,
    scene::{Frame, Geometry, Scene},
};
use glam::{DAffine3, DVec3};
use std::sync::Arc;

/// The most triangles that are in no BVH. With more of them, on lavapipe, rays are faster with all in a BVH.
const MOST_APART: usize = 8;

/// The joint BLAS of static shapes and small static meshes; and planes, which are in no BVH.
#[derive(Clone, Debug)]
pub struct Joint {
    pub input: JointInput,
    pub blas: Arc<Blas>,
    pub planes: Arc<[PackedShape]>,
    /// The number of triangles that are in no BVH either: all that there are, or 0.
    pub triangles_apart: u32,
}

/// What it is made of.
#[derive(Clone, Debug)]
pub struct JointInput {
    pub meshes: Vec<(Arc<CachedMesh>, DAffine3)>,
    /// Shapes with their materials and ids.
    shapes: Vec<(Geometry, usize, usize)>,
    /// Whether no other BLAS has meshes.
    has_all_meshes: bool,
    stack_size: usize,
    origin: DVec3,
}

impl PartialEq for JointInput {
    fn eq(&self, other: &Self) -> bool {
        let is_same = |((a, placed_a), (b, placed_b)): (&(_, _), &(_, _))| {
            Arc::ptr_eq(a, b) && placed_a == placed_b
        };
        self.meshes.len() == other.meshes.len()
            && self.meshes.iter().zip(&other.meshes).all(is_same)
            && self.shapes == other.shapes
            && self.has_all_meshes == other.has_all_meshes
            && self.stack_size == other.stack_size
            && self.origin == other.origin
    }
}

impl JointInput {
    /// That of a scene.
    pub fn new(
        scene: &Scene,
        (rest, origin): (&Frame, DVec3),
        plan: &Plan,
        meshes: &[Arc<CachedMesh>],
        stack_size: usize,
    ) -> Self {
        let mesh = |&(index, world_from_object): &(usize, DAffine3)| {
            (
                meshes[scene.instances[index].mesh].clone(),
                world_from_object,
            )
        };
        let shapes = plan.joint_shapes.iter().map(|&id| {
            let shape = &scene.shapes[id];
            let geometry = match shape.node {
                None => shape.geometry,
                Some(node) => shape.geometry.placed(rest.nodes[node].world_from_node),
            };
            (geometry, shape.material, id)
        });
        let lamps = plan.joint_lamps.iter().filter_map(|&index| {
            let (material, id) = light::material_and_id(scene, index);
            let surface = light::surface(&rest.lights[index].kind)?;
            Some((surface, material, id))
        });
        Self {
            meshes: plan.joint.iter().map(mesh).collect(),
            shapes: shapes.chain(lamps).collect(),
            has_all_meshes: plan.baked.is_empty() && plan.instanced_meshes.is_empty(),
            stack_size,
            origin,
        }
    }
}

impl Joint {
    /// Builds the BLAS.
    pub fn build(input: JointInput, offsets: Offsets) -> Result<Self, PackError> {
        let mut flat = Flat::default();
        for (mesh, world_from_object) in &input.meshes {
            flat.add_mesh(&mesh.mesh, *world_from_object, input.origin, offsets.vertex)?;
        }
        for (geometry, material, id) in &input.shapes {
            flat.add_shape(geometry, *material, *id, Some(input.origin))?;
        }
        let count = flat.triangles.len();
        let are_apart = input.has_all_meshes && count <= MOST_APART && !flat.bounded.is_empty();
        Ok(Self {
            planes: std::mem::take(&mut flat.planes).into(),
            triangles_apart: if are_apart { count as u32 } else { 0 },
            blas: Arc::new(Blas::joint(flat, are_apart, input.stack_size, offsets)),
            input,
        })
    }
    /// The same with its BLAS at other offsets.
    pub fn moved_to(self: &Arc<Self>, offsets: Offsets) -> Arc<Self> {
        match self.blas.offsets == offsets {
            true => self.clone(),
            false => Arc::new(Self {
                blas: self.blas.moved_to(offsets),
                ..Self::clone(self)
            }),
        }
    }
}
