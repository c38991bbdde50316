//! `glimray completions SHELL`: prints a shell completion script.

use crate::args::{Cli, CompletionsArgs};
use clap::CommandFactory;
use glimray_app::console;
use glimray_app::error::AppError;

pub fn run(arguments: &CompletionsArgs) -> Result<(), AppError> {
    let mut script = Vec::new();
    clap_complete::generate(arguments.shell, &mut Cli::command(), "glimray", &mut script);
    console::print_bytes(&script)
}
