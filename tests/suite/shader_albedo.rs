//! `lib/albedo.wesl` and `pack/albedo.rs`: tables of directional albedos, and multiple scattering by them.

use crate::bsdf::reference;
use crate::support::{
    harness::gpu,
    verdict::{Tolerance, Verdict},
};
use glam::DVec3;
use glimray::pack::albedo;
use half::f16;
use std::f64::consts::TAU;

const SIDE: usize = 32;
const GGX: u32 = 0;
const SHEEN: u32 = 1024;

fn view(cos: f64) -> DVec3 {
    DVec3::new((1.0 - cos * cos).sqrt(), 0.0, cos)
}

/// The factors of f0 and f90, integrated over normals in proportion to their density and cosine, seen or not.
fn ggx_albedo(cos_o: f64, alpha: f64) -> [f64; 2] {
    const PARTS: [usize; 2] = [400, 40];
    let widths = [alpha, alpha];
    let wo = view(cos_o);
    let mut sums = [0.0; 2];
    for i in 0..PARTS[0] {
        // The tangent of the normal's angle; steps are finer where the distribution ends.
        let root = 1.0 - ((i as f64 + 0.5) / PARTS[0] as f64).powi(2);
        let weight = 2.0 * (i as f64 + 0.5) / PARTS[0] as f64;
        let tan2 = alpha * alpha * root / (1.0 - root);
        let cos_h = 1.0 / (1.0 + tan2).sqrt();
        let sin_h = (1.0 - cos_h * cos_h).sqrt();
        for j in 0..PARTS[1] {
            let phi = 0.5 * TAU * (j as f64 + 0.5) / PARTS[1] as f64;
            let h = DVec3::new(sin_h * phi.cos(), sin_h * phi.sin(), cos_h);
            let cos = wo.dot(h);
            let wi = 2.0 * cos * h - wo;
            if cos > 0.0 && wi.z > 0.0 {
                let hidden = reference::ggx_lambda(wo, widths) + reference::ggx_lambda(wi, widths);
                let part = weight * cos / ((1.0 + hidden) * wo.z * h.z);
                let grazing = (1.0 - cos).powi(5);
                sums[0] += part * (1.0 - grazing);
                sums[1] += part * grazing;
            }
        }
    }
    sums.map(|sum| sum / (PARTS[0] * PARTS[1]) as f64)
}

/// The albedo of sheen, on a grid of directions.
fn sheen_albedo(cos_o: f64, alpha: f64) -> f64 {
    const PARTS: [usize; 2] = [300, 200];
    let wo = view(cos_o);
    let mut sum = 0.0;
    for i in 0..PARTS[0] {
        let cos = (i as f64 + 0.5) / PARTS[0] as f64;
        for j in 0..PARTS[1] {
            let phi = TAU * (j as f64 + 0.5) / PARTS[1] as f64;
            let flat = (1.0 - cos * cos).sqrt();
            let wi = DVec3::new(flat * phi.cos(), flat * phi.sin(), cos);
            sum += reference::sheen(wo, wi, [alpha, 0.0, 0.0, 0.0])[0];
        }
    }
    TAU * sum / (PARTS[0] * PARTS[1]) as f64
}

/// What the shader reads from a table for rows of (cosine, α).
fn looked_up(table: u32, rows: &[(f32, f32)]) -> Vec<[f32; 2]> {
    let place = "
        import package::lib::albedo::albedo_lookup;
        fn probe(first: u32, cos_o: f32, alpha: f32) -> mat2x4f {
            let found = albedo_lookup(first, cos_o, alpha);
            return mat2x4f(vec4f(found.words), found.weights);
        }";
    let inputs: Vec<_> = rows
        .iter()
        .map(|&(cos, alpha)| (table, cos, alpha))
        .collect();
    let places: Vec<[[f32; 4]; 2]> = gpu().map_source(place, &inputs);
    let words = albedo::words();
    let entries: Vec<([u32; 4], [f32; 4])> = places
        .iter()
        .map(|[indices, weights]| (indices.map(|i| words[i as usize]), *weights))
        .collect();
    gpu().map("lib::albedo::blended_albedo", &entries)
}

fn entry(table: u32, column: usize, row: usize) -> [f64; 2] {
    let word = albedo::words()[table as usize + row * SIDE + column];
    [word & 0xffff, word >> 16].map(|bits| f16::from_bits(bits as u16).to_f64())
}

#[test]
fn entries_are_the_albedos_of_the_formulas() {
    assert_eq!(albedo::words().len(), 2 * SIDE * SIDE + 24 * 24 * SIDE);
    let mut verdict = Verdict::on("pack/albedo.rs");
    // Along the normal, with α = 1, the integral has a closed form.
    let whole: f64 = entry(GGX, 31, 31).iter().sum();
    let expected = 1.0 - std::f64::consts::LN_2;
    verdict.near(
        "1 - ln 2",
        &(whole as f32),
        &expected,
        Tolerance::Absolute(1e-3),
    );
    for row in (0..SIDE).step_by(3) {
        for column in 8..SIDE {
            let [x, y] = [column, row].map(|i| i as f64 / 31.0);
            let (cos, alpha) = (x.powi(4), y.powi(4).max(1e-3));
            let name = format!("cos {cos:.4}, α {alpha:.4}");
            let expected = ggx_albedo(cos, alpha);
            let got = entry(GGX, column, row);
            let off = (got[0] - expected[0])
                .abs()
                .max((got[1] - expected[1]).abs());
            verdict.that(&name, off < 3e-3, || format!("{got:?}, not {expected:?}"));
            if alpha > 0.03 {
                let (got, albedo) = (entry(SHEEN, column, row), sheen_albedo(cos, alpha));
                let expected = [albedo.min(1.0), 1.0 / albedo.max(1.0)];
                let off = (got[0] - expected[0])
                    .abs()
                    .max((got[1] - expected[1]).abs());
                verdict.that(format!("sheen, {name}"), off < 2e-3, || {
                    format!("{got:?}, not {expected:?}")
                });
            }
        }
    }
    verdict.close();
}

#[test]
fn white_metal_reflects_everything_at_every_roughness() {
    let mut rows = Vec::new();
    for i in 0..=40 {
        for cos in [
            0.01, 0.02, 0.05, 0.1, 0.15, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9, 0.97, 1.0,
        ] {
            rows.push((cos, (i as f32 / 40.0).powi(2)));
        }
    }
    let albedos = looked_up(GGX, &rows);
    let inputs: Vec<_> = albedos.iter().map(|&albedo| ([1f32; 3], albedo)).collect();
    let factors: Vec<[f32; 3]> = gpu().map("lib::albedo::multiple_scattering", &inputs);
    let mut verdict = Verdict::on("white metal");
    for (&(cos, alpha), [factor, ..]) in rows.iter().zip(factors) {
        let single: f64 = ggx_albedo(f64::from(cos), f64::from(alpha).max(1e-3))
            .iter()
            .sum();
        let all = single * f64::from(factor);
        verdict.that(
            format!("cos {cos}, α {alpha}"),
            (all - 1.0).abs() < 5e-3,
            || format!("{all}, {single} of it at once"),
        );
    }
    verdict.close();
}

#[test]
fn lookups_meet_the_entries_and_are_linear_between_them() {
    let place = |i: usize| i as f32 / 31.0;
    let mut rows = Vec::new();
    for row in 0..SIDE {
        for column in 0..SIDE {
            rows.push((place(column).powi(4), place(row).powi(4)));
        }
    }
    let mut verdict = Verdict::on("albedo_lookup");
    for table in [GGX, SHEEN] {
        for (i, got) in looked_up(table, &rows).iter().enumerate() {
            let expected = entry(table, i % SIDE, i / SIDE);
            verdict.near(i, got, &expected, Tolerance::Absolute(2e-5));
        }
    }
    // The middle of a cell, in the fourth roots of width and cosine, is the mean of its corners.
    let [cos, alpha] = [10.5_f32, 20.5].map(|i| (i / 31.0).powi(4));
    let [middle] = looked_up(GGX, &[(cos, alpha)])[..] else {
        panic!("one row");
    };
    let corners = [(10, 20), (11, 20), (10, 21), (11, 21)].map(|(x, y)| entry(GGX, x, y));
    let mean = [0, 1].map(|part| corners.map(|corner| corner[part]).iter().sum::<f64>() / 4.0);
    verdict.near("middle", &middle, &mean, Tolerance::Absolute(1e-5));
    // Beyond the ends, the last entries hold.
    let ends = looked_up(GGX, &[(2.0, 2.0), (-1.0, -1.0)]);
    verdict.near(
        "high",
        &ends[0],
        &entry(GGX, 31, 31),
        Tolerance::Absolute(1e-6),
    );
    verdict.near(
        "low",
        &ends[1],
        &entry(GGX, 0, 0),
        Tolerance::Absolute(1e-6),
    );
    verdict.close();
}

#[test]
fn light_that_is_scattered_again_takes_the_colour_of_the_metal_again() {
    let white = [1.0; 3];
    gpu().check(
        "lib::albedo::multiple_scattering",
        Tolerance::Absolute(1e-6),
        &[
            (
                "nothing is lost at once",
                ([1f32, 0.5, 0.0], [0.6f32, 0.4]),
                white,
            ),
            (
                "a third is",
                ([1.0, 0.5, 0.0], [0.5, 0.25]),
                [4.0 / 3.0, 7.0 / 6.0, 1.0],
            ),
            (
                "more than everything is reflected",
                ([1.0; 3], [0.9, 0.2]),
                white,
            ),
        ],
    );
}

/// What rough glass reflects and transmits, integrated over directions of light by the formulas of the lobes.
#[test]
fn entries_of_rough_glass_are_integrals_of_its_lobes() {
    use crate::bsdf::reference;
    let mut verdict = Verdict::on("rough glass");
    for (slice, row, column) in [
        (2, 15, 31),
        (4, 21, 22),
        (11, 12, 29),
        (17, 20, 25),
        (20, 23, 18),
    ] {
        // Slice 7 is that of equal media; the first and the last are those of 1/3 and 3.
        let root = (f64::from(slice) - 7.0) / if slice < 7 { 7.0 } else { 16.0 };
        let amplitude = 0.5 * root * root.abs();
        let eta = (1.0 + amplitude) / (1.0 - amplitude);
        let (cos, alpha) = (
            (column as f64 / 31.0).powi(4),
            (f64::from(row) / 23.0).powi(2),
        );
        let wo = view(cos);
        const PARTS: [usize; 2] = [1200, 400];
        let mut sums = [0.0; 2];
        for i in 0..PARTS[0] {
            let z = 2.0 * (i as f64 + 0.5) / PARTS[0] as f64 - 1.0;
            for j in 0..PARTS[1] {
                let phi = 0.5 * TAU * (j as f64 + 0.5) / PARTS[1] as f64;
                let flat = (1.0 - z * z).sqrt();
                let wi = DVec3::new(flat * phi.cos(), flat * phi.sin(), z);
                if z > 0.0 {
                    let h = (wo + wi).normalize();
                    let part = fresnel(wo.dot(h), eta);
                    sums[0] += part * reference::ggx(wo, wi, [alpha, alpha, 0.0, 0.0])[0];
                } else {
                    let h = (eta * wo + wi).normalize();
                    let part = 1.0 - fresnel(wo.dot(h).abs(), eta);
                    sums[1] += part * reference::transmission(wo, wi, [alpha, alpha, eta, 0.0])[0];
                }
            }
        }
        let [reflected, transmitted] =
            sums.map(|sum| 2.0 * TAU * sum / (PARTS[0] * PARTS[1]) as f64);
        let word = albedo::words()[2048 + (slice as usize * 24 + row as usize) * SIDE + column];
        let [whole, alone] =
            [word & 0xffff, word >> 16].map(|bits| f16::from_bits(bits as u16).to_f64());
        let off = (whole - reflected - transmitted)
            .abs()
            .max((alone - reflected).abs());
        verdict.that(
            format!("cos {cos:.3}, α {alpha:.3}, η {eta:.3}"),
            off < 5e-3,
            || {
                format!(
                    "{whole} and {alone}, not {} and {reflected}",
                    reflected + transmitted
                )
            },
        );
    }
    verdict.close();
}

/// Fresnel's equations for the cosine on the side of the index `eta`, relative to the other.
fn fresnel(cos_i: f64, eta: f64) -> f64 {
    let sin2 = eta * eta * (1.0 - cos_i * cos_i);
    if sin2 >= 1.0 {
        return 1.0;
    }
    let cos_t = (1.0 - sin2).sqrt();
    let s = (eta * cos_i - cos_t) / (eta * cos_i + cos_t);
    let p = (cos_i - eta * cos_t) / (cos_i + eta * cos_t);
    0.5 * (s * s + p * p)
}

#[test]
fn lookups_of_rough_glass_meet_the_entries() {
    let slices: Vec<f32> = gpu().map(
        "lib::albedo::glass_slice",
        &[0.2f32, 1.0 / 3.0, 1.0, 1.5, 3.0, 9.0],
    );
    let expected = [0.0, 0.0, 7.0, 7.0 + 16.0 * 0.4_f64.sqrt(), 23.0, 23.0];
    let mut verdict = Verdict::on("glass_lookup");
    for (slice, expected) in slices.iter().zip(expected) {
        verdict.near("slice", slice, &expected, Tolerance::Absolute(1e-4));
    }
    let place = "
        import package::lib::albedo::glass_lookup;
        fn probe(slice: u32, cos_o: f32, alpha: f32) -> mat2x4f {
            let found = glass_lookup(slice, cos_o, alpha);
            return mat2x4f(vec4f(found.words), found.weights);
        }";
    let rows: Vec<_> = [(0_u32, 5, 3), (9, 31, 23), (23, 0, 0), (12, 17, 11)].to_vec();
    let inputs: Vec<_> = rows
        .iter()
        .map(|&(slice, column, row)| {
            (
                slice,
                (column as f32 / 31.0).powi(4),
                (row as f32 / 23.0).powi(2),
            )
        })
        .collect();
    let places: Vec<[[f32; 4]; 2]> = gpu().map_source(place, &inputs);
    for ((slice, column, row), [words, weights]) in rows.into_iter().zip(places) {
        let own = 2048 + (slice * 24 + row) * 32 + column;
        let weight: f32 = words
            .iter()
            .zip(weights)
            .filter(|(word, _)| **word == own as f32)
            .map(|(_, w)| w)
            .sum();
        verdict.that(format!("{slice}, {column}, {row}"), weight > 0.999, || {
            format!("{words:?} {weights:?}")
        });
    }
    verdict.close();
}
