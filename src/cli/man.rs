//! `glimray man DIR`: the manual pages.

use super::args::{Cli, ManArgs};
use crate::app::console;
use crate::app::error::AppError;
use crate::output;
use clap::CommandFactory;
use clap_mangen::Man;

/// Writes a page for the program and one for each command, and prints their names.
pub fn run(arguments: &ManArgs) -> Result<(), AppError> {
    let mut program = Cli::command();
    program.build();
    let commands = program.get_subcommands();
    let commands = commands.filter(|command| command.get_name() != "help");
    let mut names = String::new();
    for command in std::iter::once(&program).chain(commands) {
        let page = Man::new(command.clone());
        let path = arguments.folder.join(page.get_filename());
        let mut text = Vec::new();
        page.render(&mut text)
            .map_err(|error| AppError::Internal(error.to_string()))?;
        output::write(&path, &text, true)?;
        names += &format!("{}\n", path.display());
    }
    console::print(&names)
}
