//! The command line: one file per command, and what they share. Nothing below this module prints,
//! exits or reads arguments.

mod advice;
mod animate;
mod bench;
mod cli;
mod clock;
mod compare;
mod completions;
mod console;
mod convert;
mod demo;
mod destination;
mod device;
mod doctor;
pub mod error;
pub mod exit;
mod explain;
mod inputs;
mod inspect;
mod interrupt;
mod job;
pub mod legend;
mod man;
mod memory;
mod merge;
pub mod mesa;
mod overrides;
mod picture;
mod progress;
mod render;
mod report;
pub mod scene_file;
mod schema;
mod snippet;
mod turntable;
#[cfg(feature = "viewer")]
pub mod view;

use clap::Parser;
use cli::{Cli, Command};
use error::AppError;
use std::ffi::OsString;
use std::process::ExitCode;
use std::time::Instant;

/// Runs the command that `arguments` (the program's name first) ask for, prints what went wrong to
/// the standard error, and returns the exit code. `started` is when the process began: reports
/// count from there.
pub fn run(arguments: impl IntoIterator<Item = OsString>, started: Instant) -> ExitCode {
    interrupt::survive_file_size_limit();
    memory::exit_as_too_big();
    let arguments = with_command(arguments);
    if wants_json(&arguments) {
        console::speak_json();
    }
    let cli = match Cli::try_parse_from(arguments) {
        Ok(cli) => cli,
        Err(error) => return exit::command_line(&error),
    };
    match dispatch(cli.command, started) {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => exit::failure(&error),
    }
}

/// A program that is started without words on a desktop opens its window.
fn with_command(arguments: impl IntoIterator<Item = OsString>) -> Vec<OsString> {
    let arguments: Vec<_> = arguments.into_iter().collect();
    #[cfg(feature = "viewer")]
    if arguments.len() == 1 && view::window::has_display() {
        return [arguments, vec!["view".into()]].concat();
    }
    arguments
}

/// Whether a program reads the standard error: mistakes in the other arguments are told in its way too.
fn wants_json(arguments: &[OsString]) -> bool {
    let is_pair = |pair: &[OsString]| pair[0] == "--progress" && pair[1] == "json";
    arguments.windows(2).any(is_pair) || arguments.iter().any(|word| word == "--progress=json")
}

fn dispatch(command: Command, started: Instant) -> Result<(), AppError> {
    match command {
        Command::Demo(arguments) => demo::run(&arguments, started),
        Command::Render(arguments) => render::run(&arguments, started),
        Command::Animate(arguments) => animate::run(&arguments, started),
        Command::Turntable(arguments) => turntable::run(&arguments, started),
        #[cfg(feature = "viewer")]
        Command::View(arguments) => view::run(*arguments),
        Command::Merge(arguments) => merge::run(&arguments),
        Command::Convert(arguments) => convert::run(&arguments),
        Command::Inspect(arguments) => inspect::run(&arguments),
        Command::Explain(arguments) => explain::run(&arguments),
        Command::Doctor(arguments) => doctor::run(&arguments),
        Command::Compare(arguments) => compare::run(&arguments),
        Command::Bench(arguments) => bench::run(&arguments),
        Command::Completions(arguments) => completions::run(&arguments),
        Command::Man(arguments) => man::run(&arguments),
        Command::Schema => schema::run(),
    }
}
