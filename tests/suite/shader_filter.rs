//! `lib/filter.wesl`: importance sampling of reconstruction filters.

use crate::support::{
    harness::gpu,
    random::Random,
    statistics::{cells, check_counts, check_even, square_points},
    verdict::{Tolerance, Verdict},
};
use glimray::layout::{
    FILTER_BLACKMAN_HARRIS, FILTER_BOX, FILTER_GAUSSIAN, FILTER_MITCHELL, FILTER_TENT,
};
use std::f64::consts::PI;

/// Filters with their default radii, and others.
const FILTERS: [(&str, u32, f32); 11] = [
    ("box", FILTER_BOX, 0.5),
    ("wide box", FILTER_BOX, 2.0),
    ("tent", FILTER_TENT, 1.0),
    ("narrow tent", FILTER_TENT, 0.25),
    ("Gaussian", FILTER_GAUSSIAN, 1.5),
    ("Gaussian cut early", FILTER_GAUSSIAN, 0.5),
    ("Gaussian cut late", FILTER_GAUSSIAN, 6.0),
    ("Blackman-Harris", FILTER_BLACKMAN_HARRIS, 1.5),
    ("wide Blackman-Harris", FILTER_BLACKMAN_HARRIS, 3.0),
    ("Mitchell", FILTER_MITCHELL, 2.0),
    ("narrow Mitchell", FILTER_MITCHELL, 1.0),
];

/// The filter curve in one dimension, up to a factor.
fn curve(kind: u32, radius: f64, x: f64) -> f64 {
    let t = (x / radius).abs();
    if t > 1.0 {
        return 0.0;
    }
    match kind {
        FILTER_BOX => 1.0,
        FILTER_TENT => 1.0 - t,
        FILTER_GAUSSIAN => (-x * x / (2.0 * 0.25)).exp(),
        FILTER_BLACKMAN_HARRIS => {
            // As published: over a window from 0 to 1.
            let phase = PI * (1.0 + x / radius);
            0.35875 - 0.48829 * phase.cos() + 0.14128 * (2.0 * phase).cos()
                - 0.01168 * (3.0 * phase).cos()
        }
        _ => {
            // Mitchell and Netravali 1988, equation 8.
            let (b, c, x) = (1.0 / 3.0, 1.0 / 3.0, 2.0 * t);
            if x < 1.0 {
                (12.0 - 9.0 * b - 6.0 * c) * x.powi(3)
                    + (-18.0 + 12.0 * b + 6.0 * c) * x.powi(2)
                    + (6.0 - 2.0 * b)
            } else {
                (-b - 6.0 * c) * x.powi(3)
                    + (6.0 * b + 30.0 * c) * x.powi(2)
                    + (-12.0 * b - 48.0 * c) * x
                    + (8.0 * b + 24.0 * c)
            }
        }
    }
}

/// The integral of `of` over the curve's absolute value from -radius to `end`, by Simpson's rule.
fn integral(kind: u32, radius: f64, end: f64, of: impl Fn(f64) -> f64) -> f64 {
    const PARTS: u32 = 20_000;
    let h = (end + radius) / f64::from(PARTS);
    let term = |i: u32| {
        let x = -radius + h * f64::from(i);
        let factor = if i == 0 || i == PARTS {
            1.0
        } else {
            f64::from(2 + 2 * (i % 2))
        };
        factor * of(x) * curve(kind, radius, x).abs()
    };
    (0..=PARTS).map(term).sum::<f64>() * h / 3.0
}

fn offsets(kind: u32, radius: f32, points: &[[f32; 2]]) -> Vec<[f32; 2]> {
    let inputs: Vec<_> = points.iter().map(|&u| (kind, radius, u)).collect();
    gpu().map("lib::filter::filter_offset", &inputs)
}

fn signs(kind: u32, points: &[[f32; 2]]) -> Vec<f32> {
    let inputs: Vec<_> = points.iter().map(|&u| (kind, u)).collect();
    gpu().map("lib::filter::filter_sign", &inputs)
}

#[test]
fn samples_are_dense_where_the_filter_is_large() {
    const COUNT: usize = 100_000;
    const BINS: usize = 64;
    let points = square_points(COUNT, 1);
    let mut verdict = Verdict::on("filter_offset");
    for (name, kind, radius) in FILTERS {
        let offsets = offsets(kind, radius, &points);
        let r = f64::from(radius);
        let inside = offsets.iter().flatten().all(|x| x.abs() <= radius);
        verdict.that(format!("{name}: within the radius"), inside, || "outside");
        let total = integral(kind, r, r, |_| 1.0);
        for axis in 0..2 {
            let mut counts = vec![0; BINS];
            for offset in &offsets {
                let bin = (f64::from(offset[axis]) / r + 1.0) / 2.0 * BINS as f64;
                counts[(bin as usize).min(BINS - 1)] += 1;
            }
            let edge = |i: usize| -r + 2.0 * r * i as f64 / BINS as f64;
            let below: Vec<f64> = (0..=BINS)
                .map(|i| integral(kind, r, edge(i), |_| 1.0) / total * COUNT as f64)
                .collect();
            // Bins whose expected count is too small for the test are merged with a neighbour.
            let (mut pooled, mut expected) = (Vec::new(), Vec::new());
            let (mut count, mut sum) = (0, 0.0);
            for (i, found) in counts.iter().enumerate() {
                count += found;
                sum += below[i + 1] - below[i];
                if sum >= 8.0 && COUNT as f64 - below[i + 1] >= 8.0 || i + 1 == BINS {
                    pooled.push(count);
                    expected.push(sum);
                    (count, sum) = (0, 0.0);
                }
            }
            check_counts(
                &mut verdict,
                format!("{name}, axis {axis}"),
                &pooled,
                &expected,
            );
        }
    }
    verdict.close();
}

#[test]
fn the_two_axes_are_independent() {
    let points = square_points(100_000, 2);
    let mut verdict = Verdict::on("filter_offset");
    for (name, kind, radius) in FILTERS {
        // Ranks along both axes are uniform and independent.
        let offsets = offsets(kind, radius, &points);
        let rank = |axis: usize| {
            let mut order: Vec<usize> = (0..offsets.len()).collect();
            order.sort_by(|&a, &b| offsets[a][axis].total_cmp(&offsets[b][axis]));
            let mut ranks = vec![0.0; order.len()];
            for (rank, &i) in order.iter().enumerate() {
                ranks[i] = rank as f64 / order.len() as f64;
            }
            ranks
        };
        let pairs = rank(0).into_iter().zip(rank(1)).map(|(x, y)| [x, y]);
        check_even(&mut verdict, name, &cells(pairs, 12));
    }
    verdict.close();
}

#[test]
fn stratified_samples_integrate_a_filter_to_1_and_its_moments_to_the_curves() {
    // The midpoints of a lattice in u make the mean over samples a quadrature.
    const SIDE: u32 = 256;
    let middle = |i: u32| (f64::from(i) + 0.5) / f64::from(SIDE);
    let points: Vec<[f32; 2]> = (0..SIDE * SIDE)
        .map(|i| [middle(i % SIDE) as f32, middle(i / SIDE) as f32])
        .collect();
    let mut verdict = Verdict::on("filter_offset");
    for (name, kind, radius) in FILTERS {
        let r = f64::from(radius);
        let signed =
            |of: &dyn Fn(f64) -> f64| integral(kind, r, r, |x| of(x) * curve(kind, r, x).signum());
        let whole = signed(&|_| 1.0);
        let (offsets, signs) = (offsets(kind, radius, &points), signs(kind, &points));
        let pairs: Vec<_> = offsets.iter().zip(&signs).collect();
        let weight: f64 = signs.iter().map(|&sign| f64::from(sign)).sum();
        let mean = |of: &dyn Fn(f64, f64) -> f64| {
            let sum = pairs
                .iter()
                .map(|([x, y], sign)| f64::from(**sign) * of(f64::from(*x), f64::from(*y)));
            sum.sum::<f64>() / weight
        };
        // The sign of the samples relative to the absolute value is the ratio of the two integrals.
        let fraction = weight / f64::from(SIDE * SIDE);
        let expected = (whole / integral(kind, r, r, |_| 1.0)).powi(2);
        let off = (fraction - expected).abs();
        verdict.that(
            format!("{name}: weight"),
            off < 6e-2 * (1.0 - expected) + 1e-9,
            || format!("{fraction}, expected {expected}"),
        );
        let second = signed(&|x| x * x) / whole;
        let rows = [
            ("x", mean(&|x, _| x), 0.0),
            ("y", mean(&|_, y| y), 0.0),
            ("x²", mean(&|x, _| x * x), second),
            ("y²", mean(&|_, y| y * y), second),
            ("xy", mean(&|x, y| x * y), 0.0),
            ("x²y²", mean(&|x, y| x * x * y * y), second * second),
        ];
        for (what, got, expected) in rows {
            let scale = if what.len() > 3 { r.powi(4) } else { r * r };
            verdict.that(
                format!("{name}: mean of {what}"),
                (got - expected).abs() < 2e-3 * scale,
                || format!("{got}, expected {expected}"),
            );
        }
    }
    verdict.close();
}

#[test]
fn only_the_outer_lobes_of_mitchell_are_negative() {
    let points = square_points(20_000, 3);
    let mut verdict = Verdict::on("filter_sign");
    for (name, kind, radius) in FILTERS {
        let (offsets, signs) = (offsets(kind, radius, &points), signs(kind, &points));
        let r = f64::from(radius);
        for ([x, y], sign) in offsets.iter().zip(&signs) {
            let [x, y] = [x, y].map(|&c| f64::from(c));
            let value = curve(kind, r, x) * curve(kind, r, y);
            // Next to a zero of the curve, rounding may decide.
            let clear = value.abs() > 1e-4;
            verdict.that(
                format!("{name} at ({x}, {y})"),
                !clear || value.signum() as f32 == *sign,
                || format!("{value} has the sign {sign}"),
            );
        }
    }
    verdict.close();
}

#[test]
fn the_box_of_one_pixel_is_the_unit_square_bit_for_bit() {
    let points = square_points(20_000, 4);
    let offsets = offsets(FILTER_BOX, 0.5, &points);
    let mut verdict = Verdict::on("filter_offset");
    for (u, offset) in points.iter().zip(&offsets) {
        for (u, x) in u.iter().zip(offset) {
            verdict.that(u, (0.5 + x).to_bits() == u.to_bits(), || 0.5 + x);
        }
    }
    verdict.close();
}

#[test]
fn the_ends_of_the_unit_square_are_ends_of_the_filter() {
    let mut verdict = Verdict::on("filter_offset");
    let almost_1 = 1.0 - f32::EPSILON / 2.0;
    for (name, kind, radius) in FILTERS {
        let got = offsets(kind, radius, &[[0.0, almost_1], [0.5, 0.5]]);
        // A Gaussian truncated late has almost no weight beyond a few deviations.
        let reach = if kind == FILTER_GAUSSIAN {
            0.9 * radius.min(2.4)
        } else {
            0.9 * radius
        };
        let [low, high] = got[0];
        verdict.that(
            name,
            (-radius..=-reach).contains(&low) & (reach..=radius).contains(&high),
            || format!("{:?}", got[0]),
        );
        verdict.near(
            format!("{name}: the middle"),
            &got[1],
            &[0.0, 0.0],
            Tolerance::Absolute(1e-5),
        );
    }
    verdict.close();
}

#[test]
fn the_error_function_and_its_inverse_cancel() {
    let mut random = Random::new(5);
    let inputs: Vec<[f32; 2]> = (0..4000)
        .map(|_| {
            [
                random.between(0.0, 0.9999) as f32,
                random.between(0.0, 0.9999) as f32,
            ]
        })
        .collect();
    let inverse: Vec<[f32; 2]> = gpu().map("lib::filter::inverse_erf", &inputs);
    let flat: Vec<f32> = inverse.iter().flatten().copied().collect();
    let back: Vec<f32> = gpu().map("lib::filter::erf", &flat);
    let mut verdict = Verdict::on("erf");
    for (y, got) in inputs.iter().flatten().zip(&back) {
        verdict.near(y, got, &f64::from(*y), Tolerance::Absolute(1e-6));
    }
    // Abramowitz and Stegun, table 7.1.
    for (x, erf) in [
        (0f32, 0.0),
        (0.5, 0.520_499_878),
        (1.0, 0.842_700_793),
        (2.0, 0.995_322_265),
    ] {
        let got: Vec<f32> = gpu().map("lib::filter::erf", &[x]);
        verdict.near(
            format!("erf({x})"),
            &got[0],
            &erf,
            Tolerance::Absolute(5e-7),
        );
    }
    verdict.close();
}

#[test]
fn a_pixels_colour_is_its_weighted_mean() {
    #[rustfmt::skip]
    gpu().check("lib::filter::weighted_mean", Tolerance::Ulps(1.0), &[
        ("four samples", [2f32, 4.0, 6.0, 4.0], [0.5, 1.0, 1.5]),
        ("one negative sample alone is right all the same", [-0.5, -0.25, -0.125, -1.0], [0.5, 0.25, 0.125]),
        ("no samples: black", [0.0, 0.0, 0.0, 0.0], [0.0, 0.0, 0.0]),
        ("weights that cancel say nothing: black", [0.5, -0.25, 9.0, 0.0], [0.0, 0.0, 0.0]),
        ("beside something bright: no light is less than none", [-3.0, 4.0, 8.0, 4.0], [0.0, 1.0, 2.0]),
    ]);
}
