//! The renderer: takes a packed scene and a frame, adds samples to the film step by step, and
//! develops the picture. Every front end runs this same loop.

mod adaptive;
mod arrays;
mod bindings;
mod debug_view;
mod develop;
mod device;
mod effort;
mod error;
mod explain;
mod film;
mod layers;
mod layouts;
mod levels;
mod settings;
mod show;
mod slice;
mod stats;
mod whitted;

pub use crate::scene::{Antialias, Filter};
pub use develop::Tone;
pub use effort::LongPath;
pub use error::RenderError;
pub use explain::{RayHit, RayKind, RaySplit, RayTree, SampleTree, ShadowRay, TracedRay};
pub use levels::{Levels, Quantity};
pub use settings::{Fetch, Integrator, MIN_THROUGHPUT, Settings, Slicing, TriangleTest};
pub use show::Screen;
pub use stats::{Rays, Stats, Uploads};

use crate::clock::Instant;
use crate::{
    gpu::{AdapterReport, Gpu, GpuError},
    pack::{PackedScene, PackedView},
};
use device::{Device, Task};
use film::{CHUNK, Film};
use slice::{Planner, Slice};
use std::{ops::Range, sync::Arc};

/// Renders one frame after another of one scene.
pub struct Renderer {
    scene: Arc<PackedScene>,
    settings: Settings,
    view: PackedView,
    device: Device,
    film: Film,
    planner: Planner,
    cursor: Cursor,
    stats: Stats,
    /// Losses before the picture that is under way.
    earlier_losses: u32,
}

/// How far the render is: the tile and the samples of the sweep that is under way.
#[derive(Clone, Copy, Debug, Default)]
struct Cursor {
    window: usize,
    tile: u32,
    sample: u32,
    sweep_samples: u32,
}

impl Renderer {
    /// Checks the limits of memory and of work, uploads the scene and compiles the kernels. The settings' sizes and
    /// counts must be in the ranges they document.
    pub fn new(
        gpu: Gpu,
        scene: Arc<PackedScene>,
        view: &PackedView,
        settings: Settings,
    ) -> Result<Self, RenderError> {
        effort::check(view, &settings)?;
        let view = view.with_aspect(settings.size.0, settings.size.1);
        let film = Film::new(&settings);
        let mut stats = Stats {
            gpu_bytes: planned_bytes(&scene, &view, &settings, &film)?,
            rays: settings.count_rays.then(Rays::default),
            ..Default::default()
        };
        let task = Task {
            scene: &scene,
            view: &view,
            settings: &settings,
            film_rows: film.largest_window(),
        };
        let fetch = bindings::choose_fetch(settings.fetch, &gpu, &scene, &view);
        let gpu = gpu.serving(bindings::needs(&scene, &view, fetch, task.film_rows))?;
        let choice = gpu.choice().clone();
        let device = Device::new(gpu, fetch, task, &mut stats);
        let device = match device {
            // Others draw with this device, and cannot with another.
            Err(GpuError::Lost) if !settings.slicing.host_copy => return Err(GpuError::Lost.into()),
            device => or_replacement(device, &mut stats, 0, |stats| {
                device::reopen(&choice, fetch, task, stats)
            })?,
        };
        Ok(Self {
            planner: Planner::new(settings.slicing, effort::shadow_rays(&view, &settings)),
            scene,
            settings,
            view,
            device,
            film,
            cursor: Cursor::default(),
            stats,
            earlier_losses: 0,
        })
    }

    /// Starts over with another frame of the same scene.
    ///
    /// # Errors
    /// The device failed, or the frame places more than the memory limit or the adapter allows.
    pub fn set_frame(&mut self, view: &PackedView) -> Result<(), RenderError> {
        self.restart(self.scene.clone(), view, self.settings.clone())
    }

    /// Starts over with another scene, frame or other settings. Kernels that are compiled, and what
    /// is on the device and still serves, are kept.
    ///
    /// # Errors
    /// Those of [`Renderer::new`]; the renderer can be restarted again after them.
    pub fn restart(
        &mut self,
        scene: Arc<PackedScene>,
        view: &PackedView,
        settings: Settings,
    ) -> Result<(), RenderError> {
        effort::check(view, &settings)?;
        let view = view.with_aspect(settings.size.0, settings.size.1);
        let film = Film::new(&settings);
        let bytes = planned_bytes(&scene, &view, &settings, &film)?;
        self.stats.gpu_bytes = self.stats.gpu_bytes.max(bytes);
        self.earlier_losses = self.stats.device_losses;
        if settings.count_rays {
            self.stats.rays.get_or_insert_default();
        }
        let planner = Planner::new(settings.slicing, effort::shadow_rays(&view, &settings));
        if settings.slicing != self.settings.slicing || planner.is_for_more_work_than(&self.planner)
        {
            self.planner = planner;
        }
        let is_other_scene = !Arc::ptr_eq(&scene, &self.scene);
        (self.scene, self.view, self.settings) = (scene, view, settings);
        self.film = film;
        self.cursor = Cursor::default();
        let spare = self.settings.memory_limit_bytes.saturating_sub(bytes);
        self.prepare_device(is_other_scene, spare)
    }

    /// Goes on to another number of samples with those that there are: sample `i` of a pixel is the same,
    /// however many follow. Whether that is possible; if not, nothing changes. It is not where sampling
    /// plans ahead (adaptive), where windows take turns, or where there are as many already.
    pub fn continue_to(&mut self, samples: u32) -> bool {
        let Cursor {
            tile,
            sample,
            sweep_samples,
            ..
        } = self.cursor;
        let begun = if tile > 0 {
            sample + sweep_samples
        } else {
            sample
        };
        let is_done = self.is_done();
        if !self.film.is_one_rectangle() || samples <= begun {
            return false;
        }
        let window = &mut self.film.windows[0];
        if is_done {
            // As between any two sweeps, see `advance`; the sums are on the host.
            if sample.is_multiple_of(CHUNK) {
                window.close_chunk();
                self.device.loaded_window = None;
            }
            (self.cursor.window, self.cursor.tile) = (0, 0);
        }
        window.samples.end = samples;
        self.settings.samples = samples;
        true
    }

    /// Brings the device to what is to be rendered. `spare` bytes may be allocated beyond what is needed.
    fn prepare_device(&mut self, is_other_scene: bool, spare: u64) -> Result<(), RenderError> {
        let (gpu, scene, view) = (&self.device.gpu, &self.scene, &self.view);
        let fetch = match is_other_scene {
            true => bindings::choose_fetch(self.settings.fetch, gpu, scene, view),
            false => self.device.fetch,
        };
        let needs = bindings::needs(scene, view, fetch, self.film.largest_window());
        if !gpu.serves(needs) {
            gpu.check_limits(needs)?;
            let fetch = bindings::choose_fetch(self.settings.fetch, gpu, scene, view);
            return self.replace_device(fetch);
        }
        self.surviving_losses(|renderer| {
            let task = Task {
                scene: &renderer.scene,
                view: &renderer.view,
                settings: &renderer.settings,
                film_rows: renderer.film.largest_window(),
            };
            let (device, stats) = (&mut renderer.device, &mut renderer.stats);
            if fetch != device.fetch {
                *device = Device::new(device.gpu.clone(), fetch, task, stats)?;
                return Ok(());
            }
            device.set(task, spare, stats)
        })
    }

    /// Whether every pixel has its samples.
    pub fn is_done(&self) -> bool {
        self.cursor.window >= self.film.windows.len()
    }

    /// Share of the work that is done, in 0..=1.
    pub fn progress(&self) -> f64 {
        let Some(window) = self.film.windows.get(self.cursor.window) else {
            return 1.0;
        };
        let sweep = f64::from(self.cursor.sweep_samples) * f64::from(self.cursor.tile)
            / f64::from(window.tile_count());
        let Range { start, end } = window.samples;
        let within = (f64::from(self.cursor.sample - start) + sweep) / f64::from(end - start);
        let share = (self.cursor.window as f64 + within) / self.film.windows.len() as f64;
        self.film.progress(share)
    }

    /// What the render has cost so far.
    pub fn stats(&self) -> &Stats {
        &self.stats
    }

    /// The adapter in use.
    pub fn adapter(&self) -> &AdapterReport {
        self.device.gpu.adapter()
    }

    /// Adds samples for about [`Slicing::target_seconds`]. Does nothing when the render is done.
    pub fn step(&mut self) -> Result<(), RenderError> {
        let Some(window) = self.film.windows.get_mut(self.cursor.window) else {
            return Ok(());
        };
        if window.sums.is_empty() {
            window.begin();
        }
        let tile_count = window.tile_count();
        if self.cursor.tile == 0 {
            let left = window.samples.end - self.cursor.sample;
            let in_chunk = CHUNK - self.cursor.sample % CHUNK;
            self.cursor.sweep_samples = self.planner.sweep_samples(tile_count, left.min(in_chunk));
        }
        let Cursor {
            tile,
            sample,
            sweep_samples,
            ..
        } = self.cursor;
        let slice = self.planner.next(tile_count, tile, sample, sweep_samples);
        if self.run(slice)? {
            self.advance(&slice)?;
        }
        Ok(())
    }

    /// Runs a slice, in parts if it must be: a driver may stop a dispatch, or end the loops of a
    /// path, without a word. What it did then is thrown away; where the host has no copy of what was
    /// there before, the picture starts over, with copies. Returns whether the slice is done.
    fn run(&mut self, slice: Slice) -> Result<bool, RenderError> {
        let mut parts = vec![slice];
        while let Some(part) = parts.pop() {
            let start = Instant::now();
            let tally = self.surviving_losses(|renderer| {
                let index = renderer.cursor.window;
                let window = &mut renderer.film.windows[index];
                let device = &mut renderer.device;
                device.trace(&part, (index, window), &renderer.settings)
            })?;
            let seconds = start.elapsed().as_secs_f64();
            self.stats.submitted(seconds);
            if part.is_complete(&tally) {
                self.planner.finished(&part, seconds);
                self.stats.add(&tally);
                continue;
            }
            self.device.loaded_window = None;
            if !self.settings.slicing.host_copy {
                self.settings.slicing.host_copy = true;
                self.film = Film::new(&self.settings);
                self.cursor = Cursor::default();
                return Ok(false);
            }
            if !part.is_signed_off(&tally) {
                self.planner.cut_short();
                self.stats.count_loss(self.earlier_losses)?;
                match part.tile_halves() {
                    Some((first, last)) => parts.extend([last, first]),
                    None => parts.push(part),
                }
            } else if let Some((earlier, later)) = part.sample_halves() {
                self.planner.shorten_paths();
                parts.extend([later, earlier]);
            } else {
                return Err(self.path_too_long());
            }
        }
        Ok(true)
    }

    /// The error of a sample that the driver's loops are too short for.
    fn path_too_long(&self) -> RenderError {
        RenderError::PathTooLong(LongPath::of(&self.scene, &self.view, &self.settings))
    }

    fn advance(&mut self, slice: &Slice) -> Result<(), RenderError> {
        let window = &self.film.windows[self.cursor.window];
        self.cursor.tile = slice.end_tile;
        if self.cursor.tile < window.tile_count() {
            return Ok(());
        }
        if slice.end_sample == window.samples.end || slice.end_sample.is_multiple_of(CHUNK) {
            self.fetch_film()?;
        }
        let window = &mut self.film.windows[self.cursor.window];
        let taken = slice.end_sample - slice.first_sample;
        self.stats.samples += u64::from(taken) * window.sampled_pixels();
        self.cursor.tile = 0;
        self.cursor.sample = slice.end_sample;
        if self.cursor.sample < window.samples.end {
            if self.cursor.sample.is_multiple_of(CHUNK) {
                window.close_chunk();
                self.device.loaded_window = None;
            }
            return Ok(());
        }
        self.cursor.window += 1;
        if self.is_done() && self.film.next_round() {
            self.device.loaded_window = None;
            self.cursor.window = 0;
        }
        if let Some(next) = self.film.windows.get(self.cursor.window) {
            self.cursor.sample = next.samples.start;
        }
        Ok(())
    }

    /// Brings the sums to the host that are only on the device.
    fn fetch_film(&mut self) -> Result<(), RenderError> {
        let index = self.cursor.window;
        let is_there = self.settings.slicing.host_copy || self.device.loaded_window != Some(index);
        match self.film.windows.get_mut(index) {
            Some(window) if !is_there => Ok(self.device.fetch_film(window)?),
            _ => Ok(()),
        }
    }

    /// Repeats `attempt` on a fresh device when the old one is lost. The film on the host holds all
    /// finished slices, so nothing else is done twice; where it does not, the loss is the caller's.
    fn surviving_losses<T>(
        &mut self,
        mut attempt: impl FnMut(&mut Self) -> Result<T, GpuError>,
    ) -> Result<T, RenderError> {
        loop {
            match attempt(self) {
                Err(GpuError::Lost) if self.settings.slicing.host_copy => {
                    self.stats.count_loss(self.earlier_losses)?;
                    self.replace_device(self.device.fetch)?;
                }
                other => return Ok(other?),
            }
        }
    }

    /// Goes on with a device whose limits serve the view.
    fn replace_device(&mut self, fetch: Fetch) -> Result<(), RenderError> {
        let choice = self.device.gpu.choice().clone();
        let task = Task {
            scene: &self.scene,
            view: &self.view,
            settings: &self.settings,
            film_rows: self.film.largest_window(),
        };
        let reopen = |stats: &mut Stats| device::reopen(&choice, fetch, task, stats);
        let device = reopen(&mut self.stats);
        self.device = or_replacement(device, &mut self.stats, self.earlier_losses, reopen)?;
        Ok(())
    }
}

/// The device, or another one if it was lost while it was made; that may be lost in turn.
fn or_replacement(
    mut device: Result<Device, GpuError>,
    stats: &mut Stats,
    earlier_losses: u32,
    mut reopen: impl FnMut(&mut Stats) -> Result<Device, GpuError>,
) -> Result<Device, RenderError> {
    while let Err(GpuError::Lost) = device {
        stats.count_loss(earlier_losses)?;
        device = reopen(stats);
    }
    Ok(device?)
}

/// What a frame will take, in bytes.
///
/// # Errors
/// It is more than the settings allow.
fn planned_bytes(
    scene: &PackedScene,
    view: &PackedView,
    settings: &Settings,
    film: &Film,
) -> Result<u64, GpuError> {
    let [.., width, height] = settings.region();
    let pixels = u64::from(width) * u64::from(height);
    let ledger = bindings::ledger(scene, view, film.largest_window(), pixels);
    ledger.check(settings.memory_limit_bytes)?;
    Ok(ledger.total())
}
