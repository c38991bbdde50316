//! What the command line asks of the window.

use super::error::AppError;
use super::overrides::RenderOverrides;
use crate::gpu::AdapterChoice;
use crate::import;
use crate::render::ExecutionPolicy;
use crate::scene::Scene;
use std::path::PathBuf;

/// The window as the command line sees it.
pub struct Window {
    /// Whether there is a display to open it on.
    pub has_display: fn() -> bool,
    /// Opens it, and returns when it is closed.
    pub open: fn(ViewRequest) -> Result<(), AppError>,
    /// Measures how soon it shows a picture: as JSON, and as a line for people.
    pub bench: fn(BenchRequest) -> Result<(serde_json::Value, String), AppError>,
}

/// What the window is opened with.
#[derive(Clone, Debug)]
pub struct ViewRequest {
    /// The scene's file; `None` is the built-in scene.
    pub scene: Option<PathBuf>,
    /// What the user asks for in place of what the scene says.
    pub overrides: RenderOverrides,
    /// How scenes are read.
    pub import: import::Options,
    /// What is recorded or replayed.
    pub recording: RecordingRequest,
    /// The adapter.
    pub adapter: AdapterChoice,
    /// How pictures are made on it.
    pub policy: ExecutionPolicy,
    /// Reads command lines that are pasted into the window.
    pub parse: ParsePicture,
}

/// Reads the words of a `glimray render` or `glimray animate` command line. The error is one line.
pub type ParsePicture = fn(&[String]) -> Result<PictureRequest, String>;

/// The picture that a command line asks for.
#[derive(Clone, Debug, PartialEq)]
pub struct PictureRequest {
    /// The scene's file.
    pub scene: PathBuf,
    /// What it asks for in place of what the scene says.
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
    /// How pictures are made on it.
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
