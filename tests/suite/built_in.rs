//! The built-in environments: their light, and their names in files and on the command line.

use crate::reference::compare::{render, sized};
use crate::support::verdict::Verdict;
use glam::{DVec3, Vec3};
use glimray::import::{self, Environment, EnvironmentSource, Options};
use glimray::render::{Integrator, RenderSettings};
use glimray::scene::{
    Antialias, Background, BuiltIn, Camera, Geometry, Material, Phong, Picture, Scene, Shape, sky,
};
use std::f64::consts::{PI, TAU};
use std::sync::Arc;

/// Albedos of about white paper and of dark grey.
const ALBEDOS: [f32; 2] = [0.9, 0.2];

/// The sum over all texels of `value` times the solid angle of the texel, whose direction it gets.
fn integral(picture: &Picture, value: impl Fn(DVec3, f64) -> f64) -> f64 {
    let (width, height) = (picture.width, picture.height);
    let edge = |row: u32| (PI * (0.5 - f64::from(row) / f64::from(height))).sin();
    (picture.linear().zip(0..))
        .map(|(texel, index): (_, u32)| {
            let (x, y) = (index % width, index / width);
            let up = PI * (0.5 - (f64::from(y) + 0.5) / f64::from(height));
            let around = TAU * ((f64::from(x) + 0.5) / f64::from(width) - 0.5);
            let way = DVec3::new(up.cos() * around.sin(), up.sin(), -up.cos() * around.cos());
            let area = TAU / f64::from(width) * (edge(y) - edge(y + 1));
            area * value(way, f64::from(texel.y))
        })
        .sum()
}

fn without_sun() -> impl Iterator<Item = BuiltIn> {
    let all = BuiltIn::ALL.iter().copied();
    all.filter(|environment| environment.entry().sun_deg.is_none())
}

#[test]
fn environments_without_a_sun_are_grey_and_have_a_mean_radiance_of_1() {
    let mut verdict = Verdict::on("built-in environments");
    assert!(without_sun().count() >= 4);
    for environment in without_sun() {
        let picture = environment.picture();
        let mut texels = picture.linear();
        let is_good = texels
            .all(|t| t.is_finite() && t.x >= 0.0 && (t.x, t.x) == (t.y, t.z) && t.x < 65504.0);
        let mean = integral(&picture, |_, value| value) / (4.0 * PI);
        let name = environment.entry().name;
        verdict.that(name, is_good && (mean - 1.0).abs() < 1e-5, || {
            format!("mean {mean}, grey and finite: {is_good}")
        });
    }
    verdict.close();
}

/// CIE S 011, type 16: L = Lz (1 + 2 sin γ) / 3, whose illuminance on level ground is 7 π Lz / 9.
#[test]
fn the_overcast_sky_is_that_of_the_cie() {
    let picture = BuiltIn::Overcast.picture();
    let radiance = |elevation_deg: f64| {
        let row = (90.0 - elevation_deg) / 180.0 * f64::from(picture.height);
        let index = row as usize * picture.width as usize;
        f64::from(picture.linear().nth(index).expect("a texel").y)
    };
    let zenith = radiance(90.0);
    for elevation in [1.0, 30.0, 60.0_f64] {
        let expected = (1.0 + 2.0 * elevation.to_radians().sin()) / 3.0;
        let found = radiance(elevation) / zenith;
        assert!(
            (found - expected).abs() < 0.01,
            "{found}, expected {expected}"
        );
    }
    let level = integral(&picture, |way, value| way.y.max(0.0) * value);
    let expected = 7.0 * PI / 9.0 * zenith;
    assert!(
        (level / expected - 1.0).abs() < 1e-3,
        "{level}, expected {expected}"
    );
}

/// Light of radiance 1 from everywhere leaves a convex body of an albedo with that radiance.
#[test]
fn a_ball_in_the_furnace_has_the_radiance_of_its_albedo() {
    for albedo in ALBEDOS {
        let scene = Scene {
            cameras: vec![Camera {
                look_from: DVec3::new(0.0, 0.0, 3.0),
                look_at: DVec3::ZERO,
                fov_y: 0.4,
                ..Camera::default()
            }],
            materials: vec![Material::from(Phong {
                diffuse: Vec3::splat(albedo),
                ..Phong::default()
            })],
            shapes: vec![Shape {
                geometry: Geometry::Sphere {
                    center: DVec3::ZERO,
                    radius: 1.0,
                },
                material: 0,
                node: None,
                name: String::new(),
            }],
            pictures: vec![Arc::new(BuiltIn::Furnace.picture())],
            background: Background::Picture {
                picture: 0,
                strength: 1.0,
                rotation: 0.0,
            },
            ..Scene::default()
        };
        let settings = RenderSettings {
            integrator: Integrator::Path,
            samples: 64,
            antialias: Antialias::Stratified,
            max_depth: 4,
            ..sized(16, 16)
        };
        let (image, _) = render(&scene, &settings);
        let sum: f64 = image.pixels.iter().map(|pixel| f64::from(pixel[0])).sum();
        let mean = sum / image.pixels.len() as f64;
        let albedo = f64::from(albedo);
        assert!(
            (mean / albedo - 1.0).abs() < 0.005,
            "{mean}, expected {albedo}"
        );
    }
}

#[test]
fn the_suns_of_noon_and_sunset_are_where_they_say_and_the_low_one_is_red() {
    let sun = |environment: BuiltIn| sky::sun_of(&environment.picture()).expect("a sun");
    for (environment, elevation) in [(BuiltIn::Noon, 70.0_f64), (BuiltIn::Sunset, 4.0)] {
        let way = sun(environment).direction;
        assert!(
            (way.y.asin().to_degrees() - elevation).abs() < 1e-9,
            "{way}"
        );
        // At the left behind a camera that looks along −z.
        assert!(way.x < 0.0 && way.z > 0.0 && (way.x + way.z).abs() < 1e-12);
    }
    let redness = |environment| {
        let radiance = sun(environment).radiance;
        radiance.x / radiance.z
    };
    assert!(redness(BuiltIn::Sunset) > 4.0 && redness(BuiltIn::Noon) < 1.6);
    let lights = |environment: BuiltIn| {
        let picture = environment.picture();
        let of_sky = integral(&picture, |_, value| value) / (4.0 * PI);
        assert!(
            of_sky.is_finite() && (0.01..2.0).contains(&of_sky),
            "{of_sky}"
        );
        of_sky
    };
    assert!(lights(BuiltIn::Sunset) < lights(BuiltIn::Noon));
}

const BALL: &str = "[[objects]]\nsphere = { center = [0, 0, 0], radius = 1 }\n";

#[test]
fn each_has_the_same_name_in_files_and_among_the_options() {
    let folder = tempfile::tempdir().expect("a folder");
    let load = |name: &str, text: &str, environment| {
        let path = folder.path().join(name);
        std::fs::write(&path, text).expect("a file");
        let options = Options {
            environment,
            ..Options::default()
        };
        import::load_with(&path, &options).expect("a scene")
    };
    let mut verdict = Verdict::on("names of environments");
    for environment in BuiltIn::ALL {
        let name = environment.entry().name;
        let option = Environment {
            source: Some(EnvironmentSource::BuiltIn(*environment)),
            ..Environment::default()
        };
        let by_option = load("a.toml", BALL, option);
        let short = format!("background = \"{name}\"\n{BALL}");
        let by_name = load("b.toml", &short, Environment::default());
        let long = format!(
            "background = {{ environment = \"{name}\", strength = 2, rotation_deg = 30 }}\n{BALL}"
        );
        let turned = load("c.toml", &long, Environment::default());
        let is_same = by_option.pictures == by_name.pictures
            && by_option.background == by_name.background
            && by_name.pictures == turned.pictures;
        verdict.that(name, is_same, || "other pictures".to_owned());
        let expected = Background::Picture {
            picture: 0,
            strength: 2.0,
            rotation: 30_f64.to_radians(),
        };
        verdict.that(name, turned.background == expected, || {
            format!("{:?}", turned.background)
        });
    }
    verdict.close();
}
