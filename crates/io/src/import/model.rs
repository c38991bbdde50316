//! A model as a scene: what the importers of OBJ, PLY and STL have in common.

use super::notes::Notes;
use super::{Axis, Options, stage};
use glam::{DAffine3, DVec3};
use glimray_scene::{
    Geometry, Instance, LightTransport, Material, Mesh, OutputDefaults, Picture, Scene, Shadows,
    Shape, Texture,
};
use std::sync::Arc;

/// The contents of a model file.
#[derive(Default)]
pub(super) struct Model {
    /// Mesh whose materials are indices into `materials`.
    pub mesh: Mesh,
    /// World from mesh: the translation to the position in the file.
    pub offset: DVec3,
    /// The points of a cloud, as spheres in world space.
    pub points: Vec<Shape>,
    /// Materials, whose textures are indices into `textures`.
    pub materials: Vec<Material>,
    pub textures: Vec<Texture>,
    pub notes: Notes,
}

impl Model {
    /// The model alone in a scene, completed as `options` ask. `up` is the axis of the file that points up
    /// unless `options` name another.
    pub fn into_scene(mut self, pictures: Vec<Arc<Picture>>, up: Axis, options: &Options) -> Scene {
        self.turn(options.up.unwrap_or(up));
        if self.materials.is_empty() {
            self.materials.push(Material::default());
        }
        let is_clear = |material: &Material| material.classical().transmit.max_element() > 0.0;
        let mut scene = Scene {
            shadows: match self.materials.iter().any(is_clear) {
                true => Shadows::Filtered,
                false => Shadows::Opaque,
            },
            shapes: self.points,
            materials: self.materials,
            textures: self.textures,
            pictures,
            output: OutputDefaults {
                size: (800, 600),
                integrator: LightTransport::Path,
                max_depth: LightTransport::Path.max_depth(),
                ..OutputDefaults::default()
            },
            remarks: self.notes.take_remarks(),
            skipped: self.notes.into_lines(),
            ..Scene::default()
        };
        if !self.mesh.triangles.is_empty() {
            scene.meshes.push(self.mesh.into());
            scene.instances.push(Instance {
                mesh: 0,
                placement: DAffine3::from_translation(self.offset),
                node: None,
                name: String::new(),
            });
        } else if scene.shapes.is_empty() {
            scene.skipped.push("the model has no triangles".to_owned());
        }
        stage::complete(&mut scene, options);
        scene
    }

    /// Turns the model so that `up` becomes +Y. Coordinates are only exchanged, so nothing is rounded.
    fn turn(&mut self, up: Axis) {
        if up == Axis::Y {
            return;
        }
        let vectors = self.mesh.positions.iter_mut().chain(&mut self.mesh.normals);
        vectors.for_each(|v| *v = up.upright(v.to_array()).into());
        self.offset = up.upright(self.offset.to_array()).into();
        for shape in &mut self.points {
            if let Geometry::Sphere { center, .. } = &mut shape.geometry {
                *center = up.upright(center.to_array()).into();
            }
        }
    }
}
