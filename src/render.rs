//! The renderer: takes a packed scene and a frame, adds samples to the film step by step, and
//! develops the picture. Every front end runs this same loop.

mod adaptive;
mod arrays;
mod bindings;
mod develop;
mod device;
mod effort;
mod error;
mod explain;
mod film;
mod fingerprint;
mod integrator;
mod layers;
mod layouts;
mod levels;
mod losses;
mod overrides;
mod pipelines;
mod policy;
mod settings;
mod show;
mod slice;
mod stats;
mod sums;
mod task;
mod window;
mod windows;
mod work;

pub use crate::scene::{Antialias, Filter};
pub use develop::Tone;
pub use effort::LongPath;
pub use error::RenderError;
pub use explain::{RayHit, RayKind, RaySplit, RayTree, SampleTree, ShadowRay, TracedRay};
pub use film::{Film, FilmError, FilmHeader, Missing};
pub use fingerprint::Fingerprint;
pub use integrator::{Integrator, IntegratorEntry, Shows, TABLE as INTEGRATORS};
pub use layers::{Layer, LayerKind};
pub use levels::{Levels, Quantity};
pub use policy::{ExecutionPolicy, Fetch, Slicing};
pub use settings::{MIN_THROUGHPUT, RayOffset, RenderSettings, TriangleTest};
pub use show::Screen;
pub use stats::{Rays, Stats, Uploads};
pub use sums::SAMPLE_BLOCK;
pub use work::Status;

use crate::{
    gpu::{AdapterReport, Gpu, GpuError},
    pack::{PackedScene, PackedView},
};
use device::Device;
use losses::or_replacement;
use slice::Planner;
use std::{ops::Range, sync::Arc};
use task::Task;
use windows::Windows;
use work::Work;

/// Renders one frame after another of one scene.
pub struct Renderer {
    scene: Arc<PackedScene>,
    settings: RenderSettings,
    policy: ExecutionPolicy,
    view: PackedView,
    device: Device,
    windows: Windows,
    planner: Planner,
    cursor: Cursor,
    /// The slice that is under way.
    work: Option<Work>,
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

impl Cursor {
    fn at_start(windows: &Windows) -> Self {
        Self {
            sample: windows
                .list
                .first()
                .map_or(0, |window| window.samples.start),
            ..Self::default()
        }
    }
}

impl Renderer {
    /// Checks the limits of memory and of work, uploads the scene and compiles the kernels. The settings' sizes and
    /// counts must be in the ranges they document.
    pub fn new(
        gpu: Gpu,
        scene: Arc<PackedScene>,
        view: &PackedView,
        settings: RenderSettings,
        policy: ExecutionPolicy,
    ) -> Result<Self, RenderError> {
        effort::check(view, &settings)?;
        let view = view.with_aspect(settings.size.0, settings.size.1);
        let windows = Windows::new(&settings, policy.slicing.window_side);
        let mut stats = Stats {
            gpu_bytes: planned_bytes(&scene, &view, settings.region(), &policy, &windows)?,
            rays: policy.count_rays.then(Rays::default),
            ..Default::default()
        };
        let task = Task {
            scene: &scene,
            view: &view,
            settings: &settings,
            policy: &policy,
            film_rows: windows.largest(),
        };
        let fetch = bindings::choose_fetch(policy.fetch, &gpu, &scene, &view);
        let gpu = gpu.serving(bindings::needs(&scene, &view, fetch, task.film_rows))?;
        let (choice, is_own) = (gpu.choice().clone(), gpu.is_own());
        let device = Device::new(gpu, fetch, task, &mut stats);
        let device = match device {
            // Others draw with this device, and cannot with another.
            Err(GpuError::Lost) if !policy.host_copy || !is_own => {
                return Err(GpuError::Lost.into());
            }
            device => or_replacement(device, &mut stats, 0, |stats| {
                device::reopen(&choice, fetch, task, stats)
            })?,
        };
        let cursor = Cursor::at_start(&windows);
        Ok(Self {
            planner: Planner::new(policy.slicing, effort::shadow_rays(&view, &settings)),
            scene,
            settings,
            policy,
            view,
            device,
            windows,
            cursor,
            work: None,
            stats,
            earlier_losses: 0,
        })
    }

    /// Starts over with another frame of the same scene.
    ///
    /// # Errors
    /// The device failed, or the frame places more than the memory limit or the adapter allows.
    pub fn set_frame(&mut self, view: &PackedView) -> Result<(), RenderError> {
        self.restart(self.scene.clone(), view, self.settings.clone(), self.policy)
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
        settings: RenderSettings,
        policy: ExecutionPolicy,
    ) -> Result<(), RenderError> {
        effort::check(view, &settings)?;
        self.work = None;
        let view = view.with_aspect(settings.size.0, settings.size.1);
        let windows = Windows::new(&settings, policy.slicing.window_side);
        let bytes = planned_bytes(&scene, &view, settings.region(), &policy, &windows)?;
        self.stats.gpu_bytes = self.stats.gpu_bytes.max(bytes);
        self.earlier_losses = self.stats.device_losses;
        if policy.count_rays {
            self.stats.rays.get_or_insert_default();
        }
        let planner = Planner::new(policy.slicing, effort::shadow_rays(&view, &settings));
        if policy.slicing != self.policy.slicing || planner.is_for_more_work_than(&self.planner) {
            self.planner = planner;
        }
        let is_other_scene = !Arc::ptr_eq(&scene, &self.scene);
        (self.scene, self.view, self.settings, self.policy) = (scene, view, settings, policy);
        self.cursor = Cursor::at_start(&windows);
        self.windows = windows;
        let spare = self.policy.memory_limit_bytes.saturating_sub(bytes);
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
        if !self.windows.is_one_rectangle() || samples <= begun {
            return false;
        }
        let window = &mut self.windows.list[0];
        if is_done {
            // As between any two sweeps, see `advance`; the sums are on the host.
            if sample.is_multiple_of(SAMPLE_BLOCK) {
                window.close_block();
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
            true => bindings::choose_fetch(self.policy.fetch, gpu, scene, view),
            false => self.device.fetch,
        };
        let needs = bindings::needs(scene, view, fetch, self.windows.largest());
        if !gpu.serves(needs) {
            gpu.check_limits(needs)?;
            let fetch = bindings::choose_fetch(self.policy.fetch, gpu, scene, view);
            return self.replace_device(fetch);
        }
        self.surviving_losses(|renderer| {
            let task = Task {
                scene: &renderer.scene,
                view: &renderer.view,
                settings: &renderer.settings,
                policy: &renderer.policy,
                film_rows: renderer.windows.largest(),
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
        self.cursor.window >= self.windows.list.len()
    }

    /// Fraction of the work that is done, in 0..=1.
    pub fn progress(&self) -> f64 {
        let Some(window) = self.windows.list.get(self.cursor.window) else {
            return 1.0;
        };
        let sweep = f64::from(self.cursor.sweep_samples) * f64::from(self.cursor.tile)
            / f64::from(window.tile_count());
        let Range { start, end } = window.samples;
        let within = (f64::from(self.cursor.sample - start) + sweep) / f64::from(end - start);
        let fraction = (self.cursor.window as f64 + within) / self.windows.list.len() as f64;
        self.windows.progress(fraction)
    }

    /// What the render has cost so far.
    pub fn stats(&self) -> &Stats {
        &self.stats
    }

    /// The adapter in use.
    pub fn adapter(&self) -> &AdapterReport {
        self.device.gpu.adapter()
    }
}

/// What a frame will take, in bytes.
///
/// # Errors
/// It is more than the policy allows.
fn planned_bytes(
    scene: &PackedScene,
    view: &PackedView,
    [.., width, height]: [u32; 4],
    policy: &ExecutionPolicy,
    windows: &Windows,
) -> Result<u64, GpuError> {
    let pixels = u64::from(width) * u64::from(height);
    let mut ledger = bindings::ledger(scene, view, windows.largest(), pixels);
    if windows.has_totals() {
        ledger.plan("totals of the film", pixels * size_of::<[i128; 4]>() as u64);
    }
    ledger.check(policy.memory_limit_bytes)?;
    Ok(ledger.total())
}
