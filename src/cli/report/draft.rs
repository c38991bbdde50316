//! What is known of a run while it goes on. A run that fails has this as its report, with the error;
//! what it did not get to is null.

use crate::app::error::AppError;
use crate::app::inputs::Inputs;
use crate::cli::args::{LogFlags, SceneFlags};
use crate::cli::report::{Adapter, ImageReport, Report, SceneReport, Seconds, host_peak_bytes};
use crate::cli::scene_file;
use crate::scene::Scene;
use serde_json::{Value, json};
use std::fs;
use std::path::{Path, PathBuf};
use std::time::Instant;

/// Longer files are no reports.
const MAX_REPORT_BYTES: u64 = 1 << 20;

/// The report of a run that is going on.
pub struct Draft<'a> {
    /// The command's name.
    pub command: &'static str,
    pub log: &'a LogFlags,
    /// When the process began.
    pub started: Instant,
    /// The scene's name.
    pub scene_path: String,
    /// What the run has read so far.
    pub inputs: Inputs,
    pub seconds: Seconds,
    pub adapter: Option<Adapter>,
    /// Where the pictures go.
    image_path: PathBuf,
    image: Option<ImageReport>,
    /// `None` until the scene is read, and with it the names of all that it reads.
    scene: Option<SceneReport>,
}

impl<'a> Draft<'a> {
    /// Of a run that is to read a scene called `scene_path` and to write to `image_path`, which is not
    /// where the report goes.
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
            image_path: image_path.into(),
            image: None,
            scene: None,
        }
    }

    /// Reads the scene.
    ///
    /// # Errors
    /// Those of [`scene_file::load`].
    pub fn load(&mut self, path: &Path, flags: &SceneFlags) -> Result<Scene, AppError> {
        let loading = Instant::now();
        let (scene, inputs) = scene_file::load(path, flags);
        self.inputs = inputs;
        let scene = scene?;
        self.seconds.load = loading.elapsed().as_secs_f64();
        self.read(&scene);
        Ok(scene)
    }

    /// Takes note of what is in the scene, all of which is read by now.
    pub fn read(&mut self, scene: &Scene) {
        self.scene = Some(SceneReport::new(&self.scene_path, scene));
    }

    /// Takes note of what is to be rendered.
    pub fn plan(&mut self, image: ImageReport) {
        self.image = Some(image);
    }

    /// Passes `outcome` on. Of a failure a report is written, if the flags ask for one and nothing else
    /// is lost by it.
    pub fn close(self, outcome: Result<(), AppError>) -> Result<(), AppError> {
        if let Err(error) = &outcome
            && let Some(path) = &self.log.report
            && self.may_replace(path)
        {
            // What ended the run is told; that its report could not be written either adds nothing.
            let _ = crate::cli::report::write(path, &self.failed(error));
        }
        outcome
    }

    /// Whether what is at `path` can be given up. As long as a scene is not read as a whole, it is not
    /// known which files it names, and only an old report is safe to replace.
    fn may_replace(&self, path: &Path) -> bool {
        !self.inputs.contain(path) && (self.scene.is_some() || is_free(path) || is_report(path))
    }

    fn failed(&self, error: &AppError) -> Value {
        let scene = match &self.scene {
            Some(scene) => json!(scene),
            None => json!({
                "path": self.scene_path, "spheres": null, "triangles": null, "shapes": null,
                "instances": null, "materials": null, "lights": null, "skipped": null,
            }),
        };
        let mut image = match &self.image {
            Some(image) => json!(image),
            None => json!({
                "path": self.image_path.display().to_string(), "width": null, "height": null,
                "samples": null, "integrator": null, "max_depth": null, "seed": null,
            }),
        };
        image["mean_samples"] = Value::Null;
        let mut seconds = json!(self.seconds);
        for part in seconds.as_object_mut().into_iter().flatten() {
            // What took no time at all was not reached.
            if *part.1 == json!(0.0) {
                *part.1 = Value::Null;
            }
        }
        seconds["total"] = json!(self.started.elapsed().as_secs_f64());
        let mut report = json!({
            "glimray": Report::VERSION,
            "command": self.command,
            "scene": scene,
            "image": image,
            "adapter": self.adapter,
            "seconds": seconds,
            "rays": null,
            "submissions": { "count": null, "longest_ms": null },
            "nonfinite_samples": null,
            "cut_off_trees": null,
            "memory": { "gpu_bytes": null, "host_peak_bytes": host_peak_bytes() },
            "error": { "message": error.to_string(), "code": error.exit_code() },
        });
        if matches!(self.command, "animate" | "turntable") {
            report["animation"] = Value::Null;
        }
        report
    }
}

/// Whether there is nothing at `path` that could be lost: no file, or a pipe or a device.
fn is_free(path: &Path) -> bool {
    path == Path::new("-") || fs::metadata(path).map_or(true, |found| !found.is_file())
}

/// Whether the file at `path` is a report that an earlier run wrote.
fn is_report(path: &Path) -> bool {
    let is_short = fs::metadata(path).is_ok_and(|found| found.len() <= MAX_REPORT_BYTES);
    let text = is_short.then(|| fs::read(path).ok()).flatten();
    let value: Option<Value> = text.and_then(|text| serde_json::from_slice(&text).ok());
    value.is_some_and(|value| value["glimray"].is_string() && value["command"].is_string())
}
