//! What paths from the camera see where there is nothing, opacity, and shadow catchers, against closed forms.

use super::{ball_in, looking, matte, near, paths};
use crate::film::{bytes, film};
use crate::reference::compare::{open_gpu, render};
use crate::support::verdict::Verdict;
use glam::{DAffine3, DVec3, Vec3, dvec3};
use glimray::image::Image;
use glimray::render::RenderSettings;
use glimray::scene::{
    Attenuation, Backdrop, Background, CanonicalShape, Coverage, Geometry, Light, LightKind,
    Material, Scene, Shape,
};

const GREEN: Vec3 = Vec3::new(0.0, 0.5, 0.0);

fn behind(backdrop: Backdrop, samples: u32) -> RenderSettings {
    RenderSettings {
        backdrop,
        ..paths(samples, (16, 16), 8)
    }
}

/// The mean opacity of a picture with nothing behind.
fn opacity(scene: &Scene, samples: u32) -> f64 {
    let (image, _) = render(scene, &behind(Backdrop::Transparent, samples));
    let sum: f64 = image.pixels.iter().map(|pixel| f64::from(pixel[3])).sum();
    sum / image.pixels.len() as f64
}

fn middle(image: &Image) -> [f32; 4] {
    image.pixel(8, 8).expect("a pixel")
}

/// A surface across the view, before a background of 1.
fn pane(material: Material) -> Scene {
    let mut scene = ball_in(1.0, material);
    scene.shapes = vec![Shape {
        geometry: Geometry::Plane {
            point: DVec3::ZERO,
            normal: DVec3::Z,
        },
        material: 0,
        node: None,
    }];
    scene
}

/// A wall without reflection that lets this fraction through.
fn thin(fraction: f32) -> Material {
    Material {
        diffuse: Vec3::ZERO,
        ambient: Vec3::ZERO,
        transmit: Vec3::splat(fraction),
        opacity: 0.0,
        thin: true,
        ..Material::default()
    }
}

#[test]
fn the_camera_sees_the_backdrop_and_surfaces_see_the_background() {
    let mut scene = ball_in(1.0, matte(0.5));
    scene.cameras = vec![looking(5.0 * DVec3::Z, DVec3::ZERO, 0.8)];
    let plain = render(&scene, &behind(Backdrop::Background, 16)).0;
    let colored = render(&scene, &behind(Backdrop::Color(GREEN), 16)).0;
    assert_eq!(plain.pixel(0, 0), Some([1.0, 1.0, 1.0, 1.0]));
    assert_eq!(colored.pixel(0, 0), Some([0.0, 0.5, 0.0, 1.0]));
    assert_eq!(middle(&plain), middle(&colored), "the light is the same");

    let mirror = Material {
        diffuse: Vec3::ZERO,
        reflect: Vec3::ONE,
        ..Material::default()
    };
    let mirrored = render(&pane(mirror), &behind(Backdrop::Color(GREEN), 4)).0;
    assert_eq!(middle(&mirrored), [1.0; 4], "a mirror shows the background");
    let seen = render(&pane(thin(1.0)), &behind(Backdrop::Color(GREEN), 4)).0;
    assert_eq!(
        middle(&seen),
        [0.0, 0.5, 0.0, 1.0],
        "glass shows the backdrop"
    );
}

#[test]
fn opacity_is_what_surfaces_leave_of_the_light_behind() {
    let mut verdict = Verdict::on("opacity");
    let empty = Scene {
        cameras: vec![looking(5.0 * DVec3::Z, DVec3::ZERO, 0.2)],
        background: Background::Color(Vec3::ONE),
        ..Scene::default()
    };
    let holes = Material {
        coverage: Coverage::Blend,
        alpha: 0.3,
        ..matte(0.5)
    };
    for (name, scene, expected, tolerance) in [
        ("nothing", empty, 0.0, 0.0),
        ("a matte ball", ball_in(1.0, matte(0.5)), 1.0, 0.0),
        ("a pane of 75 %", pane(thin(0.75)), 0.25, 1e-6),
        ("a surface that is there to 30 %", pane(holes), 0.3, 0.005),
    ] {
        near(&mut verdict, name, opacity(&scene, 64), expected, tolerance);
    }
    verdict.close();
}

/// The colour of a pixel does not change with the part of it that is covered: it is not multiplied by the opacity.
#[test]
fn colors_of_partly_covered_pixels_are_those_of_the_surface() {
    let mut scene = ball_in(1.0, matte(0.5));
    scene.cameras = vec![looking(5.0 * DVec3::Z, DVec3::ZERO, 0.8)];
    let image = render(&scene, &behind(Backdrop::Transparent, 64)).0;
    let edges = (image.pixels.iter()).filter(|pixel| pixel[3] > 0.05 && pixel[3] < 0.95);
    let found: Vec<_> = edges.map(|pixel| pixel[1]).collect();
    assert!(found.len() > 8, "{} edges", found.len());
    assert!(
        found.iter().all(|green| (green - 0.5).abs() < 1e-4),
        "{found:?}"
    );
}

/// A floor that catches shadows, under a ball or a disc of this radius, seen at the origin from the side.
fn floor(occluder: Option<Geometry>, lights: &[DVec3]) -> Scene {
    let catcher = Material {
        shadow_catcher: true,
        ..matte(0.3)
    };
    let plane = Geometry::Plane {
        point: DVec3::ZERO,
        normal: DVec3::Y,
    };
    let shapes = [(Some(plane), 0), (occluder, 1)];
    let lamp = |position: &DVec3| Light {
        kind: LightKind::Point {
            position: *position,
        },
        color: Vec3::splat(3.0),
        attenuation: Attenuation::InverseSquare,
        ..Light::default()
    };
    Scene {
        cameras: vec![looking(dvec3(0.0, 1.0, 20.0), DVec3::ZERO, 1e-4)],
        materials: vec![catcher, matte(0.5)],
        lights: lights.iter().map(lamp).collect(),
        shapes: shapes
            .into_iter()
            .filter_map(|(geometry, material)| {
                Some(Shape {
                    geometry: geometry?,
                    material,
                    node: None,
                })
            })
            .collect(),
        ..Scene::default()
    }
}

#[test]
fn shadow_catchers_are_as_opaque_as_the_light_that_is_missing() {
    let mut verdict = Verdict::on("shadow catchers");
    let disc = |center: DVec3, radius: f64| {
        let scale = DAffine3::from_scale(DVec3::splat(radius));
        Some(Geometry::Placed {
            canonical: CanonicalShape::Disc { hole: 0.0 },
            world_from_canonical: DAffine3::from_translation(center) * scale,
        })
    };
    let above = dvec3(0.0, 4.0, 0.0);
    let beside = [dvec3(-3.0, 4.0, 0.0), dvec3(3.0, 4.0, 0.0)];
    let cover = disc(dvec3(0.0, 2.0, 0.0), 0.5);
    for (name, scene, expected, tolerance) in [
        ("no shadow", floor(None, &[above]), 0.0, 0.0),
        ("an umbra", floor(cover, &[above]), 1.0, 0.0),
        (
            "one of two equal lamps",
            floor(disc(dvec3(-1.5, 2.0, 0.0), 0.5), &beside),
            0.5,
            0.01,
        ),
        ("no light", floor(cover, &[]), 0.0, 0.0),
    ] {
        near(&mut verdict, name, opacity(&scene, 64), expected, tolerance);
    }
    // A disc of radius r at height h hides r²/(r² + h²) of an even sky from a horizontal surface.
    for (radius, height) in [(0.5, 1.0), (2.0, 1.0), (1.0, 3.0)] {
        let mut scene = floor(disc(dvec3(0.0, height, 0.0), radius), &[]);
        scene.background = Background::Color(Vec3::splat(0.7));
        let hidden = radius * radius / (radius * radius + height * height);
        let name = format!("an even sky behind a disc of {radius} at {height}");
        near(&mut verdict, name, opacity(&scene, 256), hidden, 0.004);
        // With a lamp of the same irradiance that reaches the floor, half of that.
        let mut both = floor(disc(dvec3(0.0, height, 0.0), radius), &[]);
        both.background = scene.background.clone();
        both.lights = vec![Light {
            kind: LightKind::Directional {
                direction: dvec3(0.9, -0.1, 0.0).normalize(),
            },
            color: Vec3::splat(0.7 / dvec3(0.9, -0.1, 0.0).normalize().y.abs() as f32),
            attenuation: Attenuation::None,
            ..Light::default()
        }];
        let name = format!("and as much light from a lamp, {radius} at {height}");
        let is_hidden = radius >= 9.0 * height;
        let expected = if is_hidden {
            0.5 + hidden / 2.0
        } else {
            hidden / 2.0
        };
        near(&mut verdict, name, opacity(&both, 512), expected, 0.01);
    }
    verdict.close();
}

#[test]
fn films_keep_opacity_however_they_are_cut() {
    let above = dvec3(0.3, 4.0, 0.0);
    let ball = Geometry::Sphere {
        center: dvec3(0.0, 1.0, 0.0),
        radius: 0.7,
    };
    let mut scene = floor(Some(ball), &[above]);
    scene.cameras = vec![looking(dvec3(0.0, 4.0, 8.0), DVec3::ZERO, 0.6)];
    for features in [false, true] {
        let whole = RenderSettings {
            features,
            ..behind(Backdrop::Transparent, 192)
        };
        let part = |range| RenderSettings {
            sample_range: Some(range),
            ..whole.clone()
        };
        let expected = film(&scene, &whole);
        let later = film(&scene, &part(64..192));
        let merged = later.merge(&film(&scene, &part(0..64))).expect("a film");
        assert_eq!(bytes(&merged), bytes(&expected));
        let (image, _) = render(&scene, &whole);
        let gpu = open_gpu();
        let developed = merged
            .develop(&gpu, &glimray::render::Tone::LINEAR)
            .expect("a picture");
        assert_eq!(image, developed, "renderer and film agree");
        let partly = |pixel: &&[f32; 4]| pixel[3] > 0.01 && pixel[3] < 0.99;
        assert!(image.pixels.iter().filter(partly).count() > 4);
        if features {
            let features = merged.features().expect("features");
            let denoised = features.picture().denoised(&gpu, &features);
            let denoised = denoised.expect("a picture");
            let apart = |(a, b): (&[f32; 4], &[f32; 4])| f64::from((a[3] - b[3]).abs());
            let pixels = image.pixels.iter().zip(&denoised.pixels);
            let mean = pixels.map(apart).sum::<f64>() / 256.0;
            assert!(mean < 0.03, "denoising moves opacity by {mean}");
        }
    }
}
