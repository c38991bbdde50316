//! Flags of `sheet` and `thumbnail`.

use super::flags::{
    AxisFlags, DevelopFlags, DeviceFlags, LogFlags, OutputFlags, SceneFlags, ShownFlags,
    ViewSettingFlags,
};
use super::values;
use clap::Args;
use glimray_app::value_names::ValueNames;
use std::path::PathBuf;

#[derive(Debug, Args)]
pub struct SheetArgs {
    /// Model or scene file, in any format that `render` reads
    pub scene: PathBuf,
    #[command(flatten)]
    pub output: OutputFlags,
    #[command(flatten)]
    pub views: ViewFlags,
    #[command(flatten)]
    pub settings: ViewSettingFlags,
    #[command(flatten)]
    pub develop: DevelopFlags,
    #[command(flatten)]
    pub axis: AxisFlags,
    #[command(flatten)]
    pub reading: SceneFlags,
    #[command(flatten)]
    pub device: DeviceFlags,
    #[command(flatten)]
    pub log: LogFlags,
}

/// The views of a sheet.
#[derive(Debug, Args)]
#[command(next_help_heading = "Views")]
pub struct ViewFlags {
    /// Width and height of each view in pixels, 64 to 2048
    #[arg(long, value_name = "N", allow_hyphen_values = true, default_value = "320", value_parser = clap::value_parser!(u32).range(64..=2048))]
    pub size: u32,
    /// The views and their order, separated by commas [default: all]
    #[arg(long, value_name = "VIEW,…", value_delimiter = ',', value_parser = values::one_of(&VIEWS))]
    pub views: Vec<View>,
    #[command(flatten)]
    pub shown: ShownFlags,
}

/// A view of a model.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum View {
    Front,
    Back,
    Left,
    Right,
    Top,
    Bottom,
    FrontRight,
    BackLeft,
}

pub static VIEWS: ValueNames<View> = ValueNames(&[
    ("front", "from +z", View::Front),
    ("back", "from -z", View::Back),
    ("left", "from -x", View::Left),
    ("right", "from +x", View::Right),
    ("top", "from +y, with -z up", View::Top),
    ("bottom", "from -y, with +z up", View::Bottom),
    (
        "front-right",
        "in perspective, from the front, the right and above",
        View::FrontRight,
    ),
    (
        "back-left",
        "in perspective, from the back, the left and above",
        View::BackLeft,
    ),
]);

#[derive(Debug, Args)]
pub struct ThumbnailArgs {
    /// Model or scene file, in any format that `render` reads; a model may have any name
    pub scene: PathBuf,
    /// Output file, a PNG whatever its name; `-` is standard output
    #[arg(short, long, value_name = "OUT")]
    pub output: PathBuf,
    /// Longest side in pixels, 16 to 1024
    #[arg(long, value_name = "N", allow_hyphen_values = true, default_value = "256", value_parser = clap::value_parser!(u32).range(16..=1024))]
    pub size: u32,
    #[command(flatten)]
    pub axis: AxisFlags,
    #[command(flatten)]
    pub device: DeviceFlags,
}
