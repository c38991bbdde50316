//! Packs the materials of a scene and of its visible lights.

use super::{glow::Glow, light, material};
use crate::layout::PackedMaterial;
use glimray_scene::{Frame, Material, Scene};
use std::sync::Arc;

/// The source of the packed materials, if they may change over time.
#[derive(Clone, Debug)]
pub struct AnimatedMaterials {
    pub materials: Vec<Material>,
    /// Indices of the visible lights.
    pub lamps: Vec<usize>,
}

/// Packed materials in scene order, with what textures of emission they have, then those of visible lights; and their source if they may change over
/// time.
pub fn materials(
    scene: &Scene,
    rest: &Frame,
    glows: &[Glow],
) -> (Arc<[PackedMaterial]>, Option<AnimatedMaterials>) {
    let lamps: Vec<usize> = light::visible(scene).collect();
    let lamp_materials = lamps
        .iter()
        .map(|&index| material::material(&light::material(&rest.lights[index]), Some(index)));
    let rest_materials = match &rest.materials[..] {
        [] => &scene.materials,
        changed => changed,
    };
    let own = rest_materials.iter().zip(glows).map(|(one, glow)| {
        let mut packed = material::material(one, None);
        packed.layers.glow = glow.mean;
        packed
    });
    let materials = own.chain(lamp_materials).collect();
    let is_changing = !rest.materials.is_empty() || (!lamps.is_empty() && !scene.tracks.is_empty());
    let animated_materials = is_changing.then(|| AnimatedMaterials {
        materials: scene.materials.clone(),
        lamps,
    });
    (materials, animated_materials)
}
