//! Cuts the work on a tile into submissions that take about the target time each: watchdogs kill
//! long ones, and nothing can be shown, stopped or saved within one.

use super::{film_tile::FilmTile, policy::Slicing, settings::RenderSettings};
use crate::layout::{PackedCounters, PackedDispatch};

/// Groups of the first submission; one that turns out heavier than planned stays short.
const FIRST_GROUPS: f64 = 8.0;
/// Shadow rays from one point for which it is that many; with more of them it is fewer.
const FEW_SHADOW_RAYS: f64 = 256.0;
/// The most by which a submission may be larger than the one before.
const GROWTH: f64 = 4.0;
/// Where twice the work takes no more than this much longer, time goes elsewhere: to the submission itself,
/// or to what else the adapter and the machine have to do. Smaller submissions would only waste it.
const TWICE: f64 = 2.0;
const HARDLY_LONGER: f64 = 1.4;
/// Seconds within which submissions grow for that reason: watchdogs wait for a little longer.
const LONGEST_WAIT: f64 = 1.5;
/// Most workgroups along x: a second dimension keeps both below WebGPU's 65,535.
const GRID_WIDTH: u32 = 256;

/// What one submission does: some groups of a tile, some samples of their pixels.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Slice {
    pub first_group: u32,
    pub end_group: u32,
    pub first_sample: u32,
    pub end_sample: u32,
}

impl Slice {
    /// Workgroups along x and y.
    pub fn grid(&self) -> (u32, u32) {
        let groups = (self.end_group - self.first_group).max(1);
        let rows = groups.div_ceil(GRID_WIDTH);
        (groups.div_ceil(rows), rows)
    }

    /// Whether every workgroup of the dispatch signed off.
    pub fn is_done(&self, counters: &PackedCounters) -> bool {
        let (columns, rows) = self.grid();
        counters.groups_done == columns * rows
    }

    /// Whether all of it was done, and no path cut off.
    pub fn is_complete(&self, counters: &PackedCounters) -> bool {
        self.is_done(counters) && counters.cut_off_paths == 0
    }

    /// Its first and its last groups, if it has several.
    pub fn group_halves(&self) -> Option<(Self, Self)> {
        let middle = self.first_group + (self.end_group - self.first_group) / 2;
        let mut parts = (*self, *self);
        parts.0.end_group = middle;
        parts.1.first_group = middle;
        (middle > self.first_group).then_some(parts)
    }

    /// Its earlier and its later samples, if it has several.
    pub fn sample_halves(&self) -> Option<(Self, Self)> {
        let middle = self.first_sample + (self.end_sample - self.first_sample) / 2;
        let mut parts = (*self, *self);
        parts.0.end_sample = middle;
        parts.1.first_sample = middle;
        (middle > self.first_sample).then_some(parts)
    }

    /// Groups times samples, the measure of work.
    fn work(&self) -> f64 {
        f64::from(self.end_group - self.first_group)
            * f64::from(self.end_sample - self.first_sample)
    }

    /// The slice as the shader reads it.
    pub fn packed(&self, tile: &FilmTile, settings: &RenderSettings) -> PackedDispatch {
        PackedDispatch {
            picture_width: settings.size.0,
            picture_height: settings.size.1,
            tile_x: tile.x,
            tile_y: tile.y,
            tile_width: tile.width,
            tile_height: tile.height,
            group_columns: tile.group_columns(),
            group_count: tile.group_count(),
            group_stride: tile.group_stride(),
            first_group: self.first_group,
            end_group: self.end_group,
            grid_width: self.grid().0,
            first_sample: self.first_sample,
            end_sample: self.end_sample,
            seed: settings.seed,
            max_depth: settings.max_depth,
            min_throughput: settings.min_throughput,
            light_samples: settings.light_samples,
            ..Default::default()
        }
    }
}

/// Plans slices from how long the last ones took.
#[derive(Clone, Debug)]
pub struct Planner {
    slicing: Slicing,
    /// Work of the first submission.
    first: f64,
    /// Work that should fit into the target time.
    budget: f64,
    /// Work below which time is wasted.
    floor: f64,
    /// Work and seconds of the last submission.
    last: Option<(f64, f64)>,
    /// Most samples that an invocation takes.
    max_samples: u32,
}

impl Planner {
    /// For a picture whose points take this many shadow rays each.
    pub fn new(slicing: Slicing, shadow_rays: u64) -> Self {
        let fraction = FEW_SHADOW_RAYS / (shadow_rays as f64).max(FEW_SHADOW_RAYS);
        let first = (FIRST_GROUPS * fraction).max(1.0);
        Self {
            slicing,
            first,
            budget: first,
            floor: 1.0,
            last: None,
            max_samples: slicing.max_samples,
        }
    }

    /// Whether it begins more carefully than another, which has learned from lighter work.
    pub fn is_for_more_work_than(&self, other: &Self) -> bool {
        self.first < other.first
    }

    /// The next slice of a sweep over `group_count` groups that stands at `first_group`; all slices of
    /// a sweep take the same samples.
    pub fn next_slice(
        &self,
        group_count: u32,
        first_group: u32,
        first_sample: u32,
        sweep_samples: u32,
    ) -> Slice {
        let groups = (self.budget / f64::from(sweep_samples)) as u32;
        let groups = groups
            .clamp(1, self.slicing.max_groups)
            .min(group_count - first_group);
        Slice {
            first_group,
            end_group: first_group + groups,
            first_sample,
            end_sample: first_sample + sweep_samples,
        }
    }

    /// Samples per pixel of the next sweep: several only where a slice holds the whole tile, which
    /// then saves submissions.
    pub fn sweep_samples(&self, group_count: u32, samples_left: u32) -> u32 {
        let fitting = (self.budget / f64::from(group_count)) as u32;
        fitting.clamp(1, self.max_samples).min(samples_left)
    }

    /// Learns from a finished slice.
    pub fn learn(&mut self, slice: &Slice, seconds: f64) {
        let work = slice.work();
        self.floor = match self.last {
            _ if seconds <= self.slicing.target_seconds => self.floor / TWICE,
            Some((before, took)) if before != work => {
                let (less, more) = (before.min(work), before.max(work));
                let (short, long) = if work < before {
                    (seconds, took)
                } else {
                    (took, seconds)
                };
                let is_wasted =
                    more >= TWICE * less && long <= HARDLY_LONGER * short && long <= LONGEST_WAIT;
                if is_wasted {
                    TWICE * more
                } else {
                    self.floor.min(less)
                }
            }
            // Whether it still is wasted shows when there is less of it.
            _ => self.floor / TWICE,
        }
        .max(1.0);
        self.last = Some((work, seconds));
        let most = work.max(self.first) * GROWTH;
        let fitting = work * self.slicing.target_seconds / seconds.max(1e-6);
        self.budget = fitting.clamp(self.floor.min(most), most);
    }

    /// Answers paths that the driver cut off: fewer samples in an invocation from now on.
    pub fn shorten_paths(&mut self) {
        self.max_samples = (self.max_samples / 2).max(1);
    }

    /// Answers a slice that the driver cut short: smaller ones from now on.
    pub fn shrink(&mut self) {
        self.budget = (self.budget / 2.0).max(1.0);
        self.floor = 1.0;
    }
}
