//! `lib/numeric.wesl`: the guards hold for extreme values.

use crate::support::{
    harness::gpu,
    random::Random,
    verdict::{Tolerance, Verdict},
};
use glam::DVec3;

#[test]
fn vectors_of_any_length_get_length_one_or_the_fallback() {
    let fallback = [0f32, 0.0, -1.0];
    let no_direction = [0.0, 0.0, -1.0];
    let third = 1.0 / 3f64.sqrt();
    #[rustfmt::skip]
    gpu().check("lib::numeric::normalize_or", Tolerance::Absolute(3e-7), &[
        ("an axis", ([5f32, 0.0, 0.0], fallback), [1.0, 0.0, 0.0]),
        ("a negative axis", ([0.0, -0.1, 0.0], fallback), [0.0, -1.0, 0.0]),
        ("3-4-5", ([3.0, 0.0, 4.0], fallback), [0.6, 0.0, 0.8]),
        ("the diagonal", ([2.0, 2.0, 2.0], fallback), [third; 3]),
        ("its square would be infinite", ([3e30, -4e30, 0.0], fallback), [0.6, -0.8, 0.0]),
        ("the largest numbers", ([3e38, 3e38, 3e38], fallback), [third; 3]),
        ("its square would vanish", ([3e-28, 0.0, 4e-28], fallback), [0.6, 0.0, 0.8]),
        ("one component dwarfs the others", ([1e30, 1.0, 1e-30], fallback), [1.0, 0.0, 0.0]),
        ("nothing has no direction", ([0.0; 3], fallback), no_direction),
        ("neither has negative nothing", ([-0.0; 3], fallback), no_direction),
        ("too short", ([1e-31, 1e-31, 0.0], fallback), no_direction),
        ("a subnormal", ([1e-40, 0.0, 0.0], fallback), no_direction),
        ("the fallback is taken as it is", ([0.0; 3], [0.25, 0.5, 7.0]), [0.25, 0.5, 7.0]),
    ]);
}

#[test]
fn random_vectors_get_length_one() {
    let mut random = Random::new(18);
    let inputs: Vec<_> = (0..10_000)
        .map(|_| {
            let v = random.direction() * 10f64.powf(random.between(-29.0, 38.0));
            (v.as_vec3().to_array(), [0f32; 3])
        })
        .collect();
    let units: Vec<[f32; 3]> = gpu().map("lib::numeric::normalize_or", &inputs);
    let mut verdict = Verdict::on("normalize_or");
    for ((v, _), unit) in inputs.iter().zip(&units) {
        let expected = DVec3::from(v.map(f64::from)).normalize();
        verdict.near(
            format!("{v:?}"),
            unit,
            &expected.to_array(),
            Tolerance::Absolute(3e-7),
        );
    }
    verdict.close();
}

#[test]
fn reciprocals_are_finite_for_zero() {
    let most = 1.0 / f64::from(1e-18f32);
    #[rustfmt::skip]
    gpu().check("lib::numeric::safe_reciprocal", Tolerance::Relative(4e-7), &[
        ("ordinary numbers", [2f32, -4.0, 0.1], [0.5, -0.25, 1.0 / f64::from(0.1f32)]),
        ("zero, either sign, goes far to the right", [0.0, -0.0, 1.0], [most, most, 1.0]),
        ("tiny numbers keep their sign", [1e-30, -1e-30, -1.0], [most, -most, -1.0]),
        ("subnormals", [1e-40, 1e-45, 0.5], [most, most, 2.0]),
        ("just above the limit", [2e-18, -2e-18, 1.0], [1.0 / f64::from(2e-18f32), -1.0 / f64::from(2e-18f32), 1.0]),
        ("huge numbers", [1e18, -1e18, 3.0], [1.0 / f64::from(1e18f32), -1.0 / f64::from(1e18f32), 1.0 / 3.0]),
    ]);
}

#[test]
fn infinities_and_nans_are_found_by_their_bits() {
    let bits = f32::from_bits;
    let finite = [
        1.0,
        0.0,
        -0.0,
        f32::MAX,
        f32::MIN,
        f32::MIN_POSITIVE,
        1e-45,
        bits(0x7f7f_ffff),
        bits(0x807f_ffff),
    ];
    let not = [
        f32::INFINITY,
        f32::NEG_INFINITY,
        f32::NAN,
        -f32::NAN,
        bits(0x7f80_0001),
        bits(0xffff_ffff),
        bits(0x7fa0_0000),
    ];
    let mut rows = Vec::new();
    for (values, expected) in [(&finite[..], true), (&not[..], false)] {
        for &value in values {
            for axis in 0..3 {
                let mut v = [1.0, -2.0, 3.0];
                v[axis] = value;
                rows.push((
                    format!("{:#010x} in component {axis}", value.to_bits()),
                    v,
                    expected,
                ));
            }
        }
    }
    let rows: Vec<_> = rows
        .iter()
        .map(|(name, v, expected)| (name.as_str(), *v, *expected))
        .collect();
    gpu().check("lib::numeric::is_finite", Tolerance::Exact, &rows);
}

#[test]
fn magnitudes_are_compared_with_a_limit_by_their_bits() {
    let limit = 8f32.to_bits();
    let above = f32::from_bits(limit + 1);
    #[rustfmt::skip]
    gpu().check("lib::numeric::is_within", Tolerance::Exact, &[
        ("small", ([0.0, -1.0, 7.5f32], limit), true),
        ("the limit, of either sign", ([8.0, -8.0, 8.0], limit), true),
        ("just above", ([0.0, above, 0.0], limit), false),
        ("just above, negative", ([0.0, 0.0, -above], limit), false),
        ("infinite", ([f32::INFINITY, 0.0, 0.0], limit), false),
        ("not a number", ([0.0, 0.0, f32::NAN], limit), false),
    ]);
}

#[test]
fn the_largest_component_counts_with_its_sign() {
    #[rustfmt::skip]
    gpu().check("lib::numeric::max_component", Tolerance::Absolute(0.0), &[
        ("the first", [3f32, 1.0, 2.0], 3.0),
        ("the second", [-3.0, 1.0, 0.5], 1.0),
        ("the last", [-3.0, -2.0, -0.25], -0.25),
        ("all the same", [7.0; 3], 7.0),
    ]);
}
