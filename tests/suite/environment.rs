//! Pictures in the background as lights of paths, the sky, and the files of environments.

use crate::reference::compare::{render, sized};
use crate::reference::scenes::Build;
use crate::support::random::Random;
use crate::support::verdict::Verdict;
use glam::{DVec3, Vec3, dvec3};
use glimray::import::{self, Environment, EnvironmentSource, ImportError, Options};
use glimray::pack;
use glimray::render::{Integrator, RenderSettings};
use glimray::scene::{
    Antialias, Attenuation, Background, Camera, Light, LightKind, LightTransport, Material, Minify,
    Pattern, Phong, Picture, Scene, Space, Texture, Wrap, sky,
};
use std::f64::consts::{FRAC_PI_2, PI, TAU};
use std::path::Path;
use std::sync::Arc;

const ALBEDO: f64 = 0.6;
const STRENGTH: f32 = 1.5;

fn paths(samples: u32, side: u32) -> RenderSettings {
    RenderSettings {
        integrator: Integrator::Path,
        samples,
        antialias: Antialias::Stratified,
        max_depth: 0,
        ..sized(side, side)
    }
}

/// A scene under a picture. The camera looks straight at a matte plane through the origin with this normal.
fn plane_under(picture: Picture, normal: DVec3, rotation: f64) -> Scene {
    let mut scene = Scene {
        cameras: vec![Camera {
            look_from: 3.0 * normal,
            look_at: DVec3::ZERO,
            up: normal.any_orthogonal_vector(),
            fov_y: 0.4,
            ..Camera::default()
        }],
        materials: vec![Material::from(Phong {
            diffuse: Vec3::splat(ALBEDO as f32),
            ..Phong::default()
        })],
        pictures: vec![Arc::new(picture)],
        background: Background::Picture {
            picture: 0,
            strength: STRENGTH,
            rotation,
        },
        ..Scene::default()
    };
    scene.add_plane(DVec3::ZERO, normal, 0);
    scene
}

fn greys(scene: &Scene, settings: &RenderSettings) -> Vec<f64> {
    let (image, stats) = render(scene, settings);
    assert_eq!(stats.nonfinite_samples, 0);
    (image.pixels.iter().map(|pixel| f64::from(pixel[1]))).collect()
}

fn mean(values: &[f64]) -> f64 {
    values.iter().sum::<f64>() / values.len() as f64
}

/// The direction of a place in an equirectangular picture, in parts of its width and from its lower edge.
fn direction(u: f64, v: f64, rotation: f64) -> DVec3 {
    let (around, up) = (TAU * (u - 0.5) - rotation, PI * (v - 0.5));
    dvec3(up.cos() * around.sin(), up.sin(), -up.cos() * around.cos())
}

/// The value of a picture of these texels, interpolated linearly, at a place in parts of its width and from its lower
/// edge.
fn interpolated(picture: &Picture, texels: &[f64], u: f64, v: f64) -> f64 {
    let (width, height) = (i64::from(picture.width), i64::from(picture.height));
    // Rows from the top.
    let texel =
        |x: i64, y: i64| texels[(y.clamp(0, height - 1) * width + x.rem_euclid(width)) as usize];
    let (column, row) = (u * width as f64 - 0.5, (1.0 - v) * height as f64 - 0.5);
    let (x, y) = (column.floor() as i64, row.floor() as i64);
    let (wx, wy) = (column - column.floor(), row - row.floor());
    let upper = (1.0 - wx) * texel(x, y) + wx * texel(x + 1, y);
    let lower = (1.0 - wx) * texel(x, y + 1) + wx * texel(x + 1, y + 1);
    (1.0 - wy) * upper + wy * lower
}

/// The irradiance of a surface with this normal under a picture that is looked up with bilinear filtering: the midpoint
/// rule with at least 384 points in a row.
fn irradiance(picture: &Picture, normal: DVec3, rotation: f64) -> f64 {
    let (width, height) = (picture.width, picture.height);
    let steps = (384 / width).max(6);
    let texels: Vec<f64> = picture.linear().map(|texel| f64::from(texel.y)).collect();
    let mut sum = 0.0;
    for y in 0..height * steps {
        let row = (f64::from(y) + 0.5) / f64::from(steps);
        let v = 1.0 - row / f64::from(height);
        let area = TAU * PI * (PI * (v - 0.5)).cos() / f64::from(width * height * steps * steps);
        for x in 0..width * steps {
            let u = (f64::from(x) + 0.5) / f64::from(width * steps);
            let cosine = normal.dot(direction(u, v, rotation));
            if cosine > 0.0 {
                sum += area * cosine * interpolated(picture, &texels, u, v);
            }
        }
    }
    sum
}

fn grey(width: u32, height: u32, value: impl Fn(u32, u32) -> f32) -> Picture {
    let all = (0..width * height).map(|i| Vec3::splat(value(i % width, i / width)));
    Picture::opaque(width, height, all)
}

/// Random texels between 0 and 1, to a power, so that they differ much.
fn random_picture(width: u32, height: u32) -> Picture {
    let mut random = Random::new(u64::from(width));
    let values: Vec<_> = (0..width * height)
        .map(|_| random.between(0.0, 1.0).powi(6) as f32)
        .collect();
    grey(width, height, |x, y| values[(y * width + x) as usize])
}

#[test]
fn a_plane_has_the_irradiance_of_the_picture_around_it_however_it_is_turned() {
    let mut verdict = Verdict::on("matte planes under pictures");
    let normal = dvec3(0.6, 0.64, 0.48);
    for (width, height) in [(1, 1), (3, 2), (8, 4), (37, 21), (64, 32)] {
        for rotation in [0.0, 2.0] {
            let picture = random_picture(width, height);
            let expected =
                f64::from(STRENGTH) * ALBEDO / PI * irradiance(&picture, normal, rotation);
            let scene = plane_under(picture, normal, rotation);
            let found = mean(&greys(&scene, &paths(64, 24)));
            let name = format!("{width} × {height}, rotation {rotation}");
            verdict.that(name, (found / expected - 1.0).abs() < 0.005, || {
                format!("{found}, expected {expected}")
            });
        }
    }
    verdict.close();
}

/// Without light samples a path finds the sun with the chance cosine × solid angle / π, so that the relative variance
/// of the mean of n paths is (π / (cosine × solid angle) − 1) / n.
#[test]
fn a_small_sun_is_found_by_few_samples() {
    let sun = |x: u32, y: u32| {
        if (100..102).contains(&x) && (30..32).contains(&y) {
            5000.0
        } else {
            0.0
        }
    };
    let picture = grey(256, 128, sun);
    let expected = f64::from(STRENGTH) * ALBEDO / PI * irradiance(&picture, DVec3::Y, 0.0);
    let scene = plane_under(picture, DVec3::Y, 0.0);
    let found = greys(&scene, &paths(16, 48));
    let errors: Vec<_> = found
        .iter()
        .map(|value| (value / expected - 1.0).powi(2))
        .collect();
    let elevation = PI * (0.5 - 31.0 / 128.0);
    let solid_angle = elevation.cos() * (TAU * 2.0 / 256.0).powi(2);
    let without = (PI / (elevation.sin() * solid_angle) - 1.0) / 16.0;
    assert!(
        mean(&errors) < without / 20.0,
        "{} against {without}",
        mean(&errors)
    );
    let many = mean(&greys(&scene, &paths(256, 48)));
    assert!(
        (many / expected - 1.0).abs() < 0.005,
        "{many}, expected {expected}"
    );
}

/// If pixels were independent, the mean of 64 would have a 64th of their variance. Blocks along a curve share one
/// stratified sequence, so that it has much less.
#[test]
fn neighbouring_pixels_of_few_samples_err_in_different_directions() {
    let scene = plane_under(random_picture(16, 8), DVec3::Y, 0.0);
    for samples in [1, 4] {
        let found = greys(&scene, &paths(samples, 64));
        let level = mean(&found);
        let variance = |values: &[f64]| {
            let squares: Vec<f64> = values.iter().map(|value| (value - level).powi(2)).collect();
            mean(&squares)
        };
        let block = |index: usize| {
            let first = 8 * 64 * (index / 8) + 8 * (index % 8);
            let row = |y: usize| found[first + 64 * y..][..8].iter();
            (0..8).flat_map(row).sum::<f64>() / 64.0
        };
        let blocks: Vec<f64> = (0..64).map(block).collect();
        let ratio = 64.0 * variance(&blocks) / variance(&found);
        assert!(ratio < 0.3, "{samples} samples: {ratio}");
    }
}

#[test]
fn a_lamp_and_a_picture_add_their_light() {
    let lamp = Light {
        kind: LightKind::Sphere {
            center: dvec3(1.0, 2.0, 0.0),
            radius: 0.3,
        },
        color: Vec3::splat(2.0),
        attenuation: Attenuation::InverseSquare,
        samples: 1,
        // The lamp does not shade the plane from the picture.
        visible: false,
        node: None,
        name: String::new(),
    };
    let with = |picture: f32, lamps: &[Light]| {
        let mut scene = plane_under(grey(16, 8, |x, _| picture * x as f32), DVec3::Y, 0.0);
        scene.lights = lamps.to_vec();
        mean(&greys(&scene, &paths(256, 24)))
    };
    let lamps = [lamp];
    let (both, parts) = (with(0.1, &lamps), [with(0.0, &lamps), with(0.1, &[])]);
    assert!(parts.iter().all(|part| *part > 0.1 * both), "{parts:?}");
    let sum: f64 = parts.iter().sum();
    assert!((both / sum - 1.0).abs() < 0.005, "{both}, {parts:?}");
}

#[test]
fn a_white_ball_in_a_white_picture_is_invisible() {
    let mut scene = plane_under(grey(32, 16, |_, _| 1.0), DVec3::Y, 0.3);
    scene.shapes.clear();
    scene.cameras[0] = Camera {
        look_from: 5.0 * DVec3::Z,
        look_at: DVec3::ZERO,
        fov_y: 0.6,
        ..Camera::default()
    };
    scene.materials[0].classical_mut().diffuse = Vec3::ONE;
    scene.add_sphere(DVec3::ZERO, 1.0, 0);
    let found = greys(&scene, &paths(256, 24));
    assert!(
        (mean(&found) / f64::from(STRENGTH) - 1.0).abs() < 0.003,
        "{}",
        mean(&found)
    );
}

/// The densities of a table: its columns, and those of the cells from the lowest row on.
fn densities(picture: Picture) -> (usize, Vec<f64>) {
    let scene = plane_under(picture, DVec3::Y, 0.0);
    let packed = pack::scene(&scene).expect("a packed scene");
    let frame = packed.frame(&scene.frame(0.0)).expect("a view").frame;
    let width = frame.environment_width as usize;
    let words: Vec<u32> = packed.texels.iter().copied().collect();
    let cells = words[words.len() - width * width / 2..].iter();
    (
        width,
        cells.map(|bits| f64::from(f32::from_bits(*bits))).collect(),
    )
}

#[test]
fn densities_are_in_proportion_to_the_light_above_the_mean() {
    let mut verdict = Verdict::on("tables of pictures");
    let one_bright = |width, height| grey(width, height, |x, y| f32::from((x, y) == (0, 3)));
    for picture in [
        random_picture(5, 3),
        random_picture(37, 21),
        random_picture(200, 100),
        one_bright(16, 8),
    ] {
        let size = format!("{} × {}", picture.width, picture.height);
        let (columns, found) = densities(picture.clone());
        let rows = columns / 2;
        // Twelve points in each texel and at least six in a cell, by the midpoint rule.
        let steps = (12 * picture.height as usize / rows).max(6);
        let (all_columns, all_rows) = ((columns * steps) as f64, (rows * steps) as f64);
        let texels: Vec<f64> = picture.linear().map(|texel| f64::from(texel.y)).collect();
        let mut light = vec![0.0; found.len()];
        let mut angle = vec![0.0; found.len()];
        for y in 0..rows * steps {
            let v = (y as f64 + 0.5) / all_rows;
            let band = (PI * (v - 0.5)).cos();
            for x in 0..columns * steps {
                let cell = y / steps * columns + x / steps;
                let u = (x as f64 + 0.5) / all_columns;
                light[cell] += band * interpolated(&picture, &texels, u, v);
                angle[cell] += band;
            }
        }
        let brightness = light.iter().sum::<f64>() / angle.iter().sum::<f64>();
        let above = |(light, angle): (&f64, &f64)| (light - brightness * angle).max(0.0);
        let expected: Vec<f64> = light.iter().zip(&angle).map(above).collect();
        let scale = mean(&expected);
        verdict.that(
            format!("sum of {size}"),
            (mean(&found) - 1.0).abs() < 1e-5,
            || format!("{}", mean(&found)),
        );
        // Chances are multiples of 1/1023, so what is far from most of the light may be off by more than the rest.
        let off =
            (found.iter().zip(&expected)).map(|(found, expected)| (found - expected / scale).abs());
        let off = off.sum::<f64>() / found.len() as f64;
        verdict.that(format!("mean error of {size}"), off < 0.02, || {
            format!("{off}")
        });
        let in_doubt = 0.02 * scale;
        let of_both = found.iter().zip(light.iter().zip(&angle));
        let wrong = of_both.filter(|(found, (light, angle))| {
            let difference = *light - brightness * *angle;
            difference.abs() > in_doubt && (**found > 0.0) != (difference > 0.0)
        });
        let wrong = wrong.count();
        verdict.that(format!("cells of {size}"), wrong == 0, || {
            format!("{wrong} wrong")
        });
    }
    verdict.close();
}

/// With the height h of a direction, in -1..=1, ((1 + h)/2)^k has the mean 1/(k + 1) over all directions, and its square
/// 1/(2k + 1). So the variance over the square of the mean is k²/(2k + 1): 1/3 for a gradient from black, 4/5 for its square.
#[test]
fn pictures_without_contrast_have_no_table() {
    let heights = |power: i32| {
        grey(64, 32, move |_, y| {
            let height = (PI * (0.5 - (f64::from(y) + 0.5) / 32.0)).sin();
            (0.5 + 0.5 * height).powi(power) as f32
        })
    };
    for (picture, has_table) in [
        (grey(16, 8, |_, _| 0.7), false),
        (grey(16, 8, |_, _| 0.0), false),
        (heights(1), false),
        (heights(2), true),
        (heights(8), true),
    ] {
        let scene = plane_under(picture, DVec3::Y, 0.0);
        let packed = pack::scene(&scene).expect("a packed scene");
        let frame = packed.frame(&scene.frame(0.0)).expect("a view").frame;
        assert_eq!(frame.environment_width > 0, has_table);
        assert_eq!(frame.environment_share > 0.0, has_table);
    }
}

/// Light samples go to the sun, and paths to an even sky. Its radiance is always the same, and what differs are edges of
/// the sun in cells of a quarter of a texel: less than 0.02 of the square of its light. Samples in proportion to the
/// luminance in cells as large as texels have six times as much.
#[test]
fn a_sun_in_an_even_sky_has_little_noise() {
    let is_sun = |x: u32, y: u32| {
        let (x, y) = (f64::from(x) - 100.0, f64::from(y) - 30.0);
        x.hypot(y) < 2.3
    };
    let sun = |x, y| if is_sun(x, y) { 1000.0 } else { 0.5 };
    let scene = plane_under(grey(256, 128, sun), DVec3::Y, 0.0);
    let found = greys(&scene, &paths(16, 48));
    let level = mean(&found);
    let squares: Vec<f64> = (found.iter().map(|value| (value / level - 1.0).powi(2))).collect();
    assert!(16.0 * mean(&squares) < 0.02, "{}", 16.0 * mean(&squares));
}

#[test]
fn black_pictures_and_other_integrators_have_no_table_and_no_trouble() {
    let black = plane_under(grey(4, 2, |_, _| 0.0), DVec3::Y, 0.0);
    assert_eq!(mean(&greys(&black, &paths(4, 8))), 0.0);
    let classical = RenderSettings {
        integrator: Integrator::Whitted,
        ..paths(4, 8)
    };
    let lit = plane_under(random_picture(8, 4), DVec3::Y, 0.0);
    assert_eq!(mean(&greys(&lit, &classical)), 0.0);
}

/// A surface that faces the sun gets its irradiance beside that of the picture, wherever the sky is turned.
#[test]
fn the_sun_of_the_sky_lights_surfaces_by_its_irradiance() {
    let mut verdict = Verdict::on("irradiance under the sky");
    for (degrees, rotation) in [
        (5.0_f64, 0.0),
        (20.0, 1.0),
        (45.0, 2.5),
        (70.0, 4.0),
        (89.0, -1.0),
    ] {
        let (elevation, azimuth) = (degrees.to_radians(), -2.0);
        let picture = sky::picture(elevation, azimuth);
        let normal = sky::towards_sun(elevation, azimuth - rotation);
        let of_sun = sky::sun_irradiance(elevation).y;
        let expected = f64::from(STRENGTH) * (irradiance(&picture, normal, rotation) + of_sun);
        let pixels = greys(&plane_under(picture, normal, rotation), &paths(64, 48));
        let found = mean(&pixels) * PI / ALBEDO;
        let ratio = found / expected;
        verdict.that(
            format!("sun at {degrees}°, turned by {rotation}"),
            (ratio - 1.0).abs() < 0.003,
            || format!("{found}, expected {expected}"),
        );
    }
    verdict.close();
}

/// The sun is a disc of 0.53° of even radiance, however fine the picture is.
#[test]
fn the_sun_of_the_sky_is_a_disc() {
    const SIDE: u32 = 200;
    let (elevation, azimuth) = (0.8, 0.4);
    let mut scene = plane_under(sky::picture(elevation, azimuth), DVec3::Y, 0.0);
    let sun = sky::towards_sun(elevation, azimuth);
    let fov_y = 4.0 * sky::SUN_RADIUS;
    scene.cameras = vec![Camera {
        look_from: DVec3::Y,
        look_at: DVec3::Y + sun,
        fov_y,
        ..Camera::default()
    }];
    let settings = RenderSettings {
        integrator: Integrator::Whitted,
        ..sized(SIDE, SIDE)
    };
    let pixels = greys(&scene, &settings);
    let radiance = f64::from(STRENGTH) * sky::sun_irradiance(elevation).y / sky::SUN_SOLID_ANGLE;
    let middle = f64::from(SIDE) / 2.0;
    let mut inside = 0;
    for (index, value) in pixels.iter().enumerate() {
        let (x, y) = (index as u32 % SIDE, index as u32 / SIDE);
        let away = (f64::from(x) + 0.5 - middle).hypot(f64::from(y) + 0.5 - middle);
        // In radii of the disc, which are a quarter of the picture; the direction of a ray has its rounding errors.
        let radii = 4.0 * away / f64::from(SIDE);
        let is_sun = *value > 0.5 * radiance;
        assert!(
            is_sun == (radii < 1.0) || (radii - 1.0).abs() < 0.01,
            "{value} at {radii} radii"
        );
        if is_sun {
            inside += 1;
            assert!((value / radiance - 1.0).abs() < 0.01, "{value}, {radiance}");
        }
    }
    let (image, _) = render(&scene, &settings);
    let [r, g, b, _] = image.pixel(SIDE / 2, SIDE / 2).expect("a pixel");
    let of_sun = f64::from(STRENGTH) * sky::sun_irradiance(elevation) / sky::SUN_SOLID_ANGLE;
    let ratio = dvec3(r.into(), g.into(), b.into()) / of_sun;
    assert!((ratio - 1.0).abs().max_element() < 0.005, "{ratio}");
    let share = f64::from(inside) / f64::from(SIDE * SIDE);
    assert!((share / (PI / 16.0) - 1.0).abs() < 0.01, "{share}");
}

/// A clear sky with a high sun gives a level surface about 100,000 lux, about a tenth to a quarter of it from the sky.
#[test]
fn the_sky_is_as_bright_as_a_clear_day() {
    let elevation = FRAC_PI_2 - 0.5;
    let picture = sky::picture(elevation, 0.0);
    let direct = sky::UNIT * elevation.sin() * sky::sun_irradiance(elevation).y;
    let total = sky::UNIT * irradiance(&picture, DVec3::Y, 0.0) + direct;
    assert!((80e3..120e3).contains(&total), "{total} lux");
    let share = 1.0 - direct / total;
    assert!((0.08..0.3).contains(&share), "{share}");
}

fn with_environment(
    source: Option<&Path>,
    change: Environment,
    scene: &str,
) -> Result<Scene, ImportError> {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("scene.toml");
    std::fs::write(&path, scene).expect("a file");
    let options = Options {
        environment: Environment {
            source: source.map(|path| EnvironmentSource::File(path.to_owned())),
            ..change
        },
        texture_limit: std::num::NonZero::new(16),
        ..Options::default()
    };
    import::load_with(&path, &options)
}

#[test]
fn an_environment_is_the_only_picture_behind_a_model() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("model.stl");
    let text = "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\nendfacet\nendsolid\n";
    std::fs::write(&path, text).expect("a file");
    let file = folder.path().join("grey.exr");
    let image = image::Rgb32FImage::from_pixel(8, 4, image::Rgb([0.5; 3]));
    image.save(&file).expect("a picture");
    let load = |source| {
        let options = Options {
            integrator: Some(LightTransport::Path),
            environment: Environment {
                source,
                ..Environment::default()
            },
            ..Options::default()
        };
        import::load_with(&path, &options).expect("a scene")
    };
    let sky = EnvironmentSource::Sky {
        elevation_deg: sky::SUN_ELEVATION_DEG,
        azimuth_deg: sky::SUN_AZIMUTH_DEG,
    };
    let (in_studio, under_sky) = (load(None), load(Some(sky)));
    assert!(in_studio.pictures.is_empty());
    let replaced = load(Some(EnvironmentSource::File(file)));
    assert_eq!((under_sky.pictures.len(), replaced.pictures.len()), (1, 1));
    assert_eq!(
        (replaced.pictures[0].width, replaced.pictures[0].height),
        (8, 4)
    );
    let Background::Picture { picture, .. } = replaced.background else {
        panic!("{:?}", replaced.background);
    };
    assert_eq!(picture, 0);
}

const BALL: &str =
    "background = [0.25, 0.5, 1.0]\n[[objects]]\nsphere = { center = [0, 0, 0], radius = 1 }\n";

#[test]
fn files_of_environments_replace_the_background_or_are_refused() {
    let folder = tempfile::tempdir().expect("a folder");
    let file = |name: &str| folder.path().join(name);
    let save = |name: &str, width: u32, height: u32, bad: f32| {
        let mut image = image::Rgb32FImage::from_pixel(width, height, image::Rgb([0.5; 3]));
        image.put_pixel(1, 0, image::Rgb([0.5, bad, 0.5]));
        image.save(file(name)).expect("a picture");
    };
    save("good.exr", 8, 4, 0.5);
    save("nan.exr", 8, 4, f32::NAN);
    save("negative.exr", 8, 4, -1.0);
    save("infinite.exr", 8, 4, f32::INFINITY);
    save("large.exr", 64, 32, 0.5);
    save("square.exr", 8, 8, 0.5);
    std::fs::write(file("empty.hdr"), "").expect("a file");
    std::fs::write(file("text.hdr"), "no picture").expect("a file");
    let load = |name: &str| with_environment(Some(&file(name)), Environment::default(), BALL);

    let good = load("good.exr").expect("a scene");
    assert!(good.skipped.is_empty(), "{:?}", good.skipped);
    assert!(matches!(
        good.background,
        Background::Picture { strength: 1.0, .. }
    ));
    for name in ["nan.exr", "negative.exr", "infinite.exr"] {
        let scene = load(name).expect("a scene");
        assert_eq!(scene.skipped.len(), 1, "{name}: {:?}", scene.skipped);
        assert!(
            scene.skipped[0].contains("1 texel of"),
            "{:?}",
            scene.skipped
        );
        let texels: Vec<_> = scene.pictures[0].linear().collect();
        assert_eq!(texels[1].truncate(), Vec3::ZERO, "{name}");
        assert_eq!(texels[2].truncate(), Vec3::splat(0.5), "{name}");
    }
    let large = load("large.exr").expect("a scene");
    assert_eq!((large.pictures[0].width, large.skipped.len()), (16, 1));
    for (name, why) in [
        ("square.exr", "twice as wide"),
        ("empty.hdr", "empty"),
        ("text.hdr", "supported"),
    ] {
        let error = load(name).expect_err(name);
        assert!(matches!(error, ImportError::Malformed(_)), "{error:?}");
        assert!(error.to_string().contains(why), "{error}");
    }
    let error = load("missing.hdr").expect_err("an error");
    assert!(matches!(error, ImportError::Unreadable(_)), "{error:?}");
}

/// The lines about a picture as the environment of a scene, as the background that the scene names, and read alone: what was
/// skipped, or why it is refused.
fn three_ways(file: &str, texel: impl Fn(u32, u32) -> f32, size: [u32; 2]) -> [Vec<String>; 3] {
    // Without the place.
    let refusal = |error: ImportError| {
        let line = error.to_string();
        vec![line.split_once("): ").expect("a place").1.to_owned()]
    };
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join(file);
    let [width, height] = size;
    let image =
        image::Rgb32FImage::from_fn(width, height, |x, y| image::Rgb([0.5, texel(x, y), 0.5]));
    image.save(&path).expect("a picture");
    let scene = folder.path().join("scene.toml");
    let named = format!("background = {{ picture = '{file}' }}\n");
    let alone = match import::environment(&path) {
        Ok((_, notes)) => notes,
        Err(error) => refusal(error),
    };
    let environment = Environment {
        source: Some(EnvironmentSource::File(path)),
        ..Environment::default()
    };
    let ways = [(BALL, environment), (&named, Environment::default())];
    let [asked, named] = ways.map(|(text, environment)| {
        std::fs::write(&scene, text).expect("a scene");
        let options = Options {
            environment,
            ..Options::default()
        };
        match import::load_with(&scene, &options) {
            Ok(scene) => scene.skipped.clone(),
            Err(error) => refusal(error),
        }
    });
    [asked, named, alone]
}

#[test]
fn pictures_of_backgrounds_are_checked_as_environments_are() {
    let mut verdict = Verdict::on("pictures of backgrounds");
    // One texel, and all others.
    let at =
        |[one, others]: [f32; 2]| move |x: u32, y: u32| if (x, y) == (1, 0) { one } else { others };
    let bad = "infinite, negative or not a number and";
    let cases = [
        ("good", [0.5, 0.5], [8, 4], ""),
        ("nan", [f32::NAN, 0.5], [8, 4], "1 texel of `nan.exr` was"),
        ("infinite", [f32::INFINITY, 0.5], [8, 4], bad),
        (
            "negative",
            [-1.0, -1.0],
            [8, 4],
            "all 32 texels of `negative",
        ),
        ("square", [0.5, 0.5], [8, 8], "has 8 × 8 texels, but an"),
        ("tall", [0.5, 0.5], [4, 16], "twice as wide as high"),
        ("odd", [0.5, 0.5], [9, 4], "twice as wide as high"),
        (
            "huge",
            [3e38, 0.5],
            [8, 4],
            "1 texel of `huge.exr` was cut to 1e12",
        ),
    ];
    for (name, values, size, expected) in cases {
        let [asked, named, alone] = three_ways(&format!("{name}.exr"), at(values), size);
        let is_told = match expected {
            "" => named.is_empty(),
            part => named.iter().any(|line| line.contains(part)),
        };
        verdict.that(name, asked == named && asked == alone && is_told, || {
            format!("{asked:?}, {named:?}, {alone:?}")
        });
    }
    verdict.close();
    // A sky of 0.5 cannot be kept beside a sun of 1e12 in half floats.
    let [asked, ..] = three_ways("dark.exr", at([1e12, 0.5]), [8, 4]);
    assert_eq!(asked.len(), 1, "{asked:?}");
    assert!(asked[0].contains("too dark"), "{asked:?}");
}

/// Half floats end at 65,504.
#[test]
fn a_sun_brighter_than_half_floats_has_all_its_light() {
    let mut verdict = Verdict::on("suns");
    for sun in [6e4, 1e5, 1e6, 1e7] {
        let at = |x, y| if (x, y) == (20, 8) { sun } else { 0.1 };
        let picture = grey(64, 32, at);
        let expected = f64::from(STRENGTH) * ALBEDO / PI * irradiance(&picture, DVec3::Y, 0.0);
        let found = mean(&greys(
            &plane_under(picture, DVec3::Y, 0.0),
            &paths(256, 24),
        ));
        verdict.that(
            format!("sun of {sun}"),
            (found / expected - 1.0).abs() < 0.005,
            || format!("{found}, expected {expected}"),
        );
    }
    verdict.close();
}

#[test]
fn only_pictures_brighter_than_half_floats_are_scaled() {
    let strength = |sun: f32, has_texture: bool| {
        let mut scene = plane_under(grey(4, 2, |x, _| sun * x as f32 / 3.0), DVec3::Y, 0.0);
        if has_texture {
            scene.textures.push(Texture {
                pattern: Pattern::Picture {
                    picture: 0,
                    nearest: false,
                    minify: Minify::default(),
                    wrap: [Wrap::Repeat; 2],
                },
                space: Space::Uv,
                pattern_from_space: glam::DAffine3::IDENTITY,
            });
        }
        let packed = pack::scene(&scene).expect("a packed scene");
        let frame = packed.frame(&scene.frame(0.0)).expect("a view").frame;
        let words = packed.texels.iter().copied().take(8).collect::<Vec<u32>>();
        let brightest = half::f16::from_bits((words[6] & 0xffff) as u16).to_f32();
        (frame.background[0], brightest)
    };
    assert_eq!(strength(65504.0, false), (STRENGTH, 65504.0));
    assert_eq!(strength(65536.0, false), (3.0, 32768.0));
    assert_eq!(strength(1_048_576.0, false), (STRENGTH * 32.0, 32768.0));
    // Textures have no factor for it.
    assert_eq!(strength(1_048_576.0, true).0, STRENGTH);
}

#[test]
fn strength_scales_any_background_and_only_pictures_turn() {
    let change = |strength, rotation_deg| Environment {
        source: None,
        strength,
        rotation_deg,
    };
    let scene = with_environment(None, change(Some(2.0), None), BALL).expect("a scene");
    assert_eq!(
        scene.background,
        Background::Color(Vec3::new(0.5, 1.0, 2.0))
    );
    let error = with_environment(None, change(None, Some(90.0)), BALL).expect_err("an error");
    assert!(matches!(error, ImportError::Malformed(_)), "{error:?}");
    let sky = Options {
        environment: Environment {
            source: Some(EnvironmentSource::Sky {
                elevation_deg: 30.0,
                azimuth_deg: 0.0,
            }),
            strength: Some(0.5),
            rotation_deg: Some(90.0),
        },
        ..Options::default()
    };
    let scene = import::load_with(Path::new("assets/scenes/glass_and_mirrors.toml"), &sky)
        .expect("a scene");
    let Background::Picture {
        strength, rotation, ..
    } = scene.background
    else {
        panic!("{:?}", scene.background);
    };
    assert_eq!((strength, rotation), (0.5, FRAC_PI_2));
}
