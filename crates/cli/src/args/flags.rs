//! Flags that several commands share, grouped as in their help.

mod log;
mod picture;

pub use log::{LogFlags, ProgressMode};
pub use picture::{PictureFlags, SettingFlags, SizeFlags, ViewSettingFlags};

use super::checkpoint::CheckpointFlags;
use super::values::{self, BACKENDS, FORMATS, GROUNDS, Up};
use clap::Args;
use glam::{DVec3, Vec3};
use glimray_app::layers::{LAYERS, PictureLayer};
use glimray_app::overrides::{
    BackgroundChoice, CameraOverrides, Exposure, SectionChoice, ToneOverrides,
};
use glimray_app::settings::PictureOverrides;
use glimray_app::value_names::{TONES, TRANSFERS};
use glimray_io::import;
use glimray_io::output::Format;
use glimray_render::gpu::{AdapterChoice, Backend};
use glimray_scene::{ToneCurve, Transfer};
use std::num::NonZero;
use std::path::PathBuf;

/// Where the picture is written.
#[derive(Debug, Args)]
#[command(next_help_heading = "Output")]
pub struct OutputFlags {
    /// Output file; its extension chooses the format (.png .jpg .jpeg .exr .hdr, or .film to merge or
    /// develop later); `-` is standard output [default: the scene's name with .png in the current folder;
    /// glimray.png for the demo]
    #[arg(short = 'o', long = "output", value_name = "OUT")]
    pub path: Option<PathBuf>,
    /// File format, whatever the extension [default: by extension; png for `-`]
    #[arg(long, value_parser = values::one_of(&FORMATS))]
    pub format: Option<Format>,
    /// JPEG quality, 1 (smallest file) to 100 (best)
    #[arg(long, value_name = "1..100", default_value = "90", value_parser = clap::value_parser!(u8).range(1..=100))]
    pub quality: u8,
    /// Do not replace an existing file
    #[arg(long)]
    pub no_clobber: bool,
}

/// The sample range of a partial rendering, and the checkpoints of a long one.
#[derive(Debug, Default, Args)]
#[command(next_help_heading = "Output")]
pub struct PartFlags {
    /// First sample to render, a multiple of 64; the output must be a .film [default: 0]
    #[arg(long, value_name = "A", allow_hyphen_values = true)]
    pub sample_offset: Option<u32>,
    /// Number of samples per pixel to render, a multiple of 64; the output must be a .film
    /// [default: all remaining]
    #[arg(long, value_name = "N", allow_hyphen_values = true, value_parser = clap::value_parser!(u32).range(1..))]
    pub sample_count: Option<u32>,
    #[command(flatten)]
    pub checkpoint: CheckpointFlags,
}

/// Layers of the picture.
#[derive(Debug, Default, Args)]
#[command(next_help_heading = "Output")]
pub struct LayerFlags {
    /// Layers to write to one OpenEXR file (.exr) or to keep in a film (.film), separated by commas
    #[arg(long, value_name = "LAYER,…", value_delimiter = ',', value_parser = values::one_of(&LAYERS))]
    pub layers: Vec<PictureLayer>,
    /// Write each layer as a part of its own; fewer programs read such files
    #[arg(long, requires = "layers")]
    pub layers_parts: bool,
}

/// How linear radiance becomes display values.
#[derive(Clone, Debug, Default, Args)]
#[command(next_help_heading = "Picture")]
pub struct DevelopFlags {
    /// Exposure: multiply radiance by 2^EV, -64 to 64 [default: the scene's, else 0; 0 for .exr and .hdr]
    ///
    /// auto makes the picture's average a medium grey, frame by frame; auto+1 is a stop brighter, auto-1 darker.
    #[arg(long, value_name = "EV|auto", allow_hyphen_values = true, value_parser = values::exposure)]
    pub exposure: Option<Exposure>,
    /// Tone curve [default: the scene's, else for paths neutral in models, none in bare ones, agx in scenes; none for whitted,
    /// .exr, .hdr and debug views]
    #[arg(long, value_parser = values::one_of(&TONES))]
    pub tone: Option<ToneCurve>,
    /// Transfer function [default: the scene's, else srgb; srgb too where paths bring their curve to a scene for whitted; linear for
    /// .exr, .hdr and debug views]
    #[arg(long, value_parser = values::one_of(&TRANSFERS))]
    pub transfer: Option<Transfer>,
    /// Denoise the picture [default: that of models, as the scene says for others]; films and, with --layers, the layer
    /// beauty keep the noise
    ///
    /// The filter is guided by albedo, normals, depth and the noise of each pixel.
    #[arg(long, overrides_with = "no_denoise")]
    pub denoise: bool,
    /// Show the samples as they are, also of a model; --samples 64 then has less noise
    #[arg(long, overrides_with = "denoise")]
    pub no_denoise: bool,
}

/// Camera and background.
#[derive(Debug, Default, Args)]
#[command(next_help_heading = "Camera")]
pub struct CameraFlags {
    /// Camera of the scene, by its name or its number in `inspect`
    #[arg(long, value_name = "NAME")]
    pub camera: Option<String>,
    /// Vertical field of view in degrees, 0.001 to 179.9; selects perspective projection
    #[arg(long, value_name = "DEG", allow_hyphen_values = true, value_parser = values::fov_y)]
    pub fov_y: Option<f64>,
    /// Orthographic projection with a view of this height, in scene units, 1e-9 to 1e9
    #[arg(long, value_name = "HEIGHT", allow_hyphen_values = true, value_parser = values::orthographic, conflicts_with = "fov_y")]
    pub orthographic: Option<f64>,
    /// Camera position, in scene units
    #[arg(long, value_name = "X,Y,Z", allow_hyphen_values = true, value_parser = values::vector)]
    pub look_from: Option<DVec3>,
    /// Point at the centre of the picture, in scene units
    #[arg(long, value_name = "X,Y,Z", allow_hyphen_values = true, value_parser = values::vector)]
    pub look_at: Option<DVec3>,
    /// Up direction of the camera; or with a letter the axis of a model that points up [default of models:
    /// z for .stl, else y]
    #[arg(long, value_name = "X,Y,Z|x|y|z", allow_hyphen_values = true, value_parser = values::up)]
    pub up: Option<Up>,
    /// Background colour: linear radiance, 0 or more per channel; or transparent
    ///
    /// Beside --environment, the camera sees the colour where there is nothing, also through clear glass, and the
    /// environment lights the scene and shows in mirrors. With transparent, the picture has an alpha channel (.png, .exr).
    /// With any background, models get no ground unless --ground asks for one.
    #[arg(long, value_name = "R,G,B|transparent", allow_hyphen_values = true, value_parser = values::background)]
    pub background: Option<BackgroundChoice>,
    /// Cut away what lies beyond a plane: points p with X·p.x + Y·p.y + Z·p.z > OFFSET, or none
    ///
    /// Closed meshes and shapes are solid: the plane shows their inside as a flat face of their material.
    #[arg(long, value_name = "X,Y,Z,OFFSET|none", allow_hyphen_values = true, value_parser = values::section)]
    pub section: Option<SectionChoice>,
}

/// The background and the section of a scene, for commands that place their cameras by themselves.
#[derive(Debug, Default, Args)]
pub struct ShownFlags {
    /// Background colour: linear radiance, 0 or more per channel
    #[arg(long, value_name = "R,G,B", allow_hyphen_values = true, value_parser = values::color)]
    pub background: Option<Vec3>,
    /// Cut away what lies beyond a plane: points p with X·p.x + Y·p.y + Z·p.z > OFFSET, or none
    #[arg(long, value_name = "X,Y,Z,OFFSET|none", allow_hyphen_values = true, value_parser = values::section)]
    pub section: Option<SectionChoice>,
}

/// How a scene file is read.
#[derive(Debug, Default, Args)]
#[command(next_help_heading = "Scene")]
pub struct SceneFlags {
    /// Refuse a scene if anything in it would be skipped or repaired
    #[arg(long)]
    pub strict: bool,
    /// Override a value of a native scene, such as camera.fov_y_deg=30 (repeatable)
    #[arg(long = "set", value_name = "KEY=VALUE", value_parser = values::override_of)]
    pub overrides: Vec<String>,
    /// Allow the scene to read files from this folder as well as its own (repeatable)
    #[arg(long = "allow-dir", value_name = "DIR")]
    pub allow_dirs: Vec<PathBuf>,
    /// Scene of a glTF model, by its name or number [default: the model's]
    #[arg(long = "scene", value_name = "NAME")]
    pub model_scene: Option<String>,
    /// Clip of a glTF model to play, by its name or number [default: all that fit together]
    #[arg(long, value_name = "NAME")]
    pub clip: Option<String>,
    /// Variant of a glTF model's materials, by its name or number [default: the model's]
    #[arg(long, value_name = "NAME")]
    pub variant: Option<String>,
    /// Halve pictures of textures and backgrounds until no side is longer than this, in pixels, which is reported
    /// [default: no limit; all pictures together take at most 2.75 GiB]
    #[arg(long, value_name = "PIXELS", allow_hyphen_values = true, value_parser = values::texture_limit)]
    pub texture_limit: Option<NonZero<u32>>,
    /// Replace the background: an equirectangular picture (.hdr, .exr, .png, .jpg, .webp), a built-in environment, which
    /// is noon, sunset, overcast, studio, ring or furnace, or a clear sky with the sun at this elevation, 0 to 90, and
    /// azimuth from -z towards +x, in degrees [default of sky: 45,-135]
    #[arg(long, value_name = "FILE|NAME|sky[:ELEVATION[,AZIMUTH]]", value_parser = values::environment)]
    pub environment: Option<import::EnvironmentSource>,
    /// Factor on the radiance of the background, 0 to 1e6
    #[arg(long, value_name = "FACTOR", allow_hyphen_values = true, value_parser = values::environment_strength)]
    pub environment_strength: Option<f32>,
    /// Turn the picture of the background about +y by this angle in degrees, counter-clockwise seen from above
    #[arg(long, value_name = "DEG", allow_hyphen_values = true, value_parser = values::angle)]
    pub environment_rotation: Option<f64>,
    /// Frame the model, whatever its own cameras show
    #[arg(long, conflicts_with = "bare")]
    pub fit: bool,
    /// Add nothing to a model: no camera that frames it, no lights, no background, no ground, no tone curve
    #[arg(long)]
    pub bare: bool,
    /// Add no lamps to a model without lights, or with weak ones; its background still lights paths
    #[arg(long)]
    pub no_lights: bool,
    /// Add no background to a model without lights, or with weak ones: it is black
    #[arg(long)]
    pub no_background: bool,
    /// Add no ground to a model without lights, or with weak ones; --background leaves it out too
    #[arg(long)]
    pub no_ground: bool,
    /// The ground below a model: a surface, or only the shadow on it, with a transparent background
    /// [default: a surface below models without lights or with weak ones, if no background is given]
    #[arg(long, value_parser = values::one_of(&GROUNDS), conflicts_with_all = ["no_ground", "bare"])]
    pub ground: Option<import::Ground>,
}

/// The axis of a model that points up, for commands without the flags of a camera.
#[derive(Debug, Default, Args)]
#[command(next_help_heading = "Scene")]
pub struct AxisFlags {
    /// Axis of a model that points up: x, y or z [default: z for .stl, else y]
    #[arg(long, value_name = "AXIS", value_parser = values::model_axis)]
    pub up: Option<import::Axis>,
}

impl SceneFlags {
    /// `up` is the axis of a model that points up; `has_background` tells whether a background was asked for, which
    /// leaves out the ground that was not; `picture` has the size and the integrator of the picture, if they are known.
    pub fn import_options(
        &self,
        up: Option<import::Axis>,
        has_background: bool,
        picture: &PictureFlags,
    ) -> import::Options {
        let PictureOverrides {
            size, integrator, ..
        } = picture.settings.given;
        let staging = import::Staging {
            camera: !self.bare,
            fit: self.fit,
            lights: !self.bare && !self.no_lights,
            background: !self.bare && !self.no_background,
            ground: match self.ground {
                None if self.bare || self.no_ground || has_background => import::Ground::None,
                given => given.unwrap_or(import::Ground::Default),
            },
        };
        import::Options {
            allow_dirs: self.allow_dirs.clone(),
            overrides: self.overrides.clone(),
            scene: self.model_scene.clone(),
            clip: self.clip.clone(),
            variant: self.variant.clone(),
            up,
            texture_limit: self.texture_limit,
            size,
            integrator: integrator.map(Into::into),
            baking: values::baking(integrator),
            staging,
            environment: import::Environment {
                source: self.environment.clone(),
                strength: self.environment_strength,
                rotation_deg: self.environment_rotation,
            },
            by_content: false,
            instead_of_empty: None,
        }
    }
}

/// Recording and replay of the window's input.
#[derive(Debug, Default, Args)]
#[command(next_help_heading = "Recording")]
pub struct RecordingFlags {
    /// Record mouse and keyboard input to this file, one JSON object per line
    #[arg(long, value_name = "FILE")]
    pub record: Option<PathBuf>,
    /// Replay the input recorded in this file with its original timing
    #[arg(long, value_name = "FILE")]
    pub replay: Option<PathBuf>,
    /// Replay as fast as possible: one recorded frame per window frame
    #[arg(long, requires = "replay")]
    pub replay_fast: bool,
    /// Close the window after the replay
    #[arg(long, requires = "replay")]
    pub close_after_replay: bool,
}

/// The GPU adapter and its limits.
#[derive(Debug, Args)]
#[command(next_help_heading = "Adapter")]
pub struct DeviceFlags {
    /// GPU adapter, by its number in `doctor` or part of its name [default: the fastest]
    #[arg(long, value_name = "INDEX|NAME")]
    pub adapter: Option<String>,
    /// Graphics API [default: the best available]
    #[arg(long, value_parser = values::one_of(&BACKENDS))]
    pub backend: Option<Backend>,
    /// Refuse scenes that need more GPU memory than this, in MiB
    #[arg(long, value_name = "MIB", default_value = "4096", value_parser = clap::value_parser!(u64).range(1..=1 << 24))]
    pub memory_limit: u64,
}

impl DevelopFlags {
    pub fn overrides(&self) -> ToneOverrides {
        ToneOverrides {
            exposure: self.exposure,
            curve: self.tone,
            transfer: self.transfer,
            denoise: self.denoise(),
        }
    }

    /// Whether the flags ask for denoising; `None` if they leave it to the scene.
    pub fn denoise(&self) -> Option<bool> {
        (self.denoise || self.no_denoise).then_some(self.denoise)
    }
}

impl CameraFlags {
    /// The options of a command that reads its scene with these flags for a picture.
    pub fn import_options(&self, reading: &SceneFlags, picture: &PictureFlags) -> import::Options {
        let up = self.up.and_then(Up::axis);
        reading.import_options(up, self.background.is_some(), picture)
    }

    /// The overrides of a command that reads its scene with these flags.
    pub fn overrides(&self, reading: &SceneFlags) -> CameraOverrides {
        CameraOverrides {
            name: self.camera.clone(),
            fov_y_deg: self.fov_y,
            orthographic_height: self.orthographic,
            look_from: self.look_from,
            look_at: self.look_at,
            up: match self.up {
                Some(Up::Camera(up)) => Some(up),
                Some(Up::Model(_)) | None => None,
            },
            background: self.background,
            section: self.section,
            has_environment: reading.environment.is_some(),
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
