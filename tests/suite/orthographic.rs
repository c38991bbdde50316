//! Orthographic cameras: areas and distances by closed forms, whole pictures by the reference tracer.

use crate::reference::compare::{assert_none, check_alike, render, sized};
use crate::reference::{self, scenes, scenes::Build};
use crate::support::harness::gpu;
use crate::support::types::{Ray, ray};
use crate::support::verdict::{Tolerance, Verdict};
use glam::{DAffine3, DVec3, Vec3, dvec3};
use glimray::image::Image;
use glimray::import;
use glimray::layout::PackedCamera;
use glimray::pack;
use glimray::render::{Antialias, Integrator, RenderSettings};
use glimray::scene::{
    Background, Beyond, Camera, CameraProperty, Curve, Easing, Interpolation, Lens, Material, Node,
    Phong, Scene, Target, Track, Values,
};
use glimray_shader_test::Plain;
use std::f64::consts::PI;
use std::fs;
use std::process::Command;

const SIDE: u32 = 96;

/// A camera `distance` in front of the origin, with a picture of `height`.
fn parallel(distance: f64, height: f64) -> Camera {
    Camera {
        look_from: DVec3::Z * distance,
        look_at: DVec3::ZERO,
        orthographic_height: Some(height),
        ..Camera::default()
    }
}

/// A unit sphere around the origin.
fn ball(camera: Camera) -> Scene {
    let mut scene = Scene {
        cameras: vec![camera],
        materials: vec![Material::from(Phong {
            ambient: Vec3::ONE,
            ..Phong::default()
        })],
        background: Background::Color(Vec3::ZERO),
        ambient: Vec3::ONE,
        ..Scene::default()
    };
    scene.add_sphere(DVec3::ZERO, 1.0, 0);
    scene
}

fn depths(camera: Camera, (width, height): (u32, u32)) -> Image {
    let settings = RenderSettings {
        integrator: Integrator::Depth,
        ..sized(width, height)
    };
    render(&ball(camera), &settings).0
}

#[test]
fn a_sphere_covers_the_same_fraction_of_the_picture_from_any_distance() {
    let (height, size) = (3.0, (512, 256));
    let pixels: Vec<Vec<bool>> = [1.5, 4.0, 900.0]
        .map(|distance| {
            let image = depths(parallel(distance, height), size);
            image.pixels.iter().map(|pixel| pixel[0] > 0.0).collect()
        })
        .into();
    let hits = pixels[0].iter().filter(|hit| **hit).count() as f64;
    // π r² in a picture of height h and width 2 h, sampled at pixel centres.
    let expected = PI / (2.0 * height * height) * f64::from(size.0 * size.1);
    assert!((hits / expected - 1.0).abs() < 2e-3, "{hits} of {expected}");
    for others in &pixels[1..] {
        let off = pixels[0].iter().zip(others).filter(|(a, b)| a != b).count();
        assert!(off <= 8, "{off} pixels differ");
    }
}

#[test]
fn distances_are_those_from_the_plane_through_the_eye() {
    let (distance, height) = (5.0, 2.5);
    let image = depths(parallel(distance, height), (SIDE, SIDE));
    let mut hits = 0;
    for (index, pixel) in (0..).zip(&image.pixels) {
        let at = |i: u32| ((f64::from(i) + 0.5) / f64::from(SIDE) - 0.5) * height;
        let (x, y) = (at(index % SIDE), at(index / SIDE));
        let square = 1.0 - x * x - y * y;
        if square < 1e-3 {
            assert!(pixel[0] == 0.0 || square > -1e-3, "{x} {y}");
            continue;
        }
        hits += 1;
        let expected = distance - square.sqrt();
        assert!(
            (f64::from(pixel[0]) - expected).abs() < 2e-5,
            "{x} {y}: {}",
            pixel[0]
        );
    }
    assert!(hits > 4000, "{hits}");
}

#[test]
fn objects_behind_the_plane_through_the_eye_are_not_seen() {
    // Through the centre of the sphere: only its far side is visible.
    let image = depths(parallel(0.0, 2.5).at_origin(), (SIDE, SIDE));
    let middle = image.pixels[(SIDE / 2 * SIDE + SIDE / 2) as usize][0];
    assert!((middle - 1.0).abs() < 1e-3, "{middle}");
    let image = depths(parallel(-2.0, 2.5).looking_on(), (SIDE, SIDE));
    assert!(image.pixels.iter().all(|pixel| pixel[0] == 0.0));
}

trait Turned {
    fn at_origin(self) -> Self;
    fn looking_on(self) -> Self;
}

impl Turned for Camera {
    fn at_origin(self) -> Self {
        Camera {
            look_at: DVec3::NEG_Z,
            ..self
        }
    }

    fn looking_on(self) -> Self {
        Camera {
            look_at: self.look_from - DVec3::Z,
            ..self
        }
    }
}

#[test]
fn pictures_match_an_independent_tracer() {
    let rows = [
        ("spheres", scenes::spheres(), 6.0),
        ("meshes", scenes::meshes(), 5.0),
        ("everything", scenes::everything(), 7.0),
        ("mirrors and glass", scenes::mirrors_and_glass(), 4.0),
    ];
    assert_none(rows.map(|(name, mut scene, height)| {
        scene.cameras[0].orthographic_height = Some(height);
        let size = (64, 48);
        let settings = RenderSettings {
            max_depth: scene.output.max_depth,
            ..sized(size.0, size.1)
        };
        let expected = reference::trace(&scene, size).image;
        let (actual, _) = render(&scene, &settings);
        check_alike(
            &format!("orthographic {name}"),
            &expected,
            &actual,
            1.0,
            0.005,
        )
    }));
}

#[test]
fn parallel_rays_start_in_the_points_of_the_plane() {
    let camera = PackedCamera {
        origin: [1.0, 2.0, 3.0],
        forward: [0.0, 0.0, -1.0],
        right: [2.0, 0.0, 0.0],
        up: [0.0, 1.5, 0.0],
        ..Default::default()
    };
    let size = [640f32, 480.0];
    let rows = [
        ("the middle", [320f32, 240.0], [1.0, 2.0, 3.0]),
        ("the upper left corner", [0.0, 0.0], [-1.0, 3.5, 3.0]),
        ("the lower right corner", [640.0, 480.0], [3.0, 0.5, 3.0]),
        (
            "half-way to the right edge",
            [480.0, 240.0],
            [2.0, 2.0, 3.0],
        ),
    ];
    let inputs = rows.map(|(_, position, _)| (Plain(camera), position, size));
    let rays: Vec<Ray> = gpu().map("lib::camera::parallel_ray", &inputs);
    let mut verdict = Verdict::on("parallel_ray");
    for ((name, _, origin), got) in rows.iter().zip(&rays) {
        let expected = ray(*origin, [0.0, 0.0, -1.0]);
        verdict.that(name, *got == expected, || format!("{got:?}"));
    }
    verdict.close();
}

#[test]
fn rays_through_a_lens_meet_where_it_is_sharp_and_are_parallel_on_the_mean() {
    let camera = PackedCamera {
        origin: [0.0; 3],
        forward: [0.0, 0.0, -1.0],
        right: [2.0, 0.0, 0.0],
        up: [0.0, 2.0, 0.0],
        lens_radius: 0.5,
        focus_distance: 4.0,
        ..Default::default()
    };
    let size = [2f32, 2.0];
    let mut inputs = Vec::new();
    for i in 0..16 {
        for j in 0..16 {
            let u = [(i as f32 + 0.5) / 16.0, (j as f32 + 0.5) / 16.0];
            inputs.push((Plain(camera), [1.5f32, 0.5], size, u));
        }
    }
    let rays: Vec<Ray> = gpu().map("lib::camera::parallel_lens_ray", &inputs);
    let mut mean = DVec3::ZERO;
    let mut verdict = Verdict::on("parallel_lens_ray");
    for (i, ray) in rays.iter().enumerate() {
        let [origin, direction] =
            [ray.origin, ray.direction].map(|v| DVec3::from(v.map(f64::from)));
        let met = origin + direction * (-4.0 - origin.z) / direction.z;
        let met = met.as_vec3().to_array();
        verdict.near(
            format!("ray {i}"),
            &met,
            &[1.0, 1.0, -4.0],
            Tolerance::Absolute(1e-5),
        );
        let off = (origin - dvec3(1.0, 1.0, 0.0)).length();
        verdict.that(
            format!("ray {i} starts in the opening"),
            off < 0.5 + 1e-6,
            || off,
        );
        mean += direction / rays.len() as f64;
    }
    verdict.near(
        "the mean",
        &mean.as_vec3().normalize().to_array(),
        &[0.0, 0.0, -1.0],
        Tolerance::Absolute(1e-5),
    );
    verdict.close();
}

#[test]
fn blur_has_the_size_of_the_opening_seen_from_the_focus() {
    let spread = |depth: f64| {
        let mut scene = ball(Camera {
            lens: Some(Lens {
                radius: 0.8,
                focus_distance: 10.0,
                blade_count: 0,
                blade_rotation: 0.0,
            }),
            ..parallel(depth, 4.0)
        });
        scene.shapes.clear();
        scene.add_sphere(DVec3::ZERO, 0.3, 0);
        let settings = RenderSettings {
            samples: 256,
            antialias: Antialias::Stratified,
            ..sized(SIDE, SIDE)
        };
        let image = render(&scene, &settings).0;
        let (mut sum, mut light) = (0.0, 0.0);
        for (index, pixel) in (0..).zip(&image.pixels) {
            let at = |i: u32| ((f64::from(i) + 0.5) / f64::from(SIDE) - 0.5) * 4.0;
            let (x, y) = (at(index % SIDE), at(index / SIDE));
            sum += f64::from(pixel[0]) * (x * x + y * y);
            light += f64::from(pixel[0]);
        }
        sum / light
    };
    // The mean squared distance from the centre of a disc is half its squared radius; those of the ball and of
    // the blur add up.
    for depth in [10.0, 4.0, 20.0] {
        let blur = 0.8 * (1.0_f64 - depth / 10.0).abs();
        let expected = (0.3 * 0.3 + blur * blur) / 2.0;
        let found = spread(depth);
        assert!(
            (found / expected - 1.0).abs() < 0.03,
            "{depth}: {found} and {expected}"
        );
    }
}

#[test]
fn the_height_is_animated_and_follows_the_node_of_the_camera() {
    let mut scene = ball(parallel(5.0, 2.0));
    scene.tracks = vec![Track {
        targets: vec![Target::Camera(0, CameraProperty::OrthographicHeight)],
        curve: Curve {
            times: vec![0.0, 2.0],
            values: Values::Scalar(vec![2.0, 6.0]),
            interpolation: Interpolation::Linear,
            easing: Easing::None,
            beyond: Beyond::Hold,
        },
    }];
    let height = |scene: &Scene, time| scene.frame(time).camera.orthographic_height;
    assert_eq!(height(&scene, 0.5), Some(3.0));
    assert_eq!(height(&scene, 9.0), Some(6.0));
    let packed = pack::scene(&scene).expect("a scene");
    let view = packed
        .view(&scene.motion_samples(0.0, 1.0))
        .expect("a view");
    assert!(view.cameras.len() > 1, "it moves while the shutter is open");
    scene.nodes.push(Node {
        placement: DAffine3::from_scale(DVec3::splat(2.5)),
        ..Node::default()
    });
    scene.cameras[0].node = Some(0);
    let carried = height(&scene, 0.5).expect("orthographic");
    assert!((carried - 7.5).abs() < 1e-12, "{carried}");
    // The height does not apply to perspective cameras.
    scene.cameras[0].orthographic_height = None;
    assert_eq!(height(&scene, 0.5), None);
}

#[test]
fn a_zoom_while_the_shutter_is_open_shows_the_mean() {
    let mut scene = ball(parallel(5.0, 2.0));
    scene.tracks = vec![Track {
        targets: vec![Target::Camera(0, CameraProperty::OrthographicHeight)],
        curve: Curve {
            times: vec![0.0, 1.0],
            values: Values::Scalar(vec![3.0, 6.0]),
            interpolation: Interpolation::Linear,
            easing: Easing::None,
            beyond: Beyond::Hold,
        },
    }];
    let packed = std::sync::Arc::new(pack::scene(&scene).expect("a scene"));
    let view = packed
        .view(&scene.motion_samples(0.0, 1.0))
        .expect("a view");
    let settings = RenderSettings {
        samples: 256,
        antialias: Antialias::Stratified,
        ..sized(64, 64)
    };
    let mut renderer = crate::reference::compare::start_packed(packed, &view, &settings);
    while !renderer.is_done() {
        renderer.step().expect("a step");
    }
    let image = renderer
        .develop(&glimray::render::Tone::LINEAR)
        .expect("a picture");
    let mean = image.pixels.iter().map(|p| f64::from(p[0])).sum::<f64>() / 64.0 / 64.0;
    // The mean of π / h² for h from 3 to 6.
    let expected = PI / 18.0;
    assert!(
        (mean / expected - 1.0).abs() < 5e-3,
        "{mean} and {expected}"
    );
}

#[test]
fn a_view_without_perspective_has_a_fingerprint_of_its_own() {
    let camera = parallel(5.0, 2.0);
    let with_perspective = Camera {
        orthographic_height: None,
        fov_y: 2.0 * 1_f64.atan(),
        ..camera.clone()
    };
    let bytes = |camera: Camera| {
        let scene = ball(camera);
        let packed = pack::scene(&scene).expect("a scene");
        packed
            .frame(&scene.frame(0.0))
            .expect("a frame")
            .parts()
            .concat()
    };
    assert_ne!(bytes(camera), bytes(with_perspective));
}

#[test]
fn native_scenes_and_flags_have_orthographic_cameras() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("a.toml");
    let scene = |camera: &str, more: &str| {
        let text = format!(
            "[camera]\nname = 'c'\nlook_from = [0, 0, 5]\nlook_at = [0, 0, 0]\n{camera}\n\
             [materials.m]\n[[objects]]\nmaterial = 'm'\nsphere = {{ center = [0, 0, 0], radius = 1 }}\n{more}"
        );
        fs::write(&path, text).expect("a scene");
        import::load(&path)
    };
    let height = |camera: &str| scene(camera, "").expect("a scene").cameras[0].orthographic_height;
    assert_eq!(height("orthographic = 2.5"), Some(2.5));
    assert_eq!(height(""), None);
    let keys = "[[animation]]\ncamera = 'c'\nproperty = 'orthographic'\nkeys = [[0, 1], [2, 5]]\n";
    let moving = scene("orthographic = 2.5", keys).expect("a scene");
    assert_eq!(moving.frame(1.0).camera.orthographic_height, Some(3.0));
    for (camera, more, needle) in [
        ("orthographic = 0", "", "a.toml:5:16"),
        ("orthographic = -1", "", "a.toml:5:16"),
        ("orthographic = 'wide'", "", "a.toml:5:16"),
        ("", keys, "orthographic"),
    ] {
        let why = scene(camera, more).expect_err(camera).to_string();
        assert!(why.contains(needle), "{camera}: {why}");
    }

    scene("orthographic = 2.5", "").expect("a scene");
    let run = |flags: &str| {
        let mut command = Command::new(env!("CARGO_BIN_EXE_glimray"));
        let command = command.current_dir(folder.path());
        let output = command
            .args(flags.split_whitespace())
            .output()
            .expect("glimray runs");
        let text = [output.stdout, output.stderr].concat();
        let text = String::from_utf8_lossy(&text).into_owned();
        (output.status.code(), text)
    };
    let (code, text) = run("inspect a.toml");
    assert!(
        code == Some(0) && text.contains("orthographic, view height 2.5"),
        "{text}"
    );
    let (_, text) = run("inspect a.toml --json");
    assert!(text.contains("\"orthographic\": 2.5"), "{text}");
    for (flags, needle) in [
        ("--orthographic 0", "--orthographic"),
        ("--orthographic -3", "--orthographic"),
        ("--orthographic NaN", "--orthographic"),
        ("--orthographic 3 --fov-y 40", "--fov-y"),
    ] {
        let (code, text) = run(&format!("render a.toml -o x.png {flags}"));
        assert!(code == Some(2) && text.contains(needle), "{flags}: {text}");
    }
    let made = |flags: &str| {
        let (code, text) = run(&format!(
            "render a.toml --size 40x30 --integrator normals --quiet -o x.png {flags}"
        ));
        assert_eq!(code, Some(0), "{text}");
        fs::read(folder.path().join("x.png")).expect("a picture")
    };
    let from_file = made("");
    assert_eq!(made("--orthographic 2.5 --look-from 0,0,5"), from_file);
    assert_ne!(made("--orthographic 3.5"), from_file);
    let perspective = made("--fov-y 28.07248693585296");
    assert_ne!(perspective, from_file);
    scene("fov_y_deg = 28.07248693585296", "").expect("a scene");
    assert_eq!(made(""), perspective);
}
