//! `lib/mis.wesl` and `lib/dimensions.wesl`: weights and random numbers of paths.

use crate::shader_library::shaders;
use crate::support::{
    harness::gpu,
    verdict::{Tolerance, Verdict},
};
use std::{
    collections::{BTreeMap, BTreeSet},
    fs,
    path::PathBuf,
};

#[test]
fn weights_of_two_techniques_add_up_to_one() {
    let densities = [0.0, 1e-30, 1e-6, 0.3, 1.0, 7.0, 1e6, 1e20, 1e30];
    let pairs: Vec<(f32, f32)> = densities
        .iter()
        .flat_map(|&own| densities.map(|other| (own, other)))
        .collect();
    let swapped: Vec<_> = pairs.iter().map(|&(own, other)| (other, own)).collect();
    let weights: Vec<f32> = gpu().map("lib::mis::power_heuristic", &pairs);
    let others: Vec<f32> = gpu().map("lib::mis::power_heuristic", &swapped);
    let mut verdict = Verdict::on("power_heuristic");
    for ((&(own, other), weight), rest) in pairs.iter().zip(&weights).zip(&others) {
        let (p, q) = (f64::from(own), f64::from(other));
        let sum = if p + q > 0.0 { 1.0 } else { 0.0 };
        let expected = if p > 0.0 {
            p * p / (p * p + q * q)
        } else {
            0.0
        };
        let name = format!("{own:e} and {other:e}");
        verdict.near(&name, weight, &expected, Tolerance::Absolute(1e-6));
        verdict.near(&name, &(weight + rest), &sum, Tolerance::Absolute(1e-6));
    }
    verdict.close();
}

#[test]
fn dark_paths_end_and_bright_ones_may_too() {
    gpu().check(
        "lib::mis::survival_chance",
        Tolerance::Absolute(1e-7),
        &[
            ("black", [0.0f32, 0.0, 0.0], 0.0),
            ("the largest channel counts", [0.1, 0.4, 0.2], 0.4),
            ("white", [1.0, 1.0, 1.0], 1.0),
            ("more than white", [5.0, 0.0, 0.0], 1.0),
        ],
    );
}

#[test]
fn no_random_number_of_a_path_is_used_twice() {
    let mut verdict = Verdict::on("dimension_key");
    for pixel in [0, 1, 0x1234_5678, 0x9e37_79b9, u32::MAX] {
        let rows: Vec<(u32, u32, u32)> = (0..128)
            .flat_map(|segment| (0..8).map(move |purpose| (pixel, segment, purpose)))
            .collect();
        let keys: Vec<u32> = gpu().map("lib::dimensions::dimension_key", &rows);
        let mut distinct: BTreeSet<u32> = keys.iter().copied().collect();
        distinct.insert(pixel);
        let count = distinct.len();
        // The mix of a word with a fixed one is a bijection, so all differ. The pixel's own key is among them with a
        // chance of one in four million.
        verdict.that(format!("{pixel:#x}"), count == rows.len() + 1, || count);
    }
    verdict.close();
}

/// Each purpose has a number of its own, below those of the next segment, and one place that draws it. A shadow catcher
/// scatters in place of what other surfaces do.
#[test]
fn every_purpose_of_a_segment_is_drawn_at_one_place() {
    let table = fs::read_to_string("shaders/lib/dimensions.wesl").expect("a shader");
    let constant = |line: &str| {
        let (name, value) = line.strip_prefix("const ")?.split_once(": u32 = ")?;
        let value = value.strip_suffix("u;")?.parse::<u32>().ok()?;
        Some((name.to_owned(), value))
    };
    let mut purposes: BTreeMap<_, _> = table.lines().filter_map(constant).collect();
    let limit = purposes.remove("DIMENSIONS").expect("their number");
    let distinct: BTreeSet<_> = purposes.values().filter(|value| **value < limit).collect();
    assert!(purposes.len() >= 7, "{purposes:?}");
    assert_eq!(
        distinct.len(),
        purposes.len(),
        "{purposes:?}, below {limit}"
    );

    let sources = ["shaders/scene", "shaders/kernels"].map(shaders).concat();
    let mut verdict = Verdict::on("purposes");
    for purpose in purposes.keys() {
        let drawn = |(path, text): &(PathBuf, String)| {
            let count = ["random_1d", "random_2d"]
                .map(|of| text.matches(&format!("{of}(path, {purpose})")).count());
            (path.clone(), count[0] + count[1])
        };
        let (of_catchers, others): (Vec<_>, Vec<_>) = (sources.iter().map(drawn))
            .filter(|(_, count)| *count > 0)
            .partition(|(path, _)| path.ends_with("shadow_catcher.wesl"));
        let is_once = |places: &[(PathBuf, usize)]| places.iter().all(|(_, count)| *count == 1);
        let is_fine = others.len() == 1 && is_once(&others) && is_once(&of_catchers);
        verdict.that(purpose, is_fine, || format!("{others:?}, {of_catchers:?}"));
    }
    verdict.close();
}
