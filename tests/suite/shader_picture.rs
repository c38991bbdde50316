//! `lib/picture.wesl`: texel lookup.

use crate::support::{
    harness::gpu,
    random::Random,
    types::Neighbours,
    verdict::{Tolerance, Verdict},
};
use std::f64::consts::{FRAC_1_SQRT_2, PI, TAU};

/// Name, arguments, and the neighbours with the weight of the second one.
type Row<I> = (&'static str, I, (u32, u32, f32));

#[test]
fn the_colour_of_a_texel_is_in_its_middle() {
    let rows: [Row<(f32, u32, bool)>; 13] = [
        ("the first texel", (0.125, 4, false), (0, 1, 0.0)),
        ("half way to the next", (0.25, 4, false), (0, 1, 0.5)),
        ("the last", (0.875, 4, false), (3, 0, 0.0)),
        ("the seam from the left", (0.9375, 4, false), (3, 0, 0.25)),
        ("on the seam", (0.0, 4, false), (3, 0, 0.5)),
        ("the seam from the right", (0.0625, 4, false), (3, 0, 0.75)),
        ("repeated", (7.25, 4, false), (0, 1, 0.5)),
        ("repeated downwards", (-0.125, 4, false), (3, 0, 0.0)),
        ("one texel", (0.3, 1, false), (0, 0, 0.8)),
        ("nearest: the first", (0.0, 4, true), (0, 1, 0.0)),
        ("nearest: up to its end", (0.24, 4, true), (0, 1, 0.0)),
        ("nearest: the next", (0.26, 4, true), (1, 2, 0.0)),
        ("nearest: the last", (-0.01, 4, true), (3, 0, 0.0)),
    ];
    let inputs: Vec<_> = rows.iter().map(|row| row.1).collect();
    let found: Vec<Neighbours> = gpu().map("lib::picture::repeated", &inputs);
    let mut verdict = Verdict::on("repeated");
    for ((name, _, (first, second, weight)), got) in rows.iter().zip(found) {
        let holds =
            (got.first, got.second) == (*first, *second) && (got.weight - weight).abs() < 1e-6;
        verdict.that(name, holds, || format!("{got:?}"));
    }
    verdict.close();
}

#[test]
fn neighbouring_texels_are_inside_the_picture_for_any_position() {
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
            inputs.extend([(at, count, false), (at, count, true)]);
        }
        for _ in 0..2000 {
            let at = random.between(-3.0, 3.0) as f32;
            inputs.extend([(at, count, false), (at, count, true)]);
        }
    }
    let found: Vec<Neighbours> = gpu().map("lib::picture::repeated", &inputs);
    let mut verdict = Verdict::on("repeated");
    for ((at, count, nearest), got) in inputs.iter().zip(found) {
        let follows = (got.first + 1) % count == got.second;
        let holds = got.first < *count && follows && (0.0..=1.0).contains(&got.weight);
        verdict.that(format!("{at} of {count}, {nearest}"), holds, || {
            format!("{got:?}")
        });
        // The same position in exact arithmetic, up to the rounding of the fraction.
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
fn rows_end_at_the_poles() {
    let rows: [Row<(f32, u32)>; 5] = [
        ("the lower edge", (0.0, 4), (0, 1, 0.0)),
        ("the middle of the lowest row", (0.125, 4), (0, 1, 0.0)),
        ("half way up", (0.5, 4), (1, 2, 0.5)),
        ("the upper edge", (1.0, 4), (3, 3, 0.0)),
        ("one row", (0.7, 1), (0, 0, 0.0)),
    ];
    let inputs: Vec<_> = rows.iter().map(|row| row.1).collect();
    let found: Vec<Neighbours> = gpu().map("lib::picture::ended", &inputs);
    let mut verdict = Verdict::on("ended");
    for ((name, _, (first, second, weight)), got) in rows.iter().zip(found) {
        let holds = (got.first, got.second, got.weight) == (*first, *second, *weight);
        verdict.that(name, holds, || format!("{got:?}"));
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
