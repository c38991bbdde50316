//! Backdrops, opacity, and shadow catchers, against closed forms.

use super::{ball_in, clear, looking, matte, near, paths};
use crate::film::{bytes, film, traced};
use crate::reference::compare::{open_gpu, render};
use crate::reference::scenes::Build;
use crate::support::verdict::Verdict;
use glam::{DAffine3, DVec3, Vec3, dvec3};
use glimray::image::Image;
use glimray::render::{Filter, RenderSettings, denoise};
use glimray::scene::{
    Antialias, Attenuation, Backdrop, Background, CanonicalShape, Coverage, Fresnel, Geometry,
    Light, LightKind, Material, Phong, Scene, Shape,
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
    mean_opacity(&render(scene, &behind(Backdrop::Transparent, samples)).0)
}

fn mean_opacity(image: &Image) -> f64 {
    let sum: f64 = image.pixels.iter().map(|pixel| f64::from(pixel[3])).sum();
    sum / image.pixels.len() as f64
}

/// The root mean square difference of the opacity of pairs of pixels.
fn opacity_error<'a>(pairs: impl IntoIterator<Item = (&'a [f32; 4], &'a [f32; 4])>) -> f64 {
    let squares = (pairs.into_iter()).map(|(a, b)| f64::from(a[3] - b[3]).powi(2));
    let squares: Vec<_> = squares.collect();
    (squares.iter().sum::<f64>() / squares.len() as f64).sqrt()
}

fn middle(image: &Image) -> [f32; 4] {
    image.pixel(8, 8).expect("a pixel")
}

/// A surface across the view, before a background of 1.
fn pane(material: Material) -> Scene {
    let mut scene = ball_in(1.0, material);
    scene.shapes.clear();
    scene.add_plane(DVec3::ZERO, DVec3::Z, 0);
    scene
}

/// A wall without reflection that lets this fraction through.
fn thin(fraction: f32) -> Material {
    Material {
        thin: true,
        bsdf: Phong {
            diffuse: Vec3::ZERO,
            ambient: Vec3::ZERO,
            transmit: Vec3::splat(fraction),
            opacity: 0.0,
            ..Phong::default()
        }
        .into(),
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

    let mirror = Material::from(Phong {
        diffuse: Vec3::ZERO,
        reflect: Vec3::ONE,
        ..Phong::default()
    });
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

/// A black floor that catches shadows, under something black, seen at the origin from the side.
fn floor(occluder: Option<Geometry>, lights: &[DVec3]) -> Scene {
    let catcher = Material {
        shadow_catcher: true,
        ..matte(0.0)
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
        materials: vec![catcher, matte(0.0)],
        lights: lights.iter().map(lamp).collect(),
        shapes: shapes
            .into_iter()
            .filter_map(|(geometry, material)| {
                Some(Shape {
                    geometry: geometry?,
                    material,
                    node: None,
                    name: String::new(),
                })
            })
            .collect(),
        ..Scene::default()
    }
}

/// A level disc.
fn disc(center: DVec3, radius: f64) -> Option<Geometry> {
    let scale = DAffine3::from_scale(DVec3::splat(radius));
    Some(Geometry::Placed {
        canonical: CanonicalShape::Disc { hole: 0.0 },
        world_from_canonical: DAffine3::from_translation(center) * scale,
    })
}

#[test]
fn shadow_catchers_are_as_opaque_as_the_light_that_is_missing() {
    let mut verdict = Verdict::on("shadow catchers");
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

/// A wall that reflects ρ beside a shadow: of the light E of a distant lamp, which reaches the floor at the angle θ, the wall
/// scatters ρ E sin θ, and half of what the floor sees is wall. The lamp alone would give it E cos θ.
#[test]
fn light_of_a_wall_fills_the_shadow_on_a_catcher() {
    let mut verdict = Verdict::on("a wall beside a shadow");
    for (albedo, tangent) in [(0.8, 1.0), (0.5, 2.0), (0.8, 0.25), (0.9, 3.0)] {
        let mut scene = floor(disc(dvec3(2.0 * tangent, 2.0, 0.0), 0.5), &[]);
        let direction = dvec3(-tangent, -1.0, 0.0).normalize();
        scene.lights = vec![Light {
            kind: LightKind::Directional { direction },
            color: Vec3::ONE,
            attenuation: Attenuation::None,
            ..Light::default()
        }];
        let wall = scene.add_material(matte(albedo));
        scene.add_plane(DVec3::NEG_X, DVec3::X, wall);
        let filled = (f64::from(albedo) * tangent / 2.0).min(1.0);
        let name = format!("a wall of {albedo} and a slope of {tangent}");
        near(&mut verdict, name, opacity(&scene, 128), 1.0 - filled, 0.01);
    }
    verdict.close();
}

/// A distant ball as a lamp, which a disc hides, shines back from a mirror beside the shadow. Paths meet it there with the
/// chance p of a direction within the ball, and find 1/p times the light without shadow. Of that they count eight times, so
/// that 8 p of the shadow is filled, and not all of it.
#[test]
fn a_lamp_that_paths_seldom_meet_in_a_mirror_makes_no_hole_in_a_shadow() {
    let mut verdict = Verdict::on("a mirror beside a shadow");
    for (tangent, half_angle) in [(1.0_f64, 0.05_f64), (0.5, 0.1)] {
        let mut scene = floor(disc(dvec3(2.0 * tangent, 2.0, 0.0), 1.0), &[]);
        let toward = dvec3(tangent, 1.0, 0.0).normalize();
        let distance = 1e3;
        scene.lights = vec![Light {
            kind: LightKind::Sphere {
                center: distance * toward,
                radius: distance * half_angle.sin(),
            },
            color: Vec3::splat(1e6),
            attenuation: Attenuation::InverseSquare,
            visible: true,
            ..Light::default()
        }];
        let wall = scene.add_material(Material {
            bsdf: Phong {
                reflect: Vec3::ONE,
                ..matte(0.0).classical().into_owned()
            }
            .into(),
            ..matte(0.0)
        });
        scene.add_plane(DVec3::NEG_X, DVec3::X, wall);
        let chance = half_angle.sin().powi(2) * toward.y;
        let name = format!("a slope of {tangent} and a lamp of {half_angle}");
        let expected = 1.0 - 8.0 * chance;
        near(&mut verdict, name, opacity(&scene, 512), expected, 0.006);
    }
    verdict.close();
}

/// Light of an even sky reaches a floor through a large pane of thick glass, less what its faces reflect between them:
/// of each direction (1 − F)/(1 + F).
#[test]
fn light_that_glass_refracts_onto_a_catcher_is_no_shadow() {
    const INDEX: f64 = 1.5;
    let pane = Geometry::Placed {
        canonical: CanonicalShape::Box,
        world_from_canonical: DAffine3::from_translation(dvec3(0.0, 3.0, 0.0))
            * DAffine3::from_scale(dvec3(1e4, 0.5, 1e4)),
    };
    let mut scene = floor(Some(pane), &[]);
    scene.background = Background::Color(Vec3::splat(0.7));
    scene.materials[1] = Material {
        bsdf: Phong {
            reflect: Vec3::ONE,
            transmit: Vec3::ONE,
            opacity: 0.0,
            ior: INDEX as f32,
            fresnel: Fresnel::Exact,
            ..matte(0.0).classical().into_owned()
        }
        .into(),
        ..matte(0.0)
    };
    let passing = |cosine: f64| {
        let refracted = (1.0 - (1.0 - cosine * cosine) / (INDEX * INDEX)).sqrt();
        let s = (cosine - INDEX * refracted) / (cosine + INDEX * refracted);
        let p = (INDEX * cosine - refracted) / (INDEX * cosine + refracted);
        let fresnel = 0.5 * (s * s + p * p);
        (1.0 - fresnel) / (1.0 + fresnel)
    };
    const STEPS: u32 = 10_000;
    let cosines = (0..STEPS).map(|step| (f64::from(step) + 0.5) / f64::from(STEPS));
    let arriving: f64 = cosines.map(|cosine| 2.0 * cosine * passing(cosine)).sum();
    let expected = 1.0 - arriving / f64::from(STEPS);
    let mut verdict = Verdict::on("a pane of glass above a catcher");
    near(
        &mut verdict,
        "opacity",
        opacity(&scene, 256),
        expected,
        0.003,
    );
    // Some weights of this filter are negative, and so may be the first.
    let mitchell = RenderSettings {
        filter: Filter::Mitchell,
        filter_radius: 2.0,
        ..behind(Backdrop::Transparent, 256)
    };
    let found = mean_opacity(&render(&scene, &mitchell).0);
    near(&mut verdict, "with negative weights", found, expected, 0.01);
    verdict.close();
}

/// Paths find a small glowing ball in a shell of glass that bends nothing, in a fraction f = sin² θ of the samples of a floor
/// below. The light of radiance R counts up to eight times U, which is that of the ball and of the sky of 1.
#[test]
fn what_the_cap_takes_from_catchers_is_reported() {
    const RADIANCE: f64 = 1e4;
    let mut scene = floor(None, &[]);
    scene.background = Background::Color(Vec3::ONE);
    let center = dvec3(0.0, 3.0, 0.0);
    scene.materials[1].emission = Vec3::splat(RADIANCE as f32);
    scene.add_sphere(center, 0.15, 1);
    let bare = traced(&scene, &behind(Backdrop::Transparent, 64)).catcher_light();
    assert_eq!(
        bare.expect("sums").removed,
        0.0,
        "light samples have no cap"
    );

    let shell = scene.add_material(clear());
    scene.add_sphere(center, 0.16, shell);
    let settings = RenderSettings {
        size: (8, 8),
        ..behind(Backdrop::Transparent, 4096)
    };
    let light = traced(&scene, &settings).catcher_light().expect("sums");
    let fraction = (0.15_f64 / 3.0).powi(2);
    let most = 8.0 * (1.0 + fraction * RADIANCE);
    let removed = fraction * (RADIANCE - most);
    let kept = 1.0 - fraction + fraction * most;
    let cut = light.cut().expect("a share");
    let expected = removed / (kept + removed);
    assert!((cut - expected).abs() < 0.008, "{cut}, not {expected}");
}

/// An emissive wall, which light samples do not choose, fills half of what the floor sees, and a disc hides half of that and of
/// the sky beside it. So L = 1/4 · 0.5 + 1/4 · 1. U is the whole sky, as nothing but what is hit is known of the wall, and the
/// part of the wall that the floor sees: 0.5 + 1/4 · 1.
#[test]
fn emitters_that_light_samples_do_not_find_are_light_without_shadow_too() {
    let mut scene = floor(disc(dvec3(0.0, 1.0, 0.0), 1.0), &[]);
    scene.background = Background::Color(Vec3::splat(0.5));
    scene.materials.push(Material {
        emission: Vec3::ONE,
        ..matte(0.0)
    });
    scene.add_plane(dvec3(-1.001, 0.0, 0.0), DVec3::X, 2);
    let mut verdict = Verdict::on("a disc beside an emissive wall");
    near(&mut verdict, "opacity", opacity(&scene, 256), 0.5, 0.005);
    verdict.close();
}

/// Where a lamp does not shine, half of the samples have no light at all, and the shadow of another one has no noise.
#[test]
fn adaptive_sampling_takes_few_samples_of_an_umbra_beside_a_lamp_that_does_not_reach_it() {
    let mut scene = floor(disc(dvec3(0.0, 2.0, 0.0), 0.5), &[dvec3(0.0, 4.0, 0.0)]);
    scene.lights.push(Light {
        kind: LightKind::Spot {
            position: dvec3(50.0, 4.0, 0.0),
            direction: DVec3::X,
            inner: 0.1,
            outer: 0.2,
        },
        color: Vec3::splat(3.0),
        attenuation: Attenuation::InverseSquare,
        ..Light::default()
    });
    let settings = RenderSettings {
        antialias: Antialias::Adaptive,
        samples: 256,
        noise: 0.01,
        ..behind(Backdrop::Transparent, 256)
    };
    let (image, stats) = render(&scene, &settings);
    assert!(image.pixels.iter().all(|pixel| pixel[3] == 1.0));
    assert_eq!(stats.samples, 16 * 16 * 16);
}

/// A lit floor and what lies beyond its horizon are equally clear. At the edges of a black ball what is seen of a white
/// picture differs from sample to sample, though no colour does.
#[test]
fn adaptive_sampling_takes_more_samples_of_edges_before_a_catcher_and_few_of_its_horizon() {
    let mut scene = floor(None, &[]);
    scene.background = Background::Color(Vec3::splat(0.5));
    scene.cameras = vec![looking(dvec3(0.0, 2.0, 8.0), DVec3::Y, 0.8)];
    let of = |scene: &Scene, antialias, samples, features| {
        let settings = RenderSettings {
            antialias,
            samples,
            noise: 0.01,
            features,
            backdrop: Backdrop::Transparent,
            ..paths(samples, (32, 32), 4)
        };
        render(scene, &settings)
    };
    let (image, stats) = of(&scene, Antialias::Adaptive, 256, false);
    assert!(image.pixels.iter().all(|pixel| pixel[3] == 0.0));
    assert_eq!(stats.samples, 16 * 32 * 32);

    scene.add_sphere(dvec3(0.0, 2.0, 0.0), 1.5, 1);
    let (truth, _) = of(&scene, Antialias::Stratified, 4096, false);
    let (found, stats) = of(&scene, Antialias::Adaptive, 1024, false);
    let pixels = found.pixels.iter().zip(&truth.pixels);
    let edges = pixels.filter(|(_, truth)| truth[3] > 0.2 && truth[3] < 0.8);
    let edges: Vec<_> = edges.collect();
    assert!(edges.len() > 20, "{} edges", edges.len());
    let error = opacity_error(edges);
    // Half a white picture is as bright as the threshold more or less if 0.026 more or less of it is seen.
    assert!(error < 0.02, "{error}, {} samples", stats.samples);
    let (with_features, others) = of(&scene, Antialias::Adaptive, 1024, true);
    assert_eq!((with_features, others.samples), (found, stats.samples));
}

/// The colours of such a picture are black everywhere, and have no noise.
#[test]
fn adaptive_sampling_takes_more_samples_of_soft_shadows_on_catchers() {
    let mut scene = floor(disc(dvec3(0.0, 1.0, 0.0), 0.6), &[]);
    scene.cameras = vec![looking(dvec3(0.0, 6.0, 8.0), DVec3::ZERO, 0.5)];
    scene.lights = vec![Light {
        kind: LightKind::Sphere {
            center: dvec3(1.0, 5.0, 0.0),
            radius: 0.8,
        },
        color: Vec3::ONE,
        attenuation: Attenuation::InverseSquare,
        ..Light::default()
    }];
    let of = |antialias, samples| {
        let settings = RenderSettings {
            antialias,
            samples,
            noise: 0.015,
            backdrop: Backdrop::Transparent,
            ..paths(samples, (48, 48), 4)
        };
        render(&scene, &settings)
    };
    let (truth, _) = of(Antialias::Stratified, 4096);
    let (even, even_stats) = of(Antialias::Stratified, 64);
    let (adaptive, stats) = of(Antialias::Adaptive, 1024);
    let error = |image: &Image| opacity_error(image.pixels.iter().zip(&truth.pixels));
    assert!(stats.samples > 17 * 48 * 48, "{} samples", stats.samples);
    assert!(
        stats.samples <= even_stats.samples && error(&adaptive) < error(&even),
        "error {:.5} with {} samples, {:.5} with {}",
        error(&adaptive),
        stats.samples,
        error(&even),
        even_stats.samples
    );
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
    // The ball scatters light onto the floor.
    scene.materials[1] = matte(0.8);
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
            let denoised = denoise(&features.picture(), &gpu, &features);
            let denoised = denoised.expect("a picture").image;
            let apart = |(a, b): (&[f32; 4], &[f32; 4])| f64::from((a[3] - b[3]).abs());
            let pixels = image.pixels.iter().zip(&denoised.pixels);
            let mean = pixels.map(apart).sum::<f64>() / 256.0;
            assert!(mean < 0.03, "denoising moves opacity by {mean}");
        }
    }
}
