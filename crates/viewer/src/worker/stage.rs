//! The stages of a scene on its way from the file to the first picture.

use std::fmt;
use std::path::PathBuf;
use std::sync::Arc;
use std::time::Instant;

/// A stage of loading a scene and of preparing its picture, in the order in which they come. A scene of
/// several files is read and imported file by file.
#[derive(Clone, Debug, PartialEq)]
pub enum Stage {
    /// A file is read.
    Reading(PathBuf),
    /// The contents of a file are imported.
    Importing(PathBuf),
    /// The BVH is built.
    BuildingBvh {
        /// Number of triangles, with each instance counted.
        triangles: usize,
    },
    /// Geometry and textures are uploaded to the device.
    Uploading,
    /// Shaders are compiled.
    CompilingShaders,
    /// The first samples are rendered.
    FirstSamples {
        /// The finished share of them, in 0..=1.
        share: f64,
    },
}

impl fmt::Display for Stage {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        let name = |path: &PathBuf| {
            let name = path.file_name().unwrap_or(path.as_os_str());
            name.to_string_lossy().into_owned()
        };
        match self {
            Self::Reading(path) => write!(f, "Reading {}", name(path)),
            Self::Importing(path) => write!(f, "Importing {}", name(path)),
            Self::BuildingBvh { triangles: 0 } => write!(f, "Building the BVH"),
            Self::BuildingBvh { triangles: 1 } => write!(f, "Building the BVH (1 triangle)"),
            Self::BuildingBvh { triangles } => {
                write!(f, "Building the BVH ({} triangles)", grouped(*triangles))
            }
            Self::Uploading => write!(f, "Uploading to the device"),
            Self::CompilingShaders => write!(f, "Compiling shaders"),
            Self::FirstSamples { share } => write!(f, "First samples, {:.0} %", share * 100.0),
        }
    }
}

/// A number with a comma between groups of three digits.
fn grouped(count: usize) -> String {
    let digits = count.to_string();
    let mut text = String::new();
    for (index, digit) in digits.chars().enumerate() {
        if index > 0 && (digits.len() - index).is_multiple_of(3) {
            text.push(',');
        }
        text.push(digit);
    }
    text
}

/// The current stage and the time since which the thread has been at it or at stages before it.
#[derive(Clone, Debug, PartialEq)]
pub struct Activity {
    /// The current stage.
    pub stage: Stage,
    /// The start of the first of these stages.
    pub since: Instant,
}

/// Called before each stage, and with the progress of the first samples.
pub type ReportStage = Arc<dyn Fn(Stage) + Send + Sync>;
