//! The texture coordinate view: u in red, v in green, fields of an eighth.

use crate::reference::compare::{render, sized};
use crate::reference::scenes::{self, Build};
use crate::support::harness::gpu;
use crate::support::verdict::Tolerance;
use glam::{DAffine3, DVec3, Vec2, dvec3};
use glimray::image::Image;
use glimray::render::{Integrator, RenderSettings};
use glimray::scene::{Camera, Scene};
use std::f64::consts::{FRAC_PI_2, PI};

#[test]
fn u_is_red_v_is_green_and_every_other_field_darker() {
    #[rustfmt::skip]
    gpu().check("lib::colormap::uv_color", Tolerance::Absolute(1e-6), &[
        ("the origin is black", [0.0f32, 0.0], [0.0, 0.0, 0.0]),
        ("a bright field", [0.0625, 0.09375], [0.0625, 0.09375, 0.0]),
        ("its neighbour in u", [0.1875, 0.0625], [0.13125, 0.04375, 0.0]),
        ("its neighbour in v", [0.0625, 0.1875], [0.04375, 0.13125, 0.0]),
        ("across the corner", [0.1875, 0.1875], [0.1875, 0.1875, 0.0]),
        ("the last field", [0.9375, 0.9375], [0.9375, 0.9375, 0.0]),
        ("beyond 1 it begins again", [3.0625, 7.0625], [0.0625, 0.0625, 0.0]),
        ("and below 0", [-0.75, -0.9375], [0.25, 0.0625, 0.0]),
    ]);
}

const SIDE: u32 = 64;

/// Two units of the world high and wide, seen orthographically from +Z.
fn scene() -> Scene {
    Scene {
        cameras: vec![Camera {
            look_from: dvec3(0.0, 0.0, 10.0),
            look_at: DVec3::ZERO,
            orthographic_height: Some(2.0),
            ..Camera::default()
        }],
        ..scenes::empty()
    }
}

fn uv(scene: &Scene) -> Image {
    let settings = RenderSettings {
        integrator: Integrator::Uv,
        ..sized(SIDE, SIDE)
    };
    render(scene, &settings).0
}

/// The expected colours, written independently of the shader.
fn expected(u: f64, v: f64) -> [f64; 3] {
    let parity = ((u * 8.0).floor() + (v * 8.0).floor()) as i64 & 1;
    let shade = if parity == 0 { 1.0 } else { 0.7 };
    [u * shade, v * shade, 0.0]
}

/// Standing upright: x and y from -side / 2 to side / 2.
fn upright(x: f64, y: f64) -> DAffine3 {
    DAffine3::from_translation(dvec3(x, y, 0.0)) * DAffine3::from_rotation_x(FRAC_PI_2)
}

#[test]
fn meshes_show_their_coordinates_and_those_without_are_black() {
    let mut scene = scene();
    let mut quad = scenes::quad(1.0, 0);
    // By the position of its corners when it stands upright.
    quad.uvs = (quad.positions.iter())
        .map(|p| {
            let p = upright(0.0, 0.0).transform_point3(p.as_dvec3());
            Vec2::new(p.x as f32 + 0.5, p.y as f32 + 0.5)
        })
        .collect();
    scene.add_mesh(quad, upright(-0.5, 0.5));
    scene.add_mesh(scenes::quad(1.0, 0), upright(0.5, 0.5));
    let image = uv(&scene);
    let half = SIDE / 2;
    let mut bright = 0;
    for y in 0..SIDE {
        for x in 0..SIDE {
            let pixel = image.pixels[(y * SIDE + x) as usize];
            let found = [pixel[0], pixel[1], pixel[2]].map(f64::from);
            let at = |i: u32| (f64::from(i) + 0.5) / f64::from(half);
            let expected = match x < half && y < half {
                true => expected(at(x), 1.0 - at(y)),
                false => [0.0; 3],
            };
            let off = (0..3)
                .map(|c| (found[c] - expected[c]).abs())
                .fold(0.0, f64::max);
            assert!(off < 1e-4, "{x} {y}: {found:?}, not {expected:?}");
            bright += u32::from(found != [0.0; 3]);
        }
    }
    assert_eq!(bright, half * half);
}

#[test]
fn shapes_show_theirs_without_any_texture_in_the_scene() {
    let mut scene = scene();
    scene.add_sphere(DVec3::ZERO, 1.0, 0);
    assert!(scene.textures.is_empty());
    let image = uv(&scene);
    // v is the angle from the south pole to the north pole over π, along the middle of the picture.
    let x = SIDE / 2;
    for y in [4, 13, 24, 37, 50, 61] {
        let pixel = image.pixels[(y * SIDE + x) as usize];
        let at = |i: u32| (f64::from(i) + 0.5) / f64::from(SIDE / 2) - 1.0;
        let v = 1.0 - (-at(y)).acos() / PI;
        let greens = [v, 0.7 * v];
        let found = f64::from(pixel[1]);
        let off = greens.map(|green| (found - green).abs());
        assert!(off[0].min(off[1]) < 2e-3, "{y}: {found}, not {greens:?}");
        // Half-way between x = 0 and the seam, whichever direction u has.
        assert!(pixel[0] > 0.0 && pixel[2] == 0.0);
    }
    assert_eq!(image.pixels[0][..3], [0.0; 3]);
}

#[test]
fn a_mesh_without_coordinates_is_black_beside_a_shape_that_has_them() {
    let mut scene = scene();
    scene.add_mesh(scenes::quad(1.0, 0), upright(-0.5, 0.5));
    scene.add_sphere(dvec3(0.5, -0.5, 0.0), 0.4, 0);
    let image = uv(&scene);
    let pixel = |x: u32, y: u32| image.pixels[(y * SIDE + x) as usize];
    assert_eq!(pixel(SIDE / 4, SIDE / 4)[..3], [0.0; 3]);
    assert!(pixel(3 * SIDE / 4, 3 * SIDE / 4)[1] > 0.0);
}
