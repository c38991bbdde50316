//! Invariants of every scene that was read.

use glam::Vec3;
use glimray::scene::{Background, Mesh, Scene};

/// A part of `scene` that violates its invariants.
pub fn broken(scene: &Scene) -> Option<String> {
    let is_color = |c: &Vec3| c.is_finite() && c.min_element() >= 0.0;
    for material in &scene.materials {
        let colors = [
            material.classical().diffuse,
            material.classical().specular,
            material.classical().ambient,
            material.emission,
            material.classical().reflect,
            material.classical().transmit,
        ];
        if !colors.iter().all(is_color) {
            return Some(format!("a colour of {material:?}"));
        }
    }
    if !scene.lights.iter().all(|light| is_color(&light.color)) {
        return Some("the colour of a light".to_owned());
    }
    let mut texels = scene.pictures.iter().flat_map(|picture| picture.linear());
    if !texels.all(|texel| is_color(&texel.truncate()) && (0.0..=1.0).contains(&texel.w)) {
        return Some("a texel".to_owned());
    }
    if matches!(&scene.background, Background::Color(color) if !is_color(color)) {
        return Some("the background".to_owned());
    }
    if let Some(mesh) = scene.meshes.iter().find(|mesh| !is_whole(mesh, scene)) {
        return Some(format!("the mesh `{}`", mesh.name));
    }
    if scene.cameras.is_empty() || scene.materials.is_empty() {
        return Some("no camera or no material".to_owned());
    }
    match scene.bounds() {
        Some((min, max)) if !(min.is_finite() && max.is_finite()) => {
            Some(format!("bounds {min} to {max}"))
        }
        _ => None,
    }
}

fn is_whole(mesh: &Mesh, scene: &Scene) -> bool {
    let count = mesh.positions.len();
    let materials = scene.materials.len();
    mesh.normals.len() == count
        && mesh.materials.len() == count
        && (mesh.uvs.is_empty() || mesh.uvs.len() == count)
        && mesh
            .triangles
            .iter()
            .flatten()
            .all(|&i| (i as usize) < count)
        && mesh.materials.iter().all(|&m| (m as usize) < materials)
        && mesh.positions.iter().all(|p| p.is_finite())
        && mesh.normals.iter().all(|n| (n.length() - 1.0).abs() < 1e-5)
}
