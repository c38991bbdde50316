//! `lib/colormap.wesl`: colour maps.

use crate::support::{
    harness::gpu,
    verdict::{Tolerance, Verdict},
};
use std::collections::HashSet;

#[test]
fn heat_runs_from_black_over_the_rainbow_to_white() {
    #[rustfmt::skip]
    gpu().check("lib::colormap::heat", Tolerance::Absolute(1e-6), &[
        ("below the range it is black", -3.0f32, [0.0, 0.0, 0.0]),
        ("nothing is black", 0.0, [0.0, 0.0, 0.0]),
        ("halfway to blue", 0.1, [0.0, 0.0, 0.5]),
        ("a fifth is blue", 0.2, [0.0, 0.0, 1.0]),
        ("from blue to green", 0.3, [0.0, 0.5, 0.5]),
        ("two fifths are green", 0.4, [0.0, 1.0, 0.0]),
        ("from green to yellow", 0.5, [0.5, 1.0, 0.0]),
        ("three fifths are yellow", 0.6, [1.0, 1.0, 0.0]),
        ("from yellow to red", 0.7, [1.0, 0.5, 0.0]),
        ("four fifths are red", 0.8, [1.0, 0.0, 0.0]),
        ("from red to white", 0.9, [1.0, 0.5, 0.5]),
        ("everything is white", 1.0, [1.0, 1.0, 1.0]),
        ("above the range it is white", 1e30, [1.0, 1.0, 1.0]),
    ]);
}

#[test]
fn ids_have_colours_of_their_own_that_are_not_black() {
    let ids: Vec<u32> = (0..10_000).chain([u32::MAX]).collect();
    let colors: Vec<[f32; 3]> = gpu().map("lib::colormap::id_color", &ids);
    let mut verdict = Verdict::on("id_color");
    for (id, color) in ids.iter().zip(&colors) {
        let shown = color.iter().all(|c| (0.15..=1.0).contains(c));
        verdict.that(format!("id {id} is seen"), shown, || format!("{color:?}"));
    }
    let distinct: HashSet<_> = colors.iter().map(|color| color.map(f32::to_bits)).collect();
    verdict.that(
        "no two ids share a colour",
        distinct.len() == ids.len(),
        || distinct.len(),
    );
    verdict.close();
}
