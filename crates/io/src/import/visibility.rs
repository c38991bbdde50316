//! Whether anything of a model can be seen.

use glam::Vec3;
use glimray_scene::{Coverage, Fresnel, Material, Pattern, Scene};

/// Notes it if all surfaces of `scene`, a model, are wholly transparent: its picture would be empty without a reason.
pub(super) fn note(scene: &mut Scene) {
    let mut is_used = vec![false; scene.materials.len()];
    let meshes = scene.instances.iter().map(|it| &scene.meshes[it.mesh]);
    let corners = meshes.flat_map(|mesh| mesh.materials.iter().map(|&id| id as usize));
    for id in corners.chain(scene.shapes.iter().map(|shape| shape.material)) {
        is_used[id] = true;
    }
    let used = || {
        scene
            .materials
            .iter()
            .zip(&is_used)
            .filter(|(_, used)| **used)
    };
    if used().next().is_some() && used().all(|(material, _)| is_invisible(material, scene)) {
        let note = "the model is wholly transparent: none of its materials shows anything";
        scene.skipped.push(note.to_owned());
    }
}

fn is_invisible(material: &Material, scene: &Scene) -> bool {
    let is_hole = match material.coverage {
        Coverage::Opaque => false,
        Coverage::Mask(least) => material.alpha < least,
        Coverage::Blend => material.alpha == 0.0,
    };
    if is_hole || material.coverage != Coverage::Opaque && is_masked_out(material, scene) {
        return true;
    }
    let phong = material.classical();
    let is_bent = !material.is_thin() && phong.ior != 1.0;
    let reflects = phong.reflect != Vec3::ZERO && (phong.fresnel == Fresnel::None || is_bent);
    phong.opacity == 0.0
        && material.radiance().0 == Vec3::ZERO
        && phong.transmit.min_element() > 0.999
        && !is_bent
        && !reflects
}

/// Whether the picture of alpha is 0 everywhere.
fn is_masked_out(material: &Material, scene: &Scene) -> bool {
    let texture = material.textures.alpha.map(|index| &scene.textures[index]);
    texture.is_some_and(|texture| match texture.pattern {
        Pattern::Picture { picture, .. } => {
            scene.pictures[picture].linear().all(|texel| texel.w == 0.0)
        }
        _ => false,
    })
}
