//! `lib/sampling.wesl`: the Sobol sequence and the properties that Owen scrambling must preserve.

use crate::support::{
    harness::gpu,
    random::Random,
    verdict::{Tolerance, Verdict},
};

/// The first points of the two-dimensional sequence, in eighths and sixteenths (Joe and Kuo 2008,
/// dimensions 1 and 2, in counting order).
const FIRST_POINTS: [[f64; 2]; 16] = [
    [0.0, 0.0],
    [0.5, 0.5],
    [0.25, 0.75],
    [0.75, 0.25],
    [0.125, 0.625],
    [0.625, 0.125],
    [0.375, 0.375],
    [0.875, 0.875],
    [0.0625, 0.9375],
    [0.5625, 0.4375],
    [0.3125, 0.1875],
    [0.8125, 0.6875],
    [0.1875, 0.3125],
    [0.6875, 0.8125],
    [0.4375, 0.5625],
    [0.9375, 0.0625],
];

#[test]
fn sobol_begins_with_the_published_points() {
    let indices: Vec<u32> = (0..16).collect();
    let points: Vec<[u32; 2]> = gpu().map("lib::sampling::sobol", &indices);
    let mut verdict = Verdict::on("sobol");
    for (i, (point, expected)) in points.iter().zip(FIRST_POINTS).enumerate() {
        let expected = expected.map(|x| (x * 4_294_967_296.0) as u32);
        verdict.near(format!("point {i}"), point, &expected, Tolerance::Exact);
    }
    verdict.close();
}

/// The first points in dimensions 3 and 4.
const FIRST_POINTS_34: [[f64; 2]; 16] = [
    [0.0, 0.0],
    [0.5, 0.5],
    [0.75, 0.75],
    [0.25, 0.25],
    [0.375, 0.125],
    [0.875, 0.625],
    [0.625, 0.875],
    [0.125, 0.375],
    [0.5625, 0.3125],
    [0.0625, 0.8125],
    [0.3125, 0.5625],
    [0.8125, 0.0625],
    [0.9375, 0.4375],
    [0.4375, 0.9375],
    [0.1875, 0.6875],
    [0.6875, 0.1875],
];

#[test]
fn the_third_and_fourth_dimension_begin_with_the_published_points() {
    let indices: Vec<u32> = (0..16).collect();
    let points: Vec<[u32; 2]> = gpu().map("lib::sampling::sobol_34", &indices);
    let mut verdict = Verdict::on("sobol_34");
    for (i, (point, expected)) in points.iter().zip(FIRST_POINTS_34).enumerate() {
        let expected = expected.map(|x| (x * 4_294_967_296.0) as u32);
        verdict.near(format!("point {i}"), point, &expected, Tolerance::Exact);
    }
    verdict.close();
}

/// The columns of the generator matrices by the direction numbers of Joe and Kuo (2008), file new-joe-kuo-6.21201:
/// d = 3: s = 2, a = 1, m = 1, 3; d = 4: s = 3, a = 1, m = 1, 3, 1.
#[test]
fn the_third_and_fourth_dimension_follow_the_direction_numbers() {
    let mut third = vec![1u64, 3];
    let mut fourth = vec![1u64, 3, 1];
    for k in 2..32 {
        third.push(third[k - 1] << 1 ^ third[k - 2] << 2 ^ third[k - 2]);
    }
    for k in 3..32 {
        fourth.push(fourth[k - 2] << 2 ^ fourth[k - 3] << 3 ^ fourth[k - 3]);
    }
    let expected = |index: u32, numbers: &[u64]| {
        let columns = numbers.iter().enumerate();
        let chosen = columns.filter(|(bit, _)| index >> bit & 1 != 0);
        chosen.fold(0, |sum, (bit, number)| sum ^ (number << (31 - bit)) as u32)
    };
    let mut random = Random::new(34);
    let single = (0..32).map(|bit| 1 << bit);
    let indices: Vec<u32> = single.chain((0..1000).map(|_| random.word())).collect();
    let points: Vec<[u32; 2]> = gpu().map("lib::sampling::sobol_34", &indices);
    let mut verdict = Verdict::on("sobol_34");
    for (&index, point) in indices.iter().zip(&points) {
        let expected = [&third, &fourth].map(|numbers| expected(index, numbers));
        verdict.near(
            format!("point {index:#x}"),
            point,
            &expected,
            Tolerance::Exact,
        );
    }
    verdict.close();
}

/// Sobol's property A for both pairs of dimensions together: each of the 16 sub-cubes that halve the
/// four-dimensional cube along each axis contains one of 16 points.
#[test]
fn sixteen_samples_are_in_sixteen_parts_of_the_four_dimensional_cube() {
    let mut random = Random::new(9);
    let mut verdict = Verdict::on("stratified_34");
    for key in (0..64).map(|_| random.word()) {
        let inputs: Vec<_> = (0..1024u32).map(|index| (index, key)).collect();
        let xy: Vec<[f32; 2]> = gpu().map("lib::sampling::stratified_2d", &inputs);
        let zw: Vec<[f32; 2]> = gpu().map("lib::sampling::stratified_34", &inputs);
        for (block, (xy, zw)) in xy.chunks(16).zip(zw.chunks(16)).enumerate() {
            let mut found = [0; 16];
            for ([x, y], [z, w]) in xy.iter().zip(zw) {
                let half = |c: &f32| usize::from(*c >= 0.5);
                found[half(x) * 8 + half(y) * 4 + half(z) * 2 + half(w)] += 1;
            }
            verdict.that(
                format!("key {key:#x}, block {block}"),
                found == [1; 16],
                || format!("{found:?}"),
            );
        }
        for axis in 0..2 {
            let mut strata = [0; 1024];
            for point in &zw {
                strata[(point[axis] * 1024.0) as usize] += 1;
            }
            verdict.that(
                format!("key {key:#x}, axis {axis}"),
                strata == [1; 1024],
                || "uneven",
            );
        }
    }
    verdict.close();
}

/// The number of elementary intervals (boxes of 2^-a by 2^-b, a + b = k) that do not contain exactly one of 2^k
/// points.
fn crowded_or_empty(points: &[[f64; 2]]) -> usize {
    let k = points.len().ilog2();
    assert_eq!(points.len(), 1 << k, "a power of two");
    let mut wrong = 0;
    for a in 0..=k {
        let mut counts = vec![0; points.len()];
        for [x, y] in points {
            let column = (x * f64::from(1 << a)) as usize;
            let row = (y * f64::from(1 << (k - a))) as usize;
            counts[(column << (k - a)) + row] += 1;
        }
        wrong += counts.iter().filter(|count| **count != 1).count();
    }
    wrong
}

#[test]
fn aligned_blocks_of_sobol_points_fill_every_elementary_interval_once() {
    let indices: Vec<u32> = (0..8192).collect();
    let points: Vec<[u32; 2]> = gpu().map("lib::sampling::sobol", &indices);
    let points: Vec<_> = points
        .iter()
        .map(|point| point.map(|x| f64::from(x) / 4_294_967_296.0))
        .collect();
    let mut verdict = Verdict::on("sobol");
    for k in 0..=13 {
        for (block, points) in points.chunks_exact(1 << k).enumerate() {
            let wrong = crowded_or_empty(points);
            verdict.that(format!("block {block} of 2^{k} points"), wrong == 0, || {
                format!("{wrong} intervals")
            });
        }
    }
    verdict.close();
}

#[test]
fn every_power_of_two_of_a_pixels_samples_is_stratified() {
    let mut random = Random::new(3);
    let keys: Vec<u32> = [0, 1, u32::MAX]
        .into_iter()
        .chain((0..29).map(|_| random.word()))
        .collect();
    let inputs: Vec<_> = keys
        .iter()
        .flat_map(|&key| (0..1024u32).map(move |index| (index, key)))
        .collect();
    let samples: Vec<[f32; 2]> = gpu().map("lib::sampling::stratified_2d", &inputs);
    let mut verdict = Verdict::on("stratified_2d");
    for (key, samples) in keys.iter().zip(samples.chunks_exact(1024)) {
        let inside = samples.iter().flatten().all(|x| (0.0..1.0).contains(x));
        verdict.that(
            format!("samples of key {key:#x} lie in [0, 1)"),
            inside,
            || "outside",
        );
        let samples: Vec<_> = samples.iter().map(|sample| sample.map(f64::from)).collect();
        for k in 0..=10 {
            let wrong = crowded_or_empty(&samples[..1 << k]);
            let name = format!("the first 2^{k} samples of key {key:#x}");
            verdict.that(name, wrong == 0, || format!("{wrong} intervals"));
        }
    }
    verdict.close();
}

#[test]
fn samples_of_different_keys_are_unrelated() {
    // The first sample of many pixels must itself be uniform: its mean over n pixels is 1/2 with a
    // deviation of 1/√(12 n).
    let inputs: Vec<(u32, u32)> = (0..40_000).map(|key| (0, key)).collect();
    let samples: Vec<[f32; 2]> = gpu().map("lib::sampling::stratified_2d", &inputs);
    let mean = |axis: usize| {
        samples
            .iter()
            .map(|sample| f64::from(sample[axis]))
            .sum::<f64>()
            / 40_000.0
    };
    let product = samples.iter().map(|[x, y]| f64::from(x * y)).sum::<f64>() / 40_000.0;
    let mut verdict = Verdict::on("stratified_2d");
    verdict.that(
        "mean of x is 1/2 within five sigma",
        (mean(0) - 0.5).abs() < 0.0073,
        || mean(0),
    );
    verdict.that(
        "mean of y is 1/2 within five sigma",
        (mean(1) - 0.5).abs() < 0.0073,
        || mean(1),
    );
    verdict.that(
        "x and y are independent",
        (product - 0.25).abs() < 0.0056,
        || product,
    );
    verdict.close();
}

#[test]
fn owen_scrambling_keeps_common_leading_bits_and_splits_where_they_end() {
    let mut random = Random::new(4);
    let mut inputs = Vec::new();
    for _ in 0..4000 {
        let (x, seed, shared) = (random.word(), random.word(), random.below(32) as u32);
        // Differs from x in the bit after the first `shared`, and at random after it.
        let bit = 0x8000_0000 >> shared;
        let y = (x ^ bit) ^ (random.word() & (bit - 1));
        inputs.extend([(x, seed), (y, seed)]);
    }
    let outputs: Vec<u32> = gpu().map("lib::sampling::owen_scramble", &inputs);
    let mut verdict = Verdict::on("owen_scramble");
    for (before, after) in inputs.chunks_exact(2).zip(outputs.chunks_exact(2)) {
        let shared = (before[0].0 ^ before[1].0).leading_zeros();
        let kept = (after[0] ^ after[1]).leading_zeros();
        let name = format!(
            "{:#x} and {:#x} with seed {:#x}",
            before[0].0, before[1].0, before[0].1
        );
        verdict.near(name, &kept, &shared, Tolerance::Exact);
    }
    verdict.close();
}

/// Bit k of a place on the curve is bit k/2 of a coordinate.
#[test]
fn the_z_order_has_the_bits_of_both_coordinates_by_turns() {
    let mut random = Random::new(3);
    let mut pixels: Vec<[u32; 2]> = (0..200)
        .map(|_| [(); 2].map(|()| random.word() >> 19))
        .collect();
    pixels.extend([[0, 0], [1, 0], [0, 1], [3, 5], [8191, 8191], [65535, 0]]);
    let places: Vec<u32> = gpu().map("lib::sampling::z_order", &pixels);
    let mut verdict = Verdict::on("z_order");
    for (pixel, place) in pixels.iter().zip(places) {
        let bit = |k: u32| (pixel[k as usize % 2] >> (k / 2) & 1) << k;
        let expected: u32 = (0..32).map(bit).sum();
        verdict.that(format!("{pixel:?}"), place == expected, || {
            format!("{place}, expected {expected}")
        });
    }
    verdict.close();
}
