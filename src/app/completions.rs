//! `glimray completions SHELL`: prints a shell completion script.

use super::cli::{Cli, CompletionsArgs};
use super::console;
use super::error::AppError;
use clap::CommandFactory;

pub fn run(arguments: &CompletionsArgs) -> Result<(), AppError> {
    let mut script = Vec::new();
    clap_complete::generate(arguments.shell, &mut Cli::command(), "glimray", &mut script);
    console::print_bytes(&script)
}
