//! Exceptions: the classes of `glimray/_errors.py`, by exit code.

use glimray_app::error::AppError;
use pyo3::exceptions::PyRuntimeError;
use pyo3::prelude::*;
use std::fmt::Display;

/// Why a call failed.
pub enum Failure {
    /// A command failed.
    App(AppError),
    /// A function of the caller raised, or a signal arrived.
    Python(PyErr),
    /// The process was forked after a device was opened.
    Forked,
}

const FORKED: &str = "the GPU device was opened before this process was forked (fork): a device does not survive that. \
    Start worker processes with multiprocessing.get_context(\"spawn\"), or open none before.";

impl Failure {
    /// The exception.
    pub fn raised(self, py: Python) -> PyErr {
        match self {
            Self::Python(error) => error,
            Self::App(error) => raised(py, &error.to_string(), error.exit_code()),
            Self::Forked => raised(py, FORKED, 6),
        }
    }
}

/// The exception for an exit code.
fn raised(py: Python, text: &str, code: u8) -> PyErr {
    let made = (py.import("glimray._errors"))
        .and_then(|errors| errors.getattr("of_exit_code")?.call1((text, code)));
    match made {
        Ok(error) => PyErr::from_value(error),
        Err(error) => error,
    }
}

/// A refused scene.
pub fn scene(error: &dyn Display) -> PyErr {
    Python::attach(|py| raised(py, &format!("bad scene: {error}"), 3))
}

/// A bug.
pub fn internal(error: &dyn Display) -> PyErr {
    PyRuntimeError::new_err(format!("internal fault ({error}). Please report it."))
}
