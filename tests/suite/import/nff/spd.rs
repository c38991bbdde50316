//! The contents of the scenes of the Standard Procedural Database.

use super::triangles;
use crate::reference::count;
use crate::reference::spd::{files, load};
use glam::{DVec3, Vec3};
use glimray::scene::{Background, CanonicalShape, Geometry};

/// Counted line by line without the importer: SPD starts every entity on a line of its own.
#[test]
fn every_entity_of_the_files_is_imported() {
    for name in files() {
        let (scene, text) = load(&name).expect("a file that was just listed");
        let lines = |key: &str| {
            let begins = |line: &&str| line.split_whitespace().next() == Some(key);
            text.lines().filter(begins).collect::<Vec<_>>()
        };
        let last = |key: &str, i: usize| -> Vec<f64> {
            let line = lines(key)[i];
            line.split_whitespace()
                .skip(1)
                .map(|word| word.parse().expect("a number"))
                .collect()
        };
        let is_sphere = |shape: &&_| matches!(Geometry::clone(shape), Geometry::Sphere { .. });
        let geometries: Vec<_> = scene.shapes.iter().map(|shape| shape.geometry).collect();
        let spheres = geometries.iter().filter(is_sphere).count();
        assert_eq!(spheres, lines("s").len(), "{name}");
        assert_eq!(geometries.len() - spheres, lines("c").len(), "{name}");
        let corners = |key: &str, i: usize| last(key, i)[0] as usize - 2;
        let polygons: usize = (0..lines("p").len()).map(|i| corners("p", i)).sum();
        let patches: usize = (0..lines("pp").len()).map(|i| corners("pp", i)).sum();
        let dropped = match scene.skipped.first() {
            None => 0,
            Some(note) => note
                .split(' ')
                .next()
                .and_then(|n| n.parse().ok())
                .unwrap_or(0),
        };
        assert_eq!(
            scene.triangle_count() + dropped,
            polygons + patches,
            "{name}: {:?}",
            scene.skipped
        );
        assert_eq!(scene.lights.len(), lines("l").len(), "{name}");
        let strength = 1.0 / (scene.lights.len() as f32).sqrt();
        assert!(
            scene
                .lights
                .iter()
                .all(|l| l.color == Vec3::splat(strength)),
            "{name}"
        );
        let color: DVec3 = DVec3::from_slice(&last("b", 0));
        assert_eq!(
            scene.background,
            Background::Color(color.as_vec3()),
            "{name}"
        );
        let camera = &scene.cameras[0];
        assert_eq!(
            camera.look_from,
            DVec3::from_slice(&last("from", 0)),
            "{name}"
        );
        assert_eq!(camera.look_at, DVec3::from_slice(&last("at", 0)), "{name}");
        assert_eq!(camera.fov_y.to_degrees(), last("angle", 0)[0], "{name}");
        assert_eq!(scene.output.size, (512, 512), "{name}");
        let fill = last("f", 0);
        assert_eq!(
            scene.materials[0].classical().reflect,
            Vec3::splat(fill[4] as f32),
            "{name}"
        );
        assert_eq!(
            scene.materials[0].classical().transmit,
            Vec3::splat(fill[6] as f32),
            "{name}"
        );
        assert!(scene.shapes.iter().all(|shape| match shape.geometry {
            Geometry::Placed { canonical, .. } => matches!(canonical, CanonicalShape::Cone { .. }),
            _ => true,
        }));
    }
}

/// Areas by Newell's formula from the numbers in the file.
#[test]
fn the_polygons_of_the_files_keep_their_area() {
    for name in files() {
        let (scene, text) = load(&name).expect("a file that was just listed");
        let mut expected = 0.0;
        let mut lines = text.lines();
        while let Some(line) = lines.next() {
            let words: Vec<_> = line.split_whitespace().collect();
            if !matches!(words.first(), Some(&("p" | "pp"))) {
                continue;
            }
            let count: usize = words[1].parse().expect("a count");
            let corner = |line: &str| {
                let numbers: Vec<f64> = line
                    .split_whitespace()
                    .map(|word| word.parse().expect("a number"))
                    .collect();
                DVec3::from_slice(&numbers)
            };
            let corners: Vec<_> = lines.by_ref().take(count).map(corner).collect();
            let cross =
                |i: usize| (corners[i] - corners[0]).cross(corners[(i + 1) % count] - corners[0]);
            expected += (0..count).map(cross).sum::<DVec3>().length() / 2.0;
        }
        let area = |[a, b, c]: [DVec3; 3]| (b - a).cross(c - a).length() / 2.0;
        let sum: f64 = triangles(&scene).into_iter().map(area).sum();
        assert!(
            (sum - expected).abs() <= 1e-4 * expected,
            "{name}: {sum} instead of {expected}"
        );
    }
}

/// For comparison with other renderers: see benches/peers.
#[test]
#[ignore = "prints, and saves pictures in the folder for temporary files"]
fn rays_of_the_files() {
    for name in files() {
        let (scene, _) = load(&name).expect("a file that was just listed");
        let start = std::time::Instant::now();
        let (image, rays) = count::trace(
            &scene,
            scene.output.size,
            scene.output.max_depth,
            count::Inwards::Sent,
        );
        println!("{name}: {rays:?} in {:.1?}", start.elapsed());
        let path = std::env::temp_dir().join(format!("glimray-spd-{name}.png"));
        glimray::output::save(&path, &image).expect("a picture");
    }
}

/// Numbers of reflection rays of POV-Ray 3.7.0 without antialiasing, for the same scenes in its own
/// format, 5 levels deep, at 512×512.
#[test]
fn balls_and_teapot_take_as_many_reflection_rays_as_in_pov_ray() {
    for (name, expected) in [("balls.nff", 186_818.0), ("teapot.nff", 228_365.0)] {
        let Some((scene, _)) = load(name) else {
            return;
        };
        let rays = count::count(&scene, (512, 512), 5);
        let ratio = rays.reflection as f64 / expected;
        assert!((ratio - 1.0).abs() < 1e-3, "{name}: {rays:?}");
        assert_eq!(rays.primary, 512 * 512);
        assert_eq!((rays.refraction, rays.refraction_hits), (0, 0));
    }
}
