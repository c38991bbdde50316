//! `lib/warp.wesl`: area-preserving maps from the unit square.

use crate::support::{
    harness::gpu,
    random::Random,
    statistics::{cells, check_even, square_points},
    verdict::{Tolerance, Verdict},
};
use glam::{DVec2, DVec3};
use std::f64::consts::{FRAC_1_SQRT_2, TAU};

const COUNT: usize = 100_000;
const SIDE: usize = 16;

fn wide<const N: usize>(points: &[[f32; N]]) -> Vec<[f64; N]> {
    points.iter().map(|p| p.map(f64::from)).collect()
}

/// Angle as a fraction of a full turn.
fn turn(x: f64, y: f64) -> f64 {
    y.atan2(x).rem_euclid(TAU) / TAU
}

#[test]
fn the_disc_map_keeps_the_places_of_centre_edges_and_corners() {
    let h = FRAC_1_SQRT_2;
    #[rustfmt::skip]
    gpu().check("lib::warp::disc_from_square", Tolerance::Absolute(3e-7), &[
        ("the centre", [0.5f32, 0.5], [0.0, 0.0]),
        ("the right edge", [1.0, 0.5], [1.0, 0.0]),
        ("the left edge", [0.0, 0.5], [-1.0, 0.0]),
        ("the upper edge", [0.5, 1.0], [0.0, 1.0]),
        ("the lower edge", [0.5, 0.0], [0.0, -1.0]),
        ("a corner", [1.0, 1.0], [h, h]),
        ("the corner that numbers begin in", [0.0, 0.0], [-h, -h]),
        ("half way to the right", [0.75, 0.5], [0.5, 0.0]),
        ("half way to a corner", [0.25, 0.75], [-0.5 * h, 0.5 * h]),
    ]);
}

#[test]
fn the_disc_is_covered_evenly() {
    let points: Vec<[f32; 2]> = gpu().map("lib::warp::disc_from_square", &square_points(COUNT, 1));
    let mut verdict = Verdict::on("disc_from_square");
    let even = wide(&points)
        .into_iter()
        .map(|[x, y]| [x * x + y * y, turn(x, y)]);
    check_even(
        &mut verdict,
        "rings and sectors of equal area",
        &cells(even, SIDE),
    );
    verdict.close();
}

#[test]
fn triangles_are_covered_evenly() {
    let weights: Vec<[f32; 2]> =
        gpu().map("lib::warp::triangle_from_square", &square_points(COUNT, 2));
    let mut verdict = Verdict::on("triangle_from_square");
    // Lines through a corner and lines parallel to the side opposite cut equal areas.
    let even = wide(&weights)
        .into_iter()
        .map(|[b1, b2]| [(b1 + b2).powi(2), b2 / (b1 + b2).max(1e-9)]);
    check_even(
        &mut verdict,
        "strips and wedges of equal area",
        &cells(even, SIDE),
    );
    // Strips and wedges relative to another corner.
    let even = wide(&weights)
        .into_iter()
        .map(|[b1, b2]| [(1.0 - b1).powi(2), b2 / (1.0 - b1).max(1e-9)]);
    check_even(
        &mut verdict,
        "strips and wedges at another corner",
        &cells(even, SIDE),
    );
    verdict.close();
}

#[test]
fn polygons_are_covered_evenly_from_the_first_corner_on() {
    let mut verdict = Verdict::on("polygon_from_square");
    for (count, rotation) in [
        (3u32, 0f32),
        (4, 0.3),
        (5, -1.0),
        (6, 0.5),
        (9, 2.0),
        (64, 0.0),
    ] {
        let inputs: Vec<_> = square_points(COUNT, 3)
            .into_iter()
            .map(|u| (u, count, rotation))
            .collect();
        let points: Vec<[f32; 2]> = gpu().map("lib::warp::polygon_from_square", &inputs);
        let name = format!("{count} corners turned by {rotation}");
        let n = f64::from(count);
        // Rotated back and folded into the first triangle, in its own skewed coordinates.
        let corner = DVec2::from_angle(TAU / n);
        let even = wide(&points).into_iter().map(|[x, y]| {
            let p = DVec2::from_angle(-f64::from(rotation)).rotate(DVec2::new(x, y));
            let edge = (turn(p.x, p.y) * n).floor();
            let p = DVec2::from_angle(-edge * TAU / n).rotate(p);
            let b2 = p.y / corner.y;
            let b1 = p.x - b2 * corner.x;
            let inner = b1 + b2;
            [
                inner * inner,
                ((edge + (b2 / inner.max(1e-9)).clamp(0.0, 1.0)) / n).min(1.0),
            ]
        });
        check_even(&mut verdict, &name, &cells(even, SIDE));
        // The second moment of a regular polygon with corners at 1.
        let mean = wide(&points)
            .iter()
            .map(|[x, y]| x * x + y * y)
            .sum::<f64>()
            / COUNT as f64;
        let expected = (2.0 + (TAU / n).cos()) / 6.0;
        verdict.that(
            format!("{name}: second moment"),
            (mean - expected).abs() < 5e-3,
            || format!("{mean}, expected {expected}"),
        );
    }
    let corners = [
        ([0f32, 1f32], 6u32, 0f32),
        ([0.5, 1.0], 6, 0.0),
        ([0.25, 1.0], 4, 0.0),
    ];
    let got: Vec<[f32; 2]> = gpu().map("lib::warp::polygon_from_square", &corners);
    for (got, expected) in got.iter().zip([[1.0, 0.0], [-1.0, 0.0], [0.0, 1.0]]) {
        verdict.near("a corner", got, &expected, Tolerance::Absolute(1e-6));
    }
    verdict.close();
}

#[test]
fn cones_and_the_sphere_are_covered_evenly_in_solid_angle() {
    let mut verdict = Verdict::on("cone_from_square");
    for depth in [1e-6f32, 0.01, 0.3, 1.0, 1.7, 2.0] {
        let inputs: Vec<_> = square_points(COUNT, 4)
            .into_iter()
            .map(|u| (u, depth))
            .collect();
        let directions: Vec<[f32; 3]> = gpu().map("lib::warp::cone_from_square", &inputs);
        let wide = wide(&directions);
        let longest = wide.iter().map(|&d| (DVec3::from(d).length() - 1.0).abs());
        let off = longest.fold(0.0, f64::max);
        verdict.that(format!("cone {depth}: unit length"), off < 5e-7, || off);
        // 1 - cos from the sine, which loses no precision in a narrow cone.
        let below = |[x, y, z]: [f64; 3]| {
            let sin2 = x * x + y * y;
            if z > 0.5 {
                sin2 / (1.0 + (1.0 - sin2).max(0.0).sqrt())
            } else {
                1.0 - z
            }
        };
        let even = wide
            .iter()
            .map(|&d| [below(d) / f64::from(depth), turn(d[0], d[1])]);
        check_even(&mut verdict, format!("cone {depth}"), &cells(even, SIDE));
    }
    verdict.close();
}

#[test]
fn turning_a_direction_is_a_rotation_that_takes_z_to_the_axis() {
    let mut random = Random::new(5);
    let mut axes: Vec<DVec3> = (0..2000).map(|_| random.direction()).collect();
    axes.extend([DVec3::Z, DVec3::NEG_Z, DVec3::X, DVec3::NEG_Y]);
    axes.push(DVec3::new(1e-5, 0.0, -1.0).normalize());
    let inputs: Vec<_> = axes
        .iter()
        .flat_map(|n| {
            let n = n.as_vec3().to_array();
            [[1f32, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]].map(|d| (n, d))
        })
        .collect();
    let turned: Vec<[f32; 3]> = gpu().map("lib::warp::turn_to", &inputs);
    let mut verdict = Verdict::on("turn_to");
    for (n, turned) in axes.iter().zip(turned.chunks_exact(3)) {
        let [x, y, z] = [0, 1, 2].map(|i| DVec3::from(turned[i].map(f64::from)));
        let off = [
            (z - n.as_vec3().as_dvec3()).length(),
            (x.length() - 1.0).abs(),
            (y.length() - 1.0).abs(),
            x.dot(y).abs(),
            (x.cross(y) - z).length(),
        ];
        let worst = off.into_iter().fold(0.0, f64::max);
        verdict.that(format!("{n}"), worst < 1e-6, || format!("{off:?}"));
    }
    verdict.close();
}
