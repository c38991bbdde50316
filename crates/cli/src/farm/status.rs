//! `glimray farm status DIR`: what is done, running and failed, and when all of it will be done.

use super::lease::{self, Leases};
use super::manifest::Manifest;
use super::results::unfinished;
use super::{Folder, failed_io, numbered};
use crate::args::FarmStatusArgs;
use crate::interrupt::Interrupt;
use glimray_app::console;
use glimray_app::error::AppError;
use indicatif::{ProgressBar, ProgressStyle};
use serde::Serialize;
use std::time::Duration;

/// Time between two looks at the folder.
const PAUSE: Duration = Duration::from_secs(1);

/// Steps of the bar.
const STEPS: u64 = 1000;

/// Failed parts that are listed.
const MAX_LISTED: usize = 8;

/// The state of a farm.
#[derive(Debug, Serialize)]
struct Status {
    parts: usize,
    done: usize,
    running: usize,
    failed: usize,
    waiting: usize,
    /// Share of the predicted work that is done, 0 to 1.
    progress: f64,
    /// Seconds until all is done, if the same number of processes goes on; null if none is running.
    seconds_left: Option<f64>,
    /// Adapters of the parts that are done.
    adapters: Vec<String>,
    /// The last errors of the parts that failed.
    failures: Vec<Failure>,
}

#[derive(Debug, Serialize)]
struct Failure {
    part: u32,
    attempts: u32,
    host: String,
    error: String,
}

pub fn run(arguments: &FarmStatusArgs) -> Result<(), AppError> {
    let interrupt = Interrupt::install()?;
    let folder = Folder(arguments.dir.clone());
    let manifest = Manifest::read(folder.path())?;
    if arguments.follow {
        follow(&folder, &manifest, &interrupt)?;
    }
    let status = Status::of(&folder, &manifest)?;
    match arguments.json {
        true => console::print_json(&serde_json::json!(status)),
        false => console::print(&status.text(&folder)),
    }
}

/// Shows a bar until nothing is left to wait for.
fn follow(folder: &Folder, manifest: &Manifest, interrupt: &Interrupt) -> Result<(), AppError> {
    let style = ProgressStyle::with_template("{wide_bar} {percent:>3} %  {msg}");
    let bar = ProgressBar::new(STEPS);
    bar.set_style(style.unwrap_or_else(|_| ProgressStyle::default_bar()));
    loop {
        interrupt.check()?;
        let status = Status::of(folder, manifest)?;
        bar.set_position((status.progress * STEPS as f64) as u64);
        bar.set_message(status.line());
        if status.done + status.failed == status.parts {
            bar.finish_and_clear();
            return Ok(());
        }
        std::thread::sleep(PAUSE);
    }
}

impl Status {
    fn of(folder: &Folder, manifest: &Manifest) -> Result<Self, AppError> {
        let leases = Leases::new(folder.leases(), lease::LASTS);
        let held = leases.held();
        let held = held.map_err(|error| failed_io(&folder.leases(), error))?;
        let mut status = Self {
            parts: manifest.parts.len(),
            done: 0,
            running: 0,
            failed: 0,
            waiting: 0,
            progress: 0.0,
            seconds_left: None,
            adapters: Vec::new(),
            failures: Vec::new(),
        };
        let start = manifest.measured.start_seconds;
        let (mut planned, mut taken, mut left, mut all) = (0.0, 0.0, 0.0, 0.0);
        let unfinished = unfinished(folder, manifest);
        for (number, part) in numbered(manifest) {
            let cost = start + part.seconds;
            all += cost;
            let is_done = unfinished.binary_search(&number).is_err();
            if let Some(done) = folder.done(number).filter(|_| is_done) {
                status.done += 1;
                planned += cost;
                taken += done.seconds;
                if !status.adapters.contains(&done.adapter) {
                    status.adapters.push(done.adapter);
                }
                continue;
            }
            left += cost;
            let is_running = held.contains(&Manifest::number(number));
            match (is_running, folder.failed(number)) {
                (true, _) => status.running += 1,
                (false, None) => status.waiting += 1,
                (false, Some(failed)) => {
                    status.failed += 1;
                    status.failures.push(Failure {
                        part: number,
                        attempts: failed.attempts,
                        host: failed.host,
                        error: failed.error,
                    });
                }
            }
        }
        status.adapters.sort();
        status.progress = if all > 0.0 { planned / all } else { 1.0 };
        let pace = if planned > 0.0 { taken / planned } else { 1.0 };
        status.seconds_left = (status.running > 0).then(|| left * pace / status.running as f64);
        Ok(status)
    }

    fn line(&self) -> String {
        let Self {
            parts,
            done,
            running,
            failed,
            waiting,
            seconds_left,
            ..
        } = self;
        let left = match seconds_left {
            Some(seconds) => {
                let seconds = seconds.round() as u64;
                let (hours, minutes) = (seconds / 3600, seconds / 60 % 60);
                format!(", about {hours}:{minutes:02}:{:02} left", seconds % 60)
            }
            None => String::new(),
        };
        format!(
            "{done} of {parts} parts done, {running} running, {failed} failed, {waiting} waiting{left}"
        )
    }

    fn text(&self, folder: &Folder) -> String {
        let mut text = format!("{}\n", self.line());
        for failure in self.failures.iter().take(MAX_LISTED) {
            text += &format!(
                "part {} failed on {} ({} attempts): {}\n",
                failure.part, failure.host, failure.attempts, failure.error
            );
        }
        if self.failures.len() > MAX_LISTED {
            text += &format!("and {} more\n", self.failures.len() - MAX_LISTED);
        }
        if self.done == self.parts {
            text += &format!("next: {}\n", super::command("merge", folder));
        }
        text
    }
}
