//! `glimray farm run DIR PART`: renders parts. What is done and valid is skipped, what another process renders is left to
//! it.

use super::lease::{Claim, Leases, host};
use super::manifest::{self, Manifest, Part};
use super::results::{self, Depth, State, frame_ending, frame_files};
use super::{Done, Failed, Folder, archive, failed_io, flags, frames, read, remove, write};
use crate::args::{Cli, Command, FarmRunArgs};
use crate::interrupt::Interrupt;
use crate::{animate, render};
use clap::Parser;
use glimray_app::console;
use glimray_app::console::Console;
use glimray_app::error::AppError;
use glimray_io::output;
use glimray_render::gpu::adapter_identity;
use std::collections::BTreeMap;
use std::ffi::OsString;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Child, ExitStatus};
use std::time::{Duration, Instant};

/// Pause before a part that another process renders is looked at again.
const PAUSE: Duration = Duration::from_millis(500);

/// Seconds between two checkpoints of a part.
const CHECKPOINT_SECONDS: u32 = 30;

pub fn run(arguments: &FarmRunArgs) -> Result<(), AppError> {
    let interrupt = Interrupt::install()?;
    let folder = Folder(arguments.dir.clone());
    let manifest = Manifest::read(folder.path())?;
    let parts = chosen(arguments, &manifest)?;
    if arguments.jobs > 1 {
        return share(arguments, &interrupt);
    }
    let farm = Farm {
        cut_frames: frames::cut(&manifest),
        run: arguments.run.clone().unwrap_or_else(run_name),
        attempts: arguments.attempts,
        depth: match arguments.part {
            Some(_) => Depth::Whole,
            None => Depth::Outline,
        },
        leases: Leases::new(folder.leases(), Duration::from_secs_f64(arguments.lease)),
        scene: archive::checked(&manifest.scene, &folder)?,
        environment: (manifest.environment.as_ref())
            .map(|packed| archive::checked(packed, &folder))
            .transpose()?,
        console: Console::new(arguments.quiet, false),
        interrupt,
        folder,
        manifest,
    };
    farm.run(parts, !arguments.all)
}

/// The numbers of the parts to render.
fn chosen(arguments: &FarmRunArgs, manifest: &Manifest) -> Result<Vec<u32>, AppError> {
    let count = manifest.parts.len() as u32;
    match (arguments.part, arguments.slice) {
        (Some(part), _) if part >= count => Err(AppError::Usage(format!(
            "cannot run part {part} ({}): the farm has parts 0 to {}. Choose one of them.",
            arguments.dir.display(),
            count - 1
        ))),
        (Some(part), _) => Ok(vec![part]),
        (None, Some((first, step))) => Ok((first..count).step_by(step as usize).collect()),
        (None, None) => Ok((0..count).collect()),
    }
}

/// Starts processes that share the parts, and waits for them.
fn share(arguments: &FarmRunArgs, interrupt: &Interrupt) -> Result<(), AppError> {
    let failed = |error| AppError::Internal(format!("cannot start a process: {error}"));
    let program = std::env::current_exe().map_err(failed)?;
    let _deferred = interrupt.defer();
    let run = run_name();
    let mut children: Vec<Child> = Vec::new();
    for _ in 0..arguments.jobs {
        let mut command = std::process::Command::new(&program);
        command.args(["farm", "run", "--all"]);
        command.args(["--attempts", &arguments.attempts.to_string()]);
        command.args(["--run", &run]);
        command.args(["--lease", &arguments.lease.to_string()]);
        command.args(arguments.quiet.then_some("--quiet"));
        command.arg("--").arg(&arguments.dir);
        children.push(command.spawn().map_err(failed)?);
    }
    let mut first_failure: Option<ExitStatus> = None;
    while !children.is_empty() {
        let mut left = Vec::new();
        for mut child in children {
            match child.try_wait().map_err(failed)? {
                None => left.push(child),
                Some(status) if status.success() => {}
                Some(status) => {
                    first_failure.get_or_insert(status);
                }
            }
        }
        children = left;
        if let Err(error) = interrupt.check() {
            // The signal may be for this process alone. The others write their checkpoints before they end.
            let _saving = interrupt.saving();
            children.iter_mut().for_each(terminate);
            for child in &mut children {
                let _ = child.wait();
            }
            return Err(error);
        }
        std::thread::sleep(PAUSE / 10);
    }
    match first_failure {
        None => Ok(()),
        Some(status) => Err(AppError::Part {
            why: format!(
                "a process of {} ended with {status}",
                arguments.dir.display()
            ),
            code: (status.code())
                .and_then(|code| u8::try_from(code).ok())
                .unwrap_or(1),
        }),
    }
}

/// The name of the run that this process begins.
fn run_name() -> String {
    format!("{}-{}", host(), std::process::id())
}

/// Asks a process to end.
#[cfg(unix)]
fn terminate(child: &mut Child) {
    use rustix::process::{Pid, Signal, kill_process};
    let _ = kill_process(Pid::from_child(child), Signal::TERM);
}

/// Ends a process: other systems have no signal to ask for it.
#[cfg(not(unix))]
fn terminate(child: &mut Child) {
    let _ = child.kill();
}

/// The farm and this process in it.
struct Farm {
    folder: Folder,
    manifest: Manifest,
    leases: Leases,
    /// The archive.
    scene: PathBuf,
    environment: Option<PathBuf>,
    /// The parts of each frame that is cut into films.
    cut_frames: BTreeMap<u32, Vec<u32>>,
    /// The name of this run, which the processes of `--jobs` share.
    run: String,
    /// How often a part is tried in it.
    attempts: u32,
    /// How much of the results that are there is looked at.
    depth: Depth,
    console: Console,
    interrupt: Interrupt,
}

/// The outcome of a part.
enum Outcome {
    Done,
    /// This process renders it, as `HOST, process PID`.
    Elsewhere(String),
    /// The last attempt failed.
    Failed(AppError),
    /// The part failed and is to be tried again.
    Again(AppError),
}

impl Farm {
    /// Renders parts until all are done or have failed. Those that other processes render are waited for; `says_waits`
    /// prints that.
    fn run(&self, mut parts: Vec<u32>, says_waits: bool) -> Result<(), AppError> {
        let mut failure: Option<AppError> = None;
        let mut has_waited = false;
        loop {
            let (mut again, mut elsewhere) = (Vec::new(), Vec::new());
            for part in std::mem::take(&mut parts) {
                self.interrupt.check()?;
                match self.part(part)? {
                    Outcome::Done => {}
                    Outcome::Elsewhere(holder) => elsewhere.push((part, holder)),
                    Outcome::Again(error) => {
                        console::warning(format_args!(
                            "part {part} failed and is tried again: {error}"
                        ));
                        again.push(part);
                    }
                    Outcome::Failed(error) => {
                        failure.get_or_insert(error);
                    }
                }
            }
            if again.is_empty() {
                if let Some(error) = failure {
                    return Err(error);
                }
                let Some((part, holder)) = elsewhere.first() else {
                    return Ok(());
                };
                if !has_waited && says_waits {
                    has_waited = true;
                    self.console.status(format_args!(
                        "waiting for part {part}, which {holder}, renders"
                    ));
                }
                std::thread::sleep(PAUSE);
            }
            parts = again;
            parts.extend(elsewhere.into_iter().map(|(part, _)| part));
        }
    }

    /// Renders a part unless it is done or another process renders it.
    fn part(&self, number: u32) -> Result<Outcome, AppError> {
        let state = || results::state(&self.folder, &self.manifest, number, self.depth);
        if let State::Done = state() {
            return Ok(Outcome::Done);
        }
        let text = Manifest::number(number);
        let claim = self.leases.claim(&text);
        let _lease = match claim.map_err(|error| failed_io(&self.folder.leases(), error))? {
            Claim::Held(holder) => return Ok(Outcome::Elsewhere(holder)),
            Claim::Taken(lease) => lease,
        };
        // Another process may have finished it before the lease was free.
        match state() {
            State::Done => return Ok(Outcome::Done),
            State::Invalid(why) => self.set_aside(number, &why)?,
            State::Absent => {}
        }
        let earlier = self.folder.failed(number);
        let tried = match &earlier {
            Some(failed) if failed.run == self.run => failed.tried,
            _ => 0,
        };
        // Another process of this run has tried it.
        if let Some(failed) = earlier.as_ref().filter(|_| tried >= self.attempts) {
            return Ok(Outcome::Failed(failure(number, &failed.error, failed.code)));
        }
        let count = self.manifest.parts.len();
        self.console
            .status(format_args!("part {number} of {count}"));
        match self.render(number) {
            Ok(done) => {
                remove(&self.folder.failed_path(number))?;
                write(&self.folder.done_path(number), &done)?;
                self.merge_frame(number)?;
                Ok(Outcome::Done)
            }
            Err(error) if is_of_process(&error) => Err(error),
            Err(error) => {
                let failed = Failed {
                    attempts: earlier.map_or(0, |failed| failed.attempts) + 1,
                    run: self.run.clone(),
                    tried: tried + 1,
                    error: error.to_string(),
                    code: error.exit_code(),
                    host: host(),
                };
                write(&self.folder.failed_path(number), &failed)?;
                Ok(match failed.tried < self.attempts {
                    true => Outcome::Again(error),
                    false => Outcome::Failed(failure(number, &failed.error, failed.code)),
                })
            }
        }
    }

    /// Merges the frame of a part whose films are all done, if no other process does.
    fn merge_frame(&self, number: u32) -> Result<(), AppError> {
        let part = &self.manifest.parts[number as usize];
        let frame = (part.frames).and_then(|[frame, _]| self.cut_frames.get_key_value(&frame));
        let Some((&frame, parts)) = frame.filter(|_| part.is_film()) else {
            return Ok(());
        };
        if parts.iter().any(|&part| self.folder.done(part).is_none()) {
            return Ok(());
        }
        let claim = self.leases.claim(&format!("frame-{frame}"));
        let Claim::Taken(_lease) =
            claim.map_err(|error| failed_io(&self.folder.leases(), error))?
        else {
            return Ok(());
        };
        match frames::merge(&self.folder, &self.manifest, (frame, parts), false) {
            Err(error) if is_of_process(&error) => Err(error),
            Err(error) => {
                console::warning(format_args!("frame {frame} is left to the merge: {error}"));
                Ok(())
            }
            Ok(_) => Ok(()),
        }
    }

    /// Sets the result of a part aside, which cannot be used.
    fn set_aside(&self, number: u32, why: &str) -> Result<(), AppError> {
        console::warning(format_args!("part {number} is rendered again: {why}."));
        let part = &self.manifest.parts[number as usize];
        let result = match part.is_film() {
            true => self.folder.film(number),
            false => self.folder.frames(number),
        };
        if result.exists() {
            output::set_aside(&result).map_err(|why| {
                AppError::Unwritable(format!(
                    "cannot set a part aside ({}): {why}. Move it away.",
                    result.display()
                ))
            })?;
        }
        remove(&self.folder.done_path(number))
    }

    /// Renders a part to its place.
    fn render(&self, number: u32) -> Result<Done, AppError> {
        let part = &self.manifest.parts[number as usize];
        let report = self.folder.report(number);
        let words = self.words(number, part, &report)?;
        let started = Instant::now();
        let parsed = Cli::try_parse_from(words).map_err(|error| {
            let text = error.to_string();
            let why = match error.use_stderr() {
                true => text.lines().next().unwrap_or_default(),
                false => "one of them renders nothing",
            };
            AppError::Refused(format!(
                "cannot use the farm ({}): the flags of its manifest are malformed, {}. It was changed; plan it again.",
                self.folder.path().display(),
                why.trim_start_matches("error: ")
            ))
        })?;
        match parsed.command {
            Command::Render(mut arguments) => {
                arguments.part.checkpoint.is_leased = true;
                render::run(&arguments, started)?;
            }
            Command::Animate(arguments) => animate::run(&arguments, started)?,
            _ => return Err(AppError::Internal(format!("part {number}: no command"))),
        }
        let report: serde_json::Value = read(&report).unwrap_or_default();
        let adapter = |key: &str| report["adapter"][key].as_str().unwrap_or_default();
        let adapter = adapter_identity(adapter("name"), adapter("backend"), adapter("driver"));
        let frames = frame_files(&self.folder, &self.manifest, number);
        let frames = frames.iter().map(|(_, path)| {
            let bytes = fs::read(path).map_err(|error| failed_io(path, error))?;
            Ok::<_, AppError>(manifest::hash(&bytes))
        });
        Ok(Done {
            seconds: started.elapsed().as_secs_f64(),
            host: host(),
            adapter,
            frames: frames.collect::<Result<_, _>>()?,
        })
    }

    /// The command line that renders a part.
    fn words(&self, number: u32, part: &Part, report: &Path) -> Result<Vec<OsString>, AppError> {
        let mut words: Vec<OsString> = vec!["glimray".into()];
        let flag = |name: &str, value: &dyn std::fmt::Display| format!("--{name}={value}").into();
        // In one word, because a path may begin with a dash.
        let file = |name: &str, path: &Path| {
            let mut word = OsString::from(format!("--{name}="));
            word.push(path);
            word
        };
        let all = &self.manifest.flags;
        if part.is_film() {
            words.push("render".into());
            words.extend(flags::of_part(all, part.crop).map(OsString::from));
            if let Some([frame, _]) = part.frames {
                words.push(flag("frame", &frame));
            }
            if let Some([start, end]) = part.samples {
                words.push(flag("sample-offset", &start));
                words.push(flag("sample-count", &(end - start)));
            }
            if let Some([x0, y0, x1, y1]) = part.crop {
                words.push(flag("crop", &format_args!("{x0},{y0},{x1},{y1}")));
            }
            words.push(file("checkpoint", &self.folder.checkpoint(number)));
            words.push(flag("every", &CHECKPOINT_SECONDS));
            words.push(file("output", &self.folder.film(number)));
        } else {
            let frames = self.folder.frames(number);
            fs::create_dir_all(&frames).map_err(|error| failed_io(&frames, error))?;
            words.push("animate".into());
            words.extend(flags::of_animation(all).map(OsString::from));
            let [first, last] = part.frames.unwrap_or_default();
            words.push(flag("frames", &format_args!("{first}..{last}")));
            if let Some(frames) = &self.manifest.frames {
                words.push(flag("step", &frames.step));
            }
            words.push(flag("quality", &self.manifest.quality));
            let name = format!("frame_%05d.{}", frame_ending(&self.manifest.output));
            words.push(file("output", &frames.join(name)));
        }
        if let Some(environment) = &self.environment {
            words.push(file("environment", environment));
        }
        words.push(file("report", report));
        words.extend(["--progress=none".into(), "--quiet".into(), "--".into()]);
        words.push((&self.scene).into());
        Ok(words)
    }
}

fn failure(number: u32, error: &str, code: u8) -> AppError {
    AppError::Part {
        why: format!("part {number} failed: {error}"),
        code,
    }
}

/// Whether the error is unrelated to the part: a signal, or a machine without a usable adapter. Another process can render it.
fn is_of_process(error: &AppError) -> bool {
    matches!(error.exit_code(), 5 | 130 | 143)
}
