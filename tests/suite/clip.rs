//! Near and far planes of cameras: distances by closed forms, and pictures beside those of scenes that lack what is clipped.

use crate::film::film;
use crate::reference::compare::{assert_none, check_alike, render, sized};
use crate::reference::scenes::{self, Build};
use crate::support::{
    harness::gpu,
    types::{Ray, T_FAR, ray},
    verdict::{Tolerance, Verdict},
};
use glam::{DAffine3, DQuat, DVec3, Vec3, dvec3, vec3};
use glimray::image::Image;
use glimray::import;
use glimray::layout::PackedCamera;
use glimray::render::{Integrator, RenderSettings};
use glimray::scene::{
    Background, Camera, Coverage, Light, LightKind, Material, Minify, Node, Origin, Pattern, Phong,
    Picture, Scene, Space, Texels, Texture, Wrap,
};
use glimray_shader_test::Plain;
use std::f64::consts::FRAC_PI_2;
use std::fs;
use std::sync::Arc;

const SIDE: u32 = 48;
/// Not at the origin, from which rays are traced.
const EYE: DVec3 = DVec3::new(0.5, -0.25, 2.0);
const INTEGRATORS: [Integrator; 2] = [Integrator::Whitted, Integrator::Path];

fn camera(clip: (f64, f64)) -> Camera {
    Camera {
        look_from: EYE,
        look_at: EYE - DVec3::Z,
        fov_y: 1.2,
        clip,
        ..Camera::default()
    }
}

fn glowing(color: Vec3) -> Material {
    Material {
        emission: color,
        bsdf: Phong {
            diffuse: Vec3::ZERO,
            ..Phong::default()
        }
        .into(),
        ..Material::default()
    }
}

/// A scene without light but that of its surfaces, in front of a blue background.
fn scene(clip: (f64, f64), materials: Vec<Material>) -> Scene {
    Scene {
        cameras: vec![camera(clip)],
        materials,
        background: Background::Color(vec3(0.0, 0.0, 0.5)),
        ..Scene::default()
    }
}

fn with(integrator: Integrator) -> RenderSettings {
    RenderSettings {
        integrator,
        ..sized(SIDE, SIDE)
    }
}

fn center(image: &Image) -> [f32; 3] {
    let [r, g, b, _] = image.pixels[((SIDE + 1) * SIDE / 2) as usize];
    [r, g, b]
}

fn is_near(found: [f32; 3], expected: [f32; 3]) -> bool {
    found
        .iter()
        .zip(expected)
        .all(|(a, b)| (a - b).abs() < 1e-3)
}

#[test]
fn a_clipped_ray_lies_between_the_planes() {
    let camera = PackedCamera {
        origin: [1.0, 2.0, 3.0],
        forward: [0.0, 0.0, -1.0],
        ..PackedCamera::default()
    };
    // A direction at 60° to the axis: twice as far along it as the planes are.
    let slanted = [0.75_f32.sqrt(), 0.0, -0.5];
    let rows = [
        (
            "straight ahead",
            [0.0, 0.0, -1.0],
            [2.0, 7.0],
            [1.0, 2.0, 1.0],
            5.0,
        ),
        (
            "at 60°",
            slanted,
            [2.0, 7.0],
            [1.0 + 4.0 * 0.75_f32.sqrt(), 2.0, 1.0],
            10.0,
        ),
        ("no near plane", slanted, [0.0, 7.0], [1.0, 2.0, 3.0], 14.0),
        (
            "no far plane",
            slanted,
            [2.0, 0.0],
            [1.0 + 4.0 * 0.75_f32.sqrt(), 2.0, 1.0],
            T_FAR,
        ),
    ];
    let inputs: Vec<_> = (rows.iter())
        .map(|&(_, direction, clip, ..)| (Plain(camera), clip, ray(camera.origin, direction)))
        .collect();
    let found: Vec<Ray> = gpu().map("lib::camera::clipped_ray", &inputs);
    let mut verdict = Verdict::on("clipped_ray");
    for ((name, direction, _, origin, length), got) in rows.iter().zip(&found) {
        let origin = origin.map(f64::from);
        verdict.near(name, &got.origin, &origin, Tolerance::Absolute(1e-6));
        let length = f64::from(*length);
        verdict.near(name, &got.t_max, &length, Tolerance::Relative(1e-6));
        verdict.that(name, got.direction == *direction, || format!("{got:?}"));
    }
    let ways: Vec<f32> = gpu().map(
        "lib::camera::along_ray",
        &[(Plain(camera), 3.0_f32, slanted)],
    );
    verdict.near(
        "along a ray at 60°",
        &ways[0],
        &6.0,
        Tolerance::Relative(1e-6),
    );
    verdict.close();
}

#[test]
fn distances_are_those_of_the_first_surface_between_the_planes() {
    let (near, far, distance, radius) = (2.0, 6.1, 4.0, 2.2);
    for orthographic in [None, Some(9.0)] {
        let mut scene = scene((near, far), vec![Material::default()]);
        scene.cameras[0].orthographic_height = orthographic;
        scene.add_sphere(EYE - distance * DVec3::Z, radius, 0);
        let image = render(&scene, &with(Integrator::Depth)).0;
        let mut kinds = [0; 3];
        for (index, pixel) in (0..).zip(&image.pixels) {
            let at = |i: u32| 2.0 * (f64::from(i) + 0.5) / f64::from(SIDE) - 1.0;
            let (x, y) = (at(index % SIDE), -at(index / SIDE));
            let (from, way) = match orthographic {
                Some(height) => (dvec3(x, y, 0.0) * height / 2.0, DVec3::NEG_Z),
                None => {
                    let half = 0.6_f64.tan();
                    (DVec3::ZERO, dvec3(x * half, y * half, -1.0).normalize())
                }
            };
            // |from + t way - center|² = r²
            let off = from + distance * DVec3::Z;
            let (b, c) = (off.dot(way), off.length_squared() - radius * radius);
            let root = (b * b - c).max(0.0).sqrt();
            let planes = [near, far].map(|plane| plane / -way.z);
            let between = |t: &f64| b * b > c && planes[0] < *t && *t < planes[1];
            let expected = [-b - root, -b + root].into_iter().find(between);
            let edge = [-b - root, -b + root]
                .iter()
                .any(|t| planes.iter().any(|plane| (t - plane).abs() < 1e-3) || root < 1e-2);
            if edge {
                continue;
            }
            let found = f64::from(pixel[0]);
            let expected = expected.unwrap_or(0.0);
            assert!(
                (found - expected).abs() < 1e-4,
                "{x} {y}: {found}, not {expected}"
            );
            kinds[if expected == 0.0 {
                0
            } else {
                1 + usize::from(expected > -b)
            }] += 1;
        }
        assert!(
            kinds.iter().all(|count| *count > 20),
            "{orthographic:?}: {kinds:?}"
        );
    }
}

#[test]
fn what_lies_outside_of_the_planes_is_not_seen() {
    let colors = [
        vec3(0.9, 0.1, 0.1),
        vec3(0.1, 0.9, 0.1),
        vec3(0.9, 0.9, 0.1),
    ];
    let build = |clip, shown: [bool; 3], orthographic| {
        let mut scene = scene(clip, colors.map(glowing).to_vec());
        scene.cameras[0].orthographic_height = orthographic;
        let balls = [(1.0, 0.3), (4.0, 0.8), (30.0, 20.0)];
        for (index, (distance, radius)) in (0..).zip(balls) {
            if shown[index] {
                scene.add_sphere(EYE - distance * DVec3::Z, radius, index);
            }
        }
        scene
    };
    let mut results = Vec::new();
    for integrator in INTEGRATORS {
        for orthographic in [None, Some(4.0)] {
            let settings = RenderSettings {
                features: true,
                ..with(integrator)
            };
            let clipped = build((2.0, 8.0), [true; 3], orthographic);
            let without = build(Camera::UNCLIPPED, [false, true, false], orthographic);
            let name = format!("{integrator:?} {orthographic:?}");
            let (found, expected) = (film(&clipped, &settings), film(&without, &settings));
            let [a, b] = [&expected, &found].map(|film| film.features().expect("features"));
            for (a, b) in a.pixels.iter().zip(&b.pixels) {
                assert!(
                    (a.depth - b.depth).abs() < 1e-4,
                    "{name}: {} {}",
                    a.depth,
                    b.depth
                );
            }
            let (picture, wanted) = (render(&clipped, &settings).0, render(&without, &settings).0);
            let green = colors[1].to_array();
            assert!(
                is_near(center(&picture), green),
                "{name}: {:?}",
                center(&picture)
            );
            results.push(check_alike(
                &format!("clip {name}"),
                &wanted,
                &picture,
                1.0,
                0.0,
            ));
        }
    }
    assert_none(results);
}

#[test]
fn planes_that_clip_nothing_change_no_picture() {
    let mut textured = Scene {
        cameras: vec![Camera {
            look_from: dvec3(0.0, 2.0, 0.0),
            look_at: dvec3(0.0, 0.0, -6.0),
            ..Camera::default()
        }],
        ..scene(Camera::UNCLIPPED, vec![])
    };
    // Fine squares, which are filtered over the width of a ray.
    textured.pictures = vec![Arc::new(Picture {
        width: 2,
        height: 2,
        texels: Texels::Linear8(
            [0, 255, 255, 0]
                .map(|level| [level, level, level, 255])
                .to_vec(),
        ),
        origin: Origin::Texels,
    })];
    textured.textures = vec![Texture {
        pattern: Pattern::Picture {
            picture: 0,
            nearest: false,
            minify: Minify::default(),
            wrap: [Wrap::Repeat; 2],
        },
        space: Space::Uv,
        pattern_from_space: DAffine3::from_scale(DVec3::splat(60.0)),
    }];
    let mut board = glowing(Vec3::ONE);
    board.textures.emission = Some(0);
    textured.materials = vec![board];
    textured.add_mesh(
        scenes::quad(40.0, 0),
        DAffine3::from_translation(dvec3(0.0, -1.0, -20.0)),
    );
    let mut results = Vec::new();
    let all = [
        ("board", textured, 2.0),
        ("mirrors", scenes::mirrors_and_glass(), 0.1),
        ("everything", scenes::everything(), 0.1),
    ];
    for (name, scene, near) in all {
        let mut clipped = scene.clone();
        for camera in &mut clipped.cameras {
            camera.clip = (near, 1e5);
        }
        for integrator in INTEGRATORS {
            let settings = with(integrator);
            let (expected, found) = (render(&scene, &settings).0, render(&clipped, &settings).0);
            let name = format!("unclipped {name} {integrator:?}");
            results.push(check_alike(&name, &expected, &found, 1.0, 0.01));
        }
    }
    assert_none(results);
}

#[test]
fn clipped_surfaces_cast_shadows() {
    let build = |clip| {
        let matte = Material::from(Phong {
            diffuse: Vec3::splat(0.8),
            ..Phong::default()
        });
        let mut scene = scene(clip, vec![matte]);
        scene.lights = vec![Light {
            kind: LightKind::Directional {
                direction: DVec3::NEG_Z,
            },
            color: Vec3::ONE,
            ..Light::default()
        }];
        scene.add_sphere(EYE - 1.5 * DVec3::Z, 0.5, 0);
        scene.add_sphere(EYE - 30.0 * DVec3::Z, 20.0, 0);
        scene
    };
    for integrator in INTEGRATORS {
        let lit = |clip| center(&render(&build(clip), &with(integrator)).0)[0];
        let (seen, clipped) = (lit(Camera::UNCLIPPED), lit((3.0, 100.0)));
        assert!(seen > 0.1, "the ball has light: {seen}");
        assert!(clipped < 1e-3, "its shadow is dark: {clipped}");
    }
}

#[test]
fn the_far_plane_holds_behind_holes() {
    let veil = Material {
        alpha: 0.5,
        coverage: Coverage::Blend,
        ..glowing(vec3(1.0, 0.0, 0.0))
    };
    let mut scene = scene((0.0, 8.0), vec![veil, glowing(Vec3::ONE)]);
    scene.add_sphere(EYE - 30.0 * DVec3::Z, 20.0, 1);
    let upright = DQuat::from_rotation_x(FRAC_PI_2);
    let place = DAffine3::from_rotation_translation(upright, EYE - 3.0 * DVec3::Z);
    scene.add_mesh(scenes::quad(9.0, 0), place);
    for integrator in INTEGRATORS {
        let settings = RenderSettings {
            samples: 1024,
            size: (2, 2),
            ..with(integrator)
        };
        let [r, g, b, _] = render(&scene, &settings).0.pixels[0];
        // Half of red, half of the background.
        let tolerance = 0.03;
        let is_near = |a: f32, b: f32| (a - b).abs() < tolerance;
        assert!(
            is_near(r, 0.5) && is_near(g, 0.0) && is_near(b, 0.25),
            "{r} {g} {b}"
        );
    }
}

#[test]
fn rays_start_in_the_medium_at_the_near_plane() {
    let glass = Material::from(Phong {
        diffuse: Vec3::ZERO,
        transmit: Vec3::ONE,
        ior: 1.5,
        absorption: vec3(0.0, 2.0, 2.0),
        ..Phong::default()
    });
    let build = |clip, has_glass| {
        let mut scene = scene(clip, vec![glass.clone(), glowing(Vec3::ONE)]);
        if has_glass {
            scene.add_sphere(EYE, 1.0, 0);
        }
        scene.add_sphere(EYE - 6.0 * DVec3::Z, 1.5, 1);
        scene
    };
    for integrator in INTEGRATORS {
        let settings = with(integrator);
        let found = |clip, has_glass| center(&render(&build(clip, has_glass), &settings).0);
        assert!(is_near(found(Camera::UNCLIPPED, false), [1.0; 3]));
        assert!(found(Camera::UNCLIPPED, true)[1] < 0.5, "the glass absorbs");
        let clipped = found((2.0, f64::INFINITY), true);
        assert!(is_near(clipped, [1.0; 3]), "{integrator:?}: {clipped:?}");
    }
}

#[test]
fn the_planes_follow_the_node_of_the_camera() {
    let mut scene = scene((1.0, 4.0), vec![Material::default()]);
    scene.nodes.push(Node {
        placement: DAffine3::from_scale(DVec3::splat(2.5)),
        ..Node::default()
    });
    scene.cameras[0].node = Some(0);
    assert_eq!(scene.frame(0.0).camera.clip, (2.5, 10.0));
    scene.cameras[0].clip = Camera::UNCLIPPED;
    assert_eq!(scene.frame(0.0).camera.clip, Camera::UNCLIPPED);
}

#[test]
fn native_scenes_have_near_and_far_planes() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("a.toml");
    let clip = |camera: &str| {
        let text = format!(
            "[camera]\nlook_from = [0, 0, 5]\nlook_at = [0, 0, 0]\n{camera}\n\
             [materials.m]\n[[objects]]\nmaterial = 'm'\nsphere = {{ center = [0, 0, 0], radius = 1 }}\n"
        );
        fs::write(&path, text).expect("a scene");
        import::load(&path).map(|scene| scene.cameras[0].clip)
    };
    assert_eq!(clip("").expect("a scene"), Camera::UNCLIPPED);
    assert_eq!(clip("near = 0\nfar = 7.5").expect("a scene"), (0.0, 7.5));
    assert_eq!(clip("near = 1.5").expect("a scene"), (1.5, f64::INFINITY));
    for (camera, place) in [
        ("near = -1", "a.toml:4:8"),
        ("far = 0", "a.toml:4:7"),
        ("near = 2\nfar = 2", "a.toml:5:7"),
    ] {
        let why = clip(camera).expect_err(camera).to_string();
        assert!(why.contains(place), "{camera}: {why}");
    }
}
