//! The report of a run that failed.

use crate::report::{
    Adapter, Draft, FetchReport, ImageReport, Report, SceneReport, Seconds, SettingsReport,
    host_peak_bytes,
};
use glimray_app::error::AppError;
use schemars::JsonSchema;
use serde::Serialize;

/// The report of a run that failed: what the run had not come to is null.
#[derive(Debug, Serialize, JsonSchema)]
pub struct FailedReport<'a> {
    /// Version of the program.
    glimray: &'static str,
    /// Name of the command.
    command: &'static str,
    scene: SceneOf<'a>,
    image: ImageOf<'a>,
    adapter: Option<&'a Adapter>,
    fetch: Option<&'a FetchReport>,
    seconds: Seconds<Option<f64>>,
    rays: (),
    submissions: NoSubmissions,
    nonfinite_samples: (),
    cut_off_trees: (),
    memory: HostMemory,
    /// The share of the work that was in the checkpoint from which the run went on, 0 to 1; absent without one.
    #[serde(skip_serializing_if = "Option::is_none")]
    resumed: Option<f64>,
    /// Present for `animate` and `turntable`.
    #[serde(skip_serializing_if = "Option::is_none")]
    animation: Option<()>,
    /// Present for `sheet`.
    #[serde(skip_serializing_if = "Option::is_none")]
    sheet: Option<()>,
    error: Failure,
}

/// Why a run failed.
#[derive(Debug, Serialize, JsonSchema)]
struct Failure {
    message: String,
    /// The exit code.
    code: u8,
}

/// The scene, if it was read.
#[derive(Debug, Serialize, JsonSchema)]
#[serde(untagged)]
enum SceneOf<'a> {
    Read(&'a SceneReport),
    Unread {
        path: &'a str,
        spheres: (),
        triangles: (),
        shapes: (),
        instances: (),
        materials: (),
        lights: (),
        skipped: (),
    },
}

/// The picture, if its settings were known.
#[derive(Debug, Serialize, JsonSchema)]
#[serde(untagged)]
enum ImageOf<'a> {
    Known(&'a ImageReport),
    Unknown {
        path: String,
        width: (),
        height: (),
        #[serde(flatten)]
        settings: SettingsReport,
        mean_samples: (),
        denoise: (),
    },
}

#[derive(Debug, Serialize, JsonSchema)]
struct NoSubmissions {
    count: (),
    longest_ms: (),
}

#[derive(Debug, Serialize, JsonSchema)]
struct HostMemory {
    gpu_bytes: (),
    /// Null if the system does not report it.
    host_peak_bytes: Option<u64>,
}

impl<'a> FailedReport<'a> {
    pub fn new(draft: &'a Draft, error: &AppError) -> Self {
        let scene = match &draft.scene {
            Some(scene) => SceneOf::Read(scene),
            None => SceneOf::Unread {
                path: &draft.scene_path,
                spheres: (),
                triangles: (),
                shapes: (),
                instances: (),
                materials: (),
                lights: (),
                skipped: (),
            },
        };
        let image = match &draft.image {
            Some(image) => ImageOf::Known(image),
            None => ImageOf::Unknown {
                path: draft.image_path.display().to_string(),
                width: (),
                height: (),
                settings: SettingsReport::default(),
                mean_samples: (),
                denoise: (),
            },
        };
        Self {
            glimray: Report::VERSION,
            command: draft.command,
            scene,
            image,
            adapter: draft.adapter.as_ref(),
            fetch: draft.fetch.as_ref(),
            seconds: Seconds {
                total: Some(draft.started.elapsed().as_secs_f64()),
                ..draft.seconds.reached()
            },
            rays: (),
            submissions: NoSubmissions {
                count: (),
                longest_ms: (),
            },
            nonfinite_samples: (),
            cut_off_trees: (),
            memory: HostMemory {
                gpu_bytes: (),
                host_peak_bytes: host_peak_bytes(),
            },
            resumed: draft.resumed,
            animation: matches!(draft.command, "animate" | "turntable").then_some(()),
            sheet: (draft.command == "sheet").then_some(()),
            error: Failure {
                message: error.to_string(),
                code: error.exit_code(),
            },
        }
    }
}

impl Seconds {
    /// The parts that were reached; one that took no time was not.
    fn reached(&self) -> Seconds<Option<f64>> {
        let Self {
            total,
            load,
            bvh,
            gpu,
            compile,
            upload,
            trace,
            develop,
            denoise,
            write,
        } = *self;
        let reached = |seconds: f64| (seconds != 0.0).then_some(seconds);
        Seconds {
            total: reached(total),
            load: reached(load),
            bvh: reached(bvh),
            gpu: reached(gpu),
            compile: reached(compile),
            upload: reached(upload),
            trace: reached(trace),
            develop: reached(develop),
            denoise: denoise.map(reached),
            write: reached(write),
        }
    }
}
