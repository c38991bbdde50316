//! Predicts how well parts keep machines busy: a list schedule in the order of the parts, as an array job makes it. And
//! what merging them takes.

use super::merge_costs::MergeCosts;
use super::work::Work;
use glimray_app::error::AppError;
use std::cmp::Reverse;
use std::collections::BinaryHeap;

/// Parts for each machine that are tried.
const PARTS_PER_NODE: [usize; 7] = [1, 2, 4, 8, 16, 32, 64];

/// Spread of the costs, and the seed of their errors.
const SPREAD: Spread = Spread(0.1);
const SEED: u64 = 18;

/// A table of what the cut is worth on these numbers of machines.
///
/// # Errors
/// A fault in a cut.
pub fn table(work: &Work, nodes: &[u32], merging: &MergeCosts) -> Result<String, AppError> {
    let (width, height) = work.settings.size;
    let what = match &work.timeline {
        Some(timeline) => format!("{} frames of ", timeline.count),
        None => String::new(),
    };
    let mut table = format!(
        "{what}{width}x{height} with {} samples: {:.0} s of rendering on {}, {:.1} s to start a process\n\n\
         | machines | parts | a part, s | all, s | efficiency | part, MB | merge, MB read | merge, s | memory, MB |\n\
         |---|---|---|---|---|---|---|---|---|\n",
        work.settings.samples,
        work.seconds(),
        work.costs.adapter,
        work.costs.start,
    );
    for &nodes in nodes {
        let nodes = nodes as usize;
        let candidate = |each: &usize| {
            let parts = work.cut(each * nodes);
            let merge = merging.of(work, &parts)?;
            let seconds: Vec<f64> = parts.iter().map(|part| part.seconds).collect();
            let seconds = drawn(&seconds, SPREAD, SEED);
            let extra = work.costs.start + merge.part_seconds;
            Ok::<_, AppError>((efficiency(&seconds, extra, nodes), seconds, merge))
        };
        let candidates = PARTS_PER_NODE.iter().map(candidate);
        let candidates = candidates.collect::<Result<Vec<_>, _>>()?.into_iter();
        let best = candidates.max_by(|(a, ..), (b, ..)| a.total_cmp(b));
        let Some((share, seconds, merge)) = best else {
            continue;
        };
        let total: f64 = seconds.iter().sum();
        let mega = |bytes: u64| bytes as f64 / 1e6;
        table += &format!(
            "| {nodes} | {} | {:.1} | {:.1} | {share:.3} | {:.1} | {:.0} | {:.0} | {:.0} |\n",
            seconds.len(),
            total / seconds.len() as f64,
            total / (share * nodes as f64),
            mega(merge.largest_bytes),
            mega(merge.read_bytes),
            merge.seconds,
            mega(merge.memory_bytes),
        );
    }
    table += "\nCosts are drawn with a spread of 10 % around what was measured.\n";
    Ok(table)
}

/// Spread of what a part costs around its prediction: the standard deviation of the logarithm.
#[derive(Clone, Copy, Debug)]
struct Spread(f64);

/// Seconds until `nodes` machines have rendered parts of these seconds, each with `extra` seconds beside it. Whoever is
/// free takes the next part.
fn makespan(parts: &[f64], extra: f64, nodes: usize) -> f64 {
    // Whole nanoseconds have an order.
    let mut free: BinaryHeap<Reverse<u64>> = (0..nodes).map(|_| Reverse(0)).collect();
    let mut end = 0;
    for seconds in parts {
        let Reverse(at) = free.pop().unwrap_or(Reverse(0));
        let at = at + ((extra + seconds) * 1e9) as u64;
        end = end.max(at);
        free.push(Reverse(at));
    }
    end as f64 * 1e-9
}

/// The share of the machines' time that goes into rendering, 0 to 1.
fn efficiency(parts: &[f64], extra: f64, nodes: usize) -> f64 {
    let work: f64 = parts.iter().sum();
    let end = makespan(parts, extra, nodes);
    match end > 0.0 {
        true => work / (end * nodes as f64),
        false => 1.0,
    }
}

/// The costs with a log-normal error of this spread and a mean factor of 1, from a counter hash.
fn drawn(parts: &[f64], Spread(deviation): Spread, seed: u64) -> Vec<f64> {
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
