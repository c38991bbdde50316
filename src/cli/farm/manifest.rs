//! The manifest of a farm: what is rendered, from which files, and the parts. It does not change once it is written.

use crate::app::error::AppError;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use std::path::{Path, PathBuf};

/// The name in a farm's folder.
pub const NAME: &str = "manifest.json";

/// The version of the format.
const VERSION: u32 = 1;

/// A picture or an animation in parts.
#[derive(Clone, Debug, Serialize, Deserialize, JsonSchema)]
#[schemars(title = "glimray farm")]
pub struct Manifest {
    /// Version of this format.
    pub version: u32,
    /// Version of glimray; another one may compute other samples.
    pub glimray: String,
    /// The picture, the video, or the pattern of the frames.
    pub output: PathBuf,
    /// Quality of JPEG pictures and videos, 1 to 100.
    pub quality: u8,
    /// The scene with everything that it names.
    pub scene: PackedFile,
    /// The picture of `--environment`.
    pub environment: Option<PackedFile>,
    /// Flags of `render` and `animate`, such as `--samples=64`.
    pub flags: Vec<String>,
    /// Width and height of the whole picture in pixels.
    pub size: [u32; 2],
    /// Samples of each pixel.
    pub samples: u32,
    /// The frames of an animation; null for a picture.
    pub frames: Option<Frames>,
    /// What was measured for the plan.
    pub measured: Measured,
    /// The parts, by number.
    pub parts: Vec<Part>,
}

/// A file in the farm's folder.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct PackedFile {
    /// Name in the folder.
    pub file: String,
    /// Length in bytes.
    pub bytes: u64,
    /// 128-bit XXH3 hash in hexadecimal.
    pub xxh3: String,
}

/// The frames of an animation.
#[derive(Clone, Debug, Serialize, Deserialize, JsonSchema)]
pub struct Frames {
    /// Number of the first.
    pub first: u32,
    /// Difference between consecutive numbers.
    pub step: u32,
    /// How many there are.
    pub count: u32,
    /// Frames per second of a video.
    pub fps: f64,
    /// Whether the animation loops.
    pub repeat: bool,
}

/// What the plan measured.
#[derive(Clone, Debug, Serialize, Deserialize, JsonSchema)]
pub struct Measured {
    /// The adapter.
    pub adapter: String,
    /// Seconds that each process takes before it renders.
    pub start_seconds: f64,
    /// Seconds of all parts together, without that.
    pub render_seconds: f64,
}

/// A part.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct Part {
    /// First and last frame; null for a picture.
    pub frames: Option<[u32; 2]>,
    /// First sample and the one after the last; null for all.
    pub samples: Option<[u32; 2]>,
    /// Columns X0 to X1-1 and rows Y0 to Y1-1; null for all.
    pub crop: Option<[u32; 4]>,
    /// Predicted seconds of rendering.
    pub seconds: f64,
}

impl Part {
    /// Whether it is a part of a picture, stored as a film, and not whole frames.
    pub fn is_film(&self) -> bool {
        self.frames.is_none() || self.samples.is_some() || self.crop.is_some()
    }
}

impl Frames {
    /// The frame numbers.
    pub fn numbers(&self) -> impl Iterator<Item = u32> + use<> {
        (self.first..)
            .step_by(self.step as usize)
            .take(self.count as usize)
    }
}

impl Manifest {
    /// The version to write.
    pub const VERSION: u32 = VERSION;

    /// Reads the manifest of the farm in `folder`.
    ///
    /// # Errors
    /// There is none, it is malformed, or it was written by another version.
    pub fn read(folder: &Path) -> Result<Self, AppError> {
        let path = folder.join(NAME);
        let refused = |why: String, todo: &str| {
            AppError::Refused(format!(
                "cannot use the farm ({}): {why}. {todo}.",
                path.display()
            ))
        };
        let text = std::fs::read(&path).map_err(|error| {
            refused(
                format!("its manifest cannot be read, {error}"),
                "Name the folder that `glimray farm plan` wrote",
            )
        })?;
        let manifest: Self = serde_json::from_slice(&text).map_err(|error| {
            refused(
                format!("its manifest is malformed, {error}"),
                "Plan it again",
            )
        })?;
        let own = env!("CARGO_PKG_VERSION");
        if manifest.version != VERSION || manifest.glimray != own {
            let why = format!("glimray {} planned it, and this is {own}", manifest.glimray);
            return Err(refused(
                why,
                "Use the same version on all machines, or plan it again",
            ));
        }
        let is_whole = manifest.parts.iter().all(|part| {
            part.frames.is_some() == manifest.frames.is_some()
                && part.frames.is_none_or(|[first, last]| first <= last)
                && part.samples.is_none_or(|[start, end]| start < end)
        });
        match manifest.parts.is_empty() || !is_whole {
            true => Err(refused("its parts are malformed".into(), "Plan it again")),
            false => Ok(manifest),
        }
    }

    /// The number of a part as text, with zeros so that names sort.
    pub fn number(part: u32) -> String {
        format!("{part:05}")
    }
}

/// The JSON Schema of manifests.
pub fn schema() -> serde_json::Value {
    schemars::schema_for!(Manifest).to_value()
}
