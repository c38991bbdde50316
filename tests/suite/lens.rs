//! The thin lens in whole renders: out-of-focus points become images of the aperture, of the size given by the
//! lens formula.

use crate::reference::compare::{assert_none, check_same_bits, render, sized, start_packed};
use crate::reference::scenes::Build;
use glam::{DVec3, Vec3, dvec3};
use glimray::image::Image;
use glimray::pack;
use glimray::render::{Antialias, Integrator, RenderSettings, Tone};
use glimray::scene::{Background, Camera, Lens, Light, LightKind, Material, Phong, Scene};
use std::sync::Arc;

const SIDE: u32 = 48;
const FOCUS: f64 = 10.0;
/// Half the height of the picture, at distance 1.
const HALF_HEIGHT: f64 = 0.1;

const ROUND: Lens = Lens {
    radius: 0.25,
    focus_distance: FOCUS,
    blade_count: 0,
    blade_rotation: 0.0,
};

/// An emissive ball at `depth` in the middle of a dark picture that covers `fraction` of its height.
fn ball(depth: f64, fraction: f64, lens: Option<Lens>) -> Scene {
    let mut scene = Scene {
        cameras: vec![Camera {
            look_from: DVec3::ZERO,
            look_at: DVec3::NEG_Z,
            fov_y: 2.0 * HALF_HEIGHT.atan(),
            lens,
            ..Camera::default()
        }],
        materials: vec![Material {
            emission: Vec3::ONE,
            bsdf: Phong {
                diffuse: Vec3::ZERO,
                ..Phong::default()
            }
            .into(),
            ..Material::default()
        }],
        background: Background::Color(Vec3::ZERO),
        ..Scene::default()
    };
    scene.add_sphere(dvec3(0.0, 0.0, -depth), fraction * HALF_HEIGHT * depth, 0);
    scene
}

fn picture(scene: &Scene, integrator: Integrator) -> Image {
    let settings = RenderSettings {
        samples: 256,
        antialias: Antialias::Stratified,
        integrator,
        ..sized(SIDE, SIDE)
    };
    render(scene, &settings).0
}

/// The mean of x^i y^j, weighted by radiance, with x to the right, y up and the edges at ±1.
fn moment(image: &Image, i: i32, j: i32) -> f64 {
    let (mut sum, mut light) = (0.0, 0.0);
    for (index, pixel) in (0..).zip(&image.pixels) {
        let at = |index: u32| (f64::from(index) + 0.5) / f64::from(SIDE) * 2.0 - 1.0;
        let (x, y) = (at(index % SIDE), -at(index / SIDE));
        sum += f64::from(pixel[1]) * x.powi(i) * y.powi(j);
        light += f64::from(pixel[1]);
    }
    sum / light
}

#[test]
fn the_circle_of_confusion_has_the_size_of_the_thin_lens_formula() {
    let fraction = 0.2;
    let depths = [4.0, 5.0, 40.0, 1000.0].map(|depth| (Integrator::Whitted, depth));
    let rows = depths
        .into_iter()
        .chain([(Integrator::Path, 5.0), (Integrator::Path, 40.0)]);
    assert_none(rows.map(|(integrator, depth)| {
        let image = picture(&ball(depth, fraction, Some(ROUND)), integrator);
        // The variance of a disc along each axis is a quarter of its squared radius; that of the ball itself is
        // added, and a twelfth of the squared side of a pixel.
        let pixel = 2.0 / f64::from(SIDE);
        let spread = moment(&image, 2, 0) + moment(&image, 0, 2) - pixel * pixel / 6.0;
        let measured = 2.0 * (2.0 * spread - fraction * fraction).sqrt();
        let expected = 2.0 * ROUND.radius * (1.0 / FOCUS - 1.0 / depth).abs() / HALF_HEIGHT;
        if (measured / expected - 1.0).abs() < 0.01 {
            return Ok(());
        }
        Err(format!(
            "{integrator:?}, depth {depth}: {measured} wide, expected {expected}"
        ))
    }));
}

#[test]
fn points_in_focus_are_as_sharp_as_through_a_pinhole() {
    let spread = |lens| {
        let image = picture(&ball(FOCUS, 0.5, lens), Integrator::Whitted);
        moment(&image, 2, 0) + moment(&image, 0, 2)
    };
    let (sharp, pinhole) = (spread(Some(ROUND)), spread(None));
    assert!(
        (sharp / pinhole - 1.0).abs() < 2e-3,
        "{sharp} and {pinhole}"
    );
}

#[test]
fn the_blur_is_the_opening_upright_behind_the_focus_and_turned_before_it() {
    let triangle = |rotation: f64| Lens {
        blade_count: 3,
        blade_rotation: rotation.to_radians(),
        radius: 0.35,
        ..ROUND
    };
    let shape = |lens, depth| {
        let image = picture(&ball(depth, 0.3, Some(lens)), Integrator::Whitted);
        [
            moment(&image, 3, 0),
            moment(&image, 0, 3),
            moment(&image, 1, 0),
        ]
    };
    // A triangle with a corner to the right: the mean of x³ is r³/40, and none in y.
    let r: f64 = 0.35 * (1.0 / FOCUS - 1.0 / 1e3) / HALF_HEIGHT;
    let [x, y, middle] = shape(triangle(0.0), 1e3);
    assert!((x / (r.powi(3) / 40.0) - 1.0).abs() < 0.05, "{x}");
    assert!(y.abs() < 0.1 * x && middle.abs() < 0.01, "{y}, {middle}");
    let [x, y, _] = shape(triangle(90.0), 1e3);
    assert!(y > 0.0 && x.abs() < 0.1 * y, "a corner above: {x}, {y}");
    let [x, y, _] = shape(triangle(0.0), FOCUS / 2.0);
    assert!(
        x < 0.0 && y.abs() < -0.1 * x,
        "a corner to the left: {x}, {y}"
    );
}

#[test]
fn many_blades_are_a_round_opening() {
    let spread = |lens| {
        moment(
            &picture(&ball(40.0, 0.3, Some(lens)), Integrator::Whitted),
            2,
            0,
        )
    };
    let (many, round) = (
        spread(Lens {
            blade_count: 64,
            ..ROUND
        }),
        spread(ROUND),
    );
    assert!((many / round - 1.0).abs() < 0.01, "{many} and {round}");
}

#[test]
fn a_lens_without_radius_is_a_pinhole_bit_for_bit() {
    let closed = Lens {
        radius: 0.0,
        ..ROUND
    };
    let [a, b] =
        [Some(closed), None].map(|lens| picture(&ball(5.0, 0.3, lens), Integrator::Whitted));
    assert_none([check_same_bits("closed", &a, &b)]);
}

#[test]
fn a_frame_may_bring_a_lens_and_a_light_with_extent() {
    let first = ball(5.0, 0.3, None);
    let mut second = ball(5.0, 0.3, Some(ROUND));
    second.lights.push(Light {
        kind: LightKind::Sphere {
            center: dvec3(2.0, 2.0, 0.0),
            radius: 0.5,
        },
        color: Vec3::ONE,
        samples: 2,
        ..Light::default()
    });
    let settings = RenderSettings {
        samples: 4,
        antialias: Antialias::Stratified,
        ..sized(SIDE, SIDE)
    };
    let packed = Arc::new(pack::scene(&first).expect("packed"));
    let view = |scene: &Scene| packed.frame(&scene.frame(0.0)).expect("a frame");
    let mut renderer = start_packed(packed.clone(), &view(&first), &settings);
    renderer.set_frame(&view(&second)).expect("a frame");
    while !renderer.is_done() {
        renderer.step().expect("a step");
    }
    let got = renderer.develop(&Tone::LINEAR).expect("a picture");
    assert_none([check_same_bits(
        "second frame",
        &render(&second, &settings).0,
        &got,
    )]);
}
