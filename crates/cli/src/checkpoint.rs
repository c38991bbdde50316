//! The checkpoint file of a long render (`--checkpoint`): written now and then and when the run ends early, read at the
//! start, removed once the picture is written.

use crate::args::CheckpointFlags;
use crate::interrupt::Interrupt;
use crate::report::Draft;
use glimray_app::console;
use glimray_app::console::Console;
use glimray_app::error::AppError;
use glimray_app::inputs::is_same;
use glimray_app::lock::Lock;
use glimray_io::output::{self, OutputError};
use glimray_render::{CheckpointError, Renderer};
use std::fs::{self, File};
use std::io::{BufReader, ErrorKind};
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

/// The checkpoint of a picture.
pub struct CheckpointFile<'a> {
    path: &'a Path,
    /// Time from one checkpoint to the next.
    every: Duration,
    /// When the file was written, or that was tried.
    last: Instant,
    /// The saved state: the share of the work, and the submissions of this run before it.
    saved: Option<(f64, u64)>,
    /// Whether it could not be written, and a warning said so.
    has_failed: bool,
    /// Keeps other runs away until this one ends.
    _lock: Option<Lock>,
}

impl<'a> CheckpointFile<'a> {
    /// The file that the flags name, if they do.
    ///
    /// # Errors
    /// The file is the picture, the report or an input, cannot be written, or another run keeps it.
    pub fn new(
        flags: &'a CheckpointFlags,
        picture: &Path,
        draft: &Draft,
    ) -> Result<Option<Self>, AppError> {
        let Some(path) = flags.checkpoint.as_deref() else {
            return Ok(None);
        };
        let refused = |why: &str| {
            let path = path.display();
            AppError::Usage(format!("cannot keep a checkpoint ({path}): {why}."))
        };
        if path == Path::new("-") {
            return Err(refused("it is read again. Name a file"));
        }
        if is_same(path, picture) {
            return Err(refused("the picture goes there. Choose another name"));
        }
        if (draft.log.report.as_deref()).is_some_and(|report| is_same(path, report)) {
            return Err(refused("the report goes there. Choose another name"));
        }
        if draft.inputs.contain(path) {
            return Err(refused("this run reads that file. Choose another name"));
        }
        if fs::metadata(path).is_ok_and(|found| !found.is_file() && !found.is_dir()) {
            return Err(refused("it is a pipe or a device. Name a file"));
        }
        output::check_own(path)?;
        Ok(Some(Self {
            path,
            every: flags.every,
            last: Instant::now(),
            saved: None,
            has_failed: false,
            _lock: match flags.is_leased {
                true => None,
                false => Some(Lock::of_checkpoint(path)?),
            },
        }))
    }

    /// Goes on from the file if there is one, and returns the share of the work in it. A file that does not fit is
    /// renamed.
    ///
    /// # Errors
    /// The file cannot be read or renamed.
    pub fn resume(
        &mut self,
        renderer: &mut Renderer,
        console: Console,
    ) -> Result<Option<f64>, AppError> {
        let path = self.path.display();
        let unreadable = |error: &std::io::Error| {
            let why = output::reason(error);
            AppError::Refused(format!(
                "cannot read the checkpoint ({path}): {why}. Check the file and its folder."
            ))
        };
        let file = match File::open(self.path) {
            Ok(file) => file,
            Err(error) if error.kind() == ErrorKind::NotFound => return Ok(None),
            Err(error) => return Err(unreadable(&error)),
        };
        match renderer.resume(BufReader::new(file)) {
            Ok(()) => {
                let done = renderer.progress();
                console.status(format_args!("resuming from {path}: {}", percent(done)));
                self.saved = Some((done, renderer.stats().submissions));
            }
            Err(CheckpointError::Io(error)) => return Err(unreadable(&error)),
            Err(error @ CheckpointError::TooBig { .. }) => {
                return Err(AppError::TooBig(format!(
                    "cannot read the checkpoint ({path}): {error} Allow more memory."
                )));
            }
            Err(error) => {
                let aside = self.set_aside()?;
                console::warning(format_args!(
                    "cannot go on from the checkpoint ({path}): {error} The file is now {}, and the picture starts \
                     from the beginning.",
                    aside.display()
                ));
            }
        }
        self.last = Instant::now();
        Ok(self.saved.map(|(done, _)| done))
    }

    /// Renames the file and returns its new name.
    fn set_aside(&self) -> Result<PathBuf, AppError> {
        output::set_aside(self.path).map_err(|why| {
            AppError::Unwritable(format!(
                "cannot set the checkpoint aside ({}): {why}. Move it away or name another file with --checkpoint.",
                self.path.display(),
            ))
        })
    }

    /// Writes the file if that is due. If it cannot be written, a warning says so, once.
    pub fn save_if_due(&mut self, renderer: &mut Renderer, interrupt: &Interrupt) {
        if self.last.elapsed() < self.every {
            return;
        }
        if let Err(error) = self.save(renderer, interrupt)
            && !self.has_failed
        {
            self.has_failed = true;
            console::warning(format_args!(
                "{error} Rendering goes on, and the checkpoint is tried again every {} s.",
                self.every.as_secs_f64()
            ));
        }
        self.last = Instant::now();
    }

    fn save(&mut self, renderer: &mut Renderer, interrupt: &Interrupt) -> Result<(), AppError> {
        let submissions = renderer.stats().submissions;
        if self.saved.is_some_and(|(_, before)| before == submissions) {
            return Ok(());
        }
        let done = renderer.progress();
        let _saving = interrupt.saving();
        let checkpoint = renderer.checkpoint()?;
        output::write_own_with(self.path, |file| checkpoint.write(file))?;
        self.saved = Some((done, submissions));
        Ok(())
    }

    /// The error of a run that ends early, with what is kept of its work, which is saved first.
    pub fn keep(
        &mut self,
        renderer: &mut Renderer,
        interrupt: &Interrupt,
        error: AppError,
    ) -> AppError {
        if let Err(error) = self.save(renderer, interrupt) {
            console::warning(error);
        }
        let Some((done, _)) = self.saved else {
            return error;
        };
        let kept = format!(
            "{} is kept ({}). Repeat the command to go on.",
            percent(done),
            self.path.display()
        );
        AppError::Stopped {
            error: Box::new(error),
            kept,
        }
    }

    /// Removes the file after the picture is written.
    pub fn remove(self) {
        if let Err(source) = fs::remove_file(self.path)
            && source.kind() != ErrorKind::NotFound
        {
            console::warning(OutputError::Io {
                path: self.path.into(),
                source,
            });
        }
    }
}

/// A share of the work, rounded down: only a finished picture is 100 % done.
fn percent(done: f64) -> String {
    format!("{} % done", (100.0 * done).floor())
}
