//! Cuts a picture or an animation into parts of even cost. Pictures are cut by samples first, which all cost the same,
//! and then into bands of rows, by what their rows cost. Animations are cut by frames, and frames as pictures are.

use glimray_render::SAMPLE_BLOCK;
use std::ops::Range;

/// A picture to cut.
#[derive(Clone, Debug)]
pub struct Picture {
    /// Columns and rows to render: x0, y0, x1, y1.
    pub region: [u32; 4],
    /// Samples of each pixel.
    pub samples: u32,
    /// Whether samples can be cut; those of adaptive sampling cannot.
    pub has_blocks: bool,
    /// Seconds of each row of the region, for all samples.
    pub rows: Vec<f64>,
}

/// A piece of a picture.
#[derive(Clone, Debug, PartialEq)]
pub struct Piece {
    pub samples: Range<u32>,
    /// x0, y0, x1, y1.
    pub crop: [u32; 4],
    /// Predicted seconds.
    pub seconds: f64,
}

impl Picture {
    /// Cuts it into at least `count` pieces, or as many as there can be. Among the ways to cut, few more pieces and even
    /// ranges of samples win.
    pub fn cut(&self, count: usize) -> Vec<Piece> {
        let blocks = match self.has_blocks {
            true => self.samples.div_ceil(SAMPLE_BLOCK) as usize,
            false => 1,
        };
        let most_bands = self.rows.len().max(1);
        let count = count.clamp(1, blocks * most_bands);
        let waste = |bands: usize| {
            let ranges = count.div_ceil(bands);
            let unevenness = (blocks.div_ceil(ranges) * ranges) as f64 / blocks as f64;
            let more = (bands * ranges) as f64 / count as f64;
            unevenness * more
        };
        let bands = (1..=most_bands)
            .filter(|&bands| count.div_ceil(bands) <= blocks)
            .min_by(|a, b| waste(*a).total_cmp(&waste(*b)))
            .unwrap_or(most_bands);
        let ranges = count.div_ceil(bands).min(blocks);
        let [x0, y0, x1, _] = self.region;
        let mut pieces = Vec::with_capacity(bands * ranges);
        for rows in even(&self.rows, bands) {
            let seconds: f64 = self.rows[rows.clone()].iter().sum();
            let crop = [x0, y0 + rows.start as u32, x1, y0 + rows.end as u32];
            for index in 0..ranges {
                let block = |index: usize| {
                    let sample = (index * blocks / ranges) as u32 * SAMPLE_BLOCK;
                    sample.min(self.samples)
                };
                let samples = match index + 1 == ranges {
                    true => block(index)..self.samples,
                    false => block(index)..block(index + 1),
                };
                let part = f64::from(samples.end - samples.start) / f64::from(self.samples);
                pieces.push(Piece {
                    samples,
                    crop,
                    seconds: seconds * part,
                });
            }
        }
        pieces
    }
}

/// Cuts a list of costs into `count` ranges of even cost, none empty; as many as the list has entries at most.
pub fn even(costs: &[f64], count: usize) -> Vec<Range<usize>> {
    let count = count.clamp(1, costs.len().max(1));
    let total: f64 = costs.iter().sum();
    let mut ranges = Vec::with_capacity(count);
    let (mut start, mut sum) = (0, 0.0);
    for index in 0..count {
        // Later ranges need an entry each.
        let last_end = costs.len() - (count - 1 - index);
        let wanted = total * (index + 1) as f64 / count as f64;
        let mut end = start;
        while end < last_end {
            let next = sum + costs[end];
            // The boundary is the one nearest to the even one.
            if end > start && next - wanted > wanted - sum {
                break;
            }
            sum = next;
            end += 1;
        }
        if index + 1 == count {
            end = costs.len();
        }
        ranges.push(start..end);
        start = end;
    }
    ranges
}
