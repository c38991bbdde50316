//! Tests whether samples follow their distribution.

use super::{random::Random, verdict::Verdict};
use std::fmt::Display;

/// Independent points of the unit square.
pub fn square_points(count: usize, seed: u64) -> Vec<[f32; 2]> {
    let mut random = Random::new(seed);
    // 24 bits, as shaders draw them: 1 itself does not occur.
    let mut unit = || (random.word() >> 8) as f32 / 16_777_216.0;
    (0..count).map(|_| [unit(), unit()]).collect()
}

/// Pearson's χ² test of counts with equal expectations, at a level of 1e-4 (Wilson and Hilferty's approximation
/// of the quantile).
pub fn check_even(verdict: &mut Verdict, name: impl Display, counts: &[u32]) {
    let total: f64 = counts.iter().map(|&count| f64::from(count)).sum();
    let expected = vec![total / counts.len() as f64; counts.len()];
    check_counts(verdict, name, counts, &expected);
}

/// χ² test of counts with individual expectations, all of which should be at least 5.
pub fn check_counts(verdict: &mut Verdict, name: impl Display, counts: &[u32], expected: &[f64]) {
    assert_eq!(counts.len(), expected.len());
    let terms = counts.iter().zip(expected);
    let chi2: f64 = terms
        .map(|(&count, expected)| (f64::from(count) - expected).powi(2) / expected)
        .sum();
    let freedom = counts.len() as f64 - 1.0;
    let spread = 2.0 / (9.0 * freedom);
    let most = freedom * (1.0 - spread + 3.719 * spread.sqrt()).powi(3);
    verdict.that(name, chi2 <= most, || {
        format!("χ² is {chi2:.1}, at most {most:.1} with {freedom} degrees of freedom")
    });
}

/// Counts the points in each of `side` × `side` cells of the unit square. Points are clamped to it, but may
/// exceed it only by rounding.
pub fn cells(points: impl IntoIterator<Item = [f64; 2]>, side: usize) -> Vec<u32> {
    let mut counts = vec![0; side * side];
    for [x, y] in points {
        assert!(
            (-1e-4..=1.0001).contains(&x) && (-1e-4..=1.0001).contains(&y),
            "({x}, {y})"
        );
        let cell = |c: f64| ((c * side as f64).max(0.0) as usize).min(side - 1);
        counts[cell(y) * side + cell(x)] += 1;
    }
    counts
}
