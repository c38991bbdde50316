//! The flags of `glimray farm`.

use super::values;
use super::{
    CameraFlags, DeviceFlags, LayerFlags, LogFlags, MomentFlags, MotionFlags, PictureFlags,
    RangeFlags, SceneFlags,
};
use clap::{Args, Subcommand, ValueEnum};
use std::path::PathBuf;

/// The batch engines.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum Engine {
    /// Slurm: an array job and a job that depends on it
    Slurm,
}

/// The steps of a farm.
#[derive(Debug, Subcommand)]
pub enum FarmCommand {
    /// Cut a picture or an animation into parts and write the farm's folder.
    ///
    /// A short sample is rendered to measure what each part costs. The folder holds the manifest and the scene with
    /// everything it names, so that other machines need nothing else.
    #[command(after_help = "Examples:\n  \
            glimray farm plan scene.toml --samples 16384 --parts 64 -o still.exr\n  \
            glimray farm plan scene.toml --minutes 20 -o film.mp4\n  \
            glimray farm plan scene.toml --simulate 16,256,4096 -o film.mp4")]
    Plan(Box<FarmPlanArgs>),
    /// Render parts; what is done and valid is skipped.
    #[command(after_help = "Examples:\n  \
            glimray farm run still.exr.farm 3\n  \
            glimray farm run still.exr.farm --all --jobs 4\n\n\
            Any number of these may run at a time, on any number of machines that share the folder.")]
    Run(FarmRunArgs),
    /// Count the parts that are done, running and failed, and estimate the end.
    Status(FarmStatusArgs),
    /// Write the job scripts of a batch engine and submit them: the parts, and the merge after them.
    #[command(after_help = "Examples:\n  \
            glimray farm submit still.exr.farm --engine slurm --dry-run\n  \
            glimray farm submit still.exr.farm --engine slurm --partition gpu --gres gpu:1 --time 1:00:00")]
    Submit(FarmSubmitArgs),
    /// Merge the parts to the picture, the frames or the video.
    Merge(FarmMergeArgs),
}

#[derive(Debug, Args)]
pub struct FarmPlanArgs {
    /// Scene file, in any format that `render` reads
    pub scene: PathBuf,
    /// The result: a picture (.png .jpg .jpeg .exr .hdr .film), a video (.mp4 .gif .y4m), or frames such as NAME_%04d.png
    #[arg(short = 'o', long = "output", value_name = "OUT")]
    pub path: PathBuf,
    /// Folder of the farm, which must not exist or be empty [default: OUT.farm]
    #[arg(long, value_name = "DIR")]
    pub dir: Option<PathBuf>,
    /// Least number of parts
    #[arg(long, value_name = "N", required_unless_present_any = ["minutes", "simulate"], conflicts_with = "minutes", value_parser = clap::value_parser!(u32).range(1..=1_000_000))]
    pub parts: Option<u32>,
    /// Longest time of a part on a machine as fast as this one, 0.01 to 100000
    #[arg(long, value_name = "MINUTES", value_parser = values::minutes)]
    pub minutes: Option<f64>,
    /// Predict the efficiency on these numbers of machines, and write nothing
    #[arg(long, value_name = "N,…", value_delimiter = ',', conflicts_with_all = ["parts", "minutes"], value_parser = clap::value_parser!(u32).range(1..=1_000_000))]
    pub simulate: Vec<u32>,
    /// Quality of JPEG pictures and videos, 1 (smallest file) to 100 (best)
    #[arg(long, value_name = "1..100", default_value = "90", value_parser = clap::value_parser!(u8).range(1..=100))]
    pub quality: u8,
    #[command(flatten)]
    pub layers: LayerFlags,
    #[command(flatten)]
    pub range: RangeFlags,
    #[command(flatten)]
    pub moment: MomentFlags,
    #[command(flatten)]
    pub motion: MotionFlags,
    #[command(flatten)]
    pub picture: PictureFlags,
    #[command(flatten)]
    pub camera: CameraFlags,
    #[command(flatten)]
    pub reading: SceneFlags,
    #[command(flatten)]
    pub device: DeviceFlags,
    #[command(flatten)]
    pub log: LogFlags,
}

#[derive(Debug, Args)]
pub struct FarmRunArgs {
    /// Folder of the farm
    pub dir: PathBuf,
    /// Number of the part, from 0
    #[arg(required_unless_present_any = ["all", "slice"], conflicts_with_all = ["all", "slice"])]
    pub part: Option<u32>,
    /// Render every part that is not done
    #[arg(long)]
    pub all: bool,
    /// Render every Nth part, starting with part I, as the tasks of an array job do
    #[arg(long, value_name = "I/N", conflicts_with = "all", value_parser = values::slice)]
    pub slice: Option<(u32, u32)>,
    /// Number of processes that share the parts
    #[arg(long, value_name = "N", default_value = "1", requires = "all", value_parser = clap::value_parser!(u32).range(1..=1024))]
    pub jobs: u32,
    /// How often a part is tried, whatever the number of processes
    #[arg(long, value_name = "N", default_value = "3", value_parser = clap::value_parser!(u32).range(1..=1000))]
    pub attempts: u32,
    /// The run that this process belongs to: `--jobs` gives all its processes the same
    #[arg(long, value_name = "NAME", hide = true)]
    pub run: Option<String>,
    /// Time after which another process may take over a part whose process does not answer, 1 to 86400
    #[arg(long, value_name = "SECONDS", default_value = "60", value_parser = values::lease)]
    pub lease: f64,
    /// Print only warnings and errors
    #[arg(short, long)]
    pub quiet: bool,
}

#[derive(Debug, Args)]
pub struct FarmStatusArgs {
    /// Folder of the farm
    pub dir: PathBuf,
    /// Show a progress bar until all parts are done or have failed, also while they wait for machines
    #[arg(long)]
    pub follow: bool,
    /// Print JSON instead of text
    #[arg(long, conflicts_with = "follow")]
    pub json: bool,
}

#[derive(Debug, Args)]
pub struct FarmSubmitArgs {
    /// Folder of the farm
    pub dir: PathBuf,
    /// The batch engine
    #[arg(long, value_enum)]
    pub engine: Engine,
    /// Print the scripts and submit nothing
    #[arg(long)]
    pub dry_run: bool,
    /// Most tasks of the array job; with fewer tasks than parts each renders several of them
    #[arg(long, value_name = "N", default_value = "1000", value_parser = clap::value_parser!(u32).range(1..=1_000_000))]
    pub tasks: u32,
    /// How often a part is tried
    #[arg(long, value_name = "N", default_value = "3", value_parser = clap::value_parser!(u32).range(1..=1000))]
    pub attempts: u32,
    /// Partition of the cluster
    #[arg(long, value_name = "NAME")]
    pub partition: Option<String>,
    /// Time limit of a task, as the engine writes it
    #[arg(long, value_name = "TIME")]
    pub time: Option<String>,
    /// Generic resources of a task, such as gpu:1
    #[arg(long, value_name = "GRES")]
    pub gres: Option<String>,
    /// Any other option of the engine, such as account=film (repeatable)
    #[arg(long = "option", value_name = "KEY=VALUE")]
    pub options: Vec<String>,
}

#[derive(Debug, Args)]
pub struct FarmMergeArgs {
    /// Folder of the farm
    pub dir: PathBuf,
    /// Output instead of the planned one, with the same extension
    #[arg(short = 'o', long = "output", value_name = "OUT")]
    pub path: Option<PathBuf>,
    /// Write what is there even if parts of a still picture are missing
    #[arg(long)]
    pub partial: bool,
    /// Refuse parts of different adapters
    #[arg(long, conflicts_with = "mix_adapters")]
    pub same_adapter: bool,
    /// Merge parts of different adapters in the pictures of an animation
    #[arg(long)]
    pub mix_adapters: bool,
    /// Print only warnings and errors
    #[arg(short, long)]
    pub quiet: bool,
}
