//! The flags for messages and the report.

use crate::args::values::{self, PROGRESS};
use clap::Args;
use std::path::PathBuf;

/// Messages, progress and the report.
#[derive(Debug, Args)]
#[command(next_help_heading = "Messages")]
pub struct LogFlags {
    /// Write a JSON report to this file; `-` is standard output
    ///
    /// It has counts, settings, the adapter, times in seconds and memory in bytes. A run that fails writes
    /// one too, with its error and exit code.
    #[arg(long, value_name = "FILE.json")]
    pub report: Option<PathBuf>,
    /// Count the rays of each kind for the report, at a small cost in speed
    #[arg(long)]
    pub count_rays: bool,
    /// Progress display on standard error; with json, every message there is a JSON line
    #[arg(long, default_value = "auto", value_parser = values::one_of(&PROGRESS))]
    pub progress: ProgressMode,
    /// Print only warnings and errors
    #[arg(short, long, conflicts_with = "verbose")]
    pub quiet: bool,
    /// Also print times and sizes
    #[arg(short, long)]
    pub verbose: bool,
}

/// How progress is displayed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ProgressMode {
    Auto,
    Bar,
    Json,
    None,
}
