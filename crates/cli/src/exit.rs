//! Ends the program: prints the error and returns its exit code.

use crate::{memory, snippet};
use glimray_app::console;
use glimray_app::error::AppError;
use glimray_io::output;
use glimray_render::gpu;
use std::io::{self, IsTerminal};
use std::process::ExitCode;

/// Prints `error` and returns its exit code.
pub fn failure(error: &AppError) -> ExitCode {
    console::error(error, error.exit_code());
    if let AppError::Import(error) = error
        && !console::is_json()
        && io::stderr().is_terminal()
        && let Some(snippet) = snippet::of(error.fault(), console::red())
    {
        console::block(&snippet, |c| c == '\u{1b}');
    }
    ExitCode::from(error.exit_code())
}

/// Prints clap's message and returns the exit code. Help and version go to standard output, errors to
/// standard error.
pub fn command_line(error: &clap::Error) -> ExitCode {
    if error.use_stderr() {
        match console::is_json() {
            true => console::error(one_line(&error.to_string()), 2),
            false => console::wrapped(&match console::shows_color() {
                true => error.render().ansi().to_string(),
                false => error.to_string(),
            }),
        }
        return ExitCode::from(2);
    }
    match error.print() {
        Err(error) if error.kind() != io::ErrorKind::BrokenPipe => {
            failure(&AppError::Stdout(error))
        }
        _ => ExitCode::SUCCESS,
    }
}

/// Clap's error message in one line, without the usage and the pointer to the help.
pub fn one_line(text: &str) -> String {
    let ends = ["\n\nUsage:", "\n\nFor more information"].map(|end| text.find(end));
    let end = ends.into_iter().flatten().min().unwrap_or(text.len());
    let text = &text[..end];
    let text = text.strip_prefix("error: ").unwrap_or(text);
    text.split_whitespace().collect::<Vec<_>>().join(" ")
}

/// Makes a panic, which is always a bug, end the program with a one-line message and exit code 1. While
/// [`gpu::is_guarded`] is true, the panic comes from wgpu and `gpu` handles it.
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
                    "out of memory ({what}): the memory limit (`ulimit -v`) is too low. Raise it, or use \
                     a smaller scene or picture."
                ),
                7,
            ),
            false => (
                format!("internal fault ({place}): {what}. Please report it."),
                1,
            ),
        };
        output::remove_unfinished_files();
        console::error(message, exit_code);
        std::process::exit(exit_code.into());
    }));
}
