//! Merges static shapes and small static meshes into one BLAS; a few primitives stay outside it.

use super::{
    PackError, blas::Blas, features::OutsideTree, geometry::Flat, instance::Plan, light,
    mesh::CachedMesh, nodes::Offsets,
};
use crate::layout::{PackedShape, SHAPE_TORUS};
use glam::{DAffine3, DVec3};
use glimray_scene::{Frame, Geometry, Scene};
use std::sync::Arc;

/// The most triangles and the most shapes that are in no BVH. With more of them, on lavapipe, rays are faster with all in a
/// BVH.
const MOST_TRIANGLES: usize = 8;
const MOST_SHAPES: usize = 4;

/// The joint BLAS of static shapes and small static meshes; planes, which are in no BVH; and what else is in none.
#[derive(Clone, Debug)]
pub struct Joint {
    pub input: JointInput,
    pub blas: Arc<Blas>,
    pub planes: Arc<[PackedShape]>,
    pub outside_tree: OutsideTree,
}

/// The input that a [`Joint`] is built from.
#[derive(Clone, Debug)]
pub struct JointInput {
    pub meshes: Vec<(Arc<CachedMesh>, DAffine3)>,
    /// Shapes with their materials and ids.
    shapes: Vec<(Geometry, usize, usize)>,
    /// Whether no other BLAS has triangles, or shapes.
    has_all_triangles: bool,
    has_all_shapes: bool,
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
            && self.has_all_triangles == other.has_all_triangles
            && self.has_all_shapes == other.has_all_shapes
            && self.stack_size == other.stack_size
            && self.origin == other.origin
    }
}

impl JointInput {
    /// The input of a scene.
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
            has_all_triangles: plan.baked.is_empty() && plan.instanced_meshes.is_empty(),
            has_all_shapes: plan.shapes.is_empty() && plan.lamps.is_empty(),
            stack_size,
            origin,
        }
    }

    /// Which kind of the packed primitives is in no BVH.
    fn outside_tree(&self, flat: &Flat) -> OutsideTree {
        let (triangles, shapes) = (flat.triangles.len(), flat.bounded.len());
        let few_triangles = self.has_all_triangles && triangles <= MOST_TRIANGLES;
        // Tori take too long to test each ray against.
        let is_quick = |(shape, _): &(PackedShape, _)| shape.kind != SHAPE_TORUS;
        let few_shapes =
            self.has_all_shapes && shapes <= MOST_SHAPES && flat.bounded.iter().all(is_quick);
        match (few_triangles, few_shapes) {
            (true, _) if triangles > 0 && shapes > 0 => OutsideTree::Triangles,
            (false, true) if shapes > 0 => OutsideTree::Shapes,
            _ => OutsideTree::Nothing,
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
        let outside_tree = input.outside_tree(&flat);
        Ok(Self {
            planes: std::mem::take(&mut flat.planes).into(),
            blas: Arc::new(Blas::joint(flat, outside_tree, input.stack_size, offsets)),
            outside_tree,
            input,
        })
    }

    /// The joint with its BLAS at other offsets.
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
