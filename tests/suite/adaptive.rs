//! Adaptive sampling: the same quality as uniform sampling with fewer samples.

use crate::reference::compare::{assert_none, check_same_bits, render, sliced, start};
use crate::reference::scenes;
use crate::render::cut;
use glam::{Vec3, dvec3};
use glimray::image::Image;
use glimray::render::{Antialias, Filter, Integrator, RenderSettings, Slicing, Stats, Tone};
use glimray::scene::{
    Background, Camera, Geometry, Lens, Light, LightKind, Material, Scene, Shape,
};

/// Rows of small balls in the lower left of the picture, and nothing elsewhere.
fn detail_in_a_fifth() -> Scene {
    let mut scene = Scene {
        cameras: vec![Camera {
            look_from: dvec3(0.0, 0.0, 10.0),
            fov_y: 2.0 * 0.5_f64.atan(),
            ..Camera::default()
        }],
        materials: vec![Material::default()],
        background: Background::Color(Vec3::new(0.05, 0.1, 0.3)),
        lights: vec![Light {
            kind: LightKind::Directional {
                direction: dvec3(-1.0, -1.0, -2.0).normalize(),
            },
            color: Vec3::ONE,
            ..Light::default()
        }],
        ..Scene::default()
    };
    // The picture covers -5 to 5.
    for i in 0..16 {
        for j in 0..10 {
            let (x, y) = (-4.9 + 0.29 * f64::from(i), -4.9 + 0.43 * f64::from(j));
            scene.shapes.push(Shape {
                geometry: Geometry::Sphere {
                    center: dvec3(x, y, 0.0),
                    radius: 0.12,
                },
                material: 0,
                node: None,
                name: String::new(),
            });
        }
    }
    scene
}

fn settings(antialias: Antialias, samples: u32, noise: f32) -> RenderSettings {
    RenderSettings {
        size: (96, 96),
        antialias,
        samples,
        noise,
        ..RenderSettings::default()
    }
}

fn rmse(a: &Image, b: &Image) -> f64 {
    let squares = |(a, b): (&[f32; 4], &[f32; 4])| -> f64 {
        (0..3).map(|i| f64::from(a[i] - b[i]).powi(2)).sum()
    };
    let sum: f64 = a.pixels.iter().zip(&b.pixels).map(squares).sum();
    (sum / (3.0 * a.pixels.len() as f64)).sqrt()
}

#[test]
fn where_a_fifth_has_detail_half_of_the_rays_give_the_same_error() {
    let scene = detail_in_a_fifth();
    let of = |settings: &RenderSettings| -> (Image, Stats) { render(&scene, settings) };
    let truth = of(&settings(Antialias::Stratified, 4096, 0.01)).0;
    let (even, even_stats) = of(&settings(Antialias::Stratified, 32, 0.01));
    let (adaptive, stats) = of(&settings(Antialias::Adaptive, 128, 0.025));
    let (allowed, got) = (rmse(&truth, &even), rmse(&truth, &adaptive));
    assert_eq!(even_stats.samples, 32 * 96 * 96);
    assert!(
        got <= allowed && 2 * stats.samples <= even_stats.samples,
        "error {got:.5} with {} rays, {allowed:.5} with {}",
        stats.samples,
        even_stats.samples,
    );
}

#[test]
fn less_noise_takes_more_samples_and_none_takes_all_or_few() {
    let scene = scenes::spheres();
    let mut last = 0;
    for noise in [0.3, 0.03, 0.003] {
        let (_, stats) = render(&scene, &settings(Antialias::Adaptive, 64, noise));
        assert!(
            stats.samples > last,
            "{noise}: {} after {last}",
            stats.samples
        );
        last = stats.samples;
    }
    let mut even = scenes::empty();
    even.background = Background::Color(Vec3::splat(0.3));
    let (image, stats) = render(&even, &settings(Antialias::Adaptive, 64, 0.01));
    assert_eq!(stats.samples, 4 * 96 * 96);
    assert!(
        image
            .pixels
            .iter()
            .all(|pixel| (pixel[0] - 0.3).abs() < 1e-6)
    );
}

#[test]
fn the_map_of_samples_shows_where_they_went() {
    let scene = detail_in_a_fifth();
    let settings = RenderSettings {
        integrator: Integrator::Samples,
        ..settings(Antialias::Adaptive, 64, 0.01)
    };
    let (map, stats) = render(&scene, &settings);
    let spent: f64 = map
        .pixels
        .iter()
        .map(|pixel| f64::from(pixel[0]) * 64.0)
        .sum();
    assert_eq!(spent as u64, stats.samples);
    let at = |x, y| map.pixel(x, y).expect("a pixel")[0] * 64.0;
    // There is nothing above and to the right of the balls.
    assert_eq!((at(80, 10), at(10, 10), at(80, 80)), (4.0, 4.0, 4.0));
    assert!(map.pixels.iter().any(|pixel| pixel[0] == 1.0));
}

#[test]
fn the_cut_of_the_work_does_not_show_in_adaptive_pictures() {
    let scene = detail_in_a_fifth();
    let whole = settings(Antialias::Adaptive, 300, 0.01);
    let expected = render(&scene, &whole).0;
    assert_none([(1, 3, 2048), (50, 16, 16), (7, 1, 40)].map(
        |(max_groups, max_samples, tile_side)| {
            let slicing = Slicing {
                max_groups,
                max_samples,
                tile_side,
                ..Slicing::default()
            };
            let cut = sliced(&whole, slicing);
            check_same_bits(
                &format!("{max_groups} workgroups"),
                &expected,
                &render(&scene, &cut).0,
            )
        },
    ));
}

#[test]
fn an_unfinished_adaptive_picture_shows_the_samples_so_far() {
    let scene = detail_in_a_fifth();
    let slicing = Slicing {
        max_groups: 100,
        max_samples: 1,
        ..Slicing::default()
    };
    let wanted = sliced(&settings(Antialias::Adaptive, 16, 0.01), slicing);
    let mut renderer = start(&scene, &wanted).expect("a renderer");
    let mut seen = Vec::new();
    while !renderer.is_done() {
        renderer.step().expect("samples");
        let samples = renderer.samples_done();
        if samples == 0 {
            continue;
        }
        seen.push(samples);
        let image = renderer.develop(&Tone::LINEAR).expect("a picture");
        // Above the balls there is only the background.
        for (x, y) in (0..96)
            .flat_map(|y| (0..96).map(move |x| (x, y)))
            .filter(|(_, y)| *y < 45)
        {
            let [r, g, b, _] = image.pixel(x, y).expect("a pixel");
            let color = Vec3::new(r, g, b);
            assert!(
                color.abs_diff_eq(Vec3::new(0.05, 0.1, 0.3), 1e-6),
                "{color} at {x}, {y} after {samples} samples"
            );
        }
    }
    // The first round has four samples; nothing is shown before the first is complete.
    assert_eq!(seen[..2], [1, 1], "{seen:?}");
    assert!(seen.is_sorted() && seen.contains(&3), "{seen:?}");
    assert_eq!(seen.last(), Some(&16));
}

/// A small bright ball far out of focus: a disc that few rays of a pixel hit.
fn blurred_light() -> Scene {
    let mut scene = Scene {
        cameras: vec![Camera {
            look_from: dvec3(0.0, 0.0, 8.0),
            fov_y: 0.5,
            lens: Some(Lens {
                radius: 0.3,
                focus_distance: 3.0,
                blade_count: 0,
                blade_rotation: 0.0,
            }),
            ..Camera::default()
        }],
        materials: vec![Material {
            emission: Vec3::splat(40.0),
            ..Material::default()
        }],
        ..Scene::default()
    };
    scene.shapes.push(Shape {
        geometry: Geometry::Sphere {
            center: dvec3(0.0, 0.0, 0.0),
            radius: 0.05,
        },
        material: 0,
        node: None,
        name: String::new(),
    });
    scene
}

#[test]
fn no_pixel_of_a_blurred_light_stays_black_beside_bright_ones() {
    let scene = blurred_light();
    let disc = |antialias| render(&scene, &settings(antialias, 1024, 0.02)).0;
    let (even, adaptive) = (disc(Antialias::Stratified), disc(Antialias::Adaptive));
    let mut holes = 0;
    for (a, b) in even.pixels.iter().zip(&adaptive.pixels) {
        holes += usize::from(a[0] > 0.2 && b[0] < 0.05);
    }
    assert_eq!(holes, 0);
    assert!(even.pixels.iter().filter(|pixel| pixel[0] > 0.2).count() > 300);
}

#[test]
fn an_adaptive_crop_is_the_same_pixels_of_the_whole_picture() {
    // Edges through detail, through noise, one pixel, a corner, and rows up to the picture's edge.
    let crops = [
        [13, 37, 60, 71],
        [47, 47, 48, 48],
        [40, 20, 49, 75],
        [95, 95, 96, 96],
        [0, 60, 96, 61],
    ];
    let scenes = [
        ("detail", detail_in_a_fifth(), 16),
        ("detail", detail_in_a_fifth(), 300),
        ("blur", blurred_light(), 64),
    ];
    let rows = scenes.into_iter().flat_map(|(name, scene, samples)| {
        [Integrator::Whitted, Integrator::Samples].map(|integrator| {
            let whole = RenderSettings {
                integrator,
                ..settings(Antialias::Adaptive, samples, 0.01)
            };
            let expected = render(&scene, &whole).0;
            let of = |crop| RenderSettings {
                crop: Some(crop),
                ..whole.clone()
            };
            crops.map(|crop| {
                let name = format!("{name}, {samples} samples, {integrator:?}, {crop:?}");
                let actual = render(&scene, &of(crop)).0;
                check_same_bits(&name, &cut(&expected, crop), &actual)
            })
        })
    });
    assert_none(rows.flatten());
}

#[test]
fn negative_lobes_make_no_pixel_glow() {
    let mitchell = RenderSettings {
        filter: Filter::Mitchell,
        filter_radius: 2.0,
        ..settings(Antialias::Adaptive, 8, 0.01)
    };
    let (image, _) = render(&detail_in_a_fifth(), &mitchell);
    let brightest = image
        .pixels
        .iter()
        .flat_map(|p| &p[..3])
        .copied()
        .fold(0.0, f32::max);
    assert!(brightest < 4.0, "{brightest}");
}

#[test]
fn progress_reaches_1_and_a_picture_can_be_developed_on_the_way() {
    let settings = settings(Antialias::Adaptive, 32, 0.01);
    let mut renderer = start(&detail_in_a_fifth(), &settings).expect("a renderer");
    let mut last = 0.0;
    while !renderer.is_done() {
        renderer.step().expect("a step");
        assert!(renderer.progress() >= last, "{last}");
        last = renderer.progress();
        renderer.develop(&Tone::LINEAR).expect("a picture");
    }
    assert_eq!(last, 1.0);
    let picture = renderer.develop(&Tone::LINEAR).expect("a picture");
    assert_none([check_same_bits(
        "developed",
        &picture,
        &render(&detail_in_a_fifth(), &settings).0,
    )]);
}

#[test]
fn paths_take_sixteen_samples_at_least_and_no_more_for_brighter_light() {
    let paths = |noise| RenderSettings {
        integrator: Integrator::Path,
        ..settings(Antialias::Adaptive, 64, noise)
    };
    let mut even = scenes::empty();
    even.background = Background::Color(Vec3::splat(0.3));
    let (_, stats) = render(&even, &paths(0.01));
    assert_eq!(stats.samples, 16 * 96 * 96);
    // Highlights are white however bright they are, so their noise does not show.
    let samples = |strength: f32| {
        let mut scene = detail_in_a_fifth();
        scene.background = Background::Color(Vec3::splat(strength));
        scene.lights.clear();
        render(&scene, &paths(0.02)).1.samples
    };
    let (usual, bright) = (samples(1.0), samples(400.0));
    assert!(bright < usual, "{bright} samples, {usual} where light is 1");
}
