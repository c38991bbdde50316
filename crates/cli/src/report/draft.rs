//! The report of a run in progress. If the run fails, this is its report, with the error; values that are not
//! known yet are null.

use crate::args::LogFlags;
use crate::report::{
    Adapter, AnyReport, FailedReport, FetchReport, ImageReport, SceneReport, Seconds,
};
use crate::scene_file;
use glimray_app::error::AppError;
use glimray_app::inputs::Inputs;
use glimray_io::import::Options;
use glimray_render::CatcherLight;
use glimray_scene::Scene;
use serde_json::Value;
use std::fs;
use std::path::{Path, PathBuf};
use std::time::Instant;

/// Files longer than this are not taken for reports.
const MAX_REPORT_BYTES: u64 = 1 << 20;

/// The report of a run in progress.
pub struct Draft<'a> {
    /// Name of the command.
    pub command: &'static str,
    pub log: &'a LogFlags,
    /// When the process began.
    pub started: Instant,
    /// Name of the scene.
    pub scene_path: String,
    /// Files that the run has read so far.
    pub inputs: Inputs,
    pub seconds: Seconds,
    pub adapter: Option<Adapter>,
    pub fetch: Option<FetchReport>,
    pub catcher_light: CatcherLight,
    /// The share of the work that was in a checkpoint at the start, if there was one.
    pub resumed: Option<f64>,
    /// Output path.
    pub(super) image_path: PathBuf,
    pub(super) image: Option<ImageReport>,
    /// `None` until the scene and all its files are read.
    pub(super) scene: Option<SceneReport>,
}

impl<'a> Draft<'a> {
    /// Starts the report of a run that reads the scene `scene_path` and writes to `image_path`, which differs
    /// from the report's own path.
    pub fn new(
        command: &'static str,
        log: &'a LogFlags,
        scene_path: String,
        image_path: &Path,
        started: Instant,
    ) -> Self {
        Self {
            command,
            log,
            started,
            scene_path,
            inputs: Inputs::default(),
            seconds: Seconds::default(),
            adapter: None,
            fetch: None,
            catcher_light: CatcherLight::default(),
            resumed: None,
            image_path: image_path.into(),
            image: None,
            scene: None,
        }
    }

    /// Reads the scene.
    ///
    /// # Errors
    /// Errors of [`scene_file::load`].
    pub fn load(
        &mut self,
        path: &Path,
        options: &Options,
        is_strict: bool,
    ) -> Result<Scene, AppError> {
        let loading = Instant::now();
        let (scene, inputs) = scene_file::load(path, options, is_strict);
        self.inputs = inputs;
        let scene = scene?;
        self.seconds.load = loading.elapsed().as_secs_f64();
        self.set_scene(&scene);
        Ok(scene)
    }

    /// Records the contents of the scene, which is completely read by now.
    pub fn set_scene(&mut self, scene: &Scene) {
        self.scene = Some(SceneReport::new(&self.scene_path, scene));
    }

    /// Records the picture to be rendered.
    pub fn set_image(&mut self, image: ImageReport) {
        self.image = Some(image);
    }

    /// Returns `outcome`. If it is an error, writes the report if one was requested and no other file would be
    /// overwritten.
    pub fn finish(self, outcome: Result<(), AppError>) -> Result<(), AppError> {
        if let Err(error) = &outcome
            && let Some(path) = &self.log.report
            && self.may_replace(path)
        {
            // The run's own error matters more than a failure to write its report.
            let report = FailedReport::new(&self, error);
            let _ = crate::report::write(path, AnyReport::Failed(&report));
        }
        outcome
    }

    /// Whether the file at `path` may be replaced. Until the scene is completely read, the files that it names
    /// are unknown, and only an old report is safe to replace.
    fn may_replace(&self, path: &Path) -> bool {
        !self.inputs.contain(path) && (self.scene.is_some() || is_free(path) || is_report(path))
    }
}

/// Whether nothing at `path` could be lost: there is no file, or a pipe or a device.
fn is_free(path: &Path) -> bool {
    path == Path::new("-") || fs::metadata(path).map_or(true, |found| !found.is_file())
}

/// Whether the file at `path` is the report of an earlier run.
fn is_report(path: &Path) -> bool {
    let is_short = fs::metadata(path).is_ok_and(|found| found.len() <= MAX_REPORT_BYTES);
    let text = is_short.then(|| fs::read(path).ok()).flatten();
    let value: Option<Value> = text.and_then(|text| serde_json::from_slice(&text).ok());
    value.is_some_and(|value| value["glimray"].is_string() && value["command"].is_string())
}
