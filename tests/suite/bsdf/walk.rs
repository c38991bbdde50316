//! Random walks of light among microfacets in f64: Heitz, Hanika, d'Eon and Dachsbacher 2016, Multiple-Scattering
//! Microfacet BSDFs with the Smith Model, with the distribution of Trowbridge and Reitz.

use super::reference::ggx_lambda;
use crate::shader_albedo::ggx_albedo;
use crate::support::{harness::gpu, random::Random, verdict::Verdict};
use glam::{DVec3, dvec3};
use std::f64::consts::TAU;

/// Reflections after which a walk is given up: fewer than one in a million is as long.
const MOST: usize = 100;

/// Λ of a direction of either hemisphere, below -1 for one that goes down: equation 24 of the supplement.
fn lambda(w: DVec3, alpha: f64) -> f64 {
    let upward = ggx_lambda(w, [alpha; 2]);
    if w.z < 0.0 { -1.0 - upward } else { upward }
}

/// A normal of a microfacet as seen from `w`, of either hemisphere. Directions mirrored in half a unit sphere are even
/// over a cap (Dupuy and Benyoub 2023).
fn visible_normal(w: DVec3, alpha: f64, [u, v]: [f64; 2]) -> DVec3 {
    let round = dvec3(alpha * w.x, alpha * w.y, w.z).normalize();
    let height = 1.0 - u * (1.0 + round.z);
    let radius = (1.0 - height * height).max(0.0).sqrt();
    let (sin, cos) = (TAU * v).sin_cos();
    let h = round + dvec3(radius * cos, radius * sin, height);
    dvec3(alpha * h.x, alpha * h.y, h.z).normalize()
}

/// The fractions of light from a direction with cosine `cos_o` that microfacets of width `alpha` reflect: white ones at
/// their first reflection, and those of each `f0` with Schlick's approximation at any.
fn albedos<const N: usize>(
    cos_o: f64,
    alpha: f64,
    f0: [f64; N],
    walks: usize,
    random: &mut Random,
) -> (f64, [f64; N]) {
    let mut once = 0.0;
    let mut sums = [0.0; N];
    for _ in 0..walks {
        let mut w = -dvec3((1.0 - cos_o * cos_o).sqrt(), 0.0, cos_o);
        let mut kept = [1.0; N];
        // The part of the microfacets that is lower, 1 above all of them: C1 of the paper.
        let mut below = 1.0;
        for reflections in 0..MOST {
            // The chance to go on to `x` without a hit is (below/x)^Λ.
            below *= random.between(1e-15, 1.0).powf(-1.0 / lambda(w, alpha));
            if w.z > 0.0 && below >= 1.0 {
                once += f64::from(reflections == 1);
                sums = std::array::from_fn(|i| sums[i] + kept[i]);
                break;
            }
            let h = visible_normal(-w, alpha, [0; 2].map(|_| random.between(0.0, 1.0)));
            let cos = -w.dot(h);
            let grazing = (1.0 - cos).max(0.0).powi(5);
            kept = std::array::from_fn(|i| kept[i] * (f0[i] + (1.0 - f0[i]) * grazing));
            w += 2.0 * cos * h;
        }
    }
    let share = 1.0 / walks as f64;
    (once * share, sums.map(|sum| sum * share))
}

/// Metals and dielectrics reflect what random walks among their microfacets bring back, at each angle and of even light.
#[test]
fn microfacets_of_all_reflectances_reflect_as_random_walks_among_them_do() {
    const F0: [f64; 5] = [0.04, 0.2, 0.5, 0.8, 1.0];
    // Relative to the walks, with 0.3 % for their noise.
    const AT_ANGLES: [f64; 5] = [0.072, 0.052, 0.031, 0.014, 0.003];
    const OF_EVEN_LIGHT: [f64; 5] = [0.048, 0.027, 0.015, 0.007, 0.002];
    const COSINES: usize = 8;
    let mut verdict = Verdict::on("random walks");
    let mut random = Random::new(2016);
    for roughness in [0.2, 0.4, 0.6, 0.8, 1.0_f64] {
        let alpha = roughness * roughness;
        // Cosines in proportion to the light that arrives.
        let cosines: [f64; COSINES] =
            std::array::from_fn(|i| ((i as f64 + 0.5) / COSINES as f64).sqrt());
        let factors = cosines.map(|cos| ggx_albedo(cos, alpha));
        let inputs: Vec<_> = factors
            .iter()
            .flat_map(|factors| F0.map(|f0| ([f0 as f32; 3], [1f32; 3], factors.map(|x| x as f32))))
            .collect();
        let gains: Vec<[f32; 3]> = gpu().map("lib::albedo::multiple_scattering", &inputs);
        let mut sums = [[0.0; 2]; 5];
        for (row, cos) in cosines.into_iter().enumerate() {
            let what = format!("roughness {roughness}, cos {cos:.3}");
            let (once, walked) = albedos(cos, alpha, F0, 30_000, &mut random);
            let [f0_part, f90_part] = factors[row];
            let white = f0_part + f90_part;
            verdict.that(
                format!("{what}, once"),
                (once - white).abs() < 0.012,
                || format!("{once}, not {white}"),
            );
            for (i, f0) in F0.into_iter().enumerate() {
                let gain = f64::from(gains[row * F0.len() + i][0]);
                let got = (f0 * f0_part + f90_part) * gain;
                let is_near = (got / walked[i] - 1.0).abs() < AT_ANGLES[i];
                verdict.that(format!("{what}, f0 {f0}"), is_near && got < 1.002, || {
                    format!("{got}, not {}", walked[i])
                });
                sums[i][0] += got;
                sums[i][1] += walked[i];
            }
        }
        for (i, [got, walked]) in sums.into_iter().enumerate() {
            let what = format!("roughness {roughness}, f0 {}, even light", F0[i]);
            let is_near = (got / walked - 1.0).abs() < OF_EVEN_LIGHT[i];
            verdict.that(what, is_near, || format!("{got}, not {walked}"));
        }
    }
    verdict.close();
}
