//! `glimray completions SHELL`: prints a shell completion script.

use crate::app::console;
use crate::app::error::AppError;
use crate::cli::args::{Cli, CompletionsArgs};
use clap::CommandFactory;

pub fn run(arguments: &CompletionsArgs) -> Result<(), AppError> {
    let mut script = Vec::new();
    clap_complete::generate(arguments.shell, &mut Cli::command(), "glimray", &mut script);
    console::print_bytes(&script)
}
