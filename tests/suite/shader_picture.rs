//! `lib/picture.wesl`: texel lookup.

use crate::support::{
    harness::gpu,
    random::Random,
    types::Neighbours,
    verdict::{Tolerance, Verdict},
};
use glimray::layout;
use half::f16;
use std::f64::consts::{FRAC_1_SQRT_2, PI, TAU};

/// Name, arguments, and the neighbours with the weight of the second one.
type Row<I> = (&'static str, I, (u32, u32, f32));

#[test]
fn the_colour_of_a_texel_is_in_its_middle() {
    const R: u32 = layout::WRAP_REPEAT;
    const C: u32 = layout::WRAP_CLAMP;
    const M: u32 = layout::WRAP_MIRROR;
    let rows: [Row<(f32, u32, bool, u32)>; 28] = [
        ("the first texel", (0.125, 4, false, R), (0, 1, 0.0)),
        ("half way to the next", (0.25, 4, false, R), (0, 1, 0.5)),
        ("the last", (0.875, 4, false, R), (3, 0, 0.0)),
        (
            "the seam from the left",
            (0.9375, 4, false, R),
            (3, 0, 0.25),
        ),
        ("on the seam", (0.0, 4, false, R), (3, 0, 0.5)),
        (
            "the seam from the right",
            (0.0625, 4, false, R),
            (3, 0, 0.75),
        ),
        ("repeated", (7.25, 4, false, R), (0, 1, 0.5)),
        ("repeated downwards", (-0.125, 4, false, R), (3, 0, 0.0)),
        ("one texel", (0.3, 1, false, R), (0, 0, 0.8)),
        ("nearest: the first", (0.0, 4, true, R), (0, 1, 0.0)),
        ("nearest: up to its end", (0.24, 4, true, R), (0, 1, 0.0)),
        ("nearest: the next", (0.26, 4, true, R), (1, 2, 0.0)),
        ("nearest: the last", (-0.01, 4, true, R), (3, 0, 0.0)),
        ("clamped: the lower edge", (0.0, 4, false, C), (0, 0, 0.5)),
        (
            "clamped: the middle of the first",
            (0.125, 4, false, C),
            (0, 1, 0.0),
        ),
        ("clamped: half way up", (0.5, 4, false, C), (1, 2, 0.5)),
        ("clamped: the upper edge", (1.0, 4, false, C), (3, 3, 0.5)),
        ("clamped: far below", (-7.3, 4, false, C), (0, 0, 0.5)),
        ("clamped: far above", (9.0, 4, false, C), (3, 3, 0.5)),
        ("clamped: one texel", (0.75, 1, false, C), (0, 0, 0.25)),
        ("clamped: nearest above", (9.0, 4, true, C), (3, 3, 0.0)),
        (
            "mirrored: the first texel",
            (0.125, 4, false, M),
            (0, 1, 0.0),
        ),
        ("mirrored: the seam", (0.0, 4, false, M), (0, 0, 0.5)),
        (
            "mirrored: below the seam",
            (-0.125, 4, false, M),
            (0, 1, 0.0),
        ),
        (
            "mirrored: the next one backwards",
            (1.25, 4, false, M),
            (2, 3, 0.5),
        ),
        (
            "mirrored: the third forwards",
            (2.25, 4, false, M),
            (0, 1, 0.5),
        ),
        ("mirrored: its end", (1.0, 4, false, M), (3, 3, 0.5)),
        (
            "mirrored: nearest backwards",
            (1.26, 4, true, M),
            (2, 3, 0.0),
        ),
    ];
    let inputs: Vec<_> = rows.iter().map(|row| row.1).collect();
    let found: Vec<Neighbours> = gpu().map("lib::picture::neighbours", &inputs);
    let mut verdict = Verdict::on("neighbours");
    for ((name, _, (first, second, weight)), got) in rows.iter().zip(found) {
        let holds =
            (got.first, got.second) == (*first, *second) && (got.weight - weight).abs() < 1e-6;
        verdict.that(name, holds, || format!("{got:?}"));
    }
    verdict.close();
}

#[test]
fn half_floats_are_exact() {
    // Every finite value, 0 or more.
    let codes: Vec<u32> = (0..0x7c00).map(|low| low | (0x7bff - low) << 16).collect();
    let found: Vec<[f32; 2]> = gpu().map("lib::picture::halves", &codes);
    let mut verdict = Verdict::on("halves");
    for (code, got) in codes.iter().zip(found) {
        let expected = [code & 0xffff, code >> 16].map(|bits| f16::from_bits(bits as u16).to_f32());
        verdict.that(format!("{code:#x}"), got == expected, || {
            format!("{got:?}, not {expected:?}")
        });
    }
    verdict.close();
}

#[test]
fn srgb_is_decoded_as_its_standard_says() {
    let linear = |code: f64| match code {
        c if c <= 0.04045 => c / 12.92,
        c => ((c + 0.055) / 1.055).powf(2.4),
    };
    let codes: Vec<[f32; 3]> = (0..=255)
        .map(|code| [code, 255 - code, (code * 7) % 256].map(|code| code as f32 / 255.0))
        .collect();
    let found: Vec<[f32; 3]> = gpu().map("lib::picture::linear_from_srgb", &codes);
    let mut verdict = Verdict::on("linear_from_srgb");
    for (codes, got) in codes.iter().zip(found) {
        for (code, got) in codes.iter().zip(got) {
            let off = (f64::from(got) - linear(f64::from(*code))).abs();
            verdict.that(code, off < 3e-6, || format!("{got}, off by {off}"));
        }
    }
    verdict.close();
}

#[test]
fn neighbouring_texels_are_inside_the_picture_for_any_position() {
    const R: u32 = layout::WRAP_REPEAT;
    let mut random = Random::new(3);
    let mut inputs = Vec::new();
    for count in [1, 2, 3, 7, 640, 4096] {
        for at in [
            0.0,
            -0.0,
            1.0,
            -1e-9,
            -1e-38,
            1e8,
            -1e8,
            0.999_999_94,
            1e-45,
        ] {
            inputs.extend([(at, count, false, R), (at, count, true, R)]);
        }
        for _ in 0..2000 {
            let at = random.between(-3.0, 3.0) as f32;
            inputs.extend([(at, count, false, R), (at, count, true, R)]);
        }
    }
    let found: Vec<Neighbours> = gpu().map("lib::picture::neighbours", &inputs);
    let mut verdict = Verdict::on("neighbours");
    for ((at, count, nearest, _), got) in inputs.iter().zip(found) {
        let follows = (got.first + 1) % count == got.second;
        let holds = got.first < *count && follows && (0.0..=1.0).contains(&got.weight);
        verdict.that(format!("{at} of {count}, {nearest}"), holds, || {
            format!("{got:?}")
        });
        // The position in exact arithmetic, up to the rounding of the fraction.
        let place = (f64::from(*at) - f64::from(*at).floor()) * f64::from(*count);
        let (own, place) = match nearest {
            // The centre of the texel, at most half a texel from any point in it.
            true => (f64::from(got.first) + 0.5, place),
            false => (f64::from(got.first) + f64::from(got.weight), place - 0.5),
        };
        let off = (own - place).rem_euclid(f64::from(*count));
        let off = off.min(f64::from(*count) - off);
        let most = if *nearest { 0.501 } else { 1e-3 };
        verdict.that(
            format!("{at} of {count}, {nearest}: place"),
            off < most,
            || format!("{got:?}, expected {place}"),
        );
    }
    verdict.close();
}

#[test]
fn directions_map_to_the_right_place_in_an_equirectangular_picture() {
    let quarter = PI as f32 / 2.0;
    let diagonal = FRAC_1_SQRT_2 as f32;
    #[rustfmt::skip]
    gpu().check("lib::picture::equirectangular", Tolerance::Absolute(2e-5), &[
        ("ahead is the middle", ([0f32, 0.0, -1.0], 0f32), [0.5, 0.5]),
        ("right", ([1.0, 0.0, 0.0], 0.0), [0.75, 0.5]),
        ("left", ([-1.0, 0.0, 0.0], 0.0), [0.25, 0.5]),
        ("half way up", ([0.0, diagonal, -diagonal], 0.0), [0.5, 0.75]),
        ("half way down to the right", ([0.5, -diagonal, -0.5], 0.0), [0.625, 0.25]),
        ("turned a quarter, the middle is at the left", ([-1.0, 0.0, 0.0], quarter), [0.5, 0.5]),
        ("turned half, it is behind", ([0.0, 0.0, 1.0], 2.0 * quarter), [1.5, 0.5]),
        ("turned three quarters, it is at the right", ([1.0, 0.0, 0.0], 3.0 * quarter), [1.5, 0.5]),
    ]);
    // u is arbitrary there, but must be a number.
    for (y, v) in [(1.0f32, 1.0f32), (-1.0, 0.0)] {
        let poles: Vec<[f32; 2]> = gpu().map(
            "lib::picture::equirectangular",
            &[
                ([0f32, y, 0.0], 0f32),
                ([-0.0, y, -0.0], 0.0),
                ([0.0, y, -0.0], 0.0),
            ],
        );
        for [u, pole] in poles {
            assert!(u.is_finite() && (pole - v).abs() < 1e-6, "({u}, {pole})");
        }
    }
}

#[test]
fn every_direction_is_found_to_a_fraction_of_a_texel() {
    let mut random = Random::new(4);
    let inputs: Vec<_> = (0..20_000)
        .map(|_| {
            (
                random.direction().as_vec3().to_array(),
                random.between(-3.0, 3.0) as f32,
            )
        })
        .collect();
    let found: Vec<[f32; 2]> = gpu().map("lib::picture::equirectangular", &inputs);
    let mut verdict = Verdict::on("equirectangular");
    for (([x, y, z], rotation), [u, v]) in inputs.iter().zip(found) {
        let [x, y, z] = [*x, *y, *z].map(f64::from);
        let around = 0.5 + (x.atan2(-z) + f64::from(*rotation)) / TAU;
        let up = 0.5 + y.atan2(x.hypot(z)) / PI;
        let off = (f64::from(u) - around).abs().max((f64::from(v) - up).abs());
        // A tenth of a texel of a picture of 4096.
        verdict.that(format!("({x}, {y}, {z})"), off < 2.5e-5, || {
            format!("({u}, {v}), expected ({around}, {up})")
        });
    }
    verdict.close();
}
