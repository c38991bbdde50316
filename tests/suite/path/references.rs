//! Path-traced scenes against Mitsuba's pictures of them, which `benches/peers/path_tracing.py --references` wrote with
//! Mitsuba 3.9.1: for each pixel the mean and the variance of that mean. Two spheres stand in a box under a lamp: matte ones,
//! clear glass and a mirror, rough metals, rough glass; and two stand under a sky with a wide sun. Then boxes, spheres and
//! rectangles shine on plates of rough metal, one of them from just below the ceiling.
//!
//! Mitsuba's rough surfaces have the separable masking of glTF's specification, without compensation, so they are compared
//! with `BsdfModel::Spec`. That has Schlick's approximation where Mitsuba's glass has Fresnel's equations: metals reflect
//! everything, and rough glass differs at grazing angles, less than this noise.

use super::paths;
use crate::reference::compare::render;
use crate::support::verdict::Verdict;
use glimray::import;
use glimray::render::{BsdfModel, RenderSettings};
use std::path::Path;

const SIDE: u32 = 32;
const ROUNDS: usize = 16;

/// The channels of an OpenEXR file.
fn channels(name: &str) -> Vec<f64> {
    let path = Path::new("tests/references/paths").join(name);
    let picture = image::open(&path).unwrap_or_else(|error| panic!("{name}: {error}"));
    let picture = picture.into_rgb32f();
    assert_eq!(picture.dimensions(), (SIDE, SIDE), "{name}");
    picture.into_raw().into_iter().map(f64::from).collect()
}

#[test]
fn pictures_are_those_of_mitsuba_within_the_noise() {
    let mut verdict = Verdict::on("path-traced scenes");
    for (name, bounces, bsdf) in [
        ("matte", 4, BsdfModel::Full),
        ("glass", 1000, BsdfModel::Full),
        ("metal", 1000, BsdfModel::Spec),
        ("frosted", 1000, BsdfModel::Spec),
        ("sky", 4, BsdfModel::Spec),
        ("glowing_box", 4, BsdfModel::Spec),
        ("glowing_triangles", 4, BsdfModel::Spec),
        ("glowing_sphere", 4, BsdfModel::Spec),
        ("panel", 4, BsdfModel::Spec),
        ("lamps", 4, BsdfModel::Spec),
    ] {
        let path = format!("tests/references/paths/{name}.toml");
        let scene = import::load(Path::new(&path)).unwrap_or_else(|error| panic!("{error}"));
        let count = (3 * SIDE * SIDE) as usize;
        let (mut sum, mut squares) = (vec![0.0; count], vec![0.0; count]);
        for seed in 0..ROUNDS {
            let settings = RenderSettings {
                seed: seed as u32,
                bsdf,
                ..paths(128, (SIDE, SIDE), bounces)
            };
            let (image, _) = render(&scene, &settings);
            let values = image.pixels.iter().flat_map(|pixel| pixel[..3].to_vec());
            for (i, value) in values.map(f64::from).enumerate() {
                sum[i] += value;
                squares[i] += value * value;
            }
        }
        let rounds = ROUNDS as f64;
        let (means, variances) = (
            channels(&format!("{name}-mean.exr")),
            channels(&format!("{name}-variance.exr")),
        );
        // With few rounds the variance is uncertain: Student's t of 15 degrees of freedom, for a chance of
        // 1 - 0.99^(1/3072) per channel.
        let limit = 6.1;
        let mut far = Vec::new();
        for i in 0..count {
            let mean = sum[i] / rounds;
            let variance = (squares[i] / rounds - mean * mean).max(0.0) / (rounds - 1.0);
            // Both round: the lamp itself has no noise.
            let rounding = 1e-4 * means[i];
            let noise = (variance + variances[i] + rounding * rounding).sqrt();
            let z = (mean - means[i]) / noise.max(1e-9);
            if z.abs() > limit {
                far.push((i / 3 % SIDE as usize, i / 3 / SIDE as usize, i % 3, z));
            }
        }
        let share = far.len() as f64 / count as f64;
        verdict.that(
            format!("{name}: pixels within the noise"),
            // Caustics have heavy tails, of which few rounds of Mitsuba know little.
            share <= 0.003,
            || {
                format!(
                    "{} of {count} are not (x, y, channel, z): {:.1?}",
                    far.len(),
                    &far[..far.len().min(12)]
                )
            },
        );
        let (found, expected): (f64, f64) = (sum.iter().sum::<f64>() / rounds, means.iter().sum());
        let ratio = found / expected;
        verdict.that(format!("{name}: mean"), (ratio - 1.0).abs() < 0.003, || {
            format!("{ratio} times Mitsuba's")
        });
    }
    verdict.close();
}
