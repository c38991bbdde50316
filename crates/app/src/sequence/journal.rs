//! The journal of the frames in a folder: a file of JSON lines beside them. A line is appended before a frame
//! is written and another after it, so that a killed run loses only the frame it was writing. An incomplete
//! last line is ignored. A run that ends rewrites the file in frame order, so that the same frames give the
//! same journal, in whatever order they were rendered.

use super::Files;
use super::fingerprint::{self, Fingerprint};
use super::pattern::Pattern;
use crate::error::AppError;
use glimray_io::output::{self, OutputError};
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;
use std::fs::{self, File, OpenOptions};
use std::io::{self, ErrorKind, Write};
use std::path::{Path, PathBuf};

/// Version of the file format; other versions are not read.
const VERSION: u32 = 2;

/// Files larger than this are not taken for journals.
const MAX_BYTES: u64 = 1 << 30;

/// The first line.
#[derive(Debug, Serialize, Deserialize)]
struct Head {
    glimray_journal: u32,
}

/// Every other line: the record of a frame, or `None` when its file is about to be written.
#[derive(Debug, Serialize, Deserialize)]
struct Line {
    frame: u32,
    record: Option<Record>,
}

/// The inputs of a finished frame, and the contents of its file.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Record {
    /// File name in the folder.
    pub file: String,
    /// Length of the file.
    pub bytes: u64,
    /// Fingerprint of the file.
    pub content: Fingerprint,
    /// Fingerprints of the inputs.
    #[serde(flatten)]
    pub origin: Origin,
}

/// Fingerprints of everything that a frame depends on.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Origin {
    /// The static part of the scene.
    pub scene: Fingerprint,
    /// The frame's own part: camera, lights and moving objects.
    pub view: Fingerprint,
    /// Settings for rendering, developing and storing.
    pub settings: Fingerprint,
    /// Program version, adapter and driver; `None` accepts any.
    pub renderer: Option<String>,
}

/// The state of a frame's file.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum State {
    /// There is no file.
    Absent,
    /// The file equals what would be rendered.
    Done,
    /// The frame must be rendered again, for this reason.
    Stale(&'static str),
    /// The file exists, but no known run wrote it.
    Foreign,
}

/// The journal of the frames of a pattern.
pub struct Journal {
    path: PathBuf,
    /// `None` is a frame whose writing was started.
    frames: BTreeMap<u32, Option<Record>>,
    /// The file open for appending.
    file: Option<File>,
}

impl Journal {
    /// Reads the journal, if there is one. A file that is not a journal is ignored, and `warn` is told so.
    pub fn open(pattern: &Pattern, warn: impl FnOnce(String)) -> Self {
        let path = pattern.journal();
        let frames = read(&path).unwrap_or_else(|why| {
            warn(format!(
                "cannot use the frame journal ({}): {why}. All frames are rendered again.",
                path.display()
            ));
            BTreeMap::new()
        });
        Self {
            path,
            frames,
            file: None,
        }
    }

    /// The state of a frame's file for a run that would render it from `origin`, which is computed only if
    /// needed.
    ///
    /// # Errors
    /// `origin` failed.
    pub fn state(
        &self,
        pattern: &Pattern,
        number: u32,
        origin: impl FnOnce() -> Result<Origin, AppError>,
    ) -> Result<State, AppError> {
        let path = pattern.path(number);
        let exists = fs::symlink_metadata(&path).is_ok();
        let known = self.frames.get(&number);
        // A record whose name has more or fewer digits belongs to another file.
        let name = pattern.name(number);
        let known = known.filter(|known| (known.as_ref()).is_none_or(|record| record.file == name));
        let record = match known {
            None if exists => return Ok(State::Foreign),
            None => return Ok(State::Absent),
            Some(None) if exists => {
                return Ok(State::Stale("a run ended while writing it"));
            }
            Some(None) => return Ok(State::Absent),
            Some(Some(_)) if !exists => return Ok(State::Stale("its file is missing")),
            Some(Some(record)) => record,
        };
        let origin = origin()?;
        let was = &record.origin;
        Ok(if was.scene != origin.scene {
            State::Stale("the scene has changed")
        } else if was.settings != origin.settings {
            State::Stale("the settings have changed")
        } else if was.view != origin.view {
            State::Stale("moving objects, the camera or the lights have changed")
        } else if origin.renderer.is_some() && was.renderer != origin.renderer {
            State::Stale("another adapter, driver or glimray version rendered it")
        } else {
            match fingerprint::of_file(&path) {
                Ok(found) if found == (record.bytes, record.content.clone()) => State::Done,
                Ok(_) => State::Stale("its file has been modified"),
                Err(_) => State::Stale("its file cannot be read"),
            }
        })
    }

    /// Writes a frame's file with `save`, which gets its path, between two lines. `size` is its width and height in
    /// pixels.
    ///
    /// # Errors
    /// `save` failed, or the journal cannot be written.
    pub fn write(
        &mut self,
        files: &Files,
        number: u32,
        origin: Origin,
        size: (u32, u32),
        save: impl FnOnce(&Path) -> Result<(), OutputError>,
    ) -> Result<(), AppError> {
        let pattern = &files.pattern;
        let path = pattern.path(number);
        if matches!(self.frames.get(&number), Some(None)) {
            // Removes the partial file of a run that was killed while writing this frame.
            output::check(&path, &files.options, size.0, size.1)?;
        }
        self.add(number, None)?;
        save(&path)?;
        let (bytes, content) = fingerprint::of_file(&path).map_err(|source| OutputError::Io {
            path: path.clone(),
            source,
        })?;
        let record = Record {
            file: pattern.name(number),
            bytes,
            content,
            origin,
        };
        self.add(number, Some(record))
    }

    fn add(&mut self, number: u32, record: Option<Record>) -> Result<(), AppError> {
        let failed = |source| OutputError::Io {
            path: self.path.clone(),
            source,
        };
        let mut file = match self.file.take() {
            Some(file) => file,
            None => {
                // Rewriting drops an incomplete last line before anything is appended.
                self.rewrite()?;
                let file = OpenOptions::new().append(true).open(&self.path);
                file.map_err(failed)?
            }
        };
        let line = line(number, record.as_ref())?;
        file.write_all(line.as_bytes()).map_err(failed)?;
        if record.is_some() {
            file.sync_data().map_err(failed)?;
        }
        self.file = Some(file);
        self.frames.insert(number, record);
        Ok(())
    }

    /// Rewrites the file in frame order. The contents stay the same, so a failure loses nothing.
    pub fn close(&mut self) {
        if self.file.take().is_some() {
            let _ = self.rewrite();
        }
    }

    /// Removes the files of these frames, and the journal unless it has other frames.
    pub fn discard(mut self, pattern: &Pattern, numbers: impl Iterator<Item = u32>) {
        for number in numbers {
            let _ = fs::remove_file(pattern.path(number));
            self.frames.remove(&number);
        }
        let _ = match self.frames.is_empty() {
            true => fs::remove_file(&self.path).map_err(drop),
            false => self.rewrite().map_err(drop),
        };
    }

    fn rewrite(&self) -> Result<(), AppError> {
        let head = Head {
            glimray_journal: VERSION,
        };
        let mut text = json(&head)?;
        for (&number, record) in &self.frames {
            text += &line(number, record.as_ref())?;
        }
        Ok(output::write_own(&self.path, text.as_bytes())?)
    }
}

fn line(frame: u32, record: Option<&Record>) -> Result<String, AppError> {
    json(&Line {
        frame,
        record: record.cloned(),
    })
}

fn json(value: &impl Serialize) -> Result<String, AppError> {
    let text = serde_json::to_string(value);
    text.map(|text| text + "\n")
        .map_err(|error| AppError::Internal(format!("journal: {error}")))
}

/// Reads the frames of the journal at `path`. The error is the reason why it cannot be used.
fn read(path: &Path) -> Result<BTreeMap<u32, Option<Record>>, String> {
    let found = match fs::metadata(path) {
        Err(error) if error.kind() == ErrorKind::NotFound => return Ok(BTreeMap::new()),
        Err(error) => return Err(output::reason(&error)),
        Ok(found) => found,
    };
    if !found.is_file() || found.len() > MAX_BYTES {
        return Err("it is not a journal".into());
    }
    let bytes = fs::read(path).map_err(|error: io::Error| output::reason(&error))?;
    let text = String::from_utf8_lossy(&bytes);
    let mut lines = text.split_inclusive('\n');
    let head: Head = lines
        .next()
        .and_then(|line| serde_json::from_str(line).ok())
        .ok_or("it is not a journal")?;
    if head.glimray_journal != VERSION {
        return Err("it is from another version of glimray".into());
    }
    let mut frames = BTreeMap::new();
    for line in lines.filter(|line| line.ends_with('\n')) {
        match serde_json::from_str::<Line>(line) {
            Ok(line) => _ = frames.insert(line.frame, line.record),
            Err(_) => return Err("it is damaged".into()),
        }
    }
    Ok(frames)
}
