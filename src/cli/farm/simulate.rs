//! Predicts how well parts keep machines busy: a list schedule in the order of the parts, as an array job makes it.

use std::cmp::Reverse;
use std::collections::BinaryHeap;

/// Spread of what a part costs around its prediction: the standard deviation of the logarithm.
#[derive(Clone, Copy, Debug)]
pub struct Spread(pub f64);

/// Seconds until `nodes` machines have rendered parts of these seconds, each with `start` seconds before it. Whoever is
/// free takes the next part.
pub fn makespan(parts: &[f64], start: f64, nodes: usize) -> f64 {
    // Whole nanoseconds have an order.
    let mut free: BinaryHeap<Reverse<u64>> = (0..nodes).map(|_| Reverse(0)).collect();
    let mut end = 0;
    for seconds in parts {
        let Reverse(at) = free.pop().unwrap_or(Reverse(0));
        let at = at + ((start + seconds) * 1e9) as u64;
        end = end.max(at);
        free.push(Reverse(at));
    }
    end as f64 * 1e-9
}

/// The share of the machines' time that goes into rendering, 0 to 1.
pub fn efficiency(parts: &[f64], start: f64, nodes: usize) -> f64 {
    let work: f64 = parts.iter().sum();
    let end = makespan(parts, start, nodes);
    match end > 0.0 {
        true => work / (end * nodes as f64),
        false => 1.0,
    }
}

/// The costs with a log-normal error of this spread and a mean factor of 1, from a counter hash.
pub fn drawn(parts: &[f64], Spread(deviation): Spread, seed: u64) -> Vec<f64> {
    let uniform = |index: u64| {
        let hash = xxhash_rust::xxh3::xxh3_64_with_seed(&index.to_le_bytes(), seed);
        ((hash >> 11) as f64 + 0.5) / (1_u64 << 53) as f64
    };
    let factor = |index: usize| {
        // Box and Muller, "A Note on the Generation of Random Normal Deviates", 1958.
        let (u, v) = (uniform(2 * index as u64), uniform(2 * index as u64 + 1));
        let normal = (-2.0 * u.ln()).sqrt() * (std::f64::consts::TAU * v).cos();
        (deviation * normal - deviation * deviation / 2.0).exp()
    };
    (parts.iter().enumerate())
        .map(|(index, seconds)| seconds * factor(index))
        .collect()
}
