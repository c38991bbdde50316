//! Scenes and their ray sets as files, so that other programs trace the same rays. The format is in
//! benches/peers/README.md: little-endian `f32` without headers, in a folder for each scene.

use super::ray_sets;
use super::scene_runs;
use super::scenes::{Detail, Procedural};
use glimray_app::console;
use glimray_app::error::AppError;
use glimray_io::output::{self, OutputError};
use glimray_render::RayTest;
use glimray_scene::Scene;
use std::fs;
use std::path::Path;

/// Writes the scenes into `folder`, with the rays that a benchmark of them would trace. Spheres are not written: a scene
/// that has any is left out, with a line that says so.
///
/// # Errors
/// A file cannot be written.
pub fn write(folder: &Path, scenes: &[&Procedural], is_quick: bool) -> Result<(), AppError> {
    let mut text = String::new();
    for procedural in scenes {
        let (name, scene) = (procedural.name, (procedural.scene)(Detail::Full));
        if !scene.shapes.is_empty() {
            text.push_str(&format!("{name}: left out, as it has spheres\n"));
            continue;
        }
        let folder = folder.join(name);
        fs::create_dir_all(&folder).map_err(|source| OutputError::Io {
            path: folder.clone(),
            source,
        })?;
        write_floats(&folder.join("triangles.f32"), triangles(&scene))?;
        text.push_str(&format!("{name}: {} triangles\n", scene.triangle_count()));
        for set in ray_sets::of(&scene, scene_runs::side(is_quick)) {
            let test = match set.test {
                RayTest::Closest => "closest",
                RayTest::Any => "any",
            };
            let path = folder.join(format!("{}.{test}.f32", set.name));
            write_floats(&path, set.rows())?;
            text.push_str(&format!("{name}: {} {} rays\n", set.rays.len(), set.name));
        }
    }
    console::print(&text)
}

/// The corners of all triangles in world space.
fn triangles(scene: &Scene) -> impl Iterator<Item = [f32; 9]> {
    scene.instances.iter().flat_map(|instance| {
        let mesh = &scene.meshes[instance.mesh];
        mesh.triangles.iter().map(move |corners| {
            let [a, b, c] = corners.map(|corner| {
                let position = mesh.positions[corner as usize].as_dvec3();
                instance.placement.transform_point3(position).as_vec3()
            });
            [a.x, a.y, a.z, b.x, b.y, b.z, c.x, c.y, c.z]
        })
    })
}

fn write_floats<const N: usize>(
    path: &Path,
    rows: impl Iterator<Item = [f32; N]>,
) -> Result<(), OutputError> {
    output::write_with(path, true, |file| {
        for value in rows.flatten() {
            file.write_all(&value.to_le_bytes())?;
        }
        Ok(())
    })
}
