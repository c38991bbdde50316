//! Flags of checkpoints.

use super::values;
use clap::Args;
use std::path::PathBuf;
use std::time::Duration;

/// Where and how often checkpoints of a picture are written.
#[derive(Debug, Default, Args)]
#[command(next_help_heading = "Output")]
pub struct CheckpointFlags {
    /// Keep the state of the render in this file; after an interruption the same command goes on from it
    ///
    /// The picture then has the bytes of an undisturbed run, and the file is removed once the picture is written. A
    /// file that is damaged or of other work is renamed to FILE.old-1. A lock (FILE.lock) allows one run at a time.
    #[arg(long, value_name = "FILE")]
    pub checkpoint: Option<PathBuf>,
    /// Time between two checkpoints in seconds, 0.01 to 1000000, such as 60 or 60s
    #[arg(long, value_name = "SECONDS", allow_hyphen_values = true, default_value = "60", requires = "checkpoint", value_parser = values::interval)]
    pub every: Duration,
    /// Whether something else keeps other runs away from the file, also where there are no file locks: the leases of a farm.
    #[arg(skip)]
    pub is_leased: bool,
}
