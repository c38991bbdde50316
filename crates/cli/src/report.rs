//! The JSON report of a run. Its fields are a stable interface: add to them, rename none.

mod draft;
mod failed;
mod settings;

pub use draft::Draft;
pub use failed::FailedReport;
pub use settings::SettingsReport;

use glimray_app::console;
use glimray_app::error::AppError;
use glimray_app::storage::{self, Reason};
use glimray_io::output;
use glimray_render::gpu::AdapterReport;
use glimray_render::{Rays, Renderer, Stats, Storage};
use glimray_scene::text;
use glimray_scene::{Geometry, Scene};
use schemars::JsonSchema;
use serde::Serialize;
use std::path::Path;

/// The report that `--report` writes.
#[derive(Debug, Serialize, JsonSchema)]
#[serde(untagged)]
pub enum AnyReport<'a> {
    Done(&'a Report),
    Failed(&'a FailedReport<'a>),
}

/// Inputs, settings and measurements of a run.
#[derive(Debug, Serialize, JsonSchema)]
pub struct Report {
    /// Version of the program.
    pub glimray: &'static str,
    /// Name of the command.
    pub command: &'static str,
    pub scene: SceneReport,
    pub image: ImageReport,
    /// Null if no adapter was needed.
    pub adapter: Option<Adapter>,
    /// Null if nothing was rendered.
    pub fetch: Option<FetchReport>,
    pub seconds: Seconds,
    /// Null without `--count-rays`.
    pub rays: Option<RayCounts>,
    pub submissions: Submissions,
    /// Samples that were dropped because they were infinite or NaN.
    pub nonfinite_samples: u64,
    /// Samples whose ray tree was truncated: it overflowed its stack, had too many rays, or had a ray inside
    /// too many transparent objects at once.
    pub cut_off_trees: u64,
    /// Number of paths; present for path-traced pictures, as the next.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub paths: Option<u64>,
    /// The estimated share of the light that the limit of bounces and clamps removed.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub energy_cut: Option<f64>,
    /// The share of the light on shadow catchers that the cap of single samples removed; present where they are seen and lit.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub catcher_cut: Option<f64>,
    pub memory: Memory,
    /// The share of the work that was in the checkpoint from which the run went on, 0 to 1; absent without one.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub resumed: Option<f64>,
    /// Present for `animate` and `turntable`.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub animation: Option<AnimationReport>,
    /// Present for `sheet`.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub sheet: Option<SheetReport>,
    /// Null; the report of a failed run has the error here.
    pub error: (),
}

impl Report {
    /// Version of the program.
    pub const VERSION: &str = env!("CARGO_PKG_VERSION");
}

/// Statistics of an animation's frames and video.
#[derive(Debug, Serialize, JsonSchema)]
pub struct AnimationReport {
    /// Number of the first frame.
    pub first: u32,
    /// Number of the last frame.
    pub last: u32,
    /// Difference between consecutive frame numbers.
    pub step: u32,
    /// Number of frames in the range.
    pub frames: usize,
    /// Frame n is at n / `fps` seconds.
    pub fps: f64,
    /// Shutter opening and closing times, in frames relative to a frame's time.
    pub shutter: [f64; 2],
    /// Number of frames that this run rendered.
    pub rendered: usize,
    /// Number of frames reused from an earlier run.
    pub reused: usize,
    /// Frames that were rendered again, by reason.
    pub redone: Vec<Redone>,
    /// Name pattern of the frame files; null if none are kept.
    pub frame_files: Option<String>,
    /// Path of the video; null if there is none, `-` for standard output.
    pub video: Option<String>,
    /// Time to encode the video; 0 without a video.
    pub encode_seconds: f64,
    /// Rendered frames per second of compiling, uploading, rendering and writing; null if no frame was
    /// rendered.
    pub frames_per_second: Option<f64>,
}

/// The views of a sheet.
#[derive(Debug, Serialize, JsonSchema)]
pub struct SheetReport {
    pub views: Vec<SheetView>,
    /// Width and height of each in pixels.
    pub side: u32,
    /// Length of the scale bar in scene units.
    pub scale_bar: f64,
}

#[derive(Debug, Serialize, JsonSchema)]
pub struct SheetView {
    /// As `--views` takes it.
    pub name: &'static str,
    /// Column of its upper left pixel in the sheet.
    pub x: u32,
    /// Row of its upper left pixel in the sheet.
    pub y: u32,
    /// The scale; null for a view in perspective.
    pub units_per_pixel: Option<f64>,
}

/// Existing frames that could not be reused.
#[derive(Debug, Serialize, JsonSchema)]
pub struct Redone {
    /// The reason, such as "the scene has changed".
    pub why: &'static str,
    /// Frame numbers.
    pub frames: Vec<u32>,
}

/// Counts of the scene's contents.
#[derive(Debug, Serialize, JsonSchema)]
pub struct SceneReport {
    pub path: String,
    pub spheres: usize,
    /// Triangles of all instances.
    pub triangles: usize,
    /// Analytic shapes other than spheres.
    pub shapes: usize,
    /// Mesh instances.
    pub instances: usize,
    pub materials: usize,
    pub lights: usize,
    /// Parts of the file that the importer skipped or repaired.
    pub skipped: Vec<String>,
}

/// The picture and its main settings.
#[derive(Debug, Serialize, JsonSchema)]
pub struct ImageReport {
    /// `-` for standard output.
    pub path: String,
    pub width: u32,
    pub height: u32,
    #[serde(flatten)]
    pub settings: SettingsReport,
    /// Mean number of samples per pixel that were taken; null if the run failed.
    pub mean_samples: Option<f64>,
    /// Whether the picture is denoised.
    pub denoise: bool,
}

#[derive(Debug, Serialize, JsonSchema)]
pub struct Adapter {
    pub name: String,
    pub backend: String,
    pub driver: String,
    pub device_type: String,
}

/// Where kernels read the scene from.
#[derive(Clone, Debug, Serialize, JsonSchema)]
pub struct FetchReport {
    /// "image" or "buffer".
    pub storage: &'static str,
    /// Why: "device_type", "environment" or "limits".
    pub reason: Reason,
}

impl FetchReport {
    /// The storage of a renderer, if the environment requested one or none.
    pub fn new(renderer: &Renderer, requested: Option<Storage>) -> Self {
        let used = renderer.storage();
        Self {
            storage: storage::name(used),
            reason: Reason::of(used, requested, Storage::usual(renderer.gpu())),
        }
    }

    /// For people.
    pub fn sentence(&self) -> String {
        let (storage, why) = (self.storage, self.reason.phrase());
        format!("the scene is read from {storage}s, {why}")
    }
}

/// Wall-clock times in seconds. `total` runs from the start of the process until the file is on disk; the
/// others are parts of it that do not overlap.
#[derive(Clone, Debug, Default, Serialize, JsonSchema)]
pub struct Seconds<T = f64> {
    pub total: T,
    /// Reading the scene.
    pub load: T,
    /// Building the BVH.
    pub bvh: T,
    /// Opening the adapter.
    pub gpu: T,
    /// Compiling shaders.
    pub compile: T,
    pub upload: T,
    pub trace: T,
    /// Exposure, tone curve, transfer function and reading the picture back.
    pub develop: T,
    /// Denoising; present for path-traced and for denoised pictures.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub denoise: Option<T>,
    /// Encoding and writing the file.
    pub write: T,
}

#[derive(Debug, Serialize, JsonSchema)]
pub struct RayCounts {
    pub primary: u64,
    pub primary_hits: u64,
    /// One per light sample that faces the surface.
    pub shadow: u64,
    pub shadow_blocked: u64,
    pub reflection: u64,
    pub reflection_hits: u64,
    pub refraction: u64,
    pub refraction_hits: u64,
}

#[derive(Debug, Serialize, JsonSchema)]
pub struct Submissions {
    pub count: u64,
    pub longest_ms: f64,
}

#[derive(Debug, Serialize, JsonSchema)]
pub struct Memory {
    pub gpu_bytes: u64,
    /// Null if the system does not report it.
    pub host_peak_bytes: Option<u64>,
}

impl SceneReport {
    pub fn new(path: &str, scene: &Scene) -> Self {
        let is_sphere = |geometry| matches!(geometry, Geometry::Sphere { .. });
        let shapes = scene.shapes.iter();
        let spheres = shapes.filter(|shape| is_sphere(shape.geometry)).count();
        Self {
            path: path.into(),
            spheres,
            triangles: scene.triangle_count(),
            shapes: scene.shapes.len() - spheres,
            instances: scene.instances.len(),
            materials: scene.materials.len(),
            lights: scene.lights.len(),
            skipped: scene.skipped.clone(),
        }
    }
}

impl From<&AdapterReport> for Adapter {
    fn from(adapter: &AdapterReport) -> Self {
        Self {
            name: adapter.name.clone(),
            backend: adapter.backend.clone(),
            driver: adapter.driver.clone(),
            device_type: adapter.device_type.clone(),
        }
    }
}

impl From<&Rays> for RayCounts {
    fn from(rays: &Rays) -> Self {
        Self {
            primary: rays.primary,
            primary_hits: rays.primary_hits,
            shadow: rays.shadow,
            shadow_blocked: rays.shadow_blocked,
            reflection: rays.reflection,
            reflection_hits: rays.reflection_hits,
            refraction: rays.refraction,
            refraction_hits: rays.refraction_hits,
        }
    }
}

impl From<&Stats> for Submissions {
    fn from(stats: &Stats) -> Self {
        Self {
            count: stats.submissions,
            longest_ms: stats.longest_submission_ms,
        }
    }
}

/// Writes a report to `path`; `-` is standard output.
///
/// # Errors
/// The report cannot be written.
pub fn write(path: &Path, report: AnyReport) -> Result<(), AppError> {
    let text = text(report)?;
    if path == Path::new("-") {
        console::print_bytes(text.as_bytes())
    } else {
        Ok(output::write(path, text.as_bytes(), true)?)
    }
}

/// A report as JSON.
///
/// # Errors
/// A bug: reports can be written as JSON.
pub fn text(report: AnyReport) -> Result<String, AppError> {
    let mut text = serde_json::to_string_pretty(&report)
        .map_err(|error| AppError::Internal(format!("report: {error}")))?;
    text.push('\n');
    Ok(text::escape_json(&text))
}

/// Peak resident memory of this process in bytes. Only Linux reports it.
pub fn host_peak_bytes() -> Option<u64> {
    let status = std::fs::read_to_string(Path::new("/proc/self/status")).ok()?;
    let line = status
        .lines()
        .find_map(|line| line.strip_prefix("VmHWM:"))?;
    let kibibytes: u64 = line.trim().strip_suffix("kB")?.trim().parse().ok()?;
    Some(kibibytes << 10)
}
