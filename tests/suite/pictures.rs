//! Whole pictures against the independent tracer in `reference`.

use crate::reference::compare::{
    assert_none, check_alike, check_same_bits, counting, fetched, render, sized,
};
use crate::reference::{scenes, trace};
use glimray::image::Image;
use glimray::import;
use glimray::render::{Antialias, Fetch, RenderSettings, TriangleTest};
use glimray::scene::Scene;
use std::path::PathBuf;

/// The tolerance of the course and of the tests here: 2 levels on 99.9 % of the pixels.
const LEVELS: f32 = 2.0;
const SHARE: f64 = 0.001;

fn project_scene(name: &str) -> Scene {
    let path = PathBuf::from(env!("CARGO_MANIFEST_DIR"))
        .join("assets/scenes")
        .join(name);
    import::load(&path).unwrap_or_else(|error| panic!("{error}"))
}

fn against_the_reference(
    name: &str,
    scene: &Scene,
    settings: &RenderSettings,
) -> Result<(), String> {
    let settings = RenderSettings {
        max_depth: scene.output.max_depth,
        ..settings.clone()
    };
    let expected = trace(scene, settings.size).image;
    check_alike(name, &expected, &render(scene, &settings).0, LEVELS, SHARE)
}

#[test]
fn the_course_scenes_match_an_independent_tracer_at_their_full_size() {
    let names = [
        "sphere.scene",
        "spheres_and_triangles.scene",
        "terrain.scene",
    ];
    assert_none(
        names.map(|name| against_the_reference(name, &project_scene(name), &sized(640, 480))),
    );
}

#[test]
fn the_native_scenes_match_an_independent_tracer() {
    // Brute force over the thousands of triangles of mesh.toml limits the size of the picture.
    let rows = [
        ("shapes.toml", 320),
        ("solids.toml", 320),
        ("lights.toml", 320),
        ("far_away.toml", 320),
        ("mesh.toml", 96),
    ];
    assert_none(rows.map(|(name, width)| {
        against_the_reference(name, &project_scene(name), &sized(width, width * 3 / 4))
    }));
}

#[test]
fn scenes_with_every_surface_and_light_match_an_independent_tracer() {
    let rows = [
        ("spheres and planes", scenes::spheres()),
        ("meshes", scenes::meshes()),
        ("everything", scenes::everything()),
        ("solids", scenes::solids()),
    ];
    assert_none(rows.map(|(name, scene)| against_the_reference(name, &scene, &sized(256, 192))));
}

#[test]
fn mirrors_and_glass_match_a_tracer_that_calls_itself() {
    let mut course = project_scene("spheres_and_triangles.scene");
    course.output.max_depth = 3;
    let rows = [("glass", scenes::mirrors_and_glass()), ("course", course)];
    assert_none(rows.map(|(name, scene)| {
        let settings = RenderSettings {
            max_depth: scene.output.max_depth,
            ..sized(256, 192)
        };
        let expected = trace(&scene, settings.size);
        let (image, stats) = render(&scene, &counting(&settings));
        let counted = stats.rays.expect("counts");
        let near = |a: u64, b: u64| a.abs_diff(b) as f64 <= 0.002 * b as f64;
        let counts = [
            (counted.reflection, expected.rays.reflection),
            (counted.reflection_hits, expected.rays.reflection_hits),
            (counted.refraction, expected.rays.refraction),
            (counted.refraction_hits, expected.rays.refraction_hits),
        ];
        if !counts.iter().all(|&(got, wanted)| near(got, wanted)) {
            return Err(format!("{name}: rays {counts:?}"));
        }
        // Edges seen through a lens or in a ball are edges as well.
        check_alike(name, &expected.image, &image, LEVELS, 0.004)
    }));
}

#[test]
fn every_form_alone_is_what_it_is_among_others() {
    // Each picture has a pipeline for a single kind of shape.
    let all = scenes::solids();
    assert_none((0..all.shapes.len()).map(|i| {
        let mut scene = all.clone();
        scene.shapes = vec![all.shapes[i].clone()];
        let name = format!("{:?}", scene.shapes[0].geometry);
        against_the_reference(&name[..name.len().min(60)], &scene, &sized(96, 72))
    }));
}

#[test]
fn the_tree_finds_the_shapes_that_brute_force_finds() {
    let scene = scenes::solids();
    let brute = RenderSettings {
        brute_force: true,
        ..sized(256, 192)
    };
    let (expected, actual) = (render(&scene, &brute).0, render(&scene, &sized(256, 192)).0);
    assert_none([check_same_bits("solids", &expected, &actual)]);
}

#[test]
fn all_triangle_tests_give_the_reference_picture() {
    let scene = scenes::meshes();
    let expected = trace(&scene, (256, 192)).image;
    let tests = [
        TriangleTest::Plane,
        TriangleTest::MollerTrumbore,
        TriangleTest::Watertight,
    ];
    assert_none(tests.map(|triangle_test| {
        let settings = RenderSettings {
            triangle_test,
            ..sized(256, 192)
        };
        let name = format!("{triangle_test:?}");
        check_alike(
            &name,
            &expected,
            &render(&scene, &settings).0,
            LEVELS,
            SHARE,
        )
    }));
}

/// Adapters whose subgroups do not all have 8 or all 16 lanes have no packets.
#[test]
fn images_buffers_and_packets_give_the_same_bits() {
    let scene = scenes::everything();
    let of = |fetch| render(&scene, &fetched(&sized(160, 120), fetch)).0;
    let expected = of(Fetch::Image);
    assert_none([
        check_same_bits("buffers", &expected, &of(Fetch::Buffer)),
        check_same_bits("packets", &expected, &of(Fetch::Packet)),
    ]);
}

#[test]
fn the_seed_moves_stratified_samples_and_no_others() {
    let scene = scenes::spheres();
    let picture = |antialias, seed| -> Image {
        let settings = RenderSettings {
            antialias,
            seed,
            samples: 4,
            ..sized(64, 48)
        };
        render(&scene, &settings).0
    };
    assert_none([check_same_bits(
        "centre",
        &picture(Antialias::None, 1),
        &picture(Antialias::None, 2),
    )]);
    let (a, b) = (
        picture(Antialias::Stratified, 1),
        picture(Antialias::Stratified, 2),
    );
    assert_ne!(a, b, "another seed gives another picture");
    assert_eq!(
        a,
        picture(Antialias::Stratified, 1),
        "the same seed gives the same picture"
    );
}

#[test]
fn many_stratified_samples_average_the_pixel() {
    // The mean of a picture with 8 times the resolution over 8x8 pixels is a good estimate of the same
    // integral.
    let scene = scenes::spheres();
    let settings = RenderSettings {
        samples: 256,
        antialias: Antialias::Stratified,
        ..sized(40, 30)
    };
    let (actual, _) = render(&scene, &settings);
    let fine = trace(&scene, (320, 240)).image;
    let mut expected = Image::new(40, 30);
    for (i, pixel) in expected.pixels.iter_mut().enumerate() {
        let (x, y) = (i as u32 % 40 * 8, i as u32 / 40 * 8);
        for channel in 0..3 {
            let parts = (0..64).filter_map(|k| fine.pixel(x + k % 8, y + k / 8));
            pixel[channel] = parts.map(|part| part[channel]).sum::<f32>() / 64.0;
        }
    }
    assert_none([check_alike("mean", &expected, &actual, 5.0, 0.01)]);
}
