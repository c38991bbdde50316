//! Submits work to the GPU slice by slice and collects the results.

use super::{
    Cursor, Integrator, RenderError, Renderer,
    device::Readback,
    effort::LongPath,
    film_tile::FilmTile,
    policy::{Fetch, Stack},
    slice::Slice,
    sums::SAMPLE_BLOCK,
};
use crate::{
    gpu::{GpuError, Reading, Submitted},
    layout::{CUT_OFF_STACK, PackedCounters},
};
use glimray_scene::clock::Instant;

/// Most paths that a lane traces in one submission that covers a part of the picture.
const PATHS_PER_LANE: u32 = 32;

/// The state of the work that [`Renderer::submit`] submitted.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Status {
    /// The GPU is busy.
    Working,
    /// The work is finished, or there was none: the renderer can submit more.
    Ready,
    /// Every pixel has all its samples.
    Done,
}

/// The current slice, possibly split into parts.
pub struct Work {
    slice: Slice,
    /// Parts still to be submitted, the last one first.
    parts: Vec<Slice>,
    running: Option<Running>,
}

impl Work {
    /// Work on a slice of which these parts are left, the last one first.
    pub fn left(slice: Slice, parts: Vec<Slice>) -> Self {
        Self {
            slice,
            parts,
            running: None,
        }
    }

    /// The slice, and the parts of it that are not finished, the last one first.
    pub fn unfinished(&self) -> (Slice, Vec<Slice>) {
        let running = self.running.as_ref().map(|running| running.part);
        (
            self.slice,
            self.parts.iter().copied().chain(running).collect(),
        )
    }
}

/// A submitted part.
struct Running {
    part: Slice,
    back: Readback,
    reading: Reading,
    started: Instant,
}

impl Renderer {
    /// Adds samples for about [`super::Slicing::target_seconds`]. Does nothing if the render is done.
    ///
    /// # Errors
    /// The device failed or cannot render the scene.
    pub async fn step_async(&mut self) -> Result<(), RenderError> {
        loop {
            self.submit()?;
            let was_running = self.is_running();
            self.finish_work().await?;
            if self.work.is_none() && (was_running || self.is_done()) {
                return Ok(());
            }
        }
    }

    /// Submits the next work unless the GPU is busy or the render is done. Does not wait: [`Self::poll`]
    /// collects the results.
    ///
    /// # Errors
    /// The device failed.
    pub fn submit(&mut self) -> Result<(), RenderError> {
        if self.is_done() || self.submitted().is_some() {
            return Ok(());
        }
        let mut work = match self.work.take() {
            Some(work) => work,
            None => self.plan_slice(),
        };
        let launched = match work.parts.pop() {
            Some(part) => self
                .launch(part)
                .map(Some)
                .inspect_err(|_| work.parts.push(part)),
            None => Ok(None),
        };
        let outcome = launched.map(|running| work.running = running);
        self.work = Some(work);
        outcome
    }

    /// Collects finished work without waiting for the GPU. If the device is lost and belongs to the renderer,
    /// it is replaced first, which takes a moment; in a browser that is an error.
    ///
    /// # Errors
    /// The device failed or cannot render the scene.
    pub fn poll(&mut self) -> Result<Status, RenderError> {
        while let Some(submitted) = self.submitted() {
            match self.device.gpu.is_done(submitted) {
                Ok(false) => return Ok(Status::Working),
                done => self.collect(done.map(drop))?,
            }
        }
        match self.is_done() {
            true => Ok(Status::Done),
            false => Ok(Status::Ready),
        }
    }

    /// Ends when all submitted work has been collected.
    pub(super) async fn finish_work(&mut self) -> Result<(), RenderError> {
        while let Some(submitted) = self.submitted() {
            let outcome = self.device.gpu.done(submitted).await;
            self.collect(outcome)?;
        }
        Ok(())
    }

    /// The work that the GPU is busy with.
    fn submitted(&self) -> Option<&Submitted> {
        let other = self.device.other_work.as_ref();
        let running = self.work.as_ref().and_then(|work| work.running.as_ref());
        (other.map(|other| &other.submitted)).or(running.map(|running| &running.reading.work))
    }

    fn is_running(&self) -> bool {
        (self.work.as_ref()).is_some_and(|work| work.running.is_some())
    }

    /// The next slice.
    fn plan_slice(&mut self) -> Work {
        let tile = &mut self.tiles.list[self.cursor.tile];
        if tile.sums.is_empty() {
            tile.begin_block();
        }
        let group_count = tile.group_count();
        if self.cursor.group == 0 {
            let left = tile.samples.end - self.cursor.sample;
            let in_block = SAMPLE_BLOCK - self.cursor.sample % SAMPLE_BLOCK;
            // A lane whose path ends goes on with its next sample: with more of them lanes wait less for each other.
            // The first picture does not wait for that.
            let wanted = match self.settings.integrator {
                Integrator::Path if self.cursor.sample > 0 => {
                    (self.planner).pass_samples(group_count, PATHS_PER_LANE, self.cursor.sample)
                }
                _ => 1,
            };
            self.cursor.sweep_samples =
                (self.planner).sweep_samples(group_count, wanted, left.min(in_block));
        }
        let Cursor {
            group,
            sample,
            sweep_samples,
            ..
        } = self.cursor;
        let slice = self
            .planner
            .next_slice(group_count, group, sample, sweep_samples);
        Work::left(slice, vec![slice])
    }

    fn launch(&mut self, part: Slice) -> Result<Running, RenderError> {
        let index = self.cursor.tile;
        let back = match self.policy.host_copy {
            true => Readback::Groups,
            false if ends_block(&part, &self.tiles.list[index]) => Readback::Tile,
            false => Readback::Nothing,
        };
        let started = Instant::now();
        let reading = self.surviving_losses(|renderer| {
            let tile = &renderer.tiles.list[index];
            (renderer.device).launch(&part, (index, tile), &renderer.settings, back)
        })?;
        Ok(Running {
            part,
            back,
            reading,
            started,
        })
    }

    /// Collects the results of [`Self::submitted`] work that ended so. After a device loss the work is repeated.
    fn collect(&mut self, outcome: Result<(), GpuError>) -> Result<(), RenderError> {
        let other = self.device.other_work.take();
        if let (Some(other), Ok(())) = (other, &outcome) {
            if other.compiles {
                self.stats.compile_seconds += other.submitted.seconds();
            }
            return Ok(());
        }
        let running = self.work.as_mut().and_then(|work| work.running.take());
        let Some(running) = running else {
            return outcome.or_else(|error| self.recover_from(error));
        };
        let Running {
            part,
            back,
            reading,
            started,
        } = running;
        let seconds = reading.work.seconds_since(started);
        let tile = &mut self.tiles.list[self.cursor.tile];
        let device = &self.device;
        match outcome.and_then(|()| device.finish(reading, &part, tile, back)) {
            Ok(counters) => self.finish_part(part, &counters, seconds),
            Err(error) => {
                self.submit_again(part);
                self.recover_from(error)
            }
        }
    }

    fn submit_again(&mut self, part: Slice) {
        if let Some(work) = &mut self.work {
            work.parts.push(part);
        }
    }

    /// Collects a finished part. A driver may silently stop a dispatch or end the loops of a path. The result
    /// is then discarded, and the work is repeated in smaller parts; if the host has no copy of the sums before
    /// it, the picture restarts with host copies.
    fn finish_part(
        &mut self,
        part: Slice,
        counters: &PackedCounters,
        seconds: f64,
    ) -> Result<(), RenderError> {
        self.stats.submitted(seconds);
        if part.is_complete(counters, self.device.lane_samples) {
            self.planner.learn(&part, seconds);
            self.stats.add(counters);
            if let Some(work) = self.work.take_if(|work| work.parts.is_empty()) {
                self.advance(&work.slice);
            }
            return Ok(());
        }
        self.device.loaded_tile = None;
        if !self.policy.host_copy {
            match self.is_stack_too_small(counters) {
                true => self.enlarge_stack()?,
                false => self.policy.host_copy = true,
            }
            self.tiles = self.new_tiles();
            self.cursor = Cursor::at_start(&self.tiles);
            self.work = None;
            return Ok(());
        }
        let (parts, outcome) = match self.smaller_parts(part, counters) {
            Ok(parts) => (parts, Ok(())),
            // The slice is not finished: a checkpoint has what is left of it.
            Err(error) => (vec![part], Err(error)),
        };
        if let Some(work) = &mut self.work {
            work.parts.extend(parts);
        }
        outcome
    }

    /// Smaller slices that redo a part the driver cut off, in reverse order.
    fn smaller_parts(
        &mut self,
        part: Slice,
        counters: &PackedCounters,
    ) -> Result<Vec<Slice>, RenderError> {
        if !part.is_done(counters, self.device.lane_samples) {
            self.planner.shrink();
            self.stats.count_loss(self.earlier_losses)?;
            Ok(match part.group_halves() {
                Some((first, last)) => vec![last, first],
                None => vec![part],
            })
        } else if self.is_stack_too_small(counters) {
            self.enlarge_stack()?;
            Ok(vec![part])
        } else if self.policy.fetch.allows_packets() && self.device.gpu.traces_packets() {
            // The rays of a packet share the loop limit, and a stack of fixed size. The portable kernels fetch
            // the same data.
            self.policy.fetch = Fetch::Image;
            self.prepare_device(false, 0)?;
            Ok(vec![part])
        } else if self.device.lane_samples > 1 {
            // Several samples of a lane share the limit.
            self.device.lane_samples = 1;
            Ok(vec![part])
        } else if let Some((earlier, later)) = part.sample_halves() {
            self.planner.shorten_paths();
            Ok(vec![later, earlier])
        } else {
            Err(self.path_too_long())
        }
    }

    fn is_stack_too_small(&self, counters: &PackedCounters) -> bool {
        counters.cut_off & CUT_OFF_STACK != 0 && self.policy.stack == Stack::Usual
    }

    fn enlarge_stack(&mut self) -> Result<(), RenderError> {
        self.policy.stack = Stack::Deepest;
        self.prepare_device(false, 0)
    }

    /// The error of a sample that exceeds the driver's loop limit.
    pub(super) fn path_too_long(&self) -> RenderError {
        RenderError::PathTooLong(LongPath::of(&self.scene, &self.view, &self.settings))
    }

    /// Advances the cursor past a finished slice.
    fn advance(&mut self, slice: &Slice) {
        let tile = &mut self.tiles.list[self.cursor.tile];
        self.cursor.group = slice.end_group;
        if self.cursor.group < tile.group_count() {
            return;
        }
        let sample_count = slice.end_sample - slice.first_sample;
        self.stats.samples += u64::from(sample_count) * tile.sampled_pixels();
        self.cursor.group = 0;
        self.cursor.sample = slice.end_sample;
        if self.cursor.sample < tile.samples.end {
            if self.cursor.sample.is_multiple_of(SAMPLE_BLOCK) {
                tile.close_block();
                self.device.loaded_tile = None;
            }
            return;
        }
        self.cursor.tile += 1;
        if self.is_done() && self.tiles.next_round() {
            self.device.loaded_tile = None;
            self.cursor.tile = 0;
        }
        if let Some(next) = self.tiles.list.get(self.cursor.tile) {
            self.cursor.sample = next.samples.start;
        }
    }

    /// Reads back sums that are only on the device, after submitted work has finished.
    pub(super) async fn fetch_film(&mut self) -> Result<(), RenderError> {
        self.finish_work().await?;
        let index = self.cursor.tile;
        let is_there = self.policy.host_copy || self.device.loaded_tile != Some(index);
        match self.tiles.list.get_mut(index) {
            Some(tile) if !is_there => Ok(self.device.fetch_film(tile).await?),
            _ => Ok(()),
        }
    }
}

/// Whether a slice completes the current block, or the tile.
fn ends_block(slice: &Slice, tile: &FilmTile) -> bool {
    let ends_samples =
        slice.end_sample == tile.samples.end || slice.end_sample.is_multiple_of(SAMPLE_BLOCK);
    slice.end_group == tile.group_count() && ends_samples
}
