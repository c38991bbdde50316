//! Maps packed primitives back to objects of the scene.

use super::{PackedScene, PackedView, instance::Plan, light, trees::Trees};
use crate::layout::{NO_INSTANCE, SHAPE};
use glimray_scene::{ObjectRef, Scene};

/// The objects of the scene behind packed primitives, instances and materials.
#[derive(Clone, Debug)]
pub struct Origins {
    /// First vertices of the baked meshes, in ascending order, and their instances.
    baked: Vec<(u32, usize)>,
    /// The object of each instance.
    instanced: Vec<ObjectRef>,
    shape_count: usize,
    /// Visible lights, whose ids follow those of the shapes.
    lamps: Vec<usize>,
    material_names: Vec<String>,
    instance_names: Vec<String>,
    shape_names: Vec<String>,
    light_names: Vec<String>,
}

impl Origins {
    pub fn new(scene: &Scene, plan: &Plan, trees: &Trees) -> Self {
        let own_trees = plan.baked.iter().zip(&trees.baked);
        let mut baked: Vec<_> = own_trees
            .map(|(baked, tree)| (tree.blas.offsets.vertex, baked.index))
            .collect();
        let mut first_vertex = trees.joint.blas.offsets.vertex;
        for &(index, _) in &plan.joint {
            baked.push((first_vertex, index));
            let mesh = &scene.meshes[scene.instances[index].mesh];
            first_vertex += mesh.positions.len() as u32;
        }
        Self {
            baked,
            instanced: plan.instanced_objects().collect(),
            shape_count: scene.shapes.len(),
            lamps: light::visible(scene).collect(),
            material_names: material_names(scene),
            instance_names: names(scene, scene.instances.len(), ObjectRef::Instance),
            shape_names: names(scene, scene.shapes.len(), ObjectRef::Shape),
            light_names: names(scene, scene.lights.len(), ObjectRef::Light),
        }
    }
}

fn material_names(scene: &Scene) -> Vec<String> {
    scene.materials.iter().map(|m| m.name.clone()).collect()
}

fn names(scene: &Scene, count: usize, object: fn(usize) -> ObjectRef) -> Vec<String> {
    (0..count)
        .map(|index| scene.object_name(object(index)).to_owned())
        .collect()
}

impl PackedScene {
    /// The object of a hit: `primitive` is the index of a triangle, or [`SHAPE`] with the index of a shape;
    /// `instance` is an instance of `view`, or [`NO_INSTANCE`]. `None` if the index does not exist.
    pub fn object_at(&self, view: &PackedView, primitive: u32, instance: u32) -> Option<ObjectRef> {
        let origins = &self.origins;
        if primitive & SHAPE != 0 {
            let id = self.shapes.get((primitive & !SHAPE) as usize)?.id as usize;
            return match id.checked_sub(origins.shape_count) {
                None => Some(ObjectRef::Shape(id)),
                Some(lamp) => origins
                    .lamps
                    .get(lamp)
                    .map(|&light| ObjectRef::Light(light)),
            };
        }
        let vertex = self.triangles.get(primitive as usize)?.i0;
        if instance != NO_INSTANCE {
            let index = view.instanced_index(instance)?;
            return origins.instanced.get(index).copied();
        }
        let count = (origins.baked).partition_point(|(first_vertex, _)| *first_vertex <= vertex);
        let (_, index) = origins.baked.get(count.checked_sub(1)?)?;
        Some(ObjectRef::Instance(*index))
    }

    /// The corners of a hit triangle, as indices into the vertices of its mesh; `primitive` and `instance` are those of
    /// [`Self::object_at`]. `None` for a shape, or if the index does not exist.
    pub fn corners_at(&self, primitive: u32, instance: u32) -> Option<[u32; 3]> {
        let is_shape = primitive & SHAPE != 0;
        let triangle = self.triangles.get(primitive as usize)?;
        let last = |count: usize| count.checked_sub(1).filter(|_| !is_shape);
        let first_vertex = if instance == NO_INSTANCE {
            let baked = &self.origins.baked;
            let count = baked.partition_point(|(first_vertex, _)| *first_vertex <= triangle.i0);
            baked[last(count)?].0
        } else {
            let trees = &self.trees.instanced;
            let count = trees.partition_point(|tree| tree.blas.offsets.triangle <= primitive);
            trees[last(count)?].blas.offsets.vertex
        };
        Some([triangle.i0, triangle.i1, triangle.i2].map(|vertex| vertex - first_vertex))
    }

    /// The numbers of instances and of shapes of the scene.
    pub fn object_counts(&self) -> (usize, usize) {
        let Origins {
            instance_names,
            shape_count,
            ..
        } = &self.origins;
        (instance_names.len(), *shape_count)
    }

    /// [`Scene::object_name`] in the scene that this was packed from; `None` if it has no name.
    pub fn object_name(&self, object: ObjectRef) -> Option<&str> {
        let (names, index) = match object {
            ObjectRef::Instance(index) => (&self.origins.instance_names, index),
            ObjectRef::Shape(index) => (&self.origins.shape_names, index),
            ObjectRef::Light(index) => (&self.origins.light_names, index),
        };
        names
            .get(index)
            .map(String::as_str)
            .filter(|name| !name.is_empty())
    }

    /// The index into [`Scene::materials`] of a packed material; `None` for [`crate::layout::NONE`] and the
    /// surfaces of lamps.
    pub fn material_at(&self, material: u32) -> Option<usize> {
        let index = material as usize;
        (index < self.origins.material_names.len()).then_some(index)
    }

    /// The name of a material in the scene that this was packed from; `None` if it has no name.
    pub fn material_name(&self, index: usize) -> Option<&str> {
        let name = self.origins.material_names.get(index)?;
        Some(name.as_str()).filter(|name| !name.is_empty())
    }
}
