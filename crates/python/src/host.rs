//! A command's surroundings in Python: warnings are collected, progress goes to a function, Ctrl-C is asked for between
//! submissions. The interpreter is free for other threads while a command runs.

use crate::errors::Failure;
use crate::{Files, Progress, Ran, devices};
use glimray_app::error::AppError;
use glimray_app::host::{Host, Packed};
use glimray_io::import::{Memory, Resolver};
use glimray_render::gpu::{AdapterChoice, Gpu};
use pyo3::prelude::*;
use std::cell::{Cell, RefCell};
use std::rc::Rc;
use std::time::{Duration, Instant};

/// Time between two looks for signals: the interpreter may be busy with another thread for some milliseconds.
const PAUSE: Duration = Duration::from_millis(50);

/// The files and the progress function of a call.
#[derive(Default)]
pub struct Session {
    files: Option<Memory>,
    progress: Progress,
}

impl Session {
    /// Files replace the disk, `progress` is called with fractions.
    pub fn new(files: Files, progress: Progress) -> Self {
        let files = files.map(Memory::from_iter);
        Self { files, progress }
    }

    /// Runs a command without holding the interpreter.
    pub fn run<T: Send>(
        self,
        py: Python,
        command: impl FnOnce(Rc<dyn Host>) -> Result<T, AppError> + Send,
    ) -> PyResult<(T, Ran)> {
        let outcome = py.detach(move || {
            let host = Rc::new(PythonHost {
                session: self,
                said: RefCell::default(),
                failure: Cell::new(None),
                looked: Cell::new(Instant::now()),
            });
            let done = command(host.clone());
            let failure = host.failure.take();
            match (failure, done) {
                (Some(failure), _) => Err(failure),
                (None, Ok(value)) => Ok((value, host.said.take().into())),
                (None, Err(error)) => Err(Failure::App(error)),
            }
        });
        outcome.map_err(|failure| failure.raised(py))
    }
}

#[derive(Default)]
struct Said {
    printed: Vec<u8>,
    report: String,
    warnings: Vec<String>,
}

struct PythonHost {
    session: Session,
    said: RefCell<Said>,
    /// Why the work is to stop, where a command's own error would say less.
    failure: Cell<Option<Failure>>,
    /// When signals were last looked for.
    looked: Cell<Instant>,
}

impl PythonHost {
    fn stops(&self, outcome: PyResult<()>) -> bool {
        let error = outcome.err();
        let stops = error.is_some();
        if let Some(error) = error {
            self.failure.set(Some(Failure::Python(error)));
        }
        stops
    }
}

impl Host for PythonHost {
    fn warn(&self, text: &str) {
        self.said.borrow_mut().warnings.push(text.to_owned());
    }

    fn progress(&self, done: f64) {
        if let Some(progress) = &self.session.progress {
            let called = Python::attach(|py| progress.call1(py, (done,)).map(|_| ()));
            self.stops(called);
        }
    }

    fn print(&self, bytes: &[u8]) {
        self.said.borrow_mut().printed.extend_from_slice(bytes);
    }

    fn report(&self, json: &str) {
        self.said.borrow_mut().report = json.to_owned();
    }

    fn is_stopped(&self) -> bool {
        let failure = self.failure.take();
        let has_failed = failure.is_some();
        self.failure.set(failure);
        if has_failed || self.looked.get().elapsed() < PAUSE {
            return has_failed;
        }
        self.looked.set(Instant::now());
        self.stops(Python::attach(|py| py.check_signals()))
    }

    fn files(&self) -> Option<&dyn Resolver> {
        let files = self.session.files.as_ref();
        files.map(|files| files as &dyn Resolver)
    }

    fn packed(&self) -> Option<Packed> {
        devices::packed()
    }

    fn keep_packed(&self, packed: Packed) {
        devices::keep_packed(packed);
    }

    fn gpu(&self, choice: &AdapterChoice) -> Result<Gpu, AppError> {
        devices::on(choice).map_err(|failure| match failure {
            Failure::App(error) => error,
            other => {
                self.failure.set(Some(other));
                AppError::Internal("no device".into())
            }
        })
    }
}

impl From<Said> for Ran {
    fn from(said: Said) -> Self {
        let Said {
            printed,
            report,
            warnings,
        } = said;
        Self {
            printed,
            report,
            warnings,
        }
    }
}
