//! The command line: one file per command, and the code they share. Nothing below this module prints, exits
//! or reads arguments. [`embedded`] runs commands for another program in its own process.

mod animate;
mod args;
pub mod bench;
mod checkpoint;
mod compare;
mod completions;
mod convert;
mod darkness;
mod demo;
mod destination;
mod device;
mod doctor;
pub mod embedded;
pub mod exit;
mod explain;
#[cfg(feature = "archive")]
mod farm;
mod idle_flags;
mod inspect;
mod interrupt;
mod job;
mod layers;
mod man;
mod memory;
mod merge;
mod mesa;
mod picture;
mod progress;
mod render;
mod report;
mod scene_file;
mod schema;
mod sheet;
mod snippet;
mod thumbnail;
mod turntable;
#[cfg(feature = "viewer")]
pub mod view;

use args::{Cli, Command};
use clap::{ArgMatches, CommandFactory, FromArgMatches};
use glimray_app::console;
use glimray_app::error::AppError;
use glimray_app::window::Window;
use std::ffi::OsString;
use std::process::ExitCode;
use std::time::Instant;

/// Runs the command in `arguments`, whose first element is the program's name. Prints errors to standard
/// error and returns the exit code. `started` is when the process began; reports measure from there.
/// `window` is the program's window; without it there is no `view`.
pub fn run(
    arguments: impl IntoIterator<Item = OsString>,
    started: Instant,
    window: Option<&Window>,
) -> ExitCode {
    interrupt::survive_file_size_limit();
    memory::exit_as_too_big();
    let arguments = with_command(arguments, window);
    if wants_json(&arguments) {
        console::use_json();
    }
    let parsed = (Cli::command().try_get_matches_from(arguments))
        .and_then(|matches| Ok((Cli::from_arg_matches(&matches)?, matches)));
    let (cli, matches) = match parsed {
        Ok(parsed) => parsed,
        Err(error) => return exit::command_line(&error),
    };
    #[cfg(feature = "viewer")]
    let opens_window = matches!(cli.command, Command::View(_));
    #[cfg(not(feature = "viewer"))]
    let opens_window = false;
    mesa::set_environment(opens_window);
    match dispatch(cli.command, &matches, started, window) {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => exit::failure(&error),
    }
}

/// `glimray` alone opens the window on a desktop.
fn with_command(
    arguments: impl IntoIterator<Item = OsString>,
    window: Option<&Window>,
) -> Vec<OsString> {
    let mut arguments: Vec<_> = arguments.into_iter().collect();
    if arguments.len() == 1 && window.is_some_and(|window| (window.has_display)()) {
        arguments.push("view".into());
    }
    arguments
}

/// Whether `--progress json` is among the arguments. Checked before parsing, so that a command-line error is
/// a JSON line too.
fn wants_json(arguments: &[OsString]) -> bool {
    let is_pair = |pair: &[OsString]| pair[0] == "--progress" && pair[1] == "json";
    arguments.windows(2).any(is_pair) || arguments.iter().any(|word| word == "--progress=json")
}

fn dispatch(
    command: Command,
    matches: &ArgMatches,
    started: Instant,
    window: Option<&Window>,
) -> Result<(), AppError> {
    #[cfg(not(feature = "archive"))]
    let _ = matches;
    match command {
        Command::Demo(arguments) => demo::run(&arguments, started),
        Command::Render(arguments) => render::run(&arguments, started),
        Command::Animate(arguments) => animate::run(&arguments, started),
        Command::Turntable(arguments) => turntable::run(&arguments, started),
        Command::Sheet(arguments) => sheet::run(&arguments, started),
        Command::Thumbnail(arguments) => thumbnail::run(&arguments, started),
        #[cfg(feature = "viewer")]
        Command::View(arguments) => view::run(&arguments, window),
        Command::Merge(arguments) => merge::run(&arguments),
        #[cfg(feature = "archive")]
        Command::Farm(arguments) => {
            let matches = matches.subcommand_matches("farm").unwrap_or(matches);
            farm::run(&arguments, matches, started)
        }
        Command::Convert(arguments) => convert::run(&arguments),
        Command::Inspect(arguments) => inspect::run(&arguments),
        Command::Explain(arguments) => explain::run(&arguments),
        Command::Doctor(arguments) => doctor::run(&arguments),
        Command::Compare(arguments) => compare::run(&arguments),
        Command::Bench(arguments) => bench::run(&arguments, window),
        Command::Completions(arguments) => completions::run(&arguments),
        Command::Man(arguments) => man::run(&arguments),
        Command::Schema(arguments) => schema::run(&arguments),
    }
}
