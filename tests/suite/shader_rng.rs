//! `lib/rng.wesl`: reproducible on every device, and of good quality.

use crate::support::{
    harness::gpu,
    random::Random,
    verdict::{Tolerance, Verdict},
};
use std::collections::HashSet;

/// The inverse of `lowbias32` as its author publishes it (hash-prospector, `lowbias32_r`): steps
/// and constants other than the shader's.
fn unhash(mut x: u32) -> u32 {
    x ^= x >> 16;
    x = x.wrapping_mul(0x4302_1123);
    x ^= (x >> 15) ^ (x >> 30);
    x = x.wrapping_mul(0x1d69_e2a5);
    x ^ (x >> 16)
}

/// The second value of a pair, from the first and their combined hash.
fn uncombine(a: u32, combined: u32) -> u32 {
    let sum = unhash(combined) ^ a;
    unhash(
        sum.wrapping_sub(0x9e37_79b9)
            .wrapping_sub(a << 6)
            .wrapping_sub(a >> 2),
    )
}

/// Corner cases, then random values.
fn words(count: usize) -> Vec<u32> {
    let mut random = Random::new(2);
    let corners = [
        0,
        1,
        2,
        0x7fff_ffff,
        0x8000_0000,
        0x8000_0001,
        u32::MAX - 1,
        u32::MAX,
    ];
    (0..count)
        .map(|i| corners.get(i).copied().unwrap_or_else(|| random.word()))
        .collect()
}

/// Computed with big integers in another language; stratified pictures depend on them.
#[test]
fn hashes_have_known_answers() {
    #[rustfmt::skip]
    gpu().check("lib::rng::hash", Tolerance::Exact, &[
        ("nothing stays nothing", 0u32, 0u32),
        ("one", 1, 0x6889_90c0),
        ("a word with many bits", 0xdead_beef, 0xe628_c683),
        ("all bits", u32::MAX, 0x6768_824a),
    ]);
    #[rustfmt::skip]
    gpu().check("lib::rng::hash_combine", Tolerance::Exact, &[
        ("two nothings", (0u32, 0u32), 0x01fc_e552),
        ("zero, one", (0, 1), 0xb21c_8e52),
        ("one, zero", (1, 0), 0x858a_b550),
        ("all bits twice", (u32::MAX, u32::MAX), 0x0128_a286),
    ]);
    #[rustfmt::skip]
    gpu().check("lib::rng::pixel_key", Tolerance::Exact, &[
        ("the first pixel", (0u32, [0u32, 0]), 0x9b5d_1af6),
        ("its right neighbour", (0, [1, 0]), 0x4b6e_000b),
        ("its lower neighbour", (0, [0, 1]), 0xa097_07ee),
        ("the last of 640x480 with another seed", (12_345, [639, 479]), 0x30c4_e7f4),
    ]);
}

#[test]
fn hash_is_undone_by_its_published_inverse() {
    let inputs = words(100_000);
    let hashes: Vec<u32> = gpu().map("lib::rng::hash", &inputs);
    let mut verdict = Verdict::on("hash");
    for (x, h) in inputs.iter().zip(&hashes) {
        verdict.near(
            format!("unhash(hash({x:#x}))"),
            &unhash(*h),
            x,
            Tolerance::Exact,
        );
    }
    verdict.close();
}

#[test]
fn hash_flips_half_of_the_bits_when_one_input_bit_flips() {
    let inputs: Vec<u32> = words(4000)
        .iter()
        .flat_map(|x| (0..32).flat_map(|bit| [*x, *x ^ (1 << bit)]))
        .collect();
    let hashes: Vec<u32> = gpu().map("lib::rng::hash", &inputs);
    let mut verdict = Verdict::on("hash");
    for bit in 0..32 {
        let pairs = hashes.chunks_exact(2).skip(bit).step_by(32);
        let flipped: u32 = pairs.map(|pair| (pair[0] ^ pair[1]).count_ones()).sum();
        // 4000 · 32 fair coins deviate from the half by 0.0014 (one sigma); five of them, and the
        // bias of the hash, which is below that.
        let fraction = f64::from(flipped) / (4000.0 * 32.0);
        verdict.that(
            format!("input bit {bit}"),
            (fraction - 0.5).abs() < 0.01,
            || fraction,
        );
    }
    verdict.close();
}

#[test]
fn hash_combine_is_undone_by_its_inverse_and_depends_on_order() {
    let numbers = words(20_001);
    let inputs: Vec<_> = numbers.windows(2).map(|pair| (pair[0], pair[1])).collect();
    let swapped: Vec<_> = inputs.iter().map(|&(a, b)| (b, a)).collect();
    let hashes: Vec<u32> = gpu().map("lib::rng::hash_combine", &inputs);
    let others: Vec<u32> = gpu().map("lib::rng::hash_combine", &swapped);
    let mut verdict = Verdict::on("hash_combine");
    for ((&(a, b), &hash), other) in inputs.iter().zip(&hashes).zip(&others) {
        verdict.near(
            format!("{a:#x} with {b:#x}"),
            &uncombine(a, hash),
            &b,
            Tolerance::Exact,
        );
        verdict.that(format!("{a:#x} and {b:#x} swapped"), hash != *other, || {
            hash
        });
    }
    verdict.close();
}

#[test]
fn pixel_keys_do_not_repeat() {
    let seeds = [0, 1, 12_345, u32::MAX];
    let inputs: Vec<(u32, [u32; 2])> = seeds
        .into_iter()
        .flat_map(|seed| (0..16_384).map(move |i| (seed, [i % 128, i / 128])))
        .collect();
    let keys: Vec<u32> = gpu().map("lib::rng::pixel_key", &inputs);
    let distinct: HashSet<_> = keys.iter().collect();
    // Among 65,536 random words, a pair of equal ones occurs by chance in one of two trials.
    let repeated = keys.len() - distinct.len();
    assert!(repeated <= 4, "{repeated} keys repeat");
}

#[test]
fn unit_float_is_the_upper_24_bits_and_below_one() {
    let inputs = words(50_000);
    let floats: Vec<f32> = gpu().map("lib::rng::unit_float", &inputs);
    let mut verdict = Verdict::on("unit_float");
    for (&x, float) in inputs.iter().zip(&floats) {
        let expected = f64::from(x / 256) / 16_777_216.0;
        verdict.near(format!("{x:#x}"), float, &expected, Tolerance::Exact);
        verdict.that(
            format!("{x:#x} is in [0, 1)"),
            (0.0..1.0).contains(float),
            || float,
        );
    }
    verdict.close();
}
