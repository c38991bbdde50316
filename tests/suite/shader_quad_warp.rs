//! `lib/quad_warp.wesl`: samples in proportion to a table; and the directions of a table of the sphere.

use crate::support::{
    harness::gpu,
    random::Random,
    statistics::{cells, check_counts, check_even, square_points},
    verdict::Verdict,
};
use std::f64::consts::{PI, TAU};

const STEP: &str = "import package::lib::quad_warp::{QuadPlace, quad_step};
    fn probe(word: u32, u: vec2f) -> vec4f {
        let found = quad_step(word, QuadPlace(vec2u(3u, 5u), u));
        return vec4f(vec2f(found.cell), found.u);
    }";

fn word(rows: u32, lower: u32, upper: u32) -> u32 {
    rows | lower << 10 | upper << 20
}

#[test]
fn quarters_have_their_chances_and_points_in_them_stay_even() {
    let mut verdict = Verdict::on("quad_step");
    let points = square_points(16_384, 7);
    for (rows, lower, upper) in [(300, 700, 90), (512, 511, 511), (40, 1000, 500)] {
        let inputs: Vec<_> = points
            .iter()
            .map(|u| (word(rows, lower, upper), *u))
            .collect();
        let found: Vec<[f32; 4]> = gpu().map_source(STEP, &inputs);
        let part = |steps: u32| f64::from(steps) / 1023.0;
        let (row, left) = (part(rows), [part(lower), part(upper)]);
        let expected = [
            row * left[0],
            row * (1.0 - left[0]),
            (1.0 - row) * left[1],
            (1.0 - row) * (1.0 - left[1]),
        ]
        .map(|chance| chance * points.len() as f64);
        let mut counts = [0; 4];
        let mut inside = vec![Vec::new(); 4];
        for [x, y, u, v] in found {
            // The children of cell (3, 5) are (6, 10) to (7, 11).
            let quarter = (x - 6.0 + 2.0 * (y - 10.0)) as usize;
            counts[quarter] += 1;
            inside[quarter].push([f64::from(u), f64::from(v)]);
        }
        check_counts(
            &mut verdict,
            format!("{rows} {lower} {upper}"),
            &counts,
            &expected,
        );
        for (quarter, points) in inside.into_iter().enumerate() {
            let side = if points.len() > 500 { 8 } else { 2 };
            let name = format!("quarter {quarter} of {rows} {lower} {upper}");
            check_even(&mut verdict, name, &cells(points, side));
        }
    }
    verdict.close();
}

#[test]
fn quarters_without_a_chance_are_never_chosen() {
    let mut verdict = Verdict::on("quad_step");
    let edge = 0.999_999_94_f32;
    let corners = [
        [0.0, 0.0],
        [edge, 0.0],
        [0.0, edge],
        [edge, edge],
        [0.5, 0.5],
    ];
    for (rows, lower, upper, only) in [
        (1023, 1023, 500, [6.0, 10.0]),
        (1023, 0, 500, [7.0, 10.0]),
        (0, 500, 1023, [6.0, 11.0]),
        (0, 500, 0, [7.0, 11.0]),
    ] {
        let inputs = corners.map(|u| (word(rows, lower, upper), u));
        let found: Vec<[f32; 4]> = gpu().map_source(STEP, &inputs);
        for ([x, y, u, v], input) in found.into_iter().zip(inputs) {
            let is_good = [x, y] == only && (0.0..1.0).contains(&u) && (0.0..1.0).contains(&v);
            verdict.that(format!("{input:?}"), is_good, || format!("{x} {y} {u} {v}"));
        }
    }
    verdict.close();
}

#[test]
fn the_root_splits_by_columns_alone() {
    let source = "import package::lib::quad_warp::quad_root;
        fn probe(word: u32, u: vec2f) -> vec4f {
            let found = quad_root(word, u);
            return vec4f(vec2f(found.cell), found.u);
        }";
    let inputs = [[0.1f32, 0.9], [0.24, 0.2], [0.26, 0.7], [0.8, 0.1]].map(|u| (256u32, u));
    let found: Vec<[f32; 4]> = gpu().map_source(source, &inputs);
    let chance = 256.0 / 1023.0;
    for ((_, [u, v]), found) in inputs.into_iter().zip(found) {
        let u = f64::from(u);
        let expected = match u < chance {
            true => [0.0, 0.0, u / chance, f64::from(v)],
            false => [1.0, 0.0, (u - chance) / (1.0 - chance), f64::from(v)],
        };
        for (got, expected) in found.into_iter().zip(expected) {
            assert!((f64::from(got) - expected).abs() < 1e-6, "{found:?}, {u}");
        }
    }
}

#[test]
fn u_and_v_of_a_direction_lead_back_to_it() {
    let mut random = Random::new(9);
    let inputs: Vec<_> = (0..2_000)
        .map(|_| {
            let u = [
                random.between(0.0, 1.0) as f32,
                random.between(0.0, 1.0) as f32,
            ];
            (u, random.between(-3.0, 3.0) as f32)
        })
        .collect();
    let found: Vec<[f32; 3]> = gpu().map("lib::picture::equirectangular_direction", &inputs);
    let mut verdict = Verdict::on("equirectangular_direction");
    for (([u, v], rotation), got) in inputs.into_iter().zip(found) {
        let around = TAU * (f64::from(u) - 0.5) - f64::from(rotation);
        let up = PI * (f64::from(v) - 0.5);
        let expected = [up.cos() * around.sin(), up.sin(), -up.cos() * around.cos()];
        let pairs = got.into_iter().zip(expected);
        let off = pairs.fold(0.0, |most: f64, (a, b)| most.max((f64::from(a) - b).abs()));
        verdict.that(format!("{u} {v} {rotation}"), off < 2e-5, || {
            format!("{got:?}, expected {expected:?}")
        });
    }
    verdict.close();
}
