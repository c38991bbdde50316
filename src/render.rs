//! The renderer: takes a packed scene and a frame, adds samples to the film step by step, and
//! develops the picture. Every front end runs this same loop.

mod adaptive;
mod bindings;
mod debug_view;
mod develop;
mod device;
mod film;
mod settings;
mod slice;
mod whitted;

pub use crate::scene::{Antialias, Filter};
pub use develop::Tone;
pub use settings::{Fetch, Integrator, MIN_THROUGHPUT, Settings, Slicing, TriangleTest};

use crate::{
    gpu::{AdapterReport, Gpu, GpuError},
    layout::PackedSlice,
    pack::{PackedScene, PackedView},
};
use device::{Device, Task};
use film::{CHUNK, Film};
use slice::{Planner, Slice};
use std::{ops::Range, sync::Arc, time::Instant};

/// How often a lost device is replaced before a picture is given up.
const MAX_LOSSES: u32 = 3;

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

/// What a render has cost so far.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Stats {
    /// Making pipelines and running each once with nothing to do, when drivers compile.
    pub compile_seconds: f64,
    /// Copying the scene to the device, again after a loss.
    pub upload_seconds: f64,
    /// Tracing, from submission to the copy of the film, whatever came of it.
    pub trace_seconds: f64,
    /// Developing, each time it was asked for.
    pub develop_seconds: f64,
    /// Submissions that traced.
    pub submissions: u64,
    /// The longest of them, in milliseconds.
    pub longest_submission_ms: f64,
    /// Samples that were dropped: with them a sum would be infinite or not a number.
    pub nonfinite_samples: u64,
    /// Samples whose ray tree outgrew its stack or had too many rays; what was cut off is missing
    /// in the picture.
    pub cut_off_trees: u64,
    /// Planned memory in bytes, of the frame that takes most; see [`Settings::memory_limit_bytes`].
    pub gpu_bytes: u64,
    /// How often the device was lost and replaced.
    pub device_losses: u32,
    /// Camera rays whose sum is in the film.
    pub samples: u64,
    /// Kept with [`Settings::count_rays`].
    pub rays: Option<Rays>,
}

/// Rays by kind. Shadow rays count one for each light, or sample of a light with extent, that the
/// surface faces.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Rays {
    /// From the camera, one for each sample.
    pub primary: u64,
    /// Those that hit something.
    pub primary_hits: u64,
    /// To lights.
    pub shadow: u64,
    /// Those that hit something before the light.
    pub shadow_blocked: u64,
    /// Mirrored.
    pub reflection: u64,
    /// Those that hit something.
    pub reflection_hits: u64,
    /// Refracted.
    pub refraction: u64,
    /// Those that hit something.
    pub refraction_hits: u64,
}

/// Why a picture cannot be rendered.
#[derive(Debug, thiserror::Error)]
pub enum RenderError {
    /// The device or its driver failed.
    #[error(transparent)]
    Gpu(#[from] GpuError),
    /// The driver ended a shader's loops early, even with one sample in an invocation.
    #[error(
        "too much work in one pixel (lights, or primitives with --no-bvh): this driver ends a shader's loops after 65,535 rounds, and the picture would be wrong. Use fewer lights, or leave out --no-bvh."
    )]
    PathTooLong,
}

impl RenderError {
    /// The process's exit code for this error.
    pub fn exit_code(&self) -> u8 {
        match self {
            Self::Gpu(error) => error.exit_code(),
            Self::PathTooLong => 7,
        }
    }
}

impl Stats {
    fn submitted(&mut self, seconds: f64) {
        self.trace_seconds += seconds;
        self.submissions += 1;
        self.longest_submission_ms = self.longest_submission_ms.max(seconds * 1e3);
    }

    /// Adds the accounts of a slice.
    fn add(&mut self, tally: &PackedSlice) {
        self.nonfinite_samples += u64::from(tally.nonfinite_samples);
        self.cut_off_trees += u64::from(tally.cut_off_trees);
        if let Some(rays) = &mut self.rays {
            rays.primary += u64::from(tally.primary);
            rays.primary_hits += u64::from(tally.primary_hits);
            rays.shadow += u64::from(tally.shadow);
            rays.shadow_blocked += u64::from(tally.shadow_blocked);
            rays.reflection += u64::from(tally.reflection);
            rays.reflection_hits += u64::from(tally.reflection_hits);
            rays.refraction += u64::from(tally.refraction);
            rays.refraction_hits += u64::from(tally.refraction_hits);
        }
    }

    /// Counts a failure of the device; too many of them in one picture, before which there were
    /// `earlier` ones, are the end.
    fn count_loss(&mut self, earlier: u32) -> Result<(), RenderError> {
        self.device_losses += 1;
        let count = self.device_losses - earlier;
        if count > MAX_LOSSES {
            return Err(GpuError::KeptFailing { count }.into());
        }
        Ok(())
    }
}

impl Renderer {
    /// Checks the memory limit, uploads the scene and compiles the kernels. The settings' sizes and
    /// counts must be in the ranges they document.
    pub fn new(
        gpu: Gpu,
        scene: Arc<PackedScene>,
        view: &PackedView,
        settings: Settings,
    ) -> Result<Self, RenderError> {
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
        let device = or_replacement(device, &mut stats, 0, |stats| {
            device::reopen(&choice, fetch, task, stats)
        })?;
        Ok(Self {
            planner: Planner::new(settings.slicing),
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
        let view = view.with_aspect(self.settings.size.0, self.settings.size.1);
        let film = Film::new(&self.settings);
        let bytes = planned_bytes(&self.scene, &view, &self.settings, &film)?;
        self.stats.gpu_bytes = self.stats.gpu_bytes.max(bytes);
        self.earlier_losses = self.stats.device_losses;
        self.view = view;
        self.film = film;
        self.cursor = Cursor::default();
        let (scene, view, film_rows) = (&self.scene, &self.view, self.film.largest_window());
        let needs = bindings::needs(scene, view, self.device.fetch, film_rows);
        if !self.device.gpu.serves(needs) {
            let fetch = bindings::choose_fetch(self.settings.fetch, &self.device.gpu, scene, view);
            return self.replace_device(fetch);
        }
        self.surviving_losses(|renderer| {
            let task = Task {
                scene: &renderer.scene,
                view: &renderer.view,
                settings: &renderer.settings,
                film_rows: renderer.film.largest_window(),
            };
            renderer.device.set_view(task, &mut renderer.stats)
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
        self.run(slice)?;
        self.advance(&slice);
        Ok(())
    }

    /// Runs a slice, in parts if it must be: a driver may stop a dispatch, or end the loops of a
    /// path, without a word. What it did then is thrown away.
    fn run(&mut self, slice: Slice) -> Result<(), RenderError> {
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
                return Err(RenderError::PathTooLong);
            }
        }
        Ok(())
    }

    fn advance(&mut self, slice: &Slice) {
        let window = &mut self.film.windows[self.cursor.window];
        self.cursor.tile = slice.end_tile;
        if self.cursor.tile < window.tile_count() {
            return;
        }
        let taken = slice.end_sample - slice.first_sample;
        self.stats.samples += u64::from(taken) * window.sampled_pixels();
        self.cursor.tile = 0;
        self.cursor.sample = slice.end_sample;
        if self.cursor.sample < window.samples.end {
            if self.cursor.sample.is_multiple_of(CHUNK) {
                window.close_chunk();
                self.device.loaded_window = None;
            }
            return;
        }
        self.cursor.window += 1;
        if self.is_done() && self.film.next_round() {
            self.device.loaded_window = None;
            self.cursor.window = 0;
        }
        if let Some(next) = self.film.windows.get(self.cursor.window) {
            self.cursor.sample = next.samples.start;
        }
    }

    /// Repeats `attempt` on a fresh device when the old one is lost. The film on the host holds all
    /// finished slices, so nothing else is done twice.
    fn surviving_losses<T>(
        &mut self,
        mut attempt: impl FnMut(&mut Self) -> Result<T, GpuError>,
    ) -> Result<T, RenderError> {
        loop {
            match attempt(self) {
                Err(GpuError::Lost) => {
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
