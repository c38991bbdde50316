//! Changes of what surfaces look like: no tree is built again, nothing is laid out again.

use super::{Changing, Features, PackError, PackedScene, light, material, media};
use crate::layout::PackedMaterial;
use crate::scene::{Frame, Scene, Shadows};
use std::sync::Arc;

/// Materials in scene order, then those of visible lights; and what they are made of where that may
/// change over time.
pub fn materials(scene: &Scene, rest: &Frame) -> (Vec<PackedMaterial>, Option<Changing>) {
    let lamps: Vec<usize> = light::visible(scene).collect();
    let lamp_materials = lamps
        .iter()
        .map(|&index| light::material(&rest.lights[index]));
    let rest_materials = match &rest.materials[..] {
        [] => &scene.materials,
        changed => changed,
    };
    let materials = (rest_materials.iter().map(material::material))
        .chain(lamp_materials.map(|lamp| material::material(&lamp)))
        .collect();
    let is_changing = !rest.materials.is_empty() || (!lamps.is_empty() && !scene.tracks.is_empty());
    let changing = is_changing.then(|| Changing {
        materials: scene.materials.clone(),
        lamps,
    });
    (materials, changing)
}

impl PackedScene {
    /// What packing `scene` gives, if it has all surfaces where `was` has them, of which this was made:
    /// materials, textures, pictures, lights that rays do not see, background and camera angles may
    /// differ. `None` where it must be packed anew.
    ///
    /// # Errors
    /// There are more textures or texels than can be told apart.
    pub fn with_surfaces(&self, was: &Scene, scene: &Scene) -> Result<Option<Self>, PackError> {
        let rest = scene.frame(0.0);
        if scene.render_origin_at(&rest) != self.origin || !has_same_surfaces(was, scene) {
            return Ok(None);
        }
        let (texels, pictures) = match is_shared(&was.pictures, &scene.pictures) {
            true => (self.texels.clone(), self.pictures.clone()),
            false => material::texels(scene)?,
        };
        let (materials, changing) = materials(scene, &rest);
        Ok(Some(Self {
            materials,
            changing,
            textures: material::textures(scene, self.origin, &pictures)?,
            texels,
            pictures,
            features: Features {
                shape_kinds: self.features.shape_kinds,
                mixed_materials: self.features.mixed_materials,
                instances: self.features.instances,
                contact: media::may_touch(scene),
                filtered_shadows: scene.shadows == Shadows::Filtered,
                ..material::features(scene)
            },
            bodies: match material::clear(was) == material::clear(scene) {
                true => self.bodies.clone(),
                false => media::bodies(scene),
            },
            origins: self.origins.renamed(scene),
            build_seconds: 0.0,
            ..self.clone()
        }))
    }
}

/// Whether everything that rays hit is the same and moves in the same way.
fn has_same_surfaces(was: &Scene, scene: &Scene) -> bool {
    let has_same_lamp = |index: usize| {
        let (a, b) = (&was.lights[index], &scene.lights[index]);
        a.kind == b.kind && a.node == b.node
    };
    is_shared(&was.meshes, &scene.meshes)
        && was.instances == scene.instances
        && was.shapes == scene.shapes
        && was.nodes == scene.nodes
        && was.tracks == scene.tracks
        && was.materials.len() == scene.materials.len()
        && light::visible(was).eq(light::visible(scene))
        && light::visible(scene).all(has_same_lamp)
}

fn is_shared<T>(a: &[Arc<T>], b: &[Arc<T>]) -> bool {
    a.len() == b.len() && a.iter().zip(b).all(|(a, b)| Arc::ptr_eq(a, b))
}
