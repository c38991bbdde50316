//! `lib/tile.wesl`: every pixel is visited exactly once.

use crate::support::{
    harness::gpu,
    verdict::{Tolerance, Verdict},
};
use std::collections::HashSet;

#[test]
fn quotients_and_remainders_are_exact() {
    let divisors = [
        1, 2, 3, 7, 64, 255, 4_095, 40_503, 65_521, 65_535, 65_536u32,
    ];
    let mut inputs = vec![(65_536, 1)];
    for divisor in divisors {
        for quotient in (0..65_536).step_by(97).chain([1, 65_535]) {
            let multiple = quotient * divisor;
            let around = [multiple, multiple + divisor / 2, multiple + (divisor - 1)];
            inputs.extend(around.map(|dividend| (dividend, divisor)));
        }
    }
    let found: Vec<[u32; 2]> = gpu().map("lib::tile::divided", &inputs);
    let mut verdict = Verdict::on("divided");
    for ((a, b), found) in inputs.iter().zip(&found) {
        verdict.near(
            format!("{a} by {b}"),
            found,
            &[a / b, a % b],
            Tolerance::Exact,
        );
    }
    verdict.close();
}

#[test]
fn strides_without_common_factor_visit_every_workgroup_once() {
    let mut verdict = Verdict::on("permuted_group");
    for (count, stride) in [
        (1, 1u32),
        (2, 1),
        (64, 27),
        (4800, 2969),
        (65_521, 40_503),
        (65_536, 65_535),
    ] {
        let inputs: Vec<_> = (0..count).map(|index| (index, count, stride)).collect();
        let groups: Vec<u32> = gpu().map("lib::tile::permuted_group", &inputs);
        let distinct: HashSet<_> = groups.iter().filter(|group| **group < count).collect();
        verdict.that(
            format!("{count} workgroups in strides of {stride}"),
            distinct.len() == count as usize,
            || format!("{} distinct workgroups", distinct.len()),
        );
    }
    verdict.close();
}

#[test]
fn lanes_of_a_workgroup_follow_the_z_curve() {
    let lanes: Vec<u32> = (0..64).collect();
    let places: Vec<[u32; 2]> = gpu().map("lib::tile::morton_8x8", &lanes);
    let mut verdict = Verdict::on("morton_8x8");
    let first = [
        [0, 0],
        [1, 0],
        [0, 1],
        [1, 1],
        [2, 0],
        [3, 0],
        [2, 1],
        [3, 1],
        [0, 2],
    ];
    for (lane, expected) in first.iter().enumerate() {
        verdict.near(
            format!("lane {lane}"),
            &places[lane],
            expected,
            Tolerance::Exact,
        );
    }
    for (lanes, [width, height]) in [(4, [2, 2]), (8, [4, 2]), (16, [4, 4]), (64, [8, 8])] {
        for (group, places) in places.chunks_exact(lanes).enumerate() {
            let blocks: HashSet<_> = places
                .iter()
                .map(|[x, y]| [x / width, y / height])
                .collect();
            let distinct: HashSet<_> = places.iter().collect();
            let name = format!("lanes {lanes} x {group} hold one block of {width}x{height}");
            verdict.that(name, blocks.len() == 1 && distinct.len() == lanes, || {
                format!("{places:?}")
            });
        }
    }
    verdict.close();
}

#[test]
fn workgroups_cover_a_tile_once() {
    let (columns, rows) = (5, 3);
    let groups: Vec<_> = (0..columns * rows).map(|group| (group, columns)).collect();
    let corners: Vec<[u32; 2]> = gpu().map("lib::tile::group_corner", &groups);
    let mut verdict = Verdict::on("group_corner");
    let distinct: HashSet<_> = corners
        .iter()
        .filter(|[x, y]| x % 8 == 0 && y % 8 == 0 && *x < 8 * columns && *y < 8 * rows)
        .collect();
    verdict.that("every 8x8 pixels of 40x24", distinct.len() == 15, || {
        distinct.len()
    });
    verdict.near(
        "workgroup 7 of 5 columns begins at (16, 8)",
        &corners[7],
        &[16, 8],
        Tolerance::Exact,
    );
    verdict.close();
}

#[test]
fn the_next_corner_is_that_of_the_next_workgroup() {
    let mut verdict = Verdict::on("next_corner");
    for (columns, rows, stride) in [(5, 3, 7), (5, 3, 1), (1, 13, 5), (13, 1, 12), (64, 64, 65)] {
        let corner = |index: u32| {
            let group = index * stride % (columns * rows);
            [8 * (group % columns), 8 * (group / columns)]
        };
        let step = [stride % columns, stride / columns];
        let indices = 0..columns * rows;
        let inputs: Vec<_> = (indices
            .clone()
            .map(|index| (corner(index), step, [columns, rows])))
        .collect();
        let expected: Vec<_> = indices.map(|index| corner(index + 1)).collect();
        let next: Vec<[u32; 2]> = gpu().map("lib::tile::next_corner", &inputs);
        verdict.that(
            format!("{columns} by {rows} workgroups in strides of {stride}"),
            next == expected,
            || format!("{next:?}"),
        );
    }
    verdict.close();
}
