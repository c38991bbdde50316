//! The renderer: takes a packed scene and a frame, adds samples to the film step by step, and develops the
//! picture. All front ends run this loop.
//!
//! ```
//! use glam::{DVec3, Vec3, dvec3};
//! use glimray_render::gpu::{AdapterChoice, Gpu};
//! use glimray_render::{ExecutionPolicy, RenderSettings, Renderer, Tone, pack};
//! use glimray_scene::{Camera, Geometry, Phong, Scene, Shape};
//! use std::sync::Arc;
//!
//! let bright = Phong { ambient: Vec3::splat(0.75), ..Phong::default() };
//! let scene = Scene {
//!     materials: vec![bright.into()],
//!     shapes: vec![Shape {
//!         name: String::new(),
//!         geometry: Geometry::Sphere { center: DVec3::ZERO, radius: 1.0 },
//!         material: 0,
//!         node: None,
//!     }],
//!     cameras: vec![Camera { look_from: dvec3(0.0, 0.0, 5.0), ..Camera::default() }],
//!     ambient: Vec3::ONE,
//!     ..Scene::default()
//! };
//! let packed = Arc::new(pack::scene(&scene)?);
//! let view = packed.frame(&scene.frame(0.0))?;
//! let settings = RenderSettings { size: (64, 48), ..RenderSettings::default() };
//! let gpu = Gpu::new(&AdapterChoice::default())?;
//! let mut renderer = Renderer::new(gpu, packed, &view, settings, ExecutionPolicy::default())?;
//! while !renderer.is_done() {
//!     renderer.step()?;
//! }
//! let picture = renderer.develop(&Tone::LINEAR)?;
//! assert_eq!(picture.pixels[24 * 64 + 32], [0.75, 0.75, 0.75, 1.0]);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod adaptive;
mod arrays;
mod binary;
mod bindings;
#[cfg(not(target_arch = "wasm32"))]
mod blocking;
pub mod bvh;
mod checkpoint;
mod denoise;
mod develop;
mod device;
mod effort;
mod error;
mod explain;
mod exposure;
mod features;
mod film;
mod film_pass;
mod film_tile;
mod film_tiles;
mod fingerprint;
pub mod gpu;
mod integrator;
mod layers;
pub mod layout;
mod layouts;
mod lecture;
mod levels;
mod losses;
mod luminance;
mod opacity;
mod overrides;
pub mod pack;
mod pipelines;
mod policy;
mod query;
mod settings;
mod show;
mod slice;
mod stats;
mod sums;
mod task;
mod tone;
mod work;

#[cfg(not(target_arch = "wasm32"))]
pub use blocking::denoise;
pub use checkpoint::{Checkpoint, CheckpointError};
pub use denoise::{Denoised, denoise_async};
pub use effort::LongPath;
pub use error::RenderError;
pub use explain::{
    LightSample, LightSource, Lobe, PathStep, PhongTerms, RayHit, RayKind, RaySplit, RayTree,
    SampleTree, ShadowRay, Sharing, StepOutcome, TracedRay,
};
pub use features::{Features, PixelFeatures};
pub use film::{Film, FilmError, FilmHeader, FilmOutline, Missing};
pub use fingerprint::Fingerprint;
pub use glimray_scene::{Antialias, Filter};
pub use integrator::{Integrator, IntegratorEntry, Shows, TABLE as INTEGRATORS};
pub use layers::{Layer, LayerKind};
pub use levels::{Levels, Quantity};
pub use opacity::CatcherLight;
pub use overrides::KERNEL_OVERRIDES;
pub use pipelines::early_module;
pub use policy::{ExecutionPolicy, Fetch, Slicing, Stack, Storage};
pub use query::{Coherence, QueryHit, QueryRay, RayBatch, RayQuery, RaySteps, RayTest};
pub use settings::{BsdfModel, MAX_SIDE, MIN_THROUGHPUT, RayOffset, RenderSettings, TriangleTest};
pub use show::Screen;
pub use stats::{Rays, Stats, Uploads};
pub use sums::SAMPLE_BLOCK;
pub use tone::Tone;
pub use work::Status;

use crate::{
    gpu::{AdapterReport, Gpu, GpuError},
    pack::{PackedScene, PackedView},
};
use denoise::Denoiser;
use device::Device;
use film_tile::GroupOrder;
use film_tiles::FilmTiles;
use glimray_scene::threads;
use losses::or_replacement;
use slice::Planner;
use std::{ops::Range, sync::Arc};
use task::Task;
use work::Work;

/// Renders frames of a scene, one after another. The scene is uploaded once; each frame brings its own camera, lights and
/// positions:
///
/// ```
/// # std::env::set_current_dir(concat!(env!("CARGO_MANIFEST_DIR"), "/../.."))?;
/// use glimray::gpu::{AdapterChoice, Gpu};
/// use glimray::render::{ExecutionPolicy, RenderSettings, Renderer, Tone};
/// use glimray::{import, pack};
/// use std::{path::Path, sync::Arc};
///
/// let scene = import::load(Path::new("assets/scenes/carousel.toml"))?;
/// let packed = Arc::new(pack::scene(&scene)?);
/// let settings = RenderSettings {
///     size: (64, 36),
///     samples: 1,
///     ..RenderSettings::from(&scene.output)
/// };
/// let gpu = Gpu::new(&AdapterChoice::default())?;
/// let first = packed.frame(&scene.frame(0.0))?;
/// let mut renderer = Renderer::new(gpu, packed.clone(), &first, settings, ExecutionPolicy::default())?;
/// let mut pictures = Vec::new();
/// for time in [0.0, 0.5, 1.0] {
///     renderer.set_frame(&packed.frame(&scene.frame(time))?)?;
///     while !renderer.is_done() {
///         // One slice of the work, so that other programs get the GPU in between.
///         renderer.step()?;
///     }
///     pictures.push(renderer.develop(&Tone::from(&scene.output))?);
/// }
/// assert_ne!(pictures[0].pixels, pictures[1].pixels);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub struct Renderer {
    scene: Arc<PackedScene>,
    settings: RenderSettings,
    policy: ExecutionPolicy,
    view: PackedView,
    device: Device,
    tiles: FilmTiles,
    planner: Planner,
    cursor: Cursor,
    /// The current slice.
    work: Option<Work>,
    stats: Stats,
    /// Device losses before the current picture.
    earlier_losses: u32,
}

/// The position of the render: film tile, sweep and workgroup. A sweep visits all workgroups of a tile once,
/// with the same samples.
#[derive(Clone, Copy, Debug, Default)]
struct Cursor {
    tile: usize,
    group: u32,
    sample: u32,
    sweep_samples: u32,
}

impl Cursor {
    fn at_start(tiles: &FilmTiles) -> Self {
        Self {
            sample: tiles.list.first().map_or(0, |tile| tile.samples.start),
            ..Self::default()
        }
    }
}

impl Renderer {
    /// Checks the limits on memory and work, uploads the scene and compiles the kernels. Sizes and counts of
    /// the settings must be in their documented ranges.
    ///
    /// # Errors
    /// The scene or the picture is above a limit, or the device failed.
    pub fn new(
        gpu: Gpu,
        scene: Arc<PackedScene>,
        view: &PackedView,
        settings: RenderSettings,
        policy: ExecutionPolicy,
    ) -> Result<Self, RenderError> {
        effort::check(view, &settings)?;
        lecture::check(&scene, view, &settings)?;
        let view = view.with_aspect(settings.size.0, settings.size.1);
        let order = GroupOrder::of(&gpu);
        let mut tiles = FilmTiles::new(&settings, policy.slicing.tile_side, order);
        let fetch = bindings::choose_fetch(&policy, &gpu, &scene, &view);
        let shown = (&*scene, &view, fetch);
        let mut stats = Stats {
            gpu_bytes: planned_bytes(shown, &settings, &policy, &tiles)?,
            rays: policy.count_rays.then(Rays::default),
            ..Default::default()
        };
        let task = Task {
            scene: &scene,
            view: &view,
            settings: &settings,
            policy: &policy,
            film_rows: tiles.largest(),
        };
        let gpu = gpu.with_limits_for(bindings::needs(&scene, &view, fetch, task.film_rows))?;
        let (choice, can_be_replaced) = (gpu.choice().clone(), gpu.can_be_replaced());
        let device = threads::join(
            || Device::new(gpu, fetch, task, &mut stats),
            || {
                // Otherwise nothing is read back before the end of a block.
                if policy.host_copy {
                    tiles.touch_memory();
                }
            },
        );
        let device = match device {
            // Other code draws with this device and cannot switch to another one.
            Err(GpuError::Lost) if !policy.host_copy || !can_be_replaced => {
                return Err(GpuError::Lost.into());
            }
            device => or_replacement(device, &mut stats, 0, |stats| {
                device::reopen(&choice, fetch, task, stats)
            })?,
        };
        let cursor = Cursor::at_start(&tiles);
        Ok(Self {
            planner: Planner::new(policy.slicing, order, effort::shadow_rays(&view, &settings)),
            scene,
            settings,
            policy,
            view,
            device,
            tiles,
            cursor,
            work: None,
            stats,
            earlier_losses: 0,
        })
    }

    /// Restarts with another frame of the same scene.
    ///
    /// # Errors
    /// The device failed, or the frame exceeds the memory limit or the limits of the adapter.
    pub fn set_frame(&mut self, view: &PackedView) -> Result<(), RenderError> {
        self.restart(self.scene.clone(), view, self.settings.clone(), self.policy)
    }

    /// Restarts with another scene, frame or other settings. Compiled kernels and unchanged data on the device
    /// are reused.
    ///
    /// # Errors
    /// As [`Renderer::new`]; the renderer can be restarted again afterwards.
    pub fn restart(
        &mut self,
        scene: Arc<PackedScene>,
        view: &PackedView,
        settings: RenderSettings,
        policy: ExecutionPolicy,
    ) -> Result<(), RenderError> {
        effort::check(view, &settings)?;
        lecture::check(&scene, view, &settings)?;
        self.work = None;
        let view = view.with_aspect(settings.size.0, settings.size.1);
        let order = GroupOrder::of(&self.device.gpu);
        let tiles = FilmTiles::new(&settings, policy.slicing.tile_side, order);
        let fetch = bindings::choose_fetch(&policy, &self.device.gpu, &scene, &view);
        let shown = (&*scene, &view, fetch);
        let bytes = planned_bytes(shown, &settings, &policy, &tiles)?;
        self.stats.gpu_bytes = self.stats.gpu_bytes.max(bytes);
        self.earlier_losses = self.stats.device_losses;
        if policy.count_rays {
            self.stats.rays.get_or_insert_default();
        }
        let shadow_rays = effort::shadow_rays(&view, &settings);
        let planner = Planner::new(policy.slicing, order, shadow_rays);
        if policy.slicing != self.policy.slicing || planner.is_for_more_work_than(&self.planner) {
            self.planner = planner;
        }
        let is_other_scene = !Arc::ptr_eq(&scene, &self.scene);
        let policy = match is_other_scene {
            true => policy,
            // Rays of this scene may have needed more entries before.
            false => ExecutionPolicy {
                stack: policy.stack.max(self.policy.stack),
                ..policy
            },
        };
        (self.scene, self.view, self.settings, self.policy) = (scene, view, settings, policy);
        self.cursor = Cursor::at_start(&tiles);
        self.tiles = tiles;
        let spare = self.policy.memory_limit_bytes.saturating_sub(bytes);
        self.prepare_device(is_other_scene, spare)
    }

    /// Changes the number of samples and keeps those already taken: sample `i` of a pixel does not depend on
    /// their total. Returns whether that is possible; if not, nothing changes. It is impossible with adaptive
    /// sampling, with several film tiles, or if at least this many samples have been started.
    pub fn continue_to(&mut self, samples: u32) -> bool {
        let Cursor {
            group,
            sample,
            sweep_samples,
            ..
        } = self.cursor;
        let started = if group > 0 {
            sample + sweep_samples
        } else {
            sample
        };
        let is_done = self.is_done();
        if !self.tiles.is_one_rectangle() || samples <= started {
            return false;
        }
        let tile = &mut self.tiles.list[0];
        if is_done {
            // As between two sweeps (see `advance`); the sums are on the host.
            if sample.is_multiple_of(SAMPLE_BLOCK) {
                tile.close_block();
                self.device.loaded_tile = None;
            }
            (self.cursor.tile, self.cursor.group) = (0, 0);
        }
        tile.samples.end = samples;
        self.settings.samples = samples;
        true
    }

    /// Goes on with another packing of the same scene and frame, as [`crate::pack::refined`] gives it for a draft. All
    /// samples are kept, so that a film or checkpoint of this picture has samples of both packings, and the fingerprint of
    /// this one. `policy` is the one that the picture was started with.
    ///
    /// # Errors
    /// As [`Renderer::new`]; the renderer can be restarted afterwards.
    pub async fn replace_scene_async(
        &mut self,
        scene: Arc<PackedScene>,
        view: &PackedView,
        policy: ExecutionPolicy,
    ) -> Result<(), RenderError> {
        let view = view.with_aspect(self.settings.size.0, self.settings.size.1);
        self.fetch_film().await?;
        let fetch = bindings::choose_fetch(&policy, &self.device.gpu, &scene, &view);
        let shown = (&*scene, &view, fetch);
        let bytes = planned_bytes(shown, &self.settings, &policy, &self.tiles)?;
        self.stats.gpu_bytes = self.stats.gpu_bytes.max(bytes);
        (self.scene, self.view, self.policy) = (scene, view, policy);
        let spare = self.policy.memory_limit_bytes.saturating_sub(bytes);
        self.prepare_device(true, spare)
    }

    /// Updates the device for the current task. Up to `spare` bytes may be allocated beyond what is needed.
    fn prepare_device(&mut self, is_other_scene: bool, spare: u64) -> Result<(), RenderError> {
        let (gpu, scene, view) = (&self.device.gpu, &self.scene, &self.view);
        let fetch = match is_other_scene {
            true => bindings::choose_fetch(&self.policy, gpu, scene, view),
            false => self.device.fetch,
        };
        let needs = bindings::needs(scene, view, fetch, self.tiles.largest());
        if !gpu.meets(needs) {
            gpu.check_limits(needs)?;
            let fetch = bindings::choose_fetch(&self.policy, gpu, scene, view);
            return self.replace_device(fetch);
        }
        self.surviving_losses(|renderer| {
            let task = Task {
                scene: &renderer.scene,
                view: &renderer.view,
                settings: &renderer.settings,
                policy: &renderer.policy,
                film_rows: renderer.tiles.largest(),
            };
            let (device, stats) = (&mut renderer.device, &mut renderer.stats);
            if fetch != device.fetch {
                *device = Device::new(device.gpu.clone(), fetch, task, stats)?;
                return Ok(());
            }
            device.set(task, spare, stats)
        })
    }

    /// Where its kernels read the scene from.
    pub fn storage(&self) -> Storage {
        match self.device.fetch {
            Fetch::Image => Storage::Image,
            _ => Storage::Buffer,
        }
    }

    /// The device that it renders on.
    pub fn gpu(&self) -> &Gpu {
        &self.device.gpu
    }

    /// Film tiles without samples.
    fn new_tiles(&self) -> FilmTiles {
        let order = GroupOrder::of(self.gpu());
        FilmTiles::new(&self.settings, self.policy.slicing.tile_side, order)
    }

    /// Whether every pixel has all its samples.
    pub fn is_done(&self) -> bool {
        self.cursor.tile >= self.tiles.list.len()
    }

    /// Completed fraction of the work, in 0..=1.
    pub fn progress(&self) -> f64 {
        let Some(tile) = self.tiles.list.get(self.cursor.tile) else {
            return 1.0;
        };
        let sweep = f64::from(self.cursor.sweep_samples) * f64::from(self.cursor.group)
            / f64::from(tile.group_count());
        let Range { start, end } = tile.samples;
        let within = (f64::from(self.cursor.sample - start) + sweep) / f64::from(end - start);
        let fraction = (self.cursor.tile as f64 + within) / self.tiles.list.len() as f64;
        self.tiles.progress(fraction)
    }

    /// Statistics of the render so far.
    pub fn stats(&self) -> &Stats {
        &self.stats
    }

    /// The adapter in use.
    pub fn adapter(&self) -> &AdapterReport {
        self.device.gpu.adapter()
    }
}

/// The memory needed for a frame, in bytes.
///
/// # Errors
/// The memory exceeds the limit of the policy.
fn planned_bytes(
    (scene, view, fetch): (&PackedScene, &PackedView, Fetch),
    settings: &RenderSettings,
    policy: &ExecutionPolicy,
    tiles: &FilmTiles,
) -> Result<u64, GpuError> {
    let [.., width, height] = settings.region();
    let pixels = u64::from(width) * u64::from(height);
    let mut ledger = bindings::ledger(scene, view, fetch, tiles.largest(), pixels);
    if tiles.has_totals() {
        ledger.plan(
            "totals of the film",
            pixels * size_of::<[i128; 4]>() as u64 * tiles.rows_per_pixel() as u64,
        );
    }
    if settings.has_features() {
        ledger.plan(
            "denoised picture",
            pixels * Denoiser::pixel_bytes(settings.has_opacity()),
        );
    }
    ledger.check(policy.memory_limit_bytes)?;
    Ok(ledger.total())
}
