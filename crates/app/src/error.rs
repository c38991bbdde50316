//! The error type of all commands, with its messages and exit codes.

use super::advice;
use glimray_io::import::ImportError;
use glimray_io::output::{self, OutputError};
use glimray_render::gpu::GpuError;
use glimray_render::pack::PackError;
use glimray_render::{FilmError, RenderError};
use std::io;
use std::path::PathBuf;

/// The error that ended a command. Its message has the form `WHAT (WHERE): WHY. WHAT TO DO.`
#[derive(Debug, thiserror::Error)]
pub enum AppError {
    /// The flags contradict each other or do not fit the scene.
    #[error("{0}")]
    Usage(String),
    /// The scene file was refused.
    #[error("{}", advice::import(.0))]
    Import(#[from] ImportError),
    /// Another input was refused.
    #[error("{0}")]
    Refused(String),
    /// A film was refused, or cannot be merged with the others.
    #[error("cannot use the film ({}): {error}", path.display())]
    Film {
        /// The film's file.
        path: PathBuf,
        /// The reason.
        error: FilmError,
    },
    /// Two films cannot be merged.
    #[error("cannot merge ({} and {}): {error}", paths[0].display(), paths[1].display())]
    Films {
        /// The files of the films.
        paths: [PathBuf; 2],
        /// The reason.
        error: FilmError,
    },
    /// `merge` found parts of the picture missing.
    #[error("{0}")]
    Missing(String),
    /// The scene cannot be packed for the GPU.
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
    /// No display is available for the window.
    #[error("{0}")]
    NoDisplay(String),
    /// The picture or report could not be written.
    #[error(transparent)]
    Output(#[from] OutputError),
    /// Standard output cannot be written.
    #[error("cannot write the result (standard output): {}. Redirect it elsewhere.", output::reason(.0))]
    Stdout(#[source] io::Error),
    /// An output file must not or cannot be written.
    #[error("{0}")]
    Unwritable(String),
    /// More memory is needed than the process may use.
    #[error("{0}")]
    TooBig(String),
    /// A run ended early, but a part of its work is kept.
    #[error("{}{kept}", prefix(error))]
    Stopped {
        /// The error that ended it.
        error: Box<AppError>,
        /// The kept work and how to resume, as a sentence.
        kept: String,
    },
    /// A part of a farm failed; the code is that of its error.
    #[error("cannot finish the parts: {why}")]
    Part {
        /// The part and its error.
        why: String,
        /// The exit code.
        code: u8,
    },
    /// `compare` found the pictures different.
    #[error("{0}")]
    Different(String),
    /// A signal requested termination.
    #[error("interrupted: no picture was written.")]
    Interrupted {
        /// 128 plus the signal's number.
        exit_code: u8,
    },
    /// A bug in glimray.
    #[error("internal fault ({0}). Please report it.")]
    Internal(String),
}

impl AppError {
    /// The exit code, a stable interface for scripts.
    pub fn exit_code(&self) -> u8 {
        match self {
            Self::Internal(_)
            | Self::Pack(PackError::NoCamera | PackError::Inconsistent { .. }) => 1,
            Self::Usage(_) => 2,
            Self::Import(error) if error.is_too_big() => 7,
            Self::Import(_) | Self::Refused(_) | Self::Film { .. } | Self::Films { .. } => 3,
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
            Self::Render(RenderError::Film(_) | RenderError::BeyondLecture { .. }) => 3,
            Self::Part { code, .. } => *code,
            Self::Interrupted { exit_code } => *exit_code,
        }
    }
}

fn gpu_exit_code(error: &GpuError) -> u8 {
    match error {
        GpuError::NoAdapter { .. }
        | GpuError::NoBackend { .. }
        | GpuError::NoSuchAdapter { .. }
        | GpuError::NoDevice { .. }
        | GpuError::WrongLanes { .. } => 5,
        GpuError::Lost | GpuError::KeptFailing { .. } => 6,
        GpuError::Limit { .. } | GpuError::Budget { .. } | GpuError::OutOfMemory { .. } => 7,
        GpuError::Internal { .. } => 1,
    }
}

/// The text before the sentence about what is kept.
fn prefix(error: &AppError) -> String {
    match error {
        AppError::Interrupted { .. } => "interrupted: ".into(),
        other => format!("{other} "),
    }
}
