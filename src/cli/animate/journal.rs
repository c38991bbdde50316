//! What is known about the frames in a folder: a file of JSON lines beside them. A line is added
//! before a frame is written and another one after it, so that a killed run loses the frame it was
//! busy with and nothing else; half a line at the end is none. A run that ends rewrites the file
//! in order, so that the same frames give the same journal however they came about.

use crate::app::console;
use crate::app::error::AppError;
use crate::cli::animate::fingerprint;
use crate::cli::animate::fingerprint::Fingerprint;
use crate::cli::animate::pattern::Pattern;
use crate::output::{self, OutputError};
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;
use std::fs::{self, File, OpenOptions};
use std::io::{self, ErrorKind, Write};
use std::path::{Path, PathBuf};

/// Of the file's form; another one's is not read.
const VERSION: u32 = 2;

/// Larger files are no journals.
const MAX_BYTES: u64 = 1 << 30;

/// The first line.
#[derive(Debug, Serialize, Deserialize)]
struct Head {
    glimray_journal: u32,
}

/// Every other line: what is known about a frame, or that its file is about to be written.
#[derive(Debug, Serialize, Deserialize)]
struct Line {
    frame: u32,
    record: Option<Record>,
}

/// What a finished frame was made of, and what its file holds.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Record {
    /// Its name in the folder.
    pub file: String,
    pub bytes: u64,
    pub content: Fingerprint,
    #[serde(flatten)]
    pub origin: Origin,
}

/// Everything that a frame depends on.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Origin {
    /// What stands still.
    pub scene: Fingerprint,
    /// What is special to the frame.
    pub view: Fingerprint,
    /// How it is rendered, developed and stored.
    pub settings: Fingerprint,
    /// The program, the adapter and its driver; `None` accepts any.
    pub renderer: Option<String>,
}

/// What a frame's file is worth.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum State {
    /// There is none.
    Absent,
    /// It is what would be rendered.
    Done,
    /// It is to be rendered again.
    Stale(&'static str),
    /// It is there, and no run is known to have written it.
    Foreign,
}

/// The journal of the frames that a pattern names.
pub struct Journal {
    path: PathBuf,
    /// `None` is a frame whose writing has begun.
    frames: BTreeMap<u32, Option<Record>>,
    /// Where lines are added.
    file: Option<File>,
}

impl Journal {
    /// Reads what there is; a file that is no journal is a warning, and like none.
    pub fn open(pattern: &Pattern) -> Self {
        let path = pattern.journal();
        let frames = read(&path).unwrap_or_else(|why| {
            console::warning(format_args!(
                "cannot use what is known about the frames ({}): {why}. All of them are rendered again.",
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

    /// What the file of a frame is worth to a run that would make it of `origin`, which is asked for
    /// only if it matters.
    pub fn state(
        &self,
        pattern: &Pattern,
        number: u32,
        origin: impl FnOnce() -> Result<Origin, AppError>,
    ) -> Result<State, AppError> {
        let path = pattern.path(number);
        let exists = fs::symlink_metadata(&path).is_ok();
        let known = self.frames.get(&number);
        // A record of a name with more or fewer digits is about another file.
        let name = pattern.name(number);
        let known = known.filter(|known| (known.as_ref()).is_none_or(|record| record.file == name));
        let record = match known {
            None if exists => return Ok(State::Foreign),
            None => return Ok(State::Absent),
            Some(None) if exists => {
                return Ok(State::Stale("it was being written when a run ended"));
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
            State::Stale("what moves, the camera or the lights have changed")
        } else if origin.renderer.is_some() && was.renderer != origin.renderer {
            State::Stale("it is from another adapter, driver or version of glimray")
        } else {
            match fingerprint::of_file(&path) {
                Ok(found) if found == (record.bytes, record.content.clone()) => State::Done,
                Ok(_) => State::Stale("its file is not what was written"),
                Err(_) => State::Stale("its file cannot be read"),
            }
        })
    }

    /// Whether an earlier run ended while it wrote a frame's file.
    pub fn has_begun(&self, number: u32) -> bool {
        matches!(self.frames.get(&number), Some(None))
    }

    /// Notes that a frame's file is about to be written.
    pub fn begin(&mut self, number: u32) -> Result<(), AppError> {
        self.add(number, None)
    }

    /// Notes that a frame's file is complete, after looking at it.
    pub fn finish(
        &mut self,
        pattern: &Pattern,
        number: u32,
        origin: Origin,
    ) -> Result<(), AppError> {
        let path = pattern.path(number);
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
                // Nothing may follow half a line.
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

    /// Puts the file in order. What it says does not change, so nothing is lost if it cannot be.
    pub fn close(&mut self) {
        if self.file.take().is_some() {
            let _ = self.rewrite();
        }
    }

    /// Removes the journal and the files of these frames.
    pub fn discard(self, pattern: &Pattern, numbers: impl Iterator<Item = u32>) {
        for number in numbers {
            let _ = fs::remove_file(pattern.path(number));
        }
        let _ = fs::remove_file(&self.path);
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

/// The frames of the journal at `path`, or why it cannot be used.
fn read(path: &Path) -> Result<BTreeMap<u32, Option<Record>>, String> {
    let found = match fs::metadata(path) {
        Err(error) if error.kind() == ErrorKind::NotFound => return Ok(BTreeMap::new()),
        Err(error) => return Err(output::reason(&error)),
        Ok(found) => found,
    };
    if !found.is_file() || found.len() > MAX_BYTES {
        return Err("it is no journal".into());
    }
    let bytes = fs::read(path).map_err(|error: io::Error| output::reason(&error))?;
    let text = String::from_utf8_lossy(&bytes);
    let mut lines = text.split_inclusive('\n');
    let head: Head = lines
        .next()
        .and_then(|line| serde_json::from_str(line).ok())
        .ok_or("it is no journal")?;
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
