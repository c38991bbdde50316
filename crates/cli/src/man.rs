//! `glimray man DIR`: the manual pages.

use super::args::{Cli, ManArgs};
use clap::{Command, CommandFactory};
use clap_mangen::Man;
use glimray_app::console;
use glimray_app::error::AppError;
use glimray_io::output;
use std::path::Path;

/// Writes a page for the program and one for each command and subcommand, and prints their names.
pub fn run(arguments: &ManArgs) -> Result<(), AppError> {
    let mut program = Cli::command();
    program.build();
    let mut names = String::new();
    write(&program, &arguments.folder, &mut names)?;
    console::print(&names)
}

/// Writes the page of `command` and those of all commands below it, and adds their paths to `names`, one a line.
fn write(command: &Command, folder: &Path, names: &mut String) -> Result<(), AppError> {
    let page = Man::new(command.clone());
    let path = folder.join(page.get_filename());
    let mut text = Vec::new();
    page.render(&mut text)
        .map_err(|error| AppError::Internal(error.to_string()))?;
    output::write(&path, &text, true)?;
    *names += &format!("{}\n", path.display());
    let commands = command.get_subcommands();
    let mut commands = commands.filter(|command| command.get_name() != "help");
    commands.try_for_each(|command| write(command, folder, names))
}
