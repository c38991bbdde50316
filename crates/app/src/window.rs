//! Requests of the command line to the window.

use super::error::AppError;
use super::overrides::RenderOverrides;
use glimray_io::import;
use glimray_render::ExecutionPolicy;
use glimray_render::gpu::AdapterChoice;
use glimray_scene::Scene;
use std::path::PathBuf;

/// The functions of the window that the command line calls.
pub struct Window {
    /// Whether there is a display.
    pub has_display: fn() -> bool,
    /// Opens it, and returns when it is closed.
    pub open: fn(ViewRequest) -> Result<(), AppError>,
    /// Measures the time to the first picture; returns JSON and a line of text.
    pub bench: fn(BenchRequest) -> Result<(serde_json::Value, String), AppError>,
}

/// The arguments of the window.
#[derive(Clone, Debug)]
pub struct ViewRequest {
    /// The scene's file; `None` is the built-in scene.
    pub scene: Option<PathBuf>,
    /// Overrides of the scene's values.
    pub overrides: RenderOverrides,
    /// Import options.
    pub import: import::Options,
    /// Recording or replay of input.
    pub recording: RecordingRequest,
    /// The adapter.
    pub adapter: AdapterChoice,
    /// How renders use it.
    pub policy: ExecutionPolicy,
    /// Reads command lines that are pasted into the window.
    pub parse: ParsePicture,
}

/// Reads the arguments of a `glimray render` or `glimray animate` command line. The error is one line.
pub type ParsePicture = fn(&[String]) -> Result<PictureRequest, String>;

/// The picture that a command line describes.
#[derive(Clone, Debug, PartialEq)]
pub struct PictureRequest {
    /// The scene's file.
    pub scene: PathBuf,
    /// Overrides of the scene's values.
    pub overrides: RenderOverrides,
}

/// Recording and replaying input.
#[derive(Clone, Debug, Default)]
pub struct RecordingRequest {
    /// Write input events to this file.
    pub record: Option<PathBuf>,
    /// Replay the input events of this file.
    pub replay: Option<PathBuf>,
    /// Replay one recorded frame per frame, as fast as possible.
    pub is_fast: bool,
    /// Close the window after the replay.
    pub closes: bool,
}

/// How the window is measured.
#[derive(Clone, Debug)]
pub struct BenchRequest {
    /// Runs; the median counts.
    pub repeats: u32,
    /// The adapter.
    pub adapter: AdapterChoice,
    /// How renders use it.
    pub policy: ExecutionPolicy,
    /// A scene of at least 600 instances.
    pub crowd: Scene,
}

/// The median of measurements; NaN of none.
pub fn median(mut values: Vec<f64>) -> f64 {
    values.sort_by(f64::total_cmp);
    let middle = values.len() / 2;
    match values.len() {
        0 => f64::NAN,
        count if count % 2 == 1 => values[middle],
        _ => (values[middle - 1] + values[middle]) / 2.0,
    }
}
