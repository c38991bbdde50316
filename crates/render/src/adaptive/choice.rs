//! The choice of the pixels of the next round.
//!
//! The choice follows from the samples of a pixel and its neighbours. Where the last round took none, nothing changed since
//! the choice of that round, which left the pixel out. So only groups with samples of the last round, and those beside
//! them, are considered.

use super::{Adaptive, Estimate, GROUP_SIDE, NEIGHBOUR_ROUNDS};
use glimray_scene::threads;
use std::{collections::BTreeMap, ops::Range};

/// A pixel with this many times fewer samples than a noisy neighbour needs more.
const BEHIND: u32 = 4;

/// Pixels by the number of their samples.
type PixelLists = BTreeMap<u32, Vec<[u32; 2]>>;

impl Adaptive {
    /// The pixels that need more samples, by their number so far, then group by group.
    pub(super) fn unfinished_pixels(&self) -> PixelLists {
        let (rows, height) = (self.group_counts()[1], self.band_height());
        let bands = (0..rows).step_by(height);
        let bands = bands.map(|first| first..rows.min(first + height));
        let mut unfinished = PixelLists::new();
        for lists in threads::map(bands.collect(), |rows| self.unfinished_in(rows)) {
            for (count, pixels) in lists {
                unfinished.entry(count).or_default().extend(pixels);
            }
        }
        unfinished
    }

    /// The unfinished pixels in some rows of groups.
    fn unfinished_in(&self, rows: Range<usize>) -> PixelLists {
        let [x0, y0, width, height] = self.region;
        let [columns, _] = self.group_counts();
        let mut unfinished = PixelLists::new();
        let groups = rows.flat_map(|row| (0..columns).map(move |column| [column, row]));
        for group in groups.filter(|&group| self.may_have_changed(group)) {
            let [left, top] = group.map(|at| (at * GROUP_SIDE) as u32);
            let end = |first: u32, length: u32| length.min(first + GROUP_SIDE as u32);
            let pixels =
                (top..end(top, height)).flat_map(|y| (left..end(left, width)).map(move |x| [x, y]));
            for [x, y] in pixels.filter(|&[x, y]| self.needs_more_samples(x, y)) {
                let list = unfinished.entry(self.estimate(x, y).count).or_default();
                list.push([x0 + x, y0 + y]);
            }
        }
        unfinished
    }

    /// Whether the last round sampled a group or one beside it.
    fn may_have_changed(&self, group: [usize; 2]) -> bool {
        let [columns, rows] = self.group_counts();
        let [across, down] = [near(group[0], columns), near(group[1], rows)];
        down.into_iter()
            .any(|row| self.sampled[row * columns..][across.clone()].contains(&true))
    }

    /// Whether a pixel needs another round: its own error is too large, or it may have missed something that
    /// its neighbours found. A few samples can all miss the same feature and then agree. After the first round
    /// a difference from a neighbour is therefore enough; later the neighbour must also be noisy and have many
    /// more samples.
    fn needs_more_samples(&self, x: u32, y: u32) -> bool {
        let own = self.estimate(x, y);
        let rounds_left = NEIGHBOUR_ROUNDS.saturating_sub(self.rounds);
        if own.count >= self.samples || self.steps_to_crop(x, y) > rounds_left {
            return false;
        }
        let missed = |other: &Estimate| {
            let differs = (other.brightness - own.brightness).abs() > self.measure.noise;
            let is_ahead = other.count >= BEHIND * own.count && other.is_noisy;
            differs && (own.count <= self.first_samples || is_ahead)
        };
        let looks_at_neighbours = self.rounds <= NEIGHBOUR_ROUNDS;
        own.is_noisy || (looks_at_neighbours && self.around(x, y).any(missed))
    }

    /// Distance in pixels from a pixel of the region to the crop; 0 inside it.
    fn steps_to_crop(&self, x: u32, y: u32) -> u32 {
        let [x0, y0, ..] = self.region;
        let [left, top, width, height] = self.crop;
        let beyond = |at: u32, start: u32, length: u32| {
            let last = start + length - 1;
            start.saturating_sub(at).max(at.saturating_sub(last))
        };
        beyond(x0 + x, left, width).max(beyond(y0 + y, top, height))
    }

    /// The pixel and its neighbours.
    fn around(&self, x: u32, y: u32) -> impl Iterator<Item = &Estimate> {
        let [width, height] = [self.region[2], self.region[3]].map(|length| length as usize);
        let across = near(x as usize, width);
        near(y as usize, height).flat_map(move |y| &self.estimates[y * width..][across.clone()])
    }

    fn estimate(&self, x: u32, y: u32) -> &Estimate {
        &self.estimates[y as usize * self.region[2] as usize + x as usize]
    }
}

/// The indices of an element of `length` and those beside it.
fn near(center: usize, length: usize) -> Range<usize> {
    center.saturating_sub(1)..length.min(center + 2)
}
