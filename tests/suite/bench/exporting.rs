//! `glimray bench --export-rays`: the files are what benches/peers/README.md says.

use crate::ray_query::triangle;
use crate::support::program::Workspace;
use glam::DVec3;
use std::path::Path;

/// The numbers of a file, in rows.
fn rows<const N: usize>(path: &Path) -> Vec<[f64; N]> {
    let bytes = std::fs::read(path).expect("a file");
    let (words, rest) = bytes.as_chunks::<4>();
    assert!(rest.is_empty(), "{}", path.display());
    let numbers: Vec<_> = words
        .iter()
        .map(|word| f64::from(f32::from_le_bytes(*word)))
        .collect();
    let (rows, rest) = numbers.as_chunks::<N>();
    assert!(rest.is_empty(), "{}", path.display());
    rows.to_vec()
}

/// The smallest distance at which a ray meets a triangle.
fn nearest(triangles: &[[f64; 9]], origin: DVec3, direction: DVec3) -> Option<f64> {
    let meet = |corners: &[f64; 9]| {
        let corners = [0, 3, 6].map(|first| DVec3::from_slice(&corners[first..]));
        triangle(origin, direction, corners)
    };
    triangles.iter().filter_map(meet).min_by(f64::total_cmp)
}

#[test]
fn the_files_hold_the_scene_and_rays_that_leave_its_surface() {
    let workspace = Workspace::new();
    let run = workspace
        .run("bench --quick --only he --export-rays out")
        .expect(0);
    for line in [
        "sphereflake: left out, as it has spheres",
        "heightfield: 180000 triangles",
    ] {
        assert!(
            run.text().lines().any(|found| found == line),
            "{}",
            run.text()
        );
    }
    let folder = workspace.path("out/heightfield");
    let triangles: Vec<[f64; 9]> = rows(&folder.join("triangles.f32"));
    assert_eq!(triangles.len(), 180_000);

    let primary: Vec<[f64; 7]> = rows(&folder.join("primary.closest.f32"));
    assert_eq!(primary.len(), 512 * 512);
    let occlusion: Vec<[f64; 7]> = rows(&folder.join("ambient-occlusion.any.f32"));
    let ray = |row: &[f64; 7]| (DVec3::from_slice(row), DVec3::from_slice(&row[3..]));
    let is_unit = |row: &[f64; 7]| (ray(row).1.length() - 1.0).abs() < 1e-6;
    assert!(primary.iter().chain(&occlusion).all(is_unit));

    // Secondary rays start just off the hills, whose height is where a ray from above meets them.
    for row in occlusion.iter().step_by(occlusion.len() / 10) {
        let (origin, _) = ray(row);
        let above = nearest(&triangles, origin + DVec3::Y, DVec3::NEG_Y);
        let height = above.expect("hills below") - 1.0;
        assert!(height.abs() < 1e-4, "{origin} is {height} above");
    }
}

#[test]
fn a_folder_that_cannot_be_made_is_named() {
    let workspace = Workspace::new();
    workspace.write("taken", "");
    let run = workspace
        .run("bench --quick --only heightfield --export-rays taken")
        .expect(4);
    run.says("taken");
    assert_eq!(run.stderr.lines().count(), 1, "{}", run.stderr);
    let run = workspace
        .run("bench --only nonsense --export-rays out")
        .expect(2);
    run.says("no scene has such a name");
}
