//! Progress of a picture or an animation: a bar on a terminal, JSON lines, calls of a host, or nothing; and once how long
//! it will take.

use crate::args::{LogFlags, ProgressMode};
use glimray_app::console::{self, Console};
use glimray_app::host;
use indicatif::{ProgressBar, ProgressStyle};
use std::io::IsTerminal;
use std::time::{Duration, Instant};

/// Steps of the bar, more than any terminal has columns.
const STEPS: u64 = 1000;

/// Minimum interval between JSON lines.
const JSON_INTERVAL: Duration = Duration::from_millis(100);

/// Shows progress on standard error. Dropping it clears the bar.
pub struct Progress {
    display: Display,
    estimate: Estimate,
    started: Instant,
}

impl Progress {
    pub fn new(flags: &LogFlags) -> Self {
        let template = "{wide_bar} {percent:>3} %  {elapsed} of {duration}";
        Self {
            display: Display::new(flags, template),
            estimate: Estimate::new(flags),
            started: Instant::now(),
        }
    }

    /// Shows `done`, the finished fraction of the work, 0 to 1.
    pub fn update(&mut self, done: f64) {
        let seconds = self.started.elapsed().as_secs_f64();
        let json = || serde_json::json!({ "progress": done, "seconds": seconds });
        self.display.show(done, String::new, json);
        if let Some(left) = self.estimate.left(done, FIRST_SECOND) {
            self.display
                .say(&self.estimate, &format!("about {left} left"));
        }
    }
}

/// Shows the progress of an animation. Dropping it clears the bar.
pub struct FrameProgress {
    display: Display,
    estimate: Estimate,
    /// Total number of frames.
    count: usize,
    /// Number of frames reused from earlier runs.
    reused: usize,
    /// Number of frames that this run has finished.
    rendered: usize,
    started: Instant,
}

impl FrameProgress {
    /// Progress of rendering `count` frames, of which `reused` exist already.
    pub fn new(flags: &LogFlags, count: usize, reused: usize) -> Self {
        let template = "{wide_bar} {percent:>3} %  {msg}";
        Self {
            display: Display::new(flags, template),
            estimate: Estimate::new(flags),
            count,
            reused,
            rendered: 0,
            started: Instant::now(),
        }
    }

    /// Progress of encoding `count` frames.
    pub fn encoding(flags: &LogFlags, count: usize) -> Self {
        Self::new(flags, count, 0)
    }

    /// Shows that frame `number` is being rendered and that the fraction `part` of it is done.
    pub fn update(&mut self, number: u32, part: f64) {
        let fresh = self.rendered as f64 + part;
        let fraction = (self.reused as f64 + fresh) / self.count as f64;
        let seconds = self.started.elapsed().as_secs_f64();
        let rate = (fresh > 0.0 && seconds > 0.0).then(|| fresh / seconds);
        let left = rate.map(|rate| ((self.count - self.reused) as f64 - fresh).max(0.0) / rate);
        let (done, count) = (self.reused + self.rendered, self.count);
        let message = || {
            let speed = rate.map_or(String::new(), |rate| format!(", {rate:.2} frames/s"));
            let left = left.map_or(String::new(), |left| {
                let left = left.round() as u64;
                format!(", {}:{:02} left", left / 60, left % 60)
            });
            format!("frame {} of {count}{speed}{left}", done + 1)
        };
        let json = || {
            serde_json::json!({
                "progress": fraction, "seconds": seconds, "frame": number, "frames_done": done,
                "frames": count, "frames_per_second": rate, "seconds_left": left,
            })
        };
        self.display.show(fraction, message, json);
        self.say_left(part, LONG_FRAME);
    }

    /// Counts a finished frame.
    pub fn finish_frame(&mut self) {
        self.rendered += 1;
        self.say_left(0.0, FIRST_SECOND);
    }

    /// Says how long the frames will take, if frames have been measured for `least`; `part` of the present one is done.
    fn say_left(&mut self, part: f64, least: Duration) {
        let missing = self.count - self.reused;
        let done = (self.rendered as f64 + part) / missing as f64;
        if let Some(left) = self.estimate.left(done, least) {
            let frames = missing - self.rendered;
            let text = format!("about {left} left for {frames} frame(s)");
            self.display.say(&self.estimate, &text);
        }
    }

    /// Shows that the frame at `index` is being encoded.
    pub fn encoded(&mut self, index: usize) {
        let count = self.count;
        let fraction = (index + 1) as f64 / count as f64;
        let seconds = self.started.elapsed().as_secs_f64();
        let message = || format!("video: frame {} of {count}", index + 1);
        let json =
            || serde_json::json!({ "encoded": fraction, "seconds": seconds, "frames": count });
        self.display.show(fraction, message, json);
    }
}

/// Time after which the rest of a picture is estimated, and that of frames after one that takes less than the second time.
const FIRST_SECOND: Duration = Duration::from_secs(1);
const LONG_FRAME: Duration = Duration::from_secs(10);

/// Seconds that are worth a line.
const LEAST_LEFT: f64 = 10.0;

/// How long a job will take, said once.
struct Estimate {
    console: Console,
    /// When the first part of the work was done, after kernels were compiled, and which.
    first: Option<(Instant, f64)>,
    is_said: bool,
}

impl Estimate {
    fn new(flags: &LogFlags) -> Self {
        Self {
            console: Console::new(flags.quiet, flags.verbose),
            first: None,
            is_said: false,
        }
    }

    /// The time that is left, once, after `least` has passed; `None` if it is short. `done` is the finished fraction.
    fn left(&mut self, done: f64, least: Duration) -> Option<String> {
        let (started, before) = *self.first.get_or_insert((Instant::now(), done));
        let elapsed = started.elapsed();
        if self.is_said || elapsed < least || done <= before {
            return None;
        }
        self.is_said = true;
        let left = elapsed.as_secs_f64() * (1.0 - done) / (done - before);
        (left >= LEAST_LEFT).then(|| spoken(left))
    }
}

/// A time in seconds in words, rounded to what an estimate can tell.
fn spoken(seconds: f64) -> String {
    let minutes = (seconds / 60.0).round() as u64;
    match minutes {
        0 | 1 => format!("{} s", (seconds / 5.0).round() as u64 * 5),
        2..90 => format!("{minutes} min"),
        _ => format!("{} h {} min", minutes / 60, minutes % 60),
    }
}

enum Display {
    Nothing,
    Bar(ProgressBar),
    Json { next: Instant },
    Host,
}

impl Display {
    fn new(flags: &LogFlags, template: &str) -> Self {
        let terminal = std::io::stderr().is_terminal();
        match flags.progress {
            _ if host::current().is_some() => Self::Host,
            ProgressMode::Auto if terminal && !flags.quiet => Self::Bar(bar(template)),
            ProgressMode::Bar => Self::Bar(bar(template)),
            ProgressMode::Json => Self::Json {
                next: Instant::now(),
            },
            ProgressMode::Auto | ProgressMode::None => Self::Nothing,
        }
    }

    /// Prints a line above the bar, unless the job is to be quiet.
    fn say(&self, estimate: &Estimate, text: &str) {
        match self {
            Self::Bar(bar) => bar.suspend(|| estimate.console.status(text)),
            Self::Nothing | Self::Json { .. } | Self::Host => estimate.console.status(text),
        }
    }

    /// Shows the fraction `done` of the work, 0 to 1, as a message on a bar or as JSON.
    fn show(
        &mut self,
        done: f64,
        message: impl FnOnce() -> String,
        json: impl FnOnce() -> serde_json::Value,
    ) {
        match self {
            Self::Nothing => {}
            Self::Host => {
                if let Some(host) = host::current() {
                    host.progress(done);
                }
            }
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
