//! Area lights in whole renders: closed forms of their illumination and of their penumbras.

use crate::reference::compare::{assert_none, check_alike, counting, render, sized};
use crate::reference::scenes::{self, Build};
use crate::reference::trace;
use glam::{DAffine3, DVec3, Vec3, dvec3};
use glimray::render::RenderSettings;
use glimray::scene::{Attenuation, Background, Camera, Light, LightKind, Material, Phong, Scene};
use std::f64::consts::PI;

/// A floor of k_d = 1/2 around the origin, seen by the camera from nearby.
fn floor() -> Scene {
    let mut scene = Scene {
        cameras: vec![Camera {
            look_from: dvec3(0.02, 0.01, 0.015),
            look_at: DVec3::ZERO,
            fov_y: 0.01,
            ..Camera::default()
        }],
        materials: vec![Material::from(Phong {
            diffuse: Vec3::splat(0.5),
            ..Phong::default()
        })],
        background: Background::Color(Vec3::ZERO),
        ..Scene::default()
    };
    scene.add_plane(DVec3::ZERO, DVec3::Y, 0);
    scene
}

/// A light whose surface has radiance 1.
fn glowing(kind: LightKind) -> Light {
    Light {
        kind,
        color: Vec3::splat((1.0 / kind.radiance().expect("an area light")) as f32),
        attenuation: Attenuation::InverseSquare,
        samples: 64,
        visible: true,
        node: None,
        name: String::new(),
    }
}

fn square(center: DVec3) -> LightKind {
    LightKind::Rectangle {
        center,
        edge_u: DVec3::X,
        edge_v: DVec3::Z,
    }
}

/// Settings of one pixel at the origin, with thousands of light samples.
fn floor_under(lights: Vec<Light>) -> f64 {
    let mut scene = floor();
    scene.lights = lights;
    let settings = RenderSettings {
        samples: 256,
        ..sized(1, 1)
    };
    let (image, stats) = render(&scene, &settings);
    assert_eq!(stats.nonfinite_samples, 0);
    f64::from(image.pixels[0][1])
}

fn check(name: &str, got: f64, expected: f64, tolerance: f64) -> Result<(), String> {
    if (got - expected).abs() <= tolerance * expected {
        return Ok(());
    }
    Err(format!("{name}: {got}, expected {expected}"))
}

fn ball(distance: f64, off_axis_deg: f64) -> LightKind {
    let angle = off_axis_deg.to_radians();
    LightKind::Sphere {
        center: distance * dvec3(angle.sin(), angle.cos(), 0.0),
        radius: 1.0,
    }
}

#[test]
fn a_sphere_light_above_the_horizon_gives_its_closed_form() {
    // k_d L (R/d)² cos θ.
    assert_none(
        [
            (2.0, 0.0, 0.125),
            (3.0, 0.0, 0.055_555_6),
            (3.0, 45.0, 0.039_283_7),
            (5.0, 60.0, 0.01),
        ]
        .map(|(distance, angle, expected)| {
            let got = floor_under(vec![glowing(ball(distance, angle))]);
            check(&format!("{distance} at {angle}°"), got, expected, 1e-3)
        }),
    );
}

/// k_d/π times the irradiance from a sphere of radiance 1, by the midpoint rule over the cone that it subtends.
fn sphere_by_quadrature(distance: f64, off_axis_deg: f64) -> f64 {
    const PARTS: u32 = 1500;
    let axis = off_axis_deg.to_radians();
    let depth = 1.0 - (1.0 - 1.0 / (distance * distance)).sqrt();
    let mut sum = 0.0;
    for i in 0..PARTS {
        let cos = 1.0 - depth * (f64::from(i) + 0.5) / f64::from(PARTS);
        let sin = (1.0 - cos * cos).sqrt();
        for j in 0..PARTS {
            let turn = 2.0 * PI * (f64::from(j) + 0.5) / f64::from(PARTS);
            sum += (cos * axis.cos() - sin * turn.cos() * axis.sin()).max(0.0);
        }
    }
    0.5 / PI * sum * 2.0 * PI * depth / f64::from(PARTS * PARTS)
}

#[test]
fn a_sphere_light_cut_by_the_horizon_or_just_outside_of_it_gives_its_quadrature() {
    // The quadrature itself against the closed form.
    let whole = sphere_by_quadrature(3.0, 45.0);
    assert!((whole - 0.039_283_7).abs() < 1e-6, "{whole}");
    assert_none(
        [
            (1.5, 60.0),
            (2.0, 90.0),
            (3.0, 100.0),
            (1.0001, 0.0),
            (1.0001, 90.0),
        ]
        .map(|(distance, angle)| {
            let light = Light {
                visible: false,
                ..glowing(ball(distance, angle))
            };
            let expected = sphere_by_quadrature(distance, angle);
            check(
                &format!("{distance} at {angle}°"),
                floor_under(vec![light]),
                expected,
                5e-3,
            )
        }),
    );
}

#[test]
fn within_a_sphere_light_it_shines_from_all_sides() {
    assert_none([0.0, 0.3, 0.9].map(|distance| {
        let got = floor_under(vec![glowing(ball(distance, 20.0))]);
        check(&format!("{distance} from its middle"), got, 0.5, 5e-3)
    }));
}

#[test]
fn a_square_light_gives_its_form_factor() {
    assert_none(
        [(0.5, 0.415_514_3), (1.0, 0.277_063_2), (2.0, 0.119_728_2)].map(|(height, expected)| {
            let got = floor_under(vec![glowing(square(DVec3::Y * height))]);
            check(&format!("{height} above"), got, expected, 1e-3)
        }),
    );
}

#[test]
fn a_disc_light_gives_its_form_factor() {
    // k_d R²/(R² + h²).
    assert_none([(1.0, 0.25), (2.0, 0.1)].map(|(height, expected)| {
        let disc = LightKind::Disc {
            center: DVec3::Y * height,
            normal: DVec3::NEG_Y,
            radius: 1.0,
        };
        check(
            &format!("{height} above"),
            floor_under(vec![glowing(disc)]),
            expected,
            1e-3,
        )
    }));
}

#[test]
fn a_tilted_parallelogram_gives_lamberts_formula() {
    let (center, edge_u, edge_v) = (
        dvec3(0.4, 1.2, -0.3),
        dvec3(0.5, 0.3, 0.1),
        dvec3(-0.1, 0.2, 0.6),
    );
    let corners = [
        center - edge_u - edge_v,
        center - edge_u + edge_v,
        center + edge_u + edge_v,
        center + edge_u - edge_v,
    ];
    // Lambert 1760: E = L/2 Σ Θ (Γ·n), over the edges; here the sign follows the winding.
    let sum: f64 = (0..4)
        .map(|i| {
            let (a, b) = (corners[i].normalize(), corners[(i + 1) % 4].normalize());
            a.dot(b).acos() * a.cross(b).normalize().y
        })
        .sum();
    let expected = 0.5 / (2.0 * PI) * sum.abs();
    let down = |kind| floor_under(vec![glowing(kind)]);
    let light = |edge_u, edge_v| LightKind::Rectangle {
        center,
        edge_u,
        edge_v,
    };
    // The normal, u × v, decides which of the two orders lights the floor.
    let (front, back) = (light(edge_u, edge_v), light(edge_v, edge_u));
    let faces = edge_u.cross(edge_v).dot(-center) > 0.0;
    let (front, back) = if faces { (front, back) } else { (back, front) };
    assert_none([check("front", down(front), expected, 1e-3)]);
    assert_eq!(down(back), 0.0, "it does not shine backwards");
}

#[test]
fn lights_below_the_surface_give_none() {
    let below = [
        ball(2.0, 180.0),
        square(DVec3::NEG_Y),
        LightKind::Disc {
            center: DVec3::NEG_Y,
            normal: DVec3::Y,
            radius: 0.5,
        },
    ];
    for kind in below {
        assert_eq!(floor_under(vec![glowing(kind)]), 0.0, "{kind:?}");
    }
}

#[test]
fn without_attenuation_a_light_is_the_mean_of_point_lights() {
    const PARTS: u32 = 400;
    let height = 0.7;
    let at = |i: u32| (f64::from(i) + 0.5) / f64::from(PARTS) * 2.0 - 1.0;
    let sum: f64 = (0..PARTS * PARTS)
        .map(|i| dvec3(at(i % PARTS), height, at(i / PARTS)).normalize().y)
        .sum();
    let light = |edge_u, edge_v| Light {
        attenuation: Attenuation::None,
        color: Vec3::splat(0.8),
        ..glowing(LightKind::Rectangle {
            center: DVec3::Y * height,
            edge_u,
            edge_v,
        })
    };
    let expected = 0.5 * 0.8 * sum / f64::from(PARTS * PARTS);
    assert_none([
        check(
            "down",
            floor_under(vec![light(DVec3::X, DVec3::Z)]),
            expected,
            1e-3,
        ),
        check(
            "up",
            floor_under(vec![light(DVec3::Z, DVec3::X)]),
            expected,
            1e-3,
        ),
    ]);
}

#[test]
fn lights_of_all_kinds_add_up() {
    let point = Light {
        kind: LightKind::Point {
            position: DVec3::Y * 2.0,
        },
        color: Vec3::splat(0.4),
        attenuation: Attenuation::InverseSquare,
        // Ignored by lights without area.
        samples: 9,
        ..Light::default()
    };
    // Invisible, so that none blocks the light of another.
    let unseen = |kind| Light {
        visible: false,
        ..glowing(kind)
    };
    let got = floor_under(vec![
        unseen(ball(3.0, 45.0)),
        point,
        unseen(square(dvec3(0.0, 2.0, 0.0))),
    ]);
    assert_none([check(
        "sum",
        got,
        0.039_283_7 + 0.5 * 0.1 + 0.119_728_2,
        1e-3,
    )]);
}

#[test]
fn each_light_sample_that_faces_the_surface_is_one_shadow_ray() {
    let mut scene = floor();
    let point = Light {
        kind: LightKind::Point { position: DVec3::Y },
        color: Vec3::ONE,
        samples: 9,
        ..Light::default()
    };
    let lamp = |samples, kind| Light {
        samples,
        ..glowing(kind)
    };
    scene.lights = vec![
        point,
        lamp(7, ball(4.0, 0.0)),
        lamp(5, square(DVec3::NEG_Y)),
    ];
    let shadow_rays = |light_samples| {
        let settings = RenderSettings {
            light_samples,
            samples: 3,
            ..sized(4, 2)
        };
        let pixels = 4 * 2 * 3;
        let (_, stats) = render(&scene, &counting(&settings));
        stats.rays.expect("counts").shadow / pixels
    };
    assert_eq!(shadow_rays(1.0), 1 + 7);
    assert_eq!(shadow_rays(2.0), 1 + 14);
    assert_eq!(shadow_rays(0.5), 1 + 4);
    assert_eq!(shadow_rays(0.01), 1 + 1);
}

/// The part of a unit disc beyond a half-plane, by the position of its edge.
fn half_covered(at: f64) -> f64 {
    let at = at.clamp(-1.0, 1.0);
    (at.acos() - at * (1.0 - at * at).sqrt()) / PI
}

/// ∫ V (1 - V) over the edge of a shadow, which is proportional to its width.
fn softness(fractions: impl Iterator<Item = f64>, step: f64) -> f64 {
    fractions
        .map(|fraction| fraction * (1.0 - fraction))
        .sum::<f64>()
        * step
}

#[test]
fn the_penumbra_of_a_sphere_light_is_as_wide_as_geometry_says() {
    const WIDTH: u32 = 256;
    let (light_height, radius, edge_height) = (20.0, 0.5, 4.0);
    let mut scene = floor();
    // A horizontal wall at edge_height, from x = 0 to the left.
    let place = DAffine3::from_translation(dvec3(-50.0, edge_height, 0.0));
    scene.add_mesh(scenes::quad(100.0, 0), place);
    scene.lights = vec![glowing(LightKind::Sphere {
        center: DVec3::Y * light_height,
        radius,
    })];
    // From below the wall, straight down, so that the picture covers 1/2 of the floor.
    let (eye_height, seen) = (3.0, 0.5);
    scene.cameras[0] = Camera {
        look_from: DVec3::Y * eye_height,
        look_at: DVec3::ZERO,
        up: DVec3::Z,
        fov_y: 2.0 * (seen / f64::from(WIDTH) / 2.0 / eye_height).atan(),
        ..Camera::default()
    };
    let settings = RenderSettings {
        samples: 16,
        ..sized(WIDTH, 1)
    };
    let (image, _) = render(&scene, &settings);
    let lit = 0.5 * (radius / light_height).powi(2);
    let fractions = image.pixels.iter().map(|pixel| f64::from(pixel[1]) / lit);
    let (dark, bright) = image
        .pixels
        .iter()
        .fold((f64::MAX, 0f64), |(low, high), pixel| {
            let fraction = f64::from(pixel[1]) / lit;
            (low.min(fraction), high.max(fraction))
        });
    assert_eq!(dark, 0.0);
    assert!((bright - 1.0).abs() < 2e-3, "{bright}");

    let half_angle = (radius / (light_height - edge_height)).asin();
    let width = 2.0 * edge_height * half_angle.tan();
    let step = 1e-4;
    let per_radius = softness(
        (0..20_000).map(|i| half_covered(-1.0 + f64::from(i) * step)),
        step,
    );
    let measured = 2.0 * softness(fractions, seen / f64::from(WIDTH)) / per_radius;
    assert!(
        (measured / width - 1.0).abs() < 0.01,
        "{measured}, expected {width}"
    );
}

#[test]
fn soft_shadows_of_every_kind_of_light_match_an_independent_tracer() {
    let lamp = |kind, color| Light {
        kind,
        color,
        attenuation: Attenuation::InverseSquare,
        samples: 64,
        visible: false,
        node: None,
        name: String::new(),
    };
    let kinds = [
        (
            "rectangle",
            LightKind::Rectangle {
                center: dvec3(1.5, 4.0, 1.5),
                edge_u: dvec3(0.2, 0.0, 0.9),
                edge_v: dvec3(0.8, 0.1, 0.0),
            },
        ),
        (
            "disc",
            LightKind::Disc {
                center: dvec3(-2.5, 3.5, 1.5),
                normal: dvec3(0.5, -0.8, -0.2).normalize(),
                radius: 0.8,
            },
        ),
        (
            "sphere",
            LightKind::Sphere {
                center: dvec3(0.4, 3.0, 2.0),
                radius: 0.6,
            },
        ),
    ];
    assert_none(kinds.map(|(name, kind)| {
        let mut scene = scenes::spheres();
        scene.lights = vec![lamp(kind, Vec3::new(9.0, 8.0, 7.0))];
        let settings = RenderSettings {
            samples: 8,
            ..sized(64, 48)
        };
        let expected = trace(&scene, settings.size).image;
        check_alike(name, &expected, &render(&scene, &settings).0, 2.0, 0.001)
    }));
}
