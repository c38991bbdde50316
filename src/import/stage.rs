//! A camera and lights for models that have none.

use super::Options;
use crate::scene::{Background, Camera, Light, LightKind, Scene};
use glam::{DVec3, Vec3};

/// Adds what a model lacks: a camera; and if it has no lights, lights, a background and a ground.
pub(super) fn complete(scene: &mut Scene, options: &Options) {
    if scene.lights.is_empty() && options.staging.lights {
        light(scene);
    }
    if scene.cameras.is_empty() {
        scene.cameras = vec![match options.staging.camera {
            true => camera(scene),
            false => Camera::default(),
        }];
    }
}

/// A camera that sees all of `scene` from the front, slightly right and above, in an image of aspect
/// ratio 4:3 or wider; the course's camera if nothing in the scene is bounded.
pub(super) fn camera(scene: &Scene) -> Camera {
    let Some((min, max)) = scene.bounds() else {
        return Camera::default();
    };
    let center = (min + max) / 2.0;
    // Never 0, not even for a single point far from the origin.
    let half = ((max - min) / 2.0).max(DVec3::splat(1e-6 * center.abs().max_element().max(1e-6)));
    let backward = DVec3::new(0.55, 0.4, 1.0).normalize();
    let right = DVec3::Y.cross(backward).normalize();
    let up = backward.cross(right);

    let fov_y = 35_f64.to_radians();
    let slope = (fov_y / 2.0).tan();
    // Distance at which a corner of the box lies on the edge of the image.
    let distance = |i: u8| {
        let side = |bit: u8| if i & bit == 0 { -1.0 } else { 1.0 };
        let corner = half * DVec3::new(side(1), side(2), side(4));
        let height = corner.dot(up).abs().max(corner.dot(right).abs() * 0.75);
        corner.dot(backward) + height / slope
    };
    let distance = (0..8).map(distance).fold(0.0, f64::max);
    Camera {
        look_from: center + 1.06 * distance * backward,
        look_at: center,
        fov_y,
        ..Camera::default()
    }
}

/// Lights, background and ambient light for a bare model: a warm key light from the right above, a cool
/// fill light from the left, and enough ambient light that nothing is black.
fn light(scene: &mut Scene) {
    let sun = |towards: DVec3, color: Vec3| Light {
        kind: LightKind::Directional {
            direction: towards.normalize(),
        },
        color,
        ..Light::default()
    };
    scene.lights = vec![
        sun(DVec3::new(-0.6, -1.0, -0.7), Vec3::new(0.85, 0.81, 0.74)),
        sun(DVec3::new(1.0, -0.35, -0.6), Vec3::new(0.16, 0.19, 0.25)),
    ];
    scene.background = Background::Color(Vec3::new(0.54, 0.62, 0.72));
    scene.ambient = Vec3::new(0.14, 0.15, 0.17);
    scene.staged = true;
}
