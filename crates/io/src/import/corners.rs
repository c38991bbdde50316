//! Notes triangles whose corners have different materials where only a part of these is interpolated.

use super::notes::Notes;
use glam::Vec3;
use glimray_scene::{LightTransport, Material, Mesh, Scene};
use std::collections::HashMap;

/// Notes how many triangles of `scene` have more than interpolated colours from the material of their first corner.
pub(super) fn note(scene: &mut Scene) {
    let paths = scene.output.integrator == LightTransport::Path;
    let mut known: HashMap<[u32; 2], bool> = HashMap::new();
    let mut differ = |a: u32, b: u32| {
        let rest = |index: u32| (scene.materials.get(index as usize)).map(|it| rest(it, paths));
        a != b && *(known.entry([a, b])).or_insert_with(|| rest(a) != rest(b))
    };
    let mut count = 0;
    for mesh in &scene.meshes {
        let Mesh {
            materials,
            triangles,
            ..
        } = &**mesh;
        if materials.iter().all(|material| *material == materials[0]) {
            continue;
        }
        let is_mixed = |triangle: &&[u32; 3]| {
            let [a, b, c] = triangle.map(|corner| materials[corner as usize]);
            differ(a, b) || differ(a, c)
        };
        count += triangles.iter().filter(is_mixed).count();
    }
    if count > 0 {
        let mut notes = Notes::default();
        notes.add("corners", || {
            format!(
                "triangles between different materials, of which only colours are interpolated: all else, such as emission and \
                 alpha, is that of the first corner: {count}"
            )
        });
        scene.skipped.extend(notes.into_lines());
    }
}

/// A material without what is interpolated between corners.
fn rest(material: &Material, paths: bool) -> Material {
    let mut rest = Material {
        name: String::new(),
        tint: Vec3::ONE,
        ..material.clone()
    };
    match rest.metallic_roughness_mut() {
        Some(model) if paths => {
            model.base_color = Vec3::ZERO;
            model.phong = None;
        }
        _ => {
            let mut phong = material.classical().into_owned();
            (phong.diffuse, phong.ambient) = (Vec3::ZERO, Vec3::ZERO);
            if !paths {
                (phong.specular, phong.shininess) = (Vec3::ZERO, 0.0);
                phong.reflect = Vec3::ZERO;
            }
            rest.bsdf = phong.into();
        }
    }
    rest
}
