//! How far a picture is: a bar on a terminal, lines of JSON for a program, or nothing.

use super::cli::{LogFlags, ProgressMode};
use super::console;
use indicatif::{ProgressBar, ProgressStyle};
use std::io::IsTerminal;
use std::time::{Duration, Instant};

/// Steps of the bar; finer than any terminal is wide.
const STEPS: u64 = 1000;

/// Lines of JSON come no faster than this.
const JSON_INTERVAL: Duration = Duration::from_millis(100);

/// Shows progress on the standard error until it is dropped, which leaves a terminal clean.
pub struct Progress(Display);

enum Display {
    Nothing,
    Bar(ProgressBar),
    Json { started: Instant, next: Instant },
}

impl Progress {
    pub fn new(flags: &LogFlags) -> Self {
        let terminal = std::io::stderr().is_terminal();
        Self(match flags.progress {
            ProgressMode::Auto if terminal && !flags.quiet => Display::Bar(bar()),
            ProgressMode::Bar => Display::Bar(bar()),
            ProgressMode::Json => Display::Json {
                started: Instant::now(),
                next: Instant::now(),
            },
            ProgressMode::Auto | ProgressMode::None => Display::Nothing,
        })
    }

    /// Shows `done`, the finished share of the work in 0..=1.
    pub fn update(&mut self, done: f64) {
        match &mut self.0 {
            Display::Nothing => {}
            Display::Bar(bar) => bar.set_position((done * STEPS as f64) as u64),
            Display::Json { started, next } => {
                let now = Instant::now();
                if now < *next && done < 1.0 {
                    return;
                }
                *next = now + JSON_INTERVAL;
                let seconds = (now - *started).as_secs_f64();
                console::line(serde_json::json!({ "progress": done, "seconds": seconds }));
            }
        }
    }
}

impl Drop for Progress {
    fn drop(&mut self) {
        if let Display::Bar(bar) = &self.0 {
            bar.finish_and_clear();
        }
    }
}

fn bar() -> ProgressBar {
    let bar = ProgressBar::new(STEPS);
    let style = ProgressStyle::with_template("{wide_bar} {percent:>3} %  {elapsed} of {duration}");
    bar.with_style(style.unwrap_or_else(|_| ProgressStyle::default_bar()))
}
