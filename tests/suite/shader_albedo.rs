//! `lib/albedo.wesl` and `pack/albedo.rs`: tables of directional albedos, and multiple scattering by them.

mod table;

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
const GGX: usize = 0;
const SHEEN: usize = 1024;
const GLASS: usize = 2048;
const GLASS_ROWS: usize = 24;
const SLICES: usize = 36;
const STRETCHED: usize = GLASS + SLICES * GLASS_ROWS * SIDE;
const CLEAR: usize = 12;

fn view(cos: f64) -> DVec3 {
    DVec3::new((1.0 - cos * cos).sqrt(), 0.0, cos)
}

/// Sums over normals in proportion to their density and cosine, seen or not: their cosine to the view `wo` and the weight,
/// the visible area per area of the surface.
fn over_normals(wo: DVec3, alpha: f64, parts: [usize; 2], mut add: impl FnMut(DVec3, f64, f64)) {
    for i in 0..parts[0] {
        // The tangent of the normal's angle; steps are finer where the distribution ends.
        let root = 1.0 - ((i as f64 + 0.5) / parts[0] as f64).powi(2);
        let weight = 2.0 * (i as f64 + 0.5) / parts[0] as f64;
        let tan2 = alpha * alpha * root / (1.0 - root);
        let cos_h = 1.0 / (1.0 + tan2).sqrt();
        let sin_h = (1.0 - cos_h * cos_h).sqrt();
        for j in 0..parts[1] {
            let phi = 0.5 * TAU * (j as f64 + 0.5) / parts[1] as f64;
            let h = DVec3::new(sin_h * phi.cos(), sin_h * phi.sin(), cos_h);
            let cos = wo.dot(h);
            if cos > 0.0 {
                let share = weight * cos / (wo.z * h.z * (parts[0] * parts[1]) as f64);
                add(h, cos, share);
            }
        }
    }
}

/// The factors of f0 and f90.
pub fn ggx_albedo(cos_o: f64, alpha: f64) -> [f64; 2] {
    let widths = [alpha, alpha];
    let wo = view(cos_o);
    let mut sums = [0.0; 2];
    over_normals(wo, alpha, [600, 120], |h, cos, share| {
        let wi = 2.0 * cos * h - wo;
        if wi.z > 0.0 {
            let hidden = reference::ggx_lambda(wo, widths) + reference::ggx_lambda(wi, widths);
            let part = share / (1.0 + hidden);
            let grazing = (1.0 - cos).powi(5);
            sums[0] += part * (1.0 - grazing);
            sums[1] += part * grazing;
        }
    });
    sums
}

/// Albedos of rough glass, reflected and transmitted: Walter et al. 2007, transmitted light shadowed independently.
fn glass_albedo(cos_o: f64, alpha: f64, eta: f64) -> [f64; 2] {
    let widths = [alpha, alpha];
    let wo = view(cos_o);
    let seen = reference::ggx_lambda(wo, widths);
    let mut sums = [0.0; 2];
    over_normals(wo, alpha, [600, 240], |h, cos, share| {
        let fresnel = reference::fresnel(cos, eta);
        let up = 2.0 * cos * h - wo;
        if up.z > 0.0 {
            sums[0] += share * fresnel / (1.0 + seen + reference::ggx_lambda(up, widths));
        }
        let cos_t = (1.0 - eta * eta * (1.0 - cos * cos)).max(0.0).sqrt();
        let through = (eta * cos - cos_t) * h - eta * wo;
        if through.z < 0.0 {
            let hidden = (1.0 + seen) * (1.0 + reference::ggx_lambda(-through, widths));
            sums[1] += share * (1.0 - fresnel) / hidden;
        }
    });
    sums
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

/// A slice, a cosine, α and an index of refraction.
type Place = (u32, f32, f32, f32);

/// Where the shader looks: indices of words and their weights.
fn places(lookup: &str, rows: &[Place]) -> Vec<[[f32; 4]; 2]> {
    let place = format!(
        "import package::lib::albedo::{{ggx_lookup, glass_lookup, sheen_lookup}};
        fn probe(slice: u32, cos_o: f32, alpha: f32, eta: f32) -> mat2x4f {{
            let found = {lookup};
            return mat2x4f(vec4f(found.words), found.weights);
        }}"
    );
    gpu().map_source(&place, rows)
}

/// The shader's lookups there: the weighted mean.
fn looked_up(lookup: &str, rows: &[Place]) -> Vec<[f32; 2]> {
    let words = albedo::words();
    let entries: Vec<([u32; 4], [f32; 4])> = places(lookup, rows)
        .iter()
        .map(|[indices, weights]| (indices.map(|i| words[i as usize]), *weights))
        .collect();
    gpu().map("lib::albedo::blended_albedo", &entries)
}

const OF_GGX: &str = "ggx_lookup(cos_o, alpha)";
const OF_SHEEN: &str = "sheen_lookup(cos_o, alpha)";
const OF_GLASS: &str = "glass_lookup(slice, cos_o, alpha, eta)";

/// The factors of f0 and f90 that the shader finds for rows of (cosine, α).
fn factors(rows: &[(f32, f32)]) -> Vec<[f32; 2]> {
    let places: Vec<_> = rows
        .iter()
        .map(|&(cos, alpha)| (0, cos, alpha, 1.0))
        .collect();
    let entries = looked_up(OF_GGX, &places);
    let cosines = rows.iter().map(|row| row.0);
    let inputs: Vec<_> = entries.into_iter().zip(cosines).collect();
    gpu().map("lib::albedo::ggx_factors", &inputs)
}

fn entry(first: usize, column: usize, row: usize) -> [f64; 2] {
    let word = albedo::words()[first + row * SIDE + column];
    [word & 0xffff, word >> 16].map(|bits| f16::from_bits(bits as u16).to_f64())
}

/// The cosine of a column of microfacets of width α.
fn cosine(column: f64, alpha: f64) -> f64 {
    let square = (column / 31.0).powi(2);
    (4.0 * alpha * square / (1.0 + 4.0 * alpha - square)).min(1.0)
}

/// The functions of C round differently: an entry may be the next half float.
#[test]
fn words_are_the_table_that_is_computed() {
    const PATH: &str = "crates/render/src/pack/albedo/words.bin";
    let computed = table::words();
    if std::env::var_os("UPDATE").is_some() {
        let bytes: Vec<u8> = computed
            .iter()
            .flat_map(|word| word.to_le_bytes())
            .collect();
        std::fs::write(PATH, bytes).expect("a file");
    }
    let words = albedo::words();
    assert_eq!(words.len(), computed.len());
    let is_near = |(a, b): (u32, u32)| {
        let halves = |word: u32| [word & 0xffff, word >> 16];
        (halves(a).into_iter().zip(halves(b))).all(|(a, b)| a.abs_diff(b) <= 1)
    };
    let pairs = words.iter().copied().zip(computed);
    let different = pairs.enumerate().find(|(_, pair)| !is_near(*pair));
    assert_eq!(different, None, "in {PATH}; UPDATE=1 writes it");
}

#[test]
fn entries_are_the_albedos_of_the_formulas() {
    assert_eq!(albedo::words().len(), STRETCHED + 5 * 14 * 20 * 24);
    let mut verdict = Verdict::on("pack/albedo.rs");
    // Along the normal, with α = 1, the integral has a closed form.
    let [whole, _] = entry(GGX, 31, 31);
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
            if row > 0 {
                let alpha = y * y;
                let cos = cosine(column as f64, alpha);
                let [f0, f90] = ggx_albedo(cos, alpha);
                let smooth = (f0 + f90) * (1.0 - cos).powi(5);
                let expected = [f0 + f90, 0.5 + 0.5 * (f90 - smooth)];
                let got = entry(GGX, column, row);
                let off = (got[0] - expected[0])
                    .abs()
                    .max((got[1] - expected[1]).abs());
                let name = format!("cos {cos:.4}, α {alpha:.4}");
                verdict.that(&name, off < 1e-3, || format!("{got:?}, not {expected:?}"));
            }
            let (cos, alpha) = (x.powi(4), y.powi(4).max(1e-3));
            if alpha > 0.03 {
                let name = format!("cos {cos:.4}, α {alpha:.4}");
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
    for i in 0..=60 {
        for cos in [
            0.005_f32, 0.01, 0.02, 0.03, 0.05, 0.1, 0.15, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9,
            0.97, 1.0,
        ] {
            rows.push((cos, (i as f32 / 60.0).powi(2).max(1e-4)));
        }
    }
    let albedos = factors(&rows);
    let white = [1f32; 3];
    let inputs: Vec<_> = (albedos.iter().map(|&albedo| (white, white, albedo))).collect();
    let gains: Vec<[f32; 3]> = gpu().map("lib::albedo::multiple_scattering", &inputs);
    let mut verdict = Verdict::on("white metal");
    for ((&(cos, alpha), [gain, ..]), factors) in rows.iter().zip(gains).zip(albedos) {
        let [f0, f90] = ggx_albedo(cos.into(), alpha.into());
        let all = (f0 + f90) * f64::from(gain);
        let off = (f90 - f64::from(factors[1])).abs();
        verdict.that(
            format!("cos {cos}, α {alpha}"),
            (all - 1.0).abs() < 1.5e-3 && off < 2e-3,
            || format!("{all}, {f90} of it grazing, in the table {factors:?}"),
        );
    }
    verdict.close();
}

#[test]
fn rough_glass_scatters_everything_at_every_roughness_and_index() {
    let mut verdict = Verdict::on("rough glass");
    for index in [1.2, 1.5, 2.0, 2.5] {
        for eta in [index, 1.0 / index] {
            let [place]: [f32; 1] = gpu()
                .map("lib::albedo::glass_slice", &[eta as f32])
                .try_into()
                .expect("a slice");
            let slice = place.floor().min(34.0);
            let part = f64::from(place - slice);
            let mut rows = Vec::new();
            for roughness in [
                0.02_f32, 0.05, 0.08, 0.12, 0.15, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9, 1.0,
            ] {
                for cos in [
                    0.02_f32, 0.05, 0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9, 1.0,
                ] {
                    rows.push((slice as u32, cos, roughness * roughness, eta as f32));
                }
            }
            let next = rows
                .iter()
                .map(|&(i, cos, alpha, eta)| (i + 1, cos, alpha, eta));
            let next: Vec<_> = next.collect();
            let both = looked_up(OF_GLASS, &rows)
                .into_iter()
                .zip(looked_up(OF_GLASS, &next));
            let entries: Vec<[f64; 2]> = both
                .map(|(low, high)| {
                    [0, 1].map(|k| (1.0 - part) * f64::from(low[k]) + part * f64::from(high[k]))
                })
                .collect();
            let inputs: Vec<_> = (entries.iter().zip(&rows))
                .map(|(entry, row)| (entry.map(|x| x as f32), row.1, row.2, eta as f32))
                .collect();
            let found: Vec<[f32; 2]> = gpu().map("lib::albedo::glass_factors", &inputs);
            for ((_, cos, alpha, _), [whole, share]) in rows.into_iter().zip(found) {
                let [reflected, transmitted] = glass_albedo(cos.into(), alpha.into(), eta);
                let all = (reflected + transmitted) / f64::from(whole);
                let what = format!("η {eta:.3}, cos {cos}, α {alpha:.4}");
                // Near an index of 1 a wall changes fastest with it.
                let (least, most) = match index < 1.3 {
                    true => (0.995, 1.005),
                    false => (0.995, 1.003),
                };
                verdict.that(&what, all > least && all < most, || all);
                let off = (reflected / (reflected + transmitted) - f64::from(share)).abs();
                verdict.that(what, off < 0.01, || {
                    format!("{share} reflected, off by {off}")
                });
            }
        }
    }
    verdict.close();
}

/// The albedo of microfacets of different widths along x and y, as [`ggx_albedo`]: over directions, on a grid around the
/// mirrored normals.
fn stretched_albedo(wo: DVec3, widths: [f64; 2]) -> f64 {
    const PARTS: [usize; 2] = [400, 360];
    let mut sum = 0.0;
    for i in 0..PARTS[0] {
        // Slopes of normals in proportion to their density: tan²θ = u/(1 - u) in units of the widths.
        let root = 1.0 - ((i as f64 + 0.5) / PARTS[0] as f64).powi(2);
        let weight = 2.0 * (i as f64 + 0.5) / PARTS[0] as f64;
        let slope = (root / (1.0 - root)).sqrt();
        for j in 0..PARTS[1] {
            let (sin, cos) = (TAU * (j as f64 + 0.5) / PARTS[1] as f64).sin_cos();
            let h = DVec3::new(widths[0] * slope * cos, widths[1] * slope * sin, 1.0).normalize();
            let seen = wo.dot(h);
            let wi = 2.0 * seen * h - wo;
            if seen > 0.0 && wi.z > 0.0 {
                let hidden = reference::ggx_lambda(wo, widths) + reference::ggx_lambda(wi, widths);
                let share = weight * seen / (wo.z * h.z * (PARTS[0] * PARTS[1]) as f64);
                sum += share / (1.0 + hidden);
            }
        }
    }
    sum
}

#[test]
fn brushed_white_metal_reflects_everything_from_every_side() {
    let mut rows = Vec::new();
    for roughness in [0.05_f32, 0.1, 0.2, 0.4, 0.6, 0.8, 0.95] {
        for strength in [0.2_f32, 0.45, 0.7, 0.9, 1.0] {
            for (cos, azimuth) in [
                (0.97_f32, 0.3_f32),
                (0.8, 1.5),
                (0.6, 0.0),
                (0.6, 0.7),
                (0.4, 1.2),
                (0.36, 1.46),
                (0.25, 0.4),
                (0.1, 1.0),
                (0.05, 0.1),
            ] {
                let narrow = roughness * roughness;
                let wide = narrow + (1.0 - narrow) * strength * strength;
                let flat = (1.0 - cos * cos).sqrt();
                let wo = [flat * azimuth.cos(), flat * azimuth.sin(), cos];
                rows.push((wo, [wide, narrow]));
            }
        }
    }
    let slices: Vec<[f32; 2]> = gpu().map("lib::albedo::stretched_slice", &rows);
    let place = "import package::lib::albedo::stretched_lookup;
        fn probe(slice: vec2u, wo: vec3f, alpha: vec2f) -> mat2x4f {
            let found = stretched_lookup(slice, wo, alpha);
            return mat2x4f(vec4f(found.words), found.weights);
        }";
    let mut whole = vec![0.0_f64; rows.len()];
    for corner in [[0, 0], [1, 0], [0, 1], [1, 1]] {
        let at = |slice: &[f32; 2]| [slice[0].floor().min(12.0), slice[1].floor().min(3.0)];
        let inputs: Vec<_> = (rows.iter().zip(&slices))
            .map(|(row, slice)| {
                let [x, y] = at(slice).map(|place| place as u32);
                ([x + corner[0], y + corner[1]], row.0, row.1)
            })
            .collect();
        let found: Vec<[[f32; 4]; 2]> = gpu().map_source(place, &inputs);
        for ((sum, slice), [words, weights]) in whole.iter_mut().zip(&slices).zip(found) {
            let parts = [0, 1].map(|axis| {
                let part = f64::from(slice[axis] - at(slice)[axis]);
                if corner[axis] == 1 { part } else { 1.0 - part }
            });
            for (word, weight) in words.iter().zip(weights) {
                let bits = albedo::words()[*word as usize] & 0xffff;
                *sum +=
                    parts[0] * parts[1] * f64::from(weight) * f16::from_bits(bits as u16).to_f64();
            }
        }
    }
    let mut verdict = Verdict::on("brushed white metal");
    let mut offs = Vec::new();
    for ((wo, widths), whole) in rows.iter().zip(whole) {
        let wo = DVec3::from_array(wo.map(f64::from));
        let all = stretched_albedo(wo, widths.map(f64::from)) / whole;
        offs.push(all - 1.0);
        verdict.that(
            format!("{wo}, α {widths:?}"),
            all > 0.995 && all < 1.002,
            || all,
        );
    }
    let mean = offs.iter().sum::<f64>() / offs.len() as f64;
    verdict.that("mean", mean.abs() < 1e-3, || mean);
    verdict.close();
}

#[test]
fn lookups_meet_the_entries_and_are_linear_between_them() {
    let place = |i: usize| i as f64 / 31.0;
    let mut of_ggx = Vec::new();
    let mut of_sheen = Vec::new();
    for row in 0..SIDE {
        for column in 0..SIDE {
            let alpha = place(row).powi(2);
            of_ggx.push((0, cosine(column as f64, alpha) as f32, alpha as f32, 1.0));
            of_sheen.push((
                0,
                place(column).powi(4) as f32,
                place(row).powi(4) as f32,
                1.0,
            ));
        }
    }
    let mut verdict = Verdict::on("lookups");
    for (table, lookup, rows) in [(GGX, OF_GGX, of_ggx), (SHEEN, OF_SHEEN, of_sheen)] {
        for (i, got) in looked_up(lookup, &rows).iter().enumerate() {
            // Without width there is only one cosine but 0.
            if table == SHEEN || i >= SIDE {
                let expected = entry(table, i % SIDE, i / SIDE);
                verdict.near(i, got, &expected, Tolerance::Absolute(5e-5));
            }
        }
    }
    // The middle of a cell is the mean of its corners.
    let corners = [(10, 20), (11, 20), (10, 21), (11, 21)];
    let alpha = (20.5_f64 / 31.0).powi(2);
    let in_ggx = (0, cosine(10.5, alpha) as f32, alpha as f32, 1.0);
    let in_sheen = (0, (10.5_f32 / 31.0).powi(4), (20.5_f32 / 31.0).powi(4), 1.0);
    for (table, lookup, row) in [(GGX, OF_GGX, in_ggx), (SHEEN, OF_SHEEN, in_sheen)] {
        let corners = corners.map(|(x, y)| entry(table, x, y));
        let mean = [0, 1].map(|part| corners.map(|corner| corner[part]).iter().sum::<f64>() / 4.0);
        let middle = looked_up(lookup, &[row])[0];
        verdict.near(lookup, &middle, &mean, Tolerance::Absolute(2e-5));
        // Beyond the ends, the last entries hold.
        let ends = looked_up(lookup, &[(0, 2.0, 2.0, 1.0), (0, -1.0, -1.0, 1.0)]);
        for (end, (x, y)) in ends.iter().zip([(31, 31), (0, 0)]) {
            verdict.near("end", end, &entry(table, x, y), Tolerance::Absolute(1e-6));
        }
    }
    verdict.close();
}

#[test]
fn light_that_is_scattered_again_takes_the_colour_of_the_metal_again() {
    let white = [1.0; 3];
    let colour = [1f32, 0.5, 0.0];
    // The root of 0.81 of the light leaves at each reflection: Σ F^(n+1) 0.9 · 0.1^n.
    let series = |kept: f64| 1.0 + 0.19 / 0.81 * 0.9 * kept / (1.0 - 0.1 * kept);
    gpu().check(
        "lib::albedo::multiple_scattering",
        Tolerance::Absolute(1e-6),
        &[
            (
                "nothing is lost at once",
                (colour, [1f32; 3], [0.6f32, 0.4]),
                white,
            ),
            (
                "a fifth is, the same at all angles",
                (colour, colour, [0.5, 0.31]),
                [1.0 / 0.81, series(0.5), 1.0],
            ),
            (
                "more at grazing angles",
                (colour, [1.0; 3], [0.5, 0.31]),
                [1.0 / 0.81, series(0.5 + 0.5 / 21.0), series(1.0 / 21.0)],
            ),
            (
                "more than everything is reflected",
                ([1.0; 3], [1.0; 3], [0.9, 0.2]),
                white,
            ),
            (
                "and again",
                ([3.0; 3], [3.0; 3], [0.5, 0.31]),
                [1.0 / 0.81; 3],
            ),
        ],
    );
}

/// Fresnel's equations for an angle at which the cosine of the transmitted light, squared, has a soft minimum of 0.
fn softened(cos_i: f64, alpha: f64, eta: f64) -> f64 {
    let squared = 1.0 - eta * eta * (1.0 - cos_i * cos_i);
    let soft = alpha * (eta * eta - 1.0).max(0.0).sqrt();
    let cos2_t = (0.5 * (squared + squared.hypot(soft))).min(1.0);
    reference::fresnel((1.0 - (1.0 - cos2_t) / (eta * eta)).max(0.0).sqrt(), eta)
}

#[test]
fn lookups_of_rough_glass_meet_the_entries() {
    let slices: Vec<f32> = gpu().map(
        "lib::albedo::glass_slice",
        &[0.2f32, 1.0 / 3.0, 1.0, 1.5, 3.0, 9.0],
    );
    let expected = [0.0, 0.0, 12.0, 12.0 + 23.0 * 0.4_f64.sqrt(), 35.0, 35.0];
    let mut verdict = Verdict::on("glass_lookup");
    for (slice, expected) in slices.iter().zip(expected) {
        verdict.near("slice", slice, &expected, Tolerance::Absolute(1e-4));
    }
    // A slice, a column and a row stand for the index of refraction, α and the cosine. The first and the last slice are those of 1/3
    // and 3; from that of equal media the root of the amplitude grows evenly.
    let place = |(slice, column, row): (usize, usize, usize)| {
        let steps = if slice < CLEAR {
            CLEAR
        } else {
            SLICES - 1 - CLEAR
        };
        let root = (slice as f64 - CLEAR as f64) / steps as f64;
        let amplitude = 0.5 * root * root.abs();
        let eta: f64 = (1.0 + amplitude) / (1.0 - amplitude);
        let alpha = (row as f64 / 23.0).powi(2);
        let critical = (1.0 - 1.0 / (eta * eta)).max(0.0).sqrt();
        let edge = |cos: f64| (1.5 * (cos - critical) / alpha).asinh();
        let at = |cos: f64| {
            let grazing = (cos * (1.0 + 4.0 * alpha) / (cos + 4.0 * alpha)).sqrt();
            (grazing + (edge(cos) - edge(0.0)) / (edge(1.0) - edge(0.0))) / 2.0
        };
        let wanted = column as f64 / 31.0;
        let (mut cos, mut step) = (0.0, 0.5);
        for _ in 0..50 {
            cos += if at(cos + step) <= wanted { step } else { 0.0 };
            step *= 0.5;
        }
        (eta, alpha, cos)
    };
    let rows = [
        (0_usize, 5, 3),
        (9, 31, 23),
        (35, 2, 1),
        (14, 17, 11),
        (23, 20, 8),
    ];
    let inputs = rows.map(|row| {
        let (eta, alpha, cos) = place(row);
        (row.0 as u32, cos as f32, alpha as f32, eta as f32)
    });
    for ((slice, column, row), [words, weights]) in rows.into_iter().zip(places(OF_GLASS, &inputs))
    {
        let own = GLASS + (slice * GLASS_ROWS + row) * SIDE + column;
        let weight: f32 = words
            .iter()
            .zip(weights)
            .filter(|(word, _)| **word == own as f32)
            .map(|(_, w)| w)
            .sum();
        verdict.that(format!("{slice}, {column}, {row}"), weight > 0.999, || {
            format!("{words:?} {weights:?}")
        });
        let (eta, alpha, cos) = place((slice, column, row));
        let [reflected, transmitted] = glass_albedo(cos, alpha, eta);
        let whole = reflected + transmitted;
        let expected = [
            whole,
            0.5 + 0.5 * (reflected / whole - softened(cos, alpha, eta)),
        ];
        let got = entry(GLASS + slice * GLASS_ROWS * SIDE, column, row);
        verdict.near(
            "entry",
            &got.map(|x| x as f32),
            &expected,
            Tolerance::Absolute(2e-3),
        );
    }
    verdict.close();
}
