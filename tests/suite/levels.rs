//! Views of quantities: their ranges and their contrast.

use crate::reference::compare::{sized, start};
use crate::support::{
    harness::gpu,
    verdict::{Tolerance, Verdict},
};
use glam::{DVec3, Vec3, dvec3};
use glimray::image::Image;
use glimray::layout::{PackedTone, VIEW_DEPTH, VIEW_HEAT, VIEW_NORMALS};
use glimray::render::{Antialias, Integrator, Levels, Quantity, RenderSettings, Renderer, Tone};
use glimray::scene::{Background, Camera, Geometry, Material, Scene, Shape};
use glimray_app::legend;
use glimray_shader_test::Plain;
use std::path::{Path, PathBuf};
use std::process::Command;

/// A ball of radius 1 at a distance of 5 from the camera.
fn ball() -> Scene {
    Scene {
        shapes: vec![Shape {
            geometry: Geometry::Sphere {
                center: DVec3::ZERO,
                radius: 1.0,
            },
            material: 0,
            node: None,
            name: String::new(),
        }],
        materials: vec![Material::default()],
        cameras: vec![Camera {
            look_from: dvec3(0.0, 0.0, 5.0),
            look_at: DVec3::ZERO,
            fov_y: 30_f64.to_radians(),
            ..Camera::default()
        }],
        ..Scene::default()
    }
}

fn traced(scene: &Scene, settings: &RenderSettings) -> Renderer {
    let mut renderer = start(scene, settings).expect("a renderer");
    while !renderer.is_done() {
        renderer.step().expect("a step");
    }
    renderer
}

fn values(image: &Image) -> Vec<f32> {
    image.pixels.iter().map(|pixel| pixel[0]).collect()
}

/// The quantile of the values.
fn percentile(values: &[f32], fraction: f64) -> f32 {
    let mut sorted = values.to_vec();
    sorted.sort_by(f32::total_cmp);
    sorted[((sorted.len() - 1) as f64 * fraction).round() as usize]
}

fn found() -> Tone {
    Tone {
        levels: Levels::Found,
        ..Tone::LINEAR
    }
}

#[test]
fn a_pixel_half_on_a_ball_has_the_distance_of_the_ball() {
    let settings = RenderSettings {
        integrator: Integrator::Depth,
        samples: 16,
        antialias: Antialias::Stratified,
        ..sized(48, 48)
    };
    let raw = values(
        &traced(&ball(), &settings)
            .develop(&Tone::LINEAR)
            .expect("a picture"),
    );
    // From the nearest point of the ball to where rays graze it.
    let (near, far) = (4.0 - 1e-4, 24_f32.sqrt() + 1e-4);
    let hits: Vec<f32> = raw.iter().copied().filter(|value| *value > 0.0).collect();
    assert!(hits.len() > 400 && hits.len() < raw.len(), "{}", hits.len());
    for value in hits {
        assert!((near..far).contains(&value), "{value}");
    }
}

#[test]
fn distances_are_shown_by_their_logarithm_over_the_range_found() {
    let settings = RenderSettings {
        integrator: Integrator::Depth,
        ..sized(48, 48)
    };
    let mut renderer = traced(&ball(), &settings);
    let raw = values(&renderer.develop(&Tone::LINEAR).expect("a picture"));
    let hits: Vec<f32> = raw.iter().copied().filter(|value| *value > 0.0).collect();
    // 2 % of the pixels at either end are left out.
    let mut sorted = hits.clone();
    sorted.sort_by(f32::total_cmp);
    let skipped = sorted.len() * 2 / 100;
    let expected = [sorted[skipped], sorted[sorted.len() - 1 - skipped]];
    let range = renderer.range().expect("a range").expect("some hits");
    assert_eq!(range, expected);
    assert!(range[0] >= 4.0 - 1e-4 && range[1] < 24_f32.sqrt() + 1e-4);
    let shown = values(&renderer.develop(&found()).expect("a picture"));
    let [least, most] = range.map(f64::from);
    for (value, shown) in raw.iter().zip(&shown) {
        let far = (f64::from(*value) / least).ln() / (most / least).ln();
        let level = match *value > 0.0 {
            true => 1.0 - 0.9 * far.clamp(0.0, 1.0),
            false => 0.0,
        };
        assert!(
            (f64::from(*shown) - level).abs() < 1e-4,
            "{value}: {shown} is not {level}"
        );
    }
    let fixed = Tone {
        levels: Levels::Fixed(range),
        ..Tone::LINEAR
    };
    let again = values(&renderer.develop(&fixed).expect("a picture"));
    assert_eq!(again, shown);
}

#[test]
fn samples_are_shown_from_the_fewest_to_the_most() {
    let settings = RenderSettings {
        integrator: Integrator::Samples,
        antialias: Antialias::Adaptive,
        samples: 16,
        noise: 0.02,
        ..sized(48, 48)
    };
    // Only its edge needs samples.
    let scene = Scene {
        background: Background::Color(Vec3::ONE),
        ..ball()
    };
    let mut renderer = traced(&scene, &settings);
    let fractions = values(&renderer.develop(&Tone::LINEAR).expect("a picture"));
    let counts: Vec<f32> = fractions.iter().map(|fraction| fraction * 16.0).collect();
    let (least, most) = (percentile(&counts, 0.0), percentile(&counts, 1.0));
    assert!(least < most, "{least}, {most}");
    assert_eq!(renderer.range().expect("a range"), Some([least, most]));
    let shown = values(&renderer.develop(&found()).expect("a picture"));
    for (count, shown) in counts.iter().zip(&shown) {
        assert_eq!(*shown, (count - least) / (most - least));
    }
}

#[test]
fn a_view_of_colours_has_no_range_and_stays_as_it_is() {
    let settings = RenderSettings {
        integrator: Integrator::Normals,
        ..sized(16, 16)
    };
    let mut renderer = traced(&ball(), &settings);
    assert_eq!(renderer.range().expect("no range"), None);
    let raw = renderer.develop(&Tone::LINEAR).expect("a picture");
    assert!(renderer.develop(&found()).expect("a picture") == raw);
}

#[test]
fn a_picture_without_hits_has_no_range_of_distances_and_is_black() {
    let mut scene = ball();
    scene.shapes.clear();
    let settings = RenderSettings {
        integrator: Integrator::Depth,
        ..sized(16, 16)
    };
    let mut renderer = traced(&scene, &settings);
    assert_eq!(renderer.range().expect("no range"), None);
    let shown = values(&renderer.develop(&found()).expect("a picture"));
    assert!(shown.iter().all(|value| *value == 0.0));
}

fn tone(view: u32, range: Option<[f32; 2]>, exposure_scale: f32) -> Plain<PackedTone> {
    let [least, most] = range.unwrap_or_default();
    Plain(PackedTone {
        view,
        range: [least, most],
        has_range: range.is_some().into(),
        exposure_scale,
        transfer: glimray::layout::TRANSFER_LINEAR,
        ..PackedTone::default()
    })
}

#[test]
fn quantities_become_levels_and_colours() {
    let depth = tone(VIEW_DEPTH, Some([2.0, 32.0]), 1.0);
    let work = tone(VIEW_HEAT, Some([10.0, 60.0]), 1.0);
    let one = tone(VIEW_HEAT, Some([7.0, 7.0]), 1.0);
    #[rustfmt::skip]
    gpu().check("lib::quantity::shown", Tolerance::Absolute(1e-5), &[
        ("the nearest is white", ([2f32, 1.0, 0.0], depth), [1.0; 3]),
        ("twice as far is a quarter of four doublings on", ([4.0, 1.0, 0.0], depth), [0.775; 3]),
        ("the farthest is dark grey", ([32.0, 1.0, 0.0], depth), [0.1; 3]),
        ("what is farther too", ([1e6, 1.0, 0.0], depth), [0.1; 3]),
        ("half of the samples hit", ([2.0, 0.5, 0.0], depth), [0.775; 3]),
        ("no hit is black", ([0.0, 0.0, 0.0], depth), [0.0; 3]),
        ("without a range a distance stays as it is", ([3.0, 0.5, 0.0], tone(VIEW_DEPTH, None, 1.0)), [6.0; 3]),
        ("an exposure scales it", ([3.0, 1.0, 0.0], tone(VIEW_DEPTH, None, 0.125)), [0.375; 3]),
        ("least work is black", ([10.0; 3], work), [0.0; 3]),
        ("a fifth on it is blue", ([20.0; 3], work), [0.0, 0.0, 1.0]),
        ("most work is white", ([60.0; 3], work), [1.0; 3]),
        ("one price for all is halfway", ([7.0; 3], one), [0.5, 1.0, 0.0]),
        ("without a range work stays as it is", ([7.0; 3], tone(VIEW_HEAT, None, 1.0)), [7.0; 3]),
        ("colours are developed", ([0.5, 0.25, 2.0], tone(VIEW_NORMALS, Some([0.0, 1.0]), 2.0)), [1.0, 0.5, 4.0]),
    ]);
}

#[test]
fn the_legend_has_the_colours_of_the_picture() {
    let mut verdict = Verdict::on("legend::stops");
    for (quantity, view) in [
        (Quantity::Distance, VIEW_DEPTH),
        (Quantity::Work, VIEW_HEAT),
    ] {
        let stops = legend::stops(quantity);
        // On a range over which both distances and steps use equal steps of the legend.
        let value = |index: usize| {
            let place = index as f32 / (stops.len() - 1) as f32;
            match quantity {
                Quantity::Distance => 2.0 * 8_f32.powf(place),
                _ => 2.0 + 14.0 * place,
            }
        };
        let inputs: Vec<_> = (0..stops.len())
            .map(|index| ([value(index), 1.0, 0.0], tone(view, Some([2.0, 16.0]), 1.0)))
            .collect();
        let shown: Vec<[f32; 3]> = gpu().map("lib::quantity::shown", &inputs);
        for (stop, shown) in stops.iter().zip(&shown) {
            let expected = stop.map(|level| f64::from(level) / 255.0);
            let name = format!("{quantity:?} {stop:?}");
            verdict.near(name, shown, &expected, Tolerance::Absolute(0.5 / 255.0));
        }
    }
    verdict.close();
}

#[test]
fn values_in_a_legend_have_three_significant_digits() {
    let rows = [
        (0.0, "0"),
        (64.0, "64"),
        (3.25, "3.25"),
        (3.256, "3.26"),
        (41.04, "41"),
        (12345.6, "12346"),
        (0.001_234, "0.00123"),
        (1e-6, "1.00e-6"),
        (2.5e9, "2.50e9"),
    ];
    for (value, expected) in rows {
        assert_eq!(legend::number(value), expected);
    }
}

fn asset(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR"))
        .join("assets/scenes")
        .join(name)
}

/// The output of `glimray render` for a scene.
fn command(scene: &Path, flags: &[&str], name: &str) -> (image::DynamicImage, String) {
    let folder = tempfile::tempdir().expect("a folder");
    let out = folder.path().join(name);
    let output = Command::new(env!("CARGO_BIN_EXE_glimray"))
        .arg("render")
        .arg(scene)
        .args(flags)
        .arg("-o")
        .arg(&out)
        .output()
        .expect("glimray");
    let said = String::from_utf8_lossy(&output.stderr).into_owned();
    assert!(output.status.success(), "{said}");
    (image::open(&out).expect("a picture"), said)
}

/// The minimum and maximum level of the channel with the largest variation, without 5 % of the pixels at either
/// end.
fn spread(picture: &image::DynamicImage) -> (f32, f32) {
    let pixels = picture.to_rgb8();
    let channels = (0..3).map(|channel| {
        let levels: Vec<f32> = pixels.pixels().map(|p| f32::from(p.0[channel])).collect();
        (percentile(&levels, 0.05), percentile(&levels, 0.95))
    });
    let widest = channels.max_by(|a, b| (a.1 - a.0).total_cmp(&(b.1 - b.0)));
    widest.expect("channels")
}

#[test]
fn every_debug_view_has_contrast_and_is_not_clipped() {
    let mut verdict = Verdict::on("debug views");
    for scene in ["mesh.toml", "carousel.toml", "soft_shadows.toml"] {
        for view in ["normals", "depth", "ids", "uv", "heat", "samples"] {
            let mut flags = vec!["--integrator", view, "--size", "96x64"];
            if view == "samples" {
                flags.extend(["--antialias", "adaptive", "--samples", "16"]);
            }
            let (picture, _) = command(&asset(scene), &flags, "view.png");
            let (low, high) = spread(&picture);
            let name = format!("{view} of {scene}");
            verdict.that(format!("{name}: spread"), high - low >= 64.0, || {
                format!("from {low} to {high}")
            });
            // White: the maximum in all channels.
            let white = picture.to_rgb8();
            let white = white.pixels().filter(|pixel| pixel.0 == [255; 3]).count();
            let fraction = white as f64 / (96.0 * 64.0);
            // Many pixels get the maximum number of samples.
            let most = if view == "samples" { 0.5 } else { 0.1 };
            verdict.that(format!("{name}: not clipped"), fraction < most, || {
                format!("{:.0} % are white", 100.0 * fraction)
            });
        }
    }
    verdict.close();
}

const BALL: &str = r#"
[camera]
look_from = [0, 0, 5]
look_at = [0, 0, 0]
fov_y_deg = 30

[materials]
grey = {}

[[objects]]
sphere = { center = [0, 0, 0], radius = 1 }
material = "grey"
"#;

#[test]
fn linear_files_and_an_explicit_exposure_keep_distances_as_they_are() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("ball.toml");
    std::fs::write(&path, BALL).expect("a scene");
    let flags = ["--integrator", "depth", "--size", "33x33", "--samples", "1"];
    let (raw, said) = command(&path, &flags, "ball.exr");
    // The centre of the picture is 4 away.
    let middle = raw.to_rgb32f().get_pixel(16, 16).0[0];
    assert!((middle - 4.0).abs() < 1e-4, "{middle}");
    assert!(!said.contains("distances"), "{said}");
    let exposed: Vec<&str> = flags.iter().copied().chain(["--exposure", "-3"]).collect();
    let (half, _) = command(&path, &exposed, "ball.png");
    let middle = half.to_rgb8().get_pixel(16, 16).0;
    // 4 / 8 of 255, rounded either way.
    assert!(middle == [127; 3] || middle == [128; 3], "{middle:?}");
    let (found, said) = command(&path, &flags, "ball.png");
    assert_eq!(found.to_rgb8().get_pixel(16, 16).0, [255; 3]);
    assert_eq!(found.to_rgb8().get_pixel(0, 0).0, [0; 3]);
    assert!(said.contains("distances from 4"), "{said}");
}
