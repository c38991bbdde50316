//! Splits the work on a film tile into submissions of about the target time each: watchdogs kill long
//! submissions, and nothing can be displayed, stopped or saved during one.

use super::{
    film_tile::{FilmTile, GroupOrder},
    policy::Slicing,
    settings::RenderSettings,
};
use crate::layout::{PackedCounters, PackedDispatch};

/// Workgroups of the first submission, so that it stays short even if the work is heavier than expected, and maximum growth
/// from one submission to the next. Where each is spread over the picture, the next one takes as long for the same work;
/// otherwise it renders another part.
const SPREAD: (f64, f64) = (32.0, 16.0);
const PARTS: (f64, f64) = (8.0, 4.0);
/// Workgroups of the first submission times shadow rays per point, at most.
const FIRST_SHADOW_RAYS: f64 = 2048.0;
/// If twice the work takes at most this factor longer, the time is spent on overhead: on the submission itself,
/// or on other work of the adapter and the machine. Smaller submissions would only add overhead.
const TWICE: f64 = 2.0;
const HARDLY_LONGER: f64 = 1.4;
/// Maximum duration, in seconds, up to which submissions grow for that reason: watchdogs allow a little more.
const LONGEST_WAIT: f64 = 1.5;
/// A pass that takes at most this long, in seconds, is hardly seen to go over the picture.
const UNSEEN: f64 = 0.25;
/// Maximum number of workgroups along x: with a second dimension both stay below the 65,535 of WebGPU.
const GRID_WIDTH: u32 = 256;

/// The work of one submission: a range of workgroups of a film tile, and a range of samples of their pixels.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Slice {
    pub first_group: u32,
    pub end_group: u32,
    pub first_sample: u32,
    pub end_sample: u32,
}

impl PackedCounters {
    /// Workgroups that ran to their end.
    pub fn finished_groups(&self) -> u32 {
        let counts = self.groups_done.iter().map(|line| line[0]);
        counts.fold(0, u32::wrapping_add)
    }
}

impl Slice {
    /// Blocks of 8x8 pixels that each workgroup renders one after the other, for lanes that take this many samples if they can.
    fn blocks(&self, lane_samples: u32) -> u32 {
        (lane_samples / (self.end_sample - self.first_sample).max(1)).max(1)
    }

    /// Workgroups along x and y, for lanes that take this many samples if they can.
    pub fn grid(&self, lane_samples: u32) -> (u32, u32) {
        let groups = (self.end_group - self.first_group).max(1);
        let groups = groups.div_ceil(self.blocks(lane_samples));
        let rows = groups.div_ceil(GRID_WIDTH);
        (groups.div_ceil(rows), rows)
    }

    /// Whether every workgroup of the dispatch finished.
    pub fn is_done(&self, counters: &PackedCounters, lane_samples: u32) -> bool {
        let (columns, rows) = self.grid(lane_samples);
        counters.finished_groups() == columns * rows
    }

    /// Whether every workgroup finished and no path was cut off.
    pub fn is_complete(&self, counters: &PackedCounters, lane_samples: u32) -> bool {
        self.is_done(counters, lane_samples) && counters.cut_off == 0
    }

    /// Whether a slice is a part of this one.
    pub fn contains(&self, part: &Self) -> bool {
        let is_within =
            |first: u32, end: u32, from: u32, to: u32| from <= first && first < end && end <= to;
        is_within(
            part.first_group,
            part.end_group,
            self.first_group,
            self.end_group,
        ) && is_within(
            part.first_sample,
            part.end_sample,
            self.first_sample,
            self.end_sample,
        )
    }

    /// Two slices with half of the workgroups each, if there are several.
    pub fn group_halves(&self) -> Option<(Self, Self)> {
        let middle = self.first_group + (self.end_group - self.first_group) / 2;
        let mut parts = (*self, *self);
        parts.0.end_group = middle;
        parts.1.first_group = middle;
        (middle > self.first_group).then_some(parts)
    }

    /// Two slices with half of the samples each, if there are several.
    pub fn sample_halves(&self) -> Option<(Self, Self)> {
        let middle = self.first_sample + (self.end_sample - self.first_sample) / 2;
        let mut parts = (*self, *self);
        parts.0.end_sample = middle;
        parts.1.first_sample = middle;
        (middle > self.first_sample).then_some(parts)
    }

    /// Workgroups times samples, the measure of work.
    pub fn work(&self) -> f64 {
        f64::from(self.end_group - self.first_group)
            * f64::from(self.end_sample - self.first_sample)
    }

    /// The dispatch parameters of the slice.
    pub fn packed(
        &self,
        tile: &FilmTile,
        settings: &RenderSettings,
        lane_samples: u32,
    ) -> PackedDispatch {
        PackedDispatch {
            picture_width: settings.size.0,
            picture_height: settings.size.1,
            tile_x: tile.x,
            tile_y: tile.y,
            tile_width: tile.width,
            tile_height: tile.height,
            group_count: tile.group_count(),
            group_stride: tile.group_stride(),
            first_group: self.first_group,
            end_group: self.end_group,
            grid_width: self.grid(lane_samples).0,
            first_sample: self.first_sample,
            end_sample: self.end_sample,
            seed: settings.seed,
            shared_samples: settings.shared_samples(),
            max_depth: settings.max_depth,
            backdrop: settings.backdrop_color(),
            min_throughput: settings.min_throughput,
            light_samples: settings.light_samples,
            footprint: settings.footprint(),
            blocks: self.blocks(lane_samples),
            ..Default::default()
        }
    }
}

/// Plans slices from the duration of the previous ones.
#[derive(Clone, Debug)]
pub struct Planner {
    slicing: Slicing,
    /// Maximum growth from one submission to the next.
    growth: f64,
    /// Work of the first submission.
    first: f64,
    /// Work that is expected to take the target time.
    budget: f64,
    /// Minimum work, below which overhead dominates.
    floor: f64,
    /// Work and seconds of the last submission.
    last: Option<(f64, f64)>,
    /// Maximum number of samples per invocation.
    max_samples: u32,
}

impl Planner {
    /// A planner for a picture with this many shadow rays per point, whose workgroups are visited in this order.
    pub fn new(slicing: Slicing, order: GroupOrder, shadow_rays: u64) -> Self {
        let (groups, growth) = match order {
            GroupOrder::Spread => SPREAD,
            GroupOrder::Diagonal => PARTS,
        };
        let first = groups.min(FIRST_SHADOW_RAYS / shadow_rays as f64).max(1.0);
        Self {
            slicing,
            growth,
            first,
            budget: first,
            floor: 1.0,
            last: None,
            max_samples: slicing.max_samples,
        }
    }

    /// Whether it starts with smaller slices than another planner, which has learned from lighter work.
    pub fn is_for_more_work_than(&self, other: &Self) -> bool {
        self.first < other.first
    }

    /// The next slice of a sweep over `group_count` workgroups, starting at `first_group`; all slices of a
    /// sweep have the same samples.
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

    /// Samples per pixel of the next pass over a film tile: `most`, or where it would be watched for long, as many as there are.
    pub fn pass_samples(&self, group_count: u32, most: u32, done: u32) -> u32 {
        let work = f64::from(group_count) * f64::from(most);
        let seconds = work / self.budget * self.slicing.target_seconds;
        match self.slicing.even_passes && seconds > UNSEEN {
            true => done.min(most),
            false => most,
        }
    }

    /// Samples per pixel of the next sweep: `wanted`, or more if a slice covers the whole film tile, which saves
    /// submissions.
    pub fn sweep_samples(&self, group_count: u32, wanted: u32, samples_left: u32) -> u32 {
        let fitting = match group_count <= self.slicing.max_groups {
            true => (self.budget / f64::from(group_count)) as u32,
            false => wanted,
        };
        let most = self.max_samples;
        fitting.clamp(wanted.min(most), most).min(samples_left)
    }

    /// Updates the plan with the duration of a finished slice.
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
                let is_overhead =
                    more >= TWICE * less && long <= HARDLY_LONGER * short && long <= LONGEST_WAIT;
                if is_overhead {
                    TWICE * more
                } else {
                    self.floor.min(less)
                }
            }
            // Smaller slices will show whether overhead still dominates.
            _ => self.floor / TWICE,
        }
        .max(1.0);
        self.last = Some((work, seconds));
        let most = work.max(self.first) * self.growth;
        let fitting = work * self.slicing.target_seconds / seconds.max(1e-6);
        self.budget = fitting.clamp(self.floor.min(most), most);
    }

    /// Reacts to paths that the driver cut off: fewer samples per invocation from now on.
    pub fn shorten_paths(&mut self) {
        self.max_samples = (self.max_samples / 2).max(1);
    }

    /// Reacts to a slice that the driver cut short: smaller slices from now on.
    pub fn shrink(&mut self) {
        self.budget = (self.budget / 2.0).max(1.0);
        self.first = self.first.min(self.budget);
        self.floor = 1.0;
    }
}

#[cfg(test)]
mod tests {
    use super::{GroupOrder, Planner, Slicing};

    /// The workgroups of each submission of a picture of 512×512 pixels, of which each takes as long as the others.
    fn submissions(order: GroupOrder, seconds_of_group: f64) -> Vec<u32> {
        let mut planner = Planner::new(Slicing::default(), order, 1);
        let (mut sizes, mut done) = (Vec::new(), 0);
        while done < 4096 {
            let slice = planner.next_slice(4096, done, 0, 1);
            let groups = slice.end_group - slice.first_group;
            planner.learn(&slice, seconds_of_group * f64::from(groups));
            done = slice.end_group;
            sizes.push(groups);
        }
        sizes
    }

    /// Each submission of a light picture takes a fraction of a millisecond of its own.
    #[test]
    fn light_pictures_take_few_submissions() {
        assert_eq!(submissions(GroupOrder::Spread, 2e-6).len(), 3);
        assert!(submissions(GroupOrder::Diagonal, 2e-6).len() <= 6);
    }

    #[test]
    fn submissions_of_heavy_pictures_take_the_target_time() {
        let target = Slicing::default().target_seconds;
        for order in [GroupOrder::Spread, GroupOrder::Diagonal] {
            for seconds in [2e-4, 1e-3, 2e-3] {
                let sizes = submissions(order, seconds);
                let times = sizes.iter().map(|groups| f64::from(*groups) * seconds);
                let longest = times.clone().fold(0.0, f64::max);
                assert!(longest <= 1.01 * target, "{order:?}: {longest} s");
                let most = (4096.0 * seconds / target).ceil() as usize + 3;
                assert!(
                    sizes.len() <= most,
                    "{order:?}: {} submissions",
                    sizes.len()
                );
            }
        }
    }

    /// A driver cut submissions short.
    #[test]
    fn submissions_grow_slowly_again_after_one_was_cut_short() {
        for order in [GroupOrder::Spread, GroupOrder::Diagonal] {
            let mut planner = Planner::new(Slicing::default(), order, 1);
            let first = planner.next_slice(4096, 0, 0, 1);
            (0..5).for_each(|_| planner.shrink());
            let slice = planner.next_slice(4096, 0, 0, 1);
            assert_eq!(slice.end_group, 1, "{order:?}");
            planner.learn(&slice, 1e-6);
            let next = planner.next_slice(4096, 1, 0, 1);
            assert!(next.end_group - 1 < first.end_group, "{order:?}: {next:?}");
        }
    }
}
