//! How far a picture or an animation is: a bar on a terminal, lines of JSON for a program, or nothing.

use crate::app::console;
use crate::cli::args::{LogFlags, ProgressMode};
use indicatif::{ProgressBar, ProgressStyle};
use std::io::IsTerminal;
use std::time::{Duration, Instant};

/// Steps of the bar; finer than any terminal is wide.
const STEPS: u64 = 1000;

/// Lines of JSON come no faster than this.
const JSON_INTERVAL: Duration = Duration::from_millis(100);

/// Shows progress on the standard error until it is dropped, which leaves a terminal clean.
pub struct Progress {
    display: Display,
    started: Instant,
}

impl Progress {
    pub fn new(flags: &LogFlags) -> Self {
        let template = "{wide_bar} {percent:>3} %  {elapsed} of {duration}";
        Self {
            display: Display::new(flags, template),
            started: Instant::now(),
        }
    }

    /// Shows `done`, the finished share of the work in 0..=1.
    pub fn update(&mut self, done: f64) {
        let seconds = self.started.elapsed().as_secs_f64();
        let json = || serde_json::json!({ "progress": done, "seconds": seconds });
        self.display.show(done, String::new, json);
    }
}

/// Shows how far many frames are, until it is dropped.
pub struct FrameProgress {
    display: Display,
    /// Frames in all.
    count: usize,
    /// Of them, those that were there before.
    reused: usize,
    /// Of them, those finished since.
    rendered: usize,
    started: Instant,
}

impl FrameProgress {
    /// For `count` frames, `reused` of which are there already.
    pub fn new(flags: &LogFlags, count: usize, reused: usize) -> Self {
        let template = "{wide_bar} {percent:>3} %  {msg}";
        Self {
            display: Display::new(flags, template),
            count,
            reused,
            rendered: 0,
            started: Instant::now(),
        }
    }

    /// For joining `count` frames.
    pub fn encoding(flags: &LogFlags, count: usize) -> Self {
        Self::new(flags, count, 0)
    }

    /// Shows the frame with this number, of which the share `part` is done.
    pub fn update(&mut self, number: u32, part: f64) {
        let fresh = self.rendered as f64 + part;
        let share = (self.reused as f64 + fresh) / self.count as f64;
        let seconds = self.started.elapsed().as_secs_f64();
        let rate = (fresh > 0.0 && seconds > 0.0).then(|| fresh / seconds);
        let left = rate.map(|rate| ((self.count - self.reused) as f64 - fresh).max(0.0) / rate);
        let (done, count) = (self.reused + self.rendered, self.count);
        let message = || {
            let pace = rate.map_or(String::new(), |rate| format!(", {rate:.2} frames/s"));
            let left = left.map_or(String::new(), |left| {
                let left = left.round() as u64;
                format!(", {}:{:02} left", left / 60, left % 60)
            });
            format!("frame {} of {count}{pace}{left}", done + 1)
        };
        let json = || {
            serde_json::json!({
                "progress": share, "seconds": seconds, "frame": number, "frames_done": done,
                "frames": count, "frames_per_second": rate, "seconds_left": left,
            })
        };
        self.display.show(share, message, json);
    }

    /// Counts a frame that is finished.
    pub fn finish_frame(&mut self) {
        self.rendered += 1;
    }

    /// Shows that the frame at `index` is being joined to a video.
    pub fn encoded(&mut self, index: usize) {
        let count = self.count;
        let share = (index + 1) as f64 / count as f64;
        let seconds = self.started.elapsed().as_secs_f64();
        let message = || format!("video: frame {} of {count}", index + 1);
        let json = || serde_json::json!({ "encoded": share, "seconds": seconds, "frames": count });
        self.display.show(share, message, json);
    }
}

enum Display {
    Nothing,
    Bar(ProgressBar),
    Json { next: Instant },
}

impl Display {
    fn new(flags: &LogFlags, template: &str) -> Self {
        let terminal = std::io::stderr().is_terminal();
        match flags.progress {
            ProgressMode::Auto if terminal && !flags.quiet => Self::Bar(bar(template)),
            ProgressMode::Bar => Self::Bar(bar(template)),
            ProgressMode::Json => Self::Json {
                next: Instant::now(),
            },
            ProgressMode::Auto | ProgressMode::None => Self::Nothing,
        }
    }

    /// Shows the share `done` of the work in 0..=1, in words on a bar or as JSON.
    fn show(
        &mut self,
        done: f64,
        message: impl FnOnce() -> String,
        json: impl FnOnce() -> serde_json::Value,
    ) {
        match self {
            Self::Nothing => {}
            Self::Bar(bar) => {
                bar.set_message(message());
                bar.set_position((done * STEPS as f64) as u64);
            }
            Self::Json { next } => {
                let now = Instant::now();
                if now < *next && done < 1.0 {
                    return;
                }
                *next = now + JSON_INTERVAL;
                console::json_line(&json());
            }
        }
    }
}

impl Drop for Display {
    fn drop(&mut self) {
        if let Self::Bar(bar) = self {
            bar.finish_and_clear();
        }
    }
}

fn bar(template: &str) -> ProgressBar {
    let bar = ProgressBar::new(STEPS);
    let style = ProgressStyle::with_template(template);
    bar.with_style(style.unwrap_or_else(|_| ProgressStyle::default_bar()))
}
