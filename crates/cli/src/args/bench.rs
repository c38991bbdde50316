//! The arguments of `glimray bench`.

use super::DeviceFlags;
use clap::Args;
use std::path::PathBuf;

/// What to measure, how often, and how to print it.
#[derive(Debug, Args)]
pub struct BenchArgs {
    /// Number of runs of each measurement; medians and spread are reported [default: 3, with --quick 1]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..=1000))]
    pub repeats: Option<u32>,
    /// Run only measurements whose name contains this
    #[arg(long, value_name = "NAME")]
    pub only: Option<String>,
    /// Measure less: smaller pictures, fewer rays, and no terrain of 4,000,000 triangles
    #[arg(long)]
    pub quick: bool,
    /// Print the ratios to an earlier run, whose output with --json is in this file
    #[arg(long, value_name = "OLD.json")]
    pub compare: Option<PathBuf>,
    /// Measure nothing, but write the triangles and rays of the scenes into this folder, for other programs
    ///
    /// One folder for each scene without spheres; the format is in benches/peers/README.md.
    #[arg(long, value_name = "FOLDER", conflicts_with_all = ["compare", "json", "repeats"])]
    pub export_rays: Option<PathBuf>,
    /// Print JSON instead of text
    #[arg(long)]
    pub json: bool,
    #[command(flatten)]
    pub device: DeviceFlags,
}

impl BenchArgs {
    /// The number of runs of each measurement.
    pub fn repeats(&self) -> u32 {
        self.repeats.unwrap_or(if self.quick { 1 } else { 3 })
    }
}
