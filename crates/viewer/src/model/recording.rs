//! Records and replays user input: one line of JSON per egui event, with its time.

use eframe::egui::{self, DroppedFile, Event, RawInput};
use glimray_app::error::AppError;
use glimray_app::inputs::Inputs;
use glimray_app::window::RecordingRequest;
use glimray_io::output::reason;
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
    /// A mouse or keyboard event of egui.
    Event(Event),
    /// A file dropped on the window.
    Drop(PathBuf),
    /// Size of the window's contents, in points.
    Size([f32; 2]),
}

/// A recording in progress, a replay, or both.
#[derive(Default)]
pub struct InputRecording {
    recorder: Option<Recorder>,
    replay: Option<Replay>,
    /// Duration of a frame when times are ignored.
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
    /// Whether times are ignored.
    is_fast: bool,
    closes: bool,
}

impl InputRecording {
    /// Opens the files of the flags.
    ///
    /// # Errors
    /// The recording cannot be read, or the file cannot be written.
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
            Inputs::new([replay]).refuse_overwrite(record, "recording", "--record")?;
        }
        let recorder = request.record.as_deref().map(Recorder::new).transpose()?;
        Ok(Self {
            recorder,
            replay,
            clock: 0.0,
        })
    }

    /// Whether there are events left to replay.
    pub fn is_playing(&self) -> bool {
        self.replay.as_ref().is_some_and(|r| !r.lines.is_empty())
    }

    /// Whether the replay has ended and the window should close. True only once.
    pub fn is_to_close(&mut self) -> bool {
        self.replay
            .as_mut()
            .is_some_and(|replay| replay.lines.is_empty() && std::mem::take(&mut replay.closes))
    }

    /// Called before each frame: replaces the input by the replay and records it. Returns an error once.
    pub fn pass(&mut self, ctx: &egui::Context, raw: &mut RawInput) -> Option<String> {
        self.clock += f64::from(raw.predicted_dt);
        let now = raw.time.unwrap_or(self.clock);
        if let Some(replay) = self.replay.as_mut().filter(|r| !r.lines.is_empty()) {
            replay.feed(now, ctx, raw);
            ctx.request_repaint();
        }
        let error = self.recorder.as_mut()?.record(now, raw).err()?;
        let path = self.recorder.take().map(|recorder| recorder.path)?;
        Some(format!(
            "the recording has ended ({}): {}. Free space or record elsewhere.",
            path.display(),
            reason(&error)
        ))
    }
}

/// Whether `path` may be overwritten: it is empty or an older recording, whose lines are JSON objects.
/// Scenes and their assets are protected this way, because they are not known yet.
fn is_free(path: &Path) -> bool {
    if !path.is_file() {
        return true;
    }
    let Ok(mut file) = File::open(path) else {
        return true;
    };
    // Default for an empty file.
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
                "cannot record ({}): {}. Name a file in a writable folder.",
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

    fn record(&mut self, now: f64, raw: &RawInput) -> std::io::Result<()> {
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
        // Flushed each frame, because recordings are most useful when the window crashes.
        self.out.flush()
    }
}

impl Replay {
    /// The events that are due; when times are ignored, those of the next recorded frame.
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
            "cannot replay ({place}): {why}. Use a file written by --record."
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
                    "its time, {} s, is before the time of the line above",
                    line.time
                ),
            ));
        }
        last = line.time;
        lines.push_back(line);
    }
    match lines.is_empty() {
        true => Err(refuse(0, "it contains no events".into())),
        false => Ok(lines),
    }
}

/// The reason without the position, which serde_json counts within the line.
fn plain(error: &serde_json::Error) -> String {
    let text = error.to_string();
    text.split(" at line ").next().unwrap_or(&text).to_owned()
}
