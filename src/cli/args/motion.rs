//! Flags of moving pictures.

use super::values::{self, SEQUENCE_FORMATS};
use crate::app::overrides::{Moment, TimingOverrides};
use crate::output::Format;
use crate::output::video::VideoFormat;
use crate::scene::Shutter;
use clap::Args;
use glam::{DVec3, Vec3};
use std::path::PathBuf;

/// Which moment of an animation a picture shows.
#[derive(Debug, Default, Args)]
#[command(next_help_heading = "Motion")]
pub struct MomentFlags {
    /// Take the picture at this frame of the scene's animation
    #[arg(long, value_name = "N", allow_hyphen_values = true, value_parser = clap::value_parser!(u32).range(..=i64::from(values::MAX_FRAME)))]
    pub frame: Option<u32>,
    /// Take the picture at this time of the scene's animation, -1e6 to 1e6 [default: 0]
    #[arg(long, value_name = "SECONDS", allow_hyphen_values = true, value_parser = values::time, conflicts_with = "frame")]
    pub time: Option<f64>,
}

/// How frames and time go together.
#[derive(Debug, Default, Args)]
#[command(next_help_heading = "Motion")]
pub struct MotionFlags {
    /// Frames per second, 0.01 to 1000: frame N is at N / FPS seconds [default: the scene's, else 24]
    #[arg(long, value_name = "FPS", allow_hyphen_values = true, value_parser = values::fps)]
    pub fps: Option<f64>,
    /// How long the shutter is open, in frames (0.5), degrees (180deg) or from..to (-0.25..0.25),
    /// from a frame's own time; 0 freezes all movement [default: the scene's, else 0]
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

/// Which frames there are.
#[derive(Debug, Default, Args)]
#[command(next_help_heading = "Motion")]
pub struct RangeFlags {
    /// The frames from A to B, both included; A.. ends with the scene's animation, A is one frame
    /// [default: the scene's whole animation]
    #[arg(long, value_name = "A..B", allow_hyphen_values = true, value_parser = values::frames)]
    pub frames: Option<Range>,
    /// Only every Nth frame; a video then has fewer per second, and takes as long
    #[arg(long, value_name = "N", allow_hyphen_values = true, default_value = "1", value_parser = clap::value_parser!(u32).range(1..=1_000_000))]
    pub step: u32,
    /// The end is the start again: leave out the last frame, and let a GIF repeat for ever
    #[arg(long = "loop")]
    pub repeat: bool,
}

/// Frames as asked for: `last` is `None` for the end of the animation.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Range {
    pub first: u32,
    pub last: Option<u32>,
}

/// Where moving pictures go.
#[derive(Debug, Args)]
#[command(next_help_heading = "Output")]
pub struct SequenceFlags {
    /// Write a video (.mp4 .gif .y4m), or a file for each frame: NAME_%04d.png (or .jpg .jpeg .exr
    /// .hdr) with four digits, NAME_####.png is the same; `-` streams Y4M to the standard output
    /// [default: the scene's name with .mp4, in the current folder]
    #[arg(short = 'o', long = "output", value_name = "OUT")]
    pub path: Option<PathBuf>,
    /// Write this format, whatever the name's ending [default: by the ending; y4m to `-`]
    #[arg(long, value_parser = values::one_of(&SEQUENCE_FORMATS))]
    pub format: Option<SequenceFormat>,
    /// Quality of JPEG frames and of a video, 1 (smallest) to 100 (best)
    #[arg(long, value_name = "1..100", default_value = "90", value_parser = clap::value_parser!(u8).range(1..=100))]
    pub quality: u8,
    /// Refuse to replace a video that exists, and frames that no earlier run of this animation wrote
    #[arg(long)]
    pub no_clobber: bool,
    /// Keep the frames of a video here [default: OUT.frames beside it; none for `-`]
    #[arg(long, value_name = "DIR")]
    pub frames_dir: Option<PathBuf>,
    /// Remove the frames of a video when it is written
    #[arg(long)]
    pub discard_frames: bool,
    /// Write the video from the frames that are there, and render nothing
    #[arg(long)]
    pub encode_only: bool,
}

/// What `--format` of a moving picture names.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SequenceFormat {
    /// A file for each frame.
    Frames(Format),
    Video(VideoFormat),
}

/// How a model turns.
#[derive(Debug, Args)]
#[command(next_help_heading = "Turntable")]
pub struct TurnFlags {
    /// How long one turn takes, 0.01 to 10000
    #[arg(long, default_value = "4", allow_hyphen_values = true, value_parser = values::seconds)]
    pub seconds: f64,
    /// Frames per second, 0.01 to 1000
    #[arg(long, default_value = "24", allow_hyphen_values = true, value_parser = values::fps)]
    pub fps: f64,
    /// What it turns round, and what is up in the picture: x, y, z or a direction
    #[arg(long, value_name = "x|y|z|X,Y,Z", default_value = "y", allow_hyphen_values = true, value_parser = values::axis)]
    pub axis: DVec3,
    /// How high above the middle of the model the camera is, in degrees, -89 to 89
    #[arg(long, value_name = "DEG", default_value = "20", allow_hyphen_values = true, value_parser = values::elevation)]
    pub elevation: f64,
    /// Vertical field of view in degrees, 1 to 170
    #[arg(long, value_name = "DEG", default_value = "35", allow_hyphen_values = true, value_parser = values::turn_fov_y)]
    pub fov_y: f64,
    /// Share of the picture that stays free at its edges, 0 to 0.9
    #[arg(long, default_value = "0.05", allow_hyphen_values = true, value_parser = values::margin)]
    pub margin: f64,
    /// Turn the model clockwise, seen from above
    #[arg(long)]
    pub clockwise: bool,
    /// Linear radiance of rays that hit nothing, 0 or more
    #[arg(long, value_name = "R,G,B", allow_hyphen_values = true, value_parser = values::color)]
    pub background: Option<Vec3>,
    /// How long the shutter is open, in frames (0.5), degrees (180deg) or from..to (-0.25..0.25);
    /// 0 freezes all movement [default: the model's, else 0]
    #[arg(long, value_name = "FRAMES", allow_hyphen_values = true, value_parser = values::shutter)]
    pub shutter: Option<Shutter>,
}
