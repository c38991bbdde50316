//! What a person does in the window, written to a file and done again: one line of JSON for each event
//! of egui, with its time.

use crate::app::error::AppError;
use crate::app::inputs::Inputs;
use crate::app::window::RecordingRequest;
use crate::output::reason;
use eframe::egui::{self, DroppedFile, Event, RawInput};
use serde::{Deserialize, Serialize};
use std::collections::VecDeque;
use std::fs::File;
use std::io::{BufRead, BufReader, BufWriter, Read, Write};
use std::path::{Path, PathBuf};
use std::sync::Arc;

/// A line of a recording.
#[derive(Debug, Serialize, Deserialize)]
struct Line {
    /// Seconds since the first frame of the window.
    time: f64,
    #[serde(flatten)]
    what: What,
}

#[derive(Debug, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
enum What {
    /// Of a mouse or a keyboard, as egui has it.
    Event(Event),
    /// A file dropped on the window.
    Drop(PathBuf),
    /// Room in the window, in points.
    Size([f32; 2]),
}

/// What is recorded, and what is played.
#[derive(Default)]
pub struct InputRecording {
    recorder: Option<Recorder>,
    replay: Option<Replay>,
    /// Where frames have no time of their own.
    clock: f64,
}

struct Recorder {
    path: PathBuf,
    out: BufWriter<File>,
    start: Option<f64>,
    size: Option<[f32; 2]>,
}

struct Replay {
    lines: VecDeque<Line>,
    start: Option<f64>,
    /// Whether times are of no matter.
    is_fast: bool,
    closes: bool,
}

impl InputRecording {
    /// What the flags ask for.
    ///
    /// # Errors
    /// The recording cannot be read, or there cannot be one here.
    pub fn new(request: &RecordingRequest) -> Result<Self, AppError> {
        let replay = match &request.replay {
            None => None,
            Some(path) => Some(Replay {
                lines: read(path)?,
                start: None,
                is_fast: request.is_fast,
                closes: request.closes,
            }),
        };
        if let (Some(record), Some(replay)) = (&request.record, &request.replay) {
            Inputs::new([replay]).spare(record, "recording", "--record")?;
        }
        let recorder = request.record.as_deref().map(Recorder::new).transpose()?;
        Ok(Self {
            recorder,
            replay,
            clock: 0.0,
        })
    }

    /// Whether there is still something to play.
    pub fn is_playing(&self) -> bool {
        self.replay.as_ref().is_some_and(|r| !r.lines.is_empty())
    }

    /// Whether all has been played, and the window is to close then. Asked once.
    pub fn is_to_close(&mut self) -> bool {
        self.replay
            .as_mut()
            .is_some_and(|replay| replay.lines.is_empty() && std::mem::take(&mut replay.closes))
    }

    /// Before each frame: puts what was recorded in the place of what happens, and records it. What went
    /// wrong, once.
    pub fn pass(&mut self, ctx: &egui::Context, raw: &mut RawInput) -> Option<String> {
        self.clock += f64::from(raw.predicted_dt);
        let now = raw.time.unwrap_or(self.clock);
        if let Some(replay) = self.replay.as_mut().filter(|r| !r.lines.is_empty()) {
            replay.feed(now, ctx, raw);
            ctx.request_repaint();
        }
        let error = self.recorder.as_mut()?.take(now, raw).err()?;
        let path = self.recorder.take().map(|recorder| recorder.path)?;
        Some(format!(
            "the recording has ended ({}): {}. Free space or record elsewhere.",
            path.display(),
            reason(&error)
        ))
    }
}

/// Whether nothing is lost at `path` but an older recording, whose lines are JSON objects. Scenes and
/// what they name are not: which files those are is not known yet.
fn is_free(path: &Path) -> bool {
    if !path.is_file() {
        return true;
    }
    let Ok(mut file) = File::open(path) else {
        return true;
    };
    // Stays as it is where the file is empty.
    let mut first = *b"{";
    file.read(&mut first).is_ok() && first == *b"{"
}

impl Recorder {
    fn new(path: &Path) -> Result<Self, AppError> {
        if !is_free(path) {
            return Err(AppError::Unwritable(format!(
                "cannot record ({}): that file is no recording, and would be lost. Name another one with \
                 --record.",
                path.display()
            )));
        }
        let file = File::create(path).map_err(|error| {
            AppError::Unwritable(format!(
                "cannot record ({}): {}. Name a file in a folder that can be written to.",
                path.display(),
                reason(&error)
            ))
        })?;
        Ok(Self {
            path: path.into(),
            out: BufWriter::new(file),
            start: None,
            size: None,
        })
    }

    fn take(&mut self, now: f64, raw: &RawInput) -> std::io::Result<()> {
        let time = now - *self.start.get_or_insert(now);
        let mut lines = Vec::new();
        let size = raw.screen_rect.map(|rect| rect.size().into());
        if size.is_some() && size != self.size {
            self.size = size;
            lines.extend(size.map(What::Size));
        }
        lines.extend(raw.events.iter().cloned().map(What::Event));
        let dropped = raw.dropped_files.iter();
        lines.extend(dropped.map(|file| What::Drop(file.path().to_owned())));
        if lines.is_empty() {
            return Ok(());
        }
        for what in lines {
            serde_json::to_writer(&mut self.out, &Line { time, what })?;
            self.out.write_all(b"\n")?;
        }
        // A window that ends badly is what recordings are for.
        self.out.flush()
    }
}

impl Replay {
    /// Gives what is due; if times are of no matter, what came at the next one.
    fn feed(&mut self, now: f64, ctx: &egui::Context, raw: &mut RawInput) {
        let elapsed = now - *self.start.get_or_insert(now);
        let until = match (self.is_fast, self.lines.front()) {
            (true, Some(line)) => line.time,
            _ => elapsed,
        };
        raw.events.clear();
        raw.dropped_files.clear();
        raw.focused = true;
        while let Some(line) = self.lines.pop_front_if(|line| line.time <= until) {
            match line.what {
                What::Event(Event::WindowFocused(_)) => {}
                What::Event(event) => raw.events.push(event),
                What::Drop(path) => raw.dropped_files.push(Arc::new(Dropped(path))),
                What::Size(size) => {
                    ctx.send_viewport_cmd(egui::ViewportCommand::InnerSize(size.into()));
                }
            }
        }
    }
}

/// A file as if it had been dropped.
#[derive(Debug)]
struct Dropped(PathBuf);

impl DroppedFile for Dropped {
    fn path(&self) -> &Path {
        &self.0
    }

    fn bytes(&self) -> Result<Vec<u8>, String> {
        std::fs::read(&self.0).map_err(|error| reason(&error))
    }
}

/// All lines of a recording.
fn read(path: &Path) -> Result<VecDeque<Line>, AppError> {
    let refuse = |line: usize, why: String| {
        let place = match line {
            0 => path.display().to_string(),
            line => format!("{}:{line}", path.display()),
        };
        AppError::Refused(format!(
            "cannot replay ({place}): {why}. Give a file that --record has written."
        ))
    };
    let file = File::open(path).map_err(|error| refuse(0, reason(&error)))?;
    let mut lines = VecDeque::new();
    let mut last = 0.0;
    for (index, text) in BufReader::new(file).lines().enumerate() {
        let number = index + 1;
        let text = text.map_err(|error| refuse(number, reason(&error)))?;
        if text.trim().is_empty() {
            continue;
        }
        let line: Line = serde_json::from_str(&text).map_err(|error| {
            refuse(
                number,
                format!("{} in column {}", plain(&error), error.column()),
            )
        })?;
        if line.time < last || line.time.is_nan() {
            return Err(refuse(
                number,
                format!(
                    "its time, {} s, is before that of the line above",
                    line.time
                ),
            ));
        }
        last = line.time;
        lines.push_back(line);
    }
    match lines.is_empty() {
        true => Err(refuse(0, "nothing is recorded in it".into())),
        false => Ok(lines),
    }
}

/// The reason without the place, which serde_json counts in a text of one line.
fn plain(error: &serde_json::Error) -> String {
    let text = error.to_string();
    text.split(" at line ").next().unwrap_or(&text).to_owned()
}
