//! Fixed ray offsets in whole pictures: the failures that they have and the error bound has not.

use crate::reference::compare::{counting, render, sized};
use crate::reference::scenes::Build;
use glam::{DAffine3, DQuat, DVec3, Vec3, dvec3};
use glimray::image::Image;
use glimray::render::{RayOffset, RenderSettings};
use glimray::scene::{
    Attenuation, Background, Camera, CanonicalShape, Geometry, Light, LightKind, Material, Phong,
    Scene, Shape,
};

/// White surfaces in the light of a sun that shines in `direction`.
fn sunlit(camera: Camera, direction: DVec3) -> Scene {
    Scene {
        cameras: vec![camera],
        materials: vec![Material::from(Phong {
            diffuse: Vec3::splat(0.5),
            ..Phong::default()
        })],
        background: Background::Color(Vec3::ONE),
        lights: vec![Light {
            kind: LightKind::Directional {
                direction: direction.normalize(),
            },
            color: Vec3::ONE,
            attenuation: Attenuation::None,
            samples: 1,
            visible: false,
            node: None,
            name: String::new(),
        }],
        ..Scene::default()
    }
}

/// A floor from above, 16 pixels to a unit, the origin in the middle; on it a box of this height,
/// from x = -0.05 to x = 0. The sun shines towards -x and falls by 1 over `slope`.
fn box_on_a_floor(height: f64, slope: f64) -> Scene {
    let camera = Camera {
        look_from: dvec3(0.0, 5.0, 0.0),
        look_at: DVec3::ZERO,
        up: DVec3::NEG_Z,
        orthographic_height: Some(4.0),
        ..Camera::default()
    };
    let mut scene = sunlit(camera, dvec3(-slope, -1.0, 0.0));
    scene.add_plane(DVec3::ZERO, DVec3::Y, 0);
    let half = dvec3(0.025, height / 2.0, 5.0);
    let center = dvec3(-0.025, height / 2.0, 0.0);
    scene.shapes.push(Shape {
        geometry: Geometry::Placed {
            canonical: CanonicalShape::Box,
            world_from_canonical: DAffine3::from_scale_rotation_translation(
                half,
                DQuat::IDENTITY,
                center,
            ),
        },
        material: 0,
        node: None,
        name: String::new(),
    });
    scene
}

/// With so many columns of a shadow in the middle row.
fn shadow_columns(scene: &Scene, offset: RayOffset) -> usize {
    let settings = RenderSettings {
        offset,
        ..sized(64, 64)
    };
    let (image, _): (Image, _) = render(scene, &settings);
    let row = &image.pixels[32 * 64..33 * 64];
    row.iter().filter(|pixel| pixel[0] == 0.0).count()
}

#[test]
fn an_offset_below_the_rounding_error_gives_shadow_acne() {
    // Render space has its origin at the camera, so that the numbers of the sphere are rounded to 1e-3. Nothing
    // but the sphere itself could block the light.
    let camera = Camera {
        look_from: dvec3(0.0, 0.0, 1e4),
        look_at: DVec3::ZERO,
        fov_y: 2e-4,
        ..Camera::default()
    };
    let mut scene = sunlit(camera, dvec3(-0.5, -0.3, -1.0));
    scene.add_sphere(DVec3::ZERO, 1.0, 0);
    let acne = |offset| {
        let settings = RenderSettings {
            offset,
            ..sized(64, 64)
        };
        let (_, stats) = render(&scene, &counting(&settings));
        let rays = stats.rays.expect("counts");
        assert!(rays.shadow > 1000, "{offset}: {rays:?}");
        rays.shadow_blocked as f64 / rays.shadow as f64
    };
    assert_eq!(acne(RayOffset::Bound), 0.0);
    assert_eq!(acne(RayOffset::Fixed(0.1)), 0.0);
    let share = acne(RayOffset::Fixed(1e-5));
    assert!(share > 0.05, "{share} of the shadow rays");
}

#[test]
fn an_offset_shortens_shadows_by_its_own_height() {
    // The sun stands at 45°: a box of height 1 has a shadow of 16 columns.
    let scene = box_on_a_floor(1.0, 1.0);
    let columns = |offset| shadow_columns(&scene, offset);
    assert_eq!(columns(RayOffset::Bound), 16);
    assert_eq!(columns(RayOffset::Fixed(1e-3)), 16);
    assert_eq!(columns(RayOffset::Fixed(0.25)), 12);
    assert_eq!(columns(RayOffset::Fixed(0.5)), 8);
}

#[test]
fn what_is_lower_than_the_offset_has_no_contact_shadow() {
    // A shadow of 0.05 · 4, which is 0.2 units or three columns.
    let scene = box_on_a_floor(0.05, 4.0);
    assert_eq!(shadow_columns(&scene, RayOffset::Bound), 3);
    assert_eq!(shadow_columns(&scene, RayOffset::Fixed(0.1)), 0);
}
