//! One error for everything that can end a command, with its words and its exit code.

use super::advice;
use crate::gpu::GpuError;
use crate::import::ImportError;
use crate::output::{self, OutputError};
use crate::pack::PackError;
use crate::render::{FilmError, RenderError};
use std::io;
use std::path::PathBuf;

/// What ended a command. The text is `WHAT (WHERE): WHY. WHAT TO DO.`
#[derive(Debug, thiserror::Error)]
pub enum AppError {
    /// The flags make no sense together, or not for this scene.
    #[error("{0}")]
    Usage(String),
    /// The scene file was refused.
    #[error("{}", advice::import(.0))]
    Import(#[from] ImportError),
    /// Some other input was refused.
    #[error("{0}")]
    Refused(String),
    /// A film was refused, or does not go with others.
    #[error("cannot use the film ({}): {error}", path.display())]
    Film {
        /// Its file.
        path: PathBuf,
        /// Why.
        error: FilmError,
    },
    /// `merge` found parts of the picture missing.
    #[error("{0}")]
    Missing(String),
    /// The scene cannot be laid out for a GPU.
    #[error(transparent)]
    Pack(#[from] PackError),
    /// No adapter could be used.
    #[error("{}", advice::gpu(.0))]
    Gpu(#[from] GpuError),
    /// Rendering failed.
    #[error("{}", advice::render(.0))]
    Render(#[from] RenderError),
    /// The adapter computes wrong results.
    #[error("{0}")]
    SelfTest(String),
    /// There is no display for a window.
    #[error("{0}")]
    NoDisplay(String),
    /// The picture or report could not be written.
    #[error(transparent)]
    Output(#[from] OutputError),
    /// The standard output takes no more.
    #[error("cannot write the result (standard output): {}. Send it elsewhere.", output::reason(.0))]
    Stdout(#[source] io::Error),
    /// Files of ours or of others are in the way.
    #[error("{0}")]
    Unwritable(String),
    /// It would take more memory than the process may have.
    #[error("{0}")]
    TooBig(String),
    /// Work of many steps ended early.
    #[error("{}{kept}", lead(error))]
    Stopped {
        /// What ended it.
        error: Box<AppError>,
        /// What is kept and how to go on, as a sentence.
        kept: String,
    },
    /// `compare` found the pictures different.
    #[error("{0}")]
    Different(String),
    /// A signal asked for the end.
    #[error("interrupted: no picture was written.")]
    Interrupted {
        /// 128 and the signal's number.
        exit_code: u8,
    },
    /// Our bug.
    #[error("internal fault ({0}). Please report it.")]
    Internal(String),
}

impl AppError {
    /// As the contract with scripts has it.
    pub fn exit_code(&self) -> u8 {
        match self {
            Self::Internal(_) => 1,
            Self::Usage(_) => 2,
            Self::Import(error) if error.is_too_big() => 7,
            Self::Import(_) | Self::Refused(_) | Self::Film { .. } => 3,
            Self::Output(error) if error.is_usage() => 2,
            Self::Output(error) if error.is_refused_input() => 3,
            Self::Output(error) if error.is_internal() => 1,
            Self::Output(_) | Self::Stdout(_) | Self::Unwritable(_) => 4,
            Self::Stopped { error, .. } => error.exit_code(),
            Self::SelfTest(_) | Self::NoDisplay(_) => 5,
            Self::Pack(_) | Self::TooBig(_) => 7,
            Self::Different(_) | Self::Missing(_) => 8,
            Self::Gpu(error) | Self::Render(RenderError::Gpu(error)) => gpu_exit_code(error),
            Self::Render(RenderError::PathTooLong(_) | RenderError::TooManyShadowRays { .. }) => 7,
            Self::Render(RenderError::Film(_)) => 3,
            Self::Interrupted { exit_code } => *exit_code,
        }
    }
}

fn gpu_exit_code(error: &GpuError) -> u8 {
    match error {
        GpuError::NoAdapter { .. }
        | GpuError::NoBackend { .. }
        | GpuError::NoSuchAdapter { .. }
        | GpuError::NoDevice { .. } => 5,
        GpuError::Lost | GpuError::KeptFailing { .. } => 6,
        GpuError::Limit { .. } | GpuError::Budget { .. } | GpuError::OutOfMemory { .. } => 7,
        GpuError::Internal { .. } => 1,
    }
}

/// What stands before the sentence of what is kept.
fn lead(error: &AppError) -> String {
    match error {
        AppError::Interrupted { .. } => "interrupted: ".into(),
        other => format!("{other} "),
    }
}
