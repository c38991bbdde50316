//! The report of a run, for programs. Fields are promises: add to them, rename nothing.

mod draft;

pub use draft::Draft;

use crate::app::console;
use crate::app::error::AppError;
use crate::gpu::AdapterReport;
use crate::output;
use crate::render::{Rays, Stats};
use crate::scene::{Geometry, Scene};
use serde::Serialize;
use std::path::Path;

/// What a command did and what it took.
#[derive(Debug, Serialize)]
pub struct Report {
    /// The program's version.
    pub glimray: &'static str,
    /// The command's name.
    pub command: &'static str,
    pub scene: SceneReport,
    pub image: ImageReport,
    /// Null where none was needed.
    pub adapter: Option<Adapter>,
    pub seconds: Seconds,
    /// Absent unless they were to be counted.
    pub rays: Option<RayCounts>,
    pub submissions: Submissions,
    /// Samples that were dropped because they were infinite or no number.
    pub nonfinite_samples: u64,
    /// Samples whose ray tree was cut off: it outgrew its stack, had too many rays, or a ray that came into
    /// too many bodies at once.
    pub cut_off_trees: u64,
    pub memory: Memory,
    /// Of `animate` and `turntable`.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub animation: Option<AnimationReport>,
    /// Null here; the report of a run that failed says what ended it (see [`Draft`]).
    pub error: Option<()>,
}

impl Report {
    /// The program's version.
    pub const VERSION: &str = env!("CARGO_PKG_VERSION");
}

/// The frames, and the video if there is one.
#[derive(Debug, Serialize)]
pub struct AnimationReport {
    /// Number of the first frame.
    pub first: u32,
    /// Number of the last frame.
    pub last: u32,
    /// From one frame's number to the next one's.
    pub step: u32,
    /// Frames in the range.
    pub frames: usize,
    /// Frame n is at n / `fps` seconds.
    pub fps: f64,
    /// When the shutter opens and closes, in frames from a frame's own time.
    pub shutter: [f64; 2],
    /// Frames that this run rendered.
    pub rendered: usize,
    /// Frames that an earlier run had rendered.
    pub reused: usize,
    /// Why frames were rendered again.
    pub redone: Vec<Redone>,
    /// The frames' names with their placeholder; null where none are kept.
    pub frame_files: Option<String>,
    /// Null where there is none; `-` is the standard output.
    pub video: Option<String>,
    /// Writing the video; 0 without one.
    pub encode_seconds: f64,
    /// Rendered frames for each second that it took to compile, upload, render and write them; null
    /// when there were none.
    pub frames_per_second: Option<f64>,
}

/// Frames that were there but could not be used.
#[derive(Debug, Serialize)]
pub struct Redone {
    /// Such as "the scene has changed".
    pub why: &'static str,
    /// Their numbers.
    pub frames: Vec<u32>,
}

/// How much is in the scene.
#[derive(Debug, Serialize)]
pub struct SceneReport {
    pub path: String,
    pub spheres: usize,
    /// Instances counted each.
    pub triangles: usize,
    /// Analytic shapes that are no spheres.
    pub shapes: usize,
    /// Placements of meshes.
    pub instances: usize,
    pub materials: usize,
    pub lights: usize,
    /// What the importer left out or repaired.
    pub skipped: Vec<String>,
}

/// The picture and the settings that determine it.
#[derive(Debug, Serialize)]
pub struct ImageReport {
    /// `-` for the standard output.
    pub path: String,
    pub width: u32,
    pub height: u32,
    /// Those allowed for each pixel.
    pub samples: u32,
    /// Those taken, on average over the pixels.
    pub mean_samples: f64,
    pub integrator: &'static str,
    /// Bounces after the first hit.
    pub max_depth: u32,
    pub seed: u32,
}

#[derive(Debug, Serialize)]
pub struct Adapter {
    pub name: String,
    pub backend: String,
    pub driver: String,
    pub device_type: String,
}

/// Wall-clock seconds. `total` is from the start of the process to the file on disk; the others are
/// parts of it that do not overlap.
#[derive(Clone, Debug, Default, Serialize)]
pub struct Seconds {
    pub total: f64,
    /// Reading the scene.
    pub load: f64,
    /// Building the tree.
    pub bvh: f64,
    /// Opening the adapter.
    pub gpu: f64,
    /// Compiling shaders.
    pub compile: f64,
    pub upload: f64,
    pub trace: f64,
    /// Exposure, tone curve, transfer, and reading the picture back.
    pub develop: f64,
    /// Encoding the picture and writing the file.
    pub write: f64,
}

#[derive(Debug, Serialize)]
pub struct RayCounts {
    pub primary: u64,
    pub primary_hits: u64,
    /// One for each light sample that faces the surface.
    pub shadow: u64,
    pub shadow_blocked: u64,
    /// Mirrored.
    pub reflection: u64,
    pub reflection_hits: u64,
    /// Refracted.
    pub refraction: u64,
    pub refraction_hits: u64,
}

#[derive(Debug, Serialize)]
pub struct Submissions {
    pub count: u64,
    pub longest_ms: f64,
}

#[derive(Debug, Serialize)]
pub struct Memory {
    pub gpu_bytes: u64,
    /// Null where the system does not tell.
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

/// Writes a report to `path`; `-` is the standard output.
///
/// # Errors
/// It cannot be written there.
pub fn write(path: &Path, report: &impl Serialize) -> Result<(), AppError> {
    let mut text = serde_json::to_string_pretty(report)
        .map_err(|error| AppError::Internal(format!("report: {error}")))?;
    text.push('\n');
    if path == Path::new("-") {
        console::print_bytes(text.as_bytes())
    } else {
        Ok(output::write(path, text.as_bytes(), true)?)
    }
}

/// The most memory that this process has held at once, in bytes, where Linux says so.
pub fn host_peak_bytes() -> Option<u64> {
    let status = std::fs::read_to_string(Path::new("/proc/self/status")).ok()?;
    let line = status
        .lines()
        .find_map(|line| line.strip_prefix("VmHWM:"))?;
    let kibibytes: u64 = line.trim().strip_suffix("kB")?.trim().parse().ok()?;
    Some(kibibytes << 10)
}
