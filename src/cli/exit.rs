//! How the program ends: the error is printed, and the exit code says which kind it was.

use crate::app::console;
use crate::app::error::AppError;
use crate::cli::{memory, snippet};
use crate::gpu;
use crate::output;
use std::io::{self, IsTerminal};
use std::process::ExitCode;

/// Prints `error` and returns its exit code.
pub fn failure(error: &AppError) -> ExitCode {
    console::error(error, error.exit_code());
    if let AppError::Import(error) = error
        && !console::speaks_json()
        && io::stderr().is_terminal()
        && let Some(snippet) = snippet::of(error.fault(), console::red())
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
