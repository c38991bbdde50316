//! `glimray farm`: one picture or film over many machines. `plan` cuts it into parts and writes a folder, `run` renders
//! parts, `merge` puts them together. A batch engine only needs to run commands: `submit` writes its scripts.
//!
//! Everything is in files of the folder, each written beside its name and renamed: any process may be killed and started
//! again at any time.

mod archive;
mod cut;
mod flags;
mod frames;
mod lease;
mod manifest;
mod measure;
mod merge;
mod merge_costs;
mod plan;
mod results;
mod run;
mod simulate;
mod slurm;
mod status;
mod submit;
mod target;
mod work;

pub use manifest::schema;

use crate::args::FarmCommand;
use clap::ArgMatches;
use glimray_app::error::AppError;
use glimray_io::output::{self, OutputError};
use manifest::{Manifest, Part};
use serde::{Deserialize, Serialize};
use std::fs;
use std::io::{self, ErrorKind};
use std::path::{Path, PathBuf};
use std::time::Instant;

/// `matches` are those of the `farm` command.
pub fn run(command: &FarmCommand, matches: &ArgMatches, started: Instant) -> Result<(), AppError> {
    match command {
        FarmCommand::Plan(arguments) => plan::run(arguments, matches, started),
        FarmCommand::Run(arguments) => run::run(arguments),
        FarmCommand::Status(arguments) => status::run(arguments),
        FarmCommand::Submit(arguments) => submit::run(arguments),
        FarmCommand::Merge(arguments) => merge::run(arguments),
    }
}

/// The folder of a farm.
#[derive(Clone, Debug)]
struct Folder(PathBuf);

/// A new folder that is removed with everything in it unless it is kept.
struct Unfinished(Option<PathBuf>);

impl Unfinished {
    fn keep(mut self) {
        self.0 = None;
    }
}

impl Drop for Unfinished {
    fn drop(&mut self) {
        if let Some(folder) = &self.0 {
            let _ = fs::remove_dir_all(folder);
        }
    }
}

/// The record of a finished part, beside its result.
#[derive(Clone, Debug, Serialize, Deserialize)]
struct Done {
    /// Seconds from the start of the process to the result on disk.
    seconds: f64,
    /// The machine.
    host: String,
    /// The adapter.
    adapter: String,
    /// The 128-bit XXH3 hashes of its frames in hexadecimal; none for a film, which has its own.
    #[serde(default)]
    frames: Vec<String>,
}

/// The record of a failed part.
#[derive(Clone, Debug, Serialize, Deserialize)]
struct Failed {
    /// How often it was tried.
    attempts: u32,
    /// The last run that tried it, and how often.
    #[serde(default)]
    run: String,
    #[serde(default)]
    tried: u32,
    /// The last error and its exit code.
    error: String,
    code: u8,
    /// The machine.
    host: String,
}

impl Folder {
    /// The subfolders.
    const ALL: [&str; 6] = ["parts", "done", "failed", "leases", "reports", "frames"];

    /// Makes the folder, which is removed again unless the result is kept.
    fn create(&self) -> Result<Unfinished, AppError> {
        let unfinished = Unfinished(Some(self.0.clone()));
        for name in Self::ALL {
            let path = self.0.join(name);
            fs::create_dir_all(&path).map_err(|source| OutputError::Io { path, source })?;
        }
        Ok(unfinished)
    }

    fn path(&self) -> &Path {
        &self.0
    }

    fn leases(&self) -> PathBuf {
        self.0.join("leases")
    }

    /// The file of a part in a subfolder.
    fn of_part(&self, subfolder: &str, part: u32, ending: &str) -> PathBuf {
        let name = format!("{}.{ending}", Manifest::number(part));
        self.0.join(subfolder).join(name)
    }

    /// The film of a part of a picture.
    fn film(&self, part: u32) -> PathBuf {
        self.of_part("parts", part, "film")
    }

    fn checkpoint(&self, part: u32) -> PathBuf {
        self.of_part("parts", part, "checkpoint")
    }

    fn report(&self, part: u32) -> PathBuf {
        self.of_part("reports", part, "json")
    }

    fn done_path(&self, part: u32) -> PathBuf {
        self.of_part("done", part, "json")
    }

    fn failed_path(&self, part: u32) -> PathBuf {
        self.of_part("failed", part, "json")
    }

    /// The folder with the frames of a part.
    fn frames(&self, part: u32) -> PathBuf {
        self.0.join("parts").join(Manifest::number(part))
    }

    /// The frame of a part.
    fn frame(&self, part: u32, frame: u32, ending: &str) -> PathBuf {
        self.frames(part).join(frame_name(frame, ending))
    }

    /// A frame that is merged from films.
    fn merged_frame(&self, frame: u32, ending: &str) -> PathBuf {
        self.0.join("frames").join(frame_name(frame, ending))
    }

    /// The record of a finished part; `None` if it is not done.
    fn done(&self, part: u32) -> Option<Done> {
        read(&self.done_path(part))
    }

    /// The record of a failed part.
    fn failed(&self, part: u32) -> Option<Failed> {
        read(&self.failed_path(part))
    }
}

fn frame_name(frame: u32, ending: &str) -> String {
    format!("frame_{frame:05}.{ending}")
}

/// Reads a small JSON file; `None` if it is missing or malformed.
fn read<T: for<'a> Deserialize<'a>>(path: &Path) -> Option<T> {
    serde_json::from_slice(&fs::read(path).ok()?).ok()
}

/// Writes a small JSON file.
fn write<T: Serialize>(path: &Path, value: &T) -> Result<(), AppError> {
    Ok(output::write(path, &json(value)?, true)?)
}

/// The text of a small JSON file.
fn json<T: Serialize>(value: &T) -> Result<Vec<u8>, AppError> {
    let mut text = serde_json::to_vec_pretty(value)
        .map_err(|error| AppError::Internal(format!("JSON: {error}")))?;
    text.push(b'\n');
    Ok(text)
}

/// Removes a file that may be missing.
fn remove(path: &Path) -> Result<(), AppError> {
    match fs::remove_file(path) {
        Err(error) if error.kind() != ErrorKind::NotFound => Err(failed_io(path, error)),
        _ => Ok(()),
    }
}

fn failed_io(path: &Path, source: io::Error) -> AppError {
    let path = path.into();
    OutputError::Io { path, source }.into()
}

/// The parts of a manifest with their numbers.
fn numbered(manifest: &Manifest) -> impl Iterator<Item = (u32, &Part)> {
    (0..).zip(&manifest.parts)
}

/// The command that follows a step, as it is typed.
fn command(step: &str, folder: &Folder) -> String {
    let folder = folder.path().display().to_string();
    let folder = match folder.starts_with('-') {
        true => format!("./{folder}"),
        false => folder,
    };
    let quoted = shlex::try_quote(&folder).map_or(folder.clone(), Into::into);
    format!("glimray farm {step} {quoted}")
}
