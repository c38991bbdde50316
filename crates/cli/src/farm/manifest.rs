//! The manifest of a farm: what is rendered, from which files, and the parts. It does not change once it is written.

use glimray_app::error::AppError;
use glimray_render::Fingerprint;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use std::path::{Component, Path, PathBuf};
use xxhash_rust::xxh3::xxh3_128;

/// The name in a farm's folder.
pub const NAME: &str = "manifest.json";

/// The version of the format.
const VERSION: u32 = 2;

/// Stands for the checksum while it is computed.
const NO_CHECKSUM: &str = "00000000000000000000000000000000";

/// More parts or frames than any farm has.
const MOST: usize = 1 << 24;

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
    /// Fingerprint of the packed scene, which films of its parts have.
    pub scene_fingerprint: String,
    /// Fingerprint of the camera, the lights and the instances; null for an animation.
    pub view_fingerprint: Option<String>,
    /// Fingerprint of the settings of the whole picture.
    pub settings_fingerprint: String,
    /// Width and height of the whole picture in pixels.
    pub size: [u32; 2],
    /// Samples of each pixel.
    pub samples: u32,
    /// The frames of an animation; null for a picture.
    pub frames: Option<Frames>,
    /// Measurements for the plan.
    pub measured: Measured,
    /// The parts, by number.
    pub parts: Vec<Part>,
    /// 128-bit XXH3 hash in hexadecimal of this file with zeros in place of the hash.
    #[serde(default)]
    pub checksum: String,
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

/// Measurements for the plan.
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

    /// Whether the numbers are sane, and the parts have each of them and no others.
    fn are_covered(&self, parts: &[Part]) -> bool {
        let span = (self.count.checked_sub(1)).and_then(|count| count.checked_mul(self.step));
        let is_sane = self.step > 0
            && (self.count as usize) < MOST
            && span.and_then(|span| span.checked_add(self.first)).is_some()
            && self.fps.is_finite();
        if !is_sane {
            return false;
        }
        let mut ranges: Vec<_> = parts.iter().filter_map(|part| part.frames).collect();
        ranges.sort_unstable();
        ranges.dedup();
        let mut numbers = self.numbers();
        let each = |[first, last]: [u32; 2]| {
            first <= last && {
                let mut own = (first..=last).step_by(self.step as usize);
                own.all(|number| numbers.next() == Some(number))
            }
        };
        ranges.into_iter().all(each) && numbers.next().is_none()
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
        if let Some(what) = manifest.fault() {
            return Err(refused(
                format!("its {what} are malformed"),
                "It was changed; plan it again",
            ));
        }
        let checksum = &manifest.checksum;
        let text = String::from_utf8_lossy(&text);
        let is_whole = checksum.len() == NO_CHECKSUM.len()
            && hash(text.replace(checksum, NO_CHECKSUM).as_bytes()) == *checksum;
        if !is_whole {
            return Err(refused(
                "its manifest was changed after it was planned".into(),
                "Copy it again, or plan it again with other flags",
            ));
        }
        Ok(manifest)
    }

    /// Writes the manifest of the farm in `folder`, with its checksum.
    ///
    /// # Errors
    /// The manifest cannot be written.
    pub fn write(&mut self, folder: &Path) -> Result<(), AppError> {
        self.checksum = NO_CHECKSUM.into();
        self.checksum = hash(&super::json(self)?);
        super::write(&folder.join(NAME), self)
    }

    /// Names malformed fields of a manifest that was changed by hand.
    fn fault(&self) -> Option<&'static str> {
        let [width, height] = self.size;
        let is_plain = |packed: &PackedFile| {
            let mut parts = Path::new(&packed.file).components();
            matches!(parts.next(), Some(Component::Normal(_))) && parts.next().is_none()
        };
        let is_valid = |part: &Part| {
            part.frames.is_some() == self.frames.is_some()
                && (part.samples).is_none_or(|[start, end]| start < end && end <= self.samples)
                && part.crop.is_none_or(|[x0, y0, x1, y1]| {
                    x0 < x1 && x1 <= width && y0 < y1 && y1 <= height
                })
        };
        if !(self.parts.iter().all(is_valid) && !self.parts.is_empty() && self.parts.len() < MOST) {
            return Some("parts");
        }
        if (self.frames.as_ref()).is_some_and(|frames| !frames.are_covered(&self.parts)) {
            return Some("frames");
        }
        if !(1..=100).contains(&self.quality) || self.samples == 0 || width == 0 || height == 0 {
            return Some("numbers");
        }
        if !is_plain(&self.scene) || !self.environment.iter().all(is_plain) {
            return Some("files");
        }
        None
    }

    /// The number of a part as text, with zeros so that names sort.
    pub fn number(part: u32) -> String {
        format!("{part:05}")
    }
}

/// The 128-bit XXH3 hash in hexadecimal.
pub fn hash(bytes: &[u8]) -> String {
    Fingerprint(xxh3_128(bytes)).to_string()
}

/// The JSON Schema of manifests.
pub fn schema() -> serde_json::Value {
    schemars::schema_for!(Manifest).to_value()
}
