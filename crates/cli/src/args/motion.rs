//! Flags for animation.

use super::flags::ShownFlags;
use super::values::{self, SEQUENCE_FORMATS};
use clap::Args;
use glam::DVec3;
use glimray_app::overrides::{Moment, TimingOverrides};
use glimray_io::output::Format;
use glimray_io::output::video::VideoFormat;
use glimray_scene::Shutter;
use std::path::PathBuf;

/// The time at which a single picture is taken.
#[derive(Debug, Default, Args)]
#[command(next_help_heading = "Motion")]
pub struct MomentFlags {
    /// Render this frame of the scene's animation
    #[arg(long, value_name = "N", allow_hyphen_values = true, value_parser = clap::value_parser!(u32).range(..=i64::from(values::MAX_FRAME)))]
    pub frame: Option<u32>,
    /// Render the scene's animation at this time, -1e6 to 1e6 [default: 0]
    #[arg(long, value_name = "SECONDS", allow_hyphen_values = true, value_parser = values::time, conflicts_with = "frame")]
    pub time: Option<f64>,
}

/// Frame rate and shutter.
#[derive(Debug, Default, Args)]
#[command(next_help_heading = "Motion")]
pub struct MotionFlags {
    /// Frames per second, 0.01 to 1000; frame N is at N / FPS seconds [default: the scene's, else 24]
    #[arg(long, value_name = "FPS", allow_hyphen_values = true, value_parser = values::fps)]
    pub fps: Option<f64>,
    /// Shutter interval for motion blur [default: the scene's, else 0]
    ///
    /// A length in frames (0.5) or degrees (180deg) that starts at the frame's time, or open..close in
    /// frames relative to it (-0.25..0.25). 0 switches motion blur off.
    #[arg(long, value_name = "FRAMES", allow_hyphen_values = true, value_parser = values::shutter)]
    pub shutter: Option<Shutter>,
}

impl MomentFlags {
    pub fn moment(&self) -> Moment {
        Moment {
            frame: self.frame,
            time: self.time,
        }
    }
}

impl MotionFlags {
    pub fn overrides(&self) -> TimingOverrides {
        TimingOverrides {
            fps: self.fps,
            shutter: self.shutter,
        }
    }
}

/// The frame range.
#[derive(Debug, Default, Args)]
#[command(next_help_heading = "Motion")]
pub struct RangeFlags {
    /// Frames A to B inclusive; A.. runs to the end of the animation, A is a single frame [default: the
    /// whole animation]
    #[arg(long, value_name = "A..B", allow_hyphen_values = true, value_parser = values::frames)]
    pub frames: Option<Range>,
    /// Render every Nth frame; a video keeps its duration at a lower frame rate
    #[arg(long, value_name = "N", allow_hyphen_values = true, default_value = "1", value_parser = clap::value_parser!(u32).range(1..=1_000_000))]
    pub step: u32,
    /// Loop: leave out the last frame, at which the animation begins again, and repeat a GIF forever
    #[arg(long = "loop")]
    pub repeat: bool,
}

/// A frame range from the command line. A `last` of `None` is the end of the animation.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Range {
    pub first: u32,
    pub last: Option<u32>,
}

/// Where an animation is written.
#[derive(Debug, Args)]
#[command(next_help_heading = "Output")]
pub struct SequenceFlags {
    /// Output video (.mp4 .gif .y4m), or one file per frame such as NAME_%04d.png (.png .jpg .jpeg .exr
    /// .hdr; NAME_####.png means the same); `-` streams Y4M to standard output [default: the scene's name
    /// with .mp4 in the current folder]
    #[arg(short = 'o', long = "output", value_name = "OUT")]
    pub path: Option<PathBuf>,
    /// File format, whatever the extension [default: by extension; y4m for `-`]
    #[arg(long, value_parser = values::one_of(&SEQUENCE_FORMATS))]
    pub format: Option<SequenceFormat>,
    /// Quality of JPEG frames and videos, 1 (smallest file) to 100 (best)
    #[arg(long, value_name = "1..100", default_value = "90", value_parser = clap::value_parser!(u8).range(1..=100))]
    pub quality: u8,
    /// Do not replace an existing video, or frames that no earlier run of this animation wrote
    #[arg(long)]
    pub no_clobber: bool,
    /// Folder for the frames of a video [default: OUT.frames beside it; none for `-`]
    #[arg(long, value_name = "DIR")]
    pub frames_dir: Option<PathBuf>,
    /// Keep the frames of a video after it is written, as --frames-dir and --encode-only do
    #[arg(long)]
    pub keep_frames: bool,
    /// Remove the frames after the video is written even with --frames-dir or --encode-only
    #[arg(long, conflicts_with = "keep_frames")]
    pub discard_frames: bool,
    /// Encode the video from existing frames without rendering
    #[arg(long)]
    pub encode_only: bool,
}

/// The formats of an animation.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SequenceFormat {
    /// One file per frame.
    Frames(Format),
    Video(VideoFormat),
}

/// The turntable's motion and camera.
#[derive(Debug, Args)]
#[command(next_help_heading = "Turntable")]
pub struct TurnFlags {
    /// Duration of one turn, 0.01 to 10000
    #[arg(long, default_value = "4", allow_hyphen_values = true, value_parser = values::seconds)]
    pub seconds: f64,
    /// Frames per second, 0.01 to 1000
    #[arg(long, default_value = "24", allow_hyphen_values = true, value_parser = values::fps)]
    pub fps: f64,
    /// Rotation axis and up direction: x, y, z or a vector
    #[arg(long, value_name = "x|y|z|X,Y,Z", default_value = "y", allow_hyphen_values = true, value_parser = values::axis)]
    pub axis: DVec3,
    /// Elevation of the camera above the model's centre in degrees, -89 to 89
    #[arg(long, value_name = "DEG", default_value = "20", allow_hyphen_values = true, value_parser = values::elevation)]
    pub elevation: f64,
    /// Vertical field of view in degrees, 1 to 170
    #[arg(long, value_name = "DEG", default_value = "35", allow_hyphen_values = true, value_parser = values::turn_fov_y)]
    pub fov_y: f64,
    /// Empty margin around the model, as a fraction of the picture, 0 to 0.9
    #[arg(long, default_value = "0.05", allow_hyphen_values = true, value_parser = values::margin)]
    pub margin: f64,
    /// Turn the model clockwise, seen from above
    #[arg(long)]
    pub clockwise: bool,
    #[command(flatten)]
    pub shown: ShownFlags,
    /// Shutter interval for motion blur [default: the model's, else 0]
    ///
    /// A length in frames (0.5) or degrees (180deg) that starts at the frame's time, or open..close in
    /// frames relative to it (-0.25..0.25). 0 switches motion blur off.
    #[arg(long, value_name = "FRAMES", allow_hyphen_values = true, value_parser = values::shutter)]
    pub shutter: Option<Shutter>,
}
