//! How the program ends: one error for everything that can go wrong, its exit code, and its words.

use super::{advice, console, memory, snippet};
use crate::gpu::{self, GpuError};
use crate::import::ImportError;
use crate::output::{self, OutputError};
use crate::pack::PackError;
use crate::render::{FilmError, RenderError};
use std::io::{self, IsTerminal};
use std::path::PathBuf;
use std::process::ExitCode;

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

/// Prints `error` and returns its exit code.
pub fn failure(error: &AppError) -> ExitCode {
    console::error(error, error.exit_code());
    if let AppError::Import(error) = error
        && !console::speaks_json()
        && io::stderr().is_terminal()
        && let Some(snippet) = snippet::of(error.fault())
    {
        console::block(&snippet, |c| c == '\u{1b}');
    }
    ExitCode::from(error.exit_code())
}

/// Prints what clap has to say: help and version to the standard output, mistakes to the standard
/// error; and returns the exit code.
pub fn command_line(error: &clap::Error) -> ExitCode {
    if error.use_stderr() && console::speaks_json() {
        console::error(mistake(&error.to_string()), 2);
        return ExitCode::from(2);
    }
    let printed = error.print();
    match (error.use_stderr(), printed) {
        (true, _) => ExitCode::from(2),
        (false, Err(error)) if error.kind() != io::ErrorKind::BrokenPipe => {
            failure(&AppError::Stdout(error))
        }
        (false, _) => ExitCode::SUCCESS,
    }
}

/// What clap has to say of a mistake, in one line and without the usage.
fn mistake(text: &str) -> String {
    let text = text.split("\n\nUsage:").next().unwrap_or_default();
    let text = text.strip_prefix("error: ").unwrap_or(text);
    text.split_whitespace().collect::<Vec<_>>().join(" ")
}

/// Makes a panic, which is always our bug, end the program with one line and exit code 1. While
/// [`gpu::is_guarded`] says so the panic is one of wgpu's, and `gpu` deals with it.
pub fn install_panic_hook() {
    std::panic::set_hook(Box::new(|panic| {
        if gpu::is_guarded() {
            return;
        }
        let place = panic.location().map_or_else(
            || "unknown place".into(),
            |place| format!("{}:{}", place.file(), place.line()),
        );
        let what = panic.payload_as_str().unwrap_or("no message");
        let what = what.trim_end().trim_end_matches('.');
        let (message, exit_code) = match memory::is_short() {
            true => (
                format!(
                    "out of memory ({what}): the limit (`ulimit -v`) leaves too little. Raise the \
                     limit, or use a smaller scene or picture."
                ),
                7,
            ),
            false => (
                format!("internal fault ({place}): {what}. Please report it."),
                1,
            ),
        };
        output::clear_away();
        console::error(message, exit_code);
        std::process::exit(exit_code.into());
    }));
}
