//! Flags that several commands share, in groups as the help shows them.

use super::values::{self, BACKENDS, FORMATS, PROGRESS};
use crate::app::overrides::{CameraOverrides, PictureOverrides, ToneOverrides};
use crate::app::words::{ANTIALIAS, FILTERS, INTEGRATORS, TONES, TRANSFERS, TRIANGLE_TESTS};
use crate::gpu::{AdapterChoice, Backend};
use crate::import;
use crate::output::Format;
use crate::render::{Antialias, Integrator, TriangleTest};
use crate::scene::{Filter, ToneCurve, Transfer};
use clap::Args;
use glam::{DVec3, Vec3};
use std::path::PathBuf;

/// Where the picture goes.
#[derive(Debug, Args)]
#[command(next_help_heading = "Output")]
pub struct OutputFlags {
    /// Write the picture here; the ending chooses the format (.png .jpg .jpeg .exr .hdr, or
    /// .film for what is developed later), `-` is the standard output [default: the scene's name with .png, in the current folder; for the
    /// demo glimray.png]
    #[arg(short = 'o', long = "output", value_name = "OUT")]
    pub path: Option<PathBuf>,
    /// Write this format, whatever the name's ending [default: by the ending; png to `-`]
    #[arg(long, value_parser = values::one_of(&FORMATS))]
    pub format: Option<Format>,
    /// Quality of a JPEG, 1 (smallest) to 100 (best)
    #[arg(long, value_name = "1..100", default_value = "90", value_parser = clap::value_parser!(u8).range(1..=100))]
    pub quality: u8,
    /// Refuse to replace a file that exists
    #[arg(long)]
    pub no_clobber: bool,
}

/// Which samples of the picture are rendered.
#[derive(Debug, Default, Args)]
#[command(next_help_heading = "Output")]
pub struct PartFlags {
    /// Render the samples from this one on, a multiple of 64, into a film (.film) [default: 0]
    #[arg(long, value_name = "A", allow_hyphen_values = true)]
    pub sample_offset: Option<u32>,
    /// Render so many samples of each pixel, a multiple of 64, into a film [default: all that are left]
    #[arg(long, value_name = "N", allow_hyphen_values = true, value_parser = clap::value_parser!(u32).range(1..))]
    pub sample_count: Option<u32>,
}

/// How large and how fine the picture is.
#[derive(Debug, Default, Args)]
#[command(next_help_heading = "Picture")]
pub struct SizeFlags {
    /// Width and height in pixels [default: the scene's, else 640x480]
    #[arg(long, value_name = "WxH", allow_hyphen_values = true, value_parser = values::size)]
    pub size: Option<(u32, u32)>,
    /// Samples per pixel, 1 to 65536 [default: the scene's, else 16 with a lens, a light with extent
    /// or an open shutter, else 1]
    #[arg(long, value_name = "N", allow_hyphen_values = true, value_parser = clap::value_parser!(u32).range(1..=65_536))]
    pub samples: Option<u32>,
}

/// How the picture is computed and developed.
#[derive(Debug, Default, Args)]
#[command(next_help_heading = "Picture")]
pub struct PictureFlags {
    #[command(flatten)]
    pub size: SizeFlags,
    /// Where samples lie in a pixel [default: stratified for more than one sample, else none]
    #[arg(long, value_parser = values::one_of(&ANTIALIAS))]
    pub antialias: Option<Antialias>,
    /// Adaptive sampling goes on where the estimated error, or after the first samples the difference
    /// from a neighbour, is more than this; on the square root of luminance, where 1 is white
    /// [default: the scene's, else 0.01]
    #[arg(long, value_name = "NOISE", allow_hyphen_values = true, value_parser = values::noise)]
    pub noise: Option<f32>,
    /// Bounces after the first hit, 0 to 1000; 0 is local shading only [default: the
    /// scene's, else 5, for .scene 0]
    #[arg(long, value_name = "N", allow_hyphen_values = true, value_parser = clap::value_parser!(u32).range(0..=1000))]
    pub max_depth: Option<u32>,
    /// Send mirrored and refracted rays only if their share in the sample is at least this, 0 to 1
    /// [default: 1/512]
    #[arg(long, value_name = "SHARE", allow_hyphen_values = true, value_parser = values::share)]
    pub min_throughput: Option<f32>,
    /// What samples round a pixel are weighted by [default: the scene's, else box]
    #[arg(long, value_parser = values::one_of(&FILTERS))]
    pub filter: Option<Filter>,
    /// How far the filter reaches, 0.01 to 16 [default: box 0.5, tent 1, mitchell 2, others 1.5]
    #[arg(long, value_name = "PIXELS", allow_hyphen_values = true, value_parser = values::filter_radius)]
    pub filter_radius: Option<f32>,
    /// Multiplies the samples of every area light, 0.001 to 1000 [default: the scene's, else 1]
    #[arg(long, value_name = "FACTOR", allow_hyphen_values = true, value_parser = values::light_samples)]
    pub light_samples: Option<f32>,
    /// What is computed for a ray [default: whitted]
    #[arg(long, value_parser = values::one_of(&INTEGRATORS))]
    pub integrator: Option<Integrator>,
    /// How rays meet triangles [default: watertight]
    #[arg(long, value_parser = values::one_of(&TRIANGLE_TESTS))]
    pub triangle_test: Option<TriangleTest>,
    /// Try every primitive for every ray instead of searching a tree: the same picture, slowly
    #[arg(long)]
    pub no_bvh: bool,
    #[command(flatten)]
    pub develop: DevelopFlags,
    /// Random seed: the same scene, settings and seed give the same picture
    #[arg(
        long,
        value_name = "N",
        allow_hyphen_values = true,
        default_value = "0"
    )]
    pub seed: u32,
    /// Render only the columns X0 to X1-1 and rows Y0 to Y1-1, in pixels from the top-left
    #[arg(long, value_name = "X0,Y0,X1,Y1", allow_hyphen_values = true, value_parser = values::crop)]
    pub crop: Option<[u32; 4]>,
}

/// How the picture is developed.
#[derive(Debug, Default, Args)]
#[command(next_help_heading = "Picture")]
pub struct DevelopFlags {
    /// Brightens the picture by 2^EV, -64 to 64 [default: the scene's, else 0; for .exr and .hdr 0]
    #[arg(long, value_name = "EV", allow_hyphen_values = true, value_parser = values::exposure)]
    pub exposure: Option<f32>,
    /// Tone curve [default: the scene's, else none; for .exr and .hdr and debug views none]
    #[arg(long, value_parser = values::one_of(&TONES))]
    pub tone: Option<ToneCurve>,
    /// Transfer function [default: the scene's, else srgb; for .exr and .hdr and debug views linear]
    #[arg(long, value_parser = values::one_of(&TRANSFERS))]
    pub transfer: Option<Transfer>,
}

/// What the picture is taken of.
#[derive(Debug, Default, Args)]
#[command(next_help_heading = "Camera")]
pub struct CameraFlags {
    /// One of the scene's cameras, by its name or its number as `inspect` lists it
    #[arg(long, value_name = "NAME")]
    pub camera: Option<String>,
    /// Vertical field of view in degrees, 0.001 to 179.9; gives an orthographic camera perspective
    #[arg(long, value_name = "DEG", allow_hyphen_values = true, value_parser = values::fov_y)]
    pub fov_y: Option<f64>,
    /// No perspective: this is the height of what is in the picture, in the scene's units, 1e-9 to 1e9
    #[arg(long, value_name = "HEIGHT", allow_hyphen_values = true, value_parser = values::orthographic, conflicts_with = "fov_y")]
    pub orthographic: Option<f64>,
    /// Position of the camera, in the scene's units
    #[arg(long, value_name = "X,Y,Z", allow_hyphen_values = true, value_parser = values::vector)]
    pub look_from: Option<DVec3>,
    /// The point in the middle of the picture, in the scene's units
    #[arg(long, value_name = "X,Y,Z", allow_hyphen_values = true, value_parser = values::vector)]
    pub look_at: Option<DVec3>,
    /// The direction that is up in the picture
    #[arg(long, value_name = "X,Y,Z", allow_hyphen_values = true, value_parser = values::vector)]
    pub up: Option<DVec3>,
    /// Linear radiance of rays that hit nothing, 0 or more
    #[arg(long, value_name = "R,G,B", allow_hyphen_values = true, value_parser = values::color)]
    pub background: Option<Vec3>,
}

/// How a scene file is read.
#[derive(Debug, Default, Args)]
#[command(next_help_heading = "Scene")]
pub struct SceneFlags {
    /// Refuse a scene of which anything would be skipped or repaired
    #[arg(long)]
    pub strict: bool,
    /// Override one value of a native scene, such as camera.fov_y_deg=30 (may be repeated)
    #[arg(long = "set", value_name = "KEY=VALUE", value_parser = values::override_of)]
    pub overrides: Vec<String>,
    /// Let the scene name files in this folder too, beside its own (may be repeated)
    #[arg(long = "allow-dir", value_name = "DIR")]
    pub allow_dirs: Vec<PathBuf>,
}

impl SceneFlags {
    pub fn import_options(&self) -> import::Options {
        import::Options {
            allow_dirs: self.allow_dirs.clone(),
            overrides: self.overrides.clone(),
        }
    }
}

/// What is done in the window, kept and done again.
#[derive(Debug, Default, Args)]
#[command(next_help_heading = "Recording")]
pub struct RecordingFlags {
    /// Write all that the mouse and the keyboard do to this file, a line of JSON for each event
    #[arg(long, value_name = "FILE")]
    pub record: Option<PathBuf>,
    /// Do what was recorded in this file, at the same times
    #[arg(long, value_name = "FILE")]
    pub replay: Option<PathBuf>,
    /// Replay as fast as possible: each frame of the recording in one of the window
    #[arg(long, requires = "replay")]
    pub replay_fast: bool,
    /// Close the window after a replay
    #[arg(long, requires = "replay")]
    pub close_after_replay: bool,
}

/// What the picture is computed on.
#[derive(Debug, Args)]
#[command(next_help_heading = "Adapter")]
pub struct DeviceFlags {
    /// The adapter, by its number as `doctor` lists it or by a part of its name [default: the fastest]
    #[arg(long, value_name = "INDEX|NAME")]
    pub adapter: Option<String>,
    /// The graphics interface [default: the best there is]
    #[arg(long, value_parser = values::one_of(&BACKENDS))]
    pub backend: Option<Backend>,
    /// Refuse a scene that needs more GPU memory than this, in MiB
    #[arg(long, value_name = "MIB", default_value = "4096", value_parser = clap::value_parser!(u64).range(1..=1 << 24))]
    pub memory_limit: u64,
}

impl PictureFlags {
    pub fn overrides(&self) -> PictureOverrides {
        PictureOverrides {
            size: self.size.size,
            samples: self.size.samples,
            antialias: self.antialias,
            noise: self.noise,
            max_depth: self.max_depth,
            min_throughput: self.min_throughput,
            filter: self.filter,
            filter_radius: self.filter_radius,
            light_samples: self.light_samples,
            integrator: self.integrator,
            triangle_test: self.triangle_test,
            brute_force: self.no_bvh,
            seed: self.seed,
            crop: self.crop,
        }
    }
}

impl DevelopFlags {
    pub fn overrides(&self) -> ToneOverrides {
        ToneOverrides {
            exposure_ev: self.exposure,
            curve: self.tone,
            transfer: self.transfer,
        }
    }
}

impl CameraFlags {
    pub fn overrides(&self) -> CameraOverrides {
        CameraOverrides {
            name: self.camera.clone(),
            fov_y_deg: self.fov_y,
            orthographic_height: self.orthographic,
            look_from: self.look_from,
            look_at: self.look_at,
            up: self.up,
            background: self.background,
        }
    }
}

impl DeviceFlags {
    pub fn choice(&self) -> AdapterChoice {
        AdapterChoice {
            backend: self.backend,
            adapter: self.adapter.clone(),
        }
    }

    pub fn memory_limit_bytes(&self) -> u64 {
        self.memory_limit << 20
    }
}

/// What is told about the work.
#[derive(Debug, Args)]
#[command(next_help_heading = "Messages")]
pub struct LogFlags {
    /// Write a report (JSON: counts, settings, adapter, times in seconds, memory in bytes) here, of a
    /// run that fails too, with its error and exit code; `-` is the standard output
    #[arg(long, value_name = "FILE.json")]
    pub report: Option<PathBuf>,
    /// Count the rays of each kind for the report, which costs a little time
    #[arg(long)]
    pub count_rays: bool,
    /// How progress is shown on the standard error; with json all messages there are lines of JSON
    #[arg(long, default_value = "auto", value_parser = values::one_of(&PROGRESS))]
    pub progress: ProgressMode,
    /// Print warnings and errors only
    #[arg(short, long, conflicts_with = "verbose")]
    pub quiet: bool,
    /// Print times and sizes as well
    #[arg(short, long)]
    pub verbose: bool,
}

/// How progress is shown.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ProgressMode {
    Auto,
    Bar,
    Json,
    None,
}
