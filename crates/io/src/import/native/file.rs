//! The native format. The docs of these types are the descriptions in the JSON Schema, so they address
//! authors of scenes.

mod animation;
mod backgrounds;
mod cameras;
mod color_or;
mod groups;
mod keys;
mod lights;
mod materials;
mod meshes;
mod nodes;
mod objects;
mod physical;
mod textures;

pub(super) use animation::{AnimationTable, InterpolationName, PropertyName};
pub(super) use cameras::{CameraTable, LensTable, LookAt};
pub(super) use groups::{GridTable, PointsTable, RepeatTable, RingTable, ScatterTable};
pub(super) use keys::{Key, KeyValue};
pub(super) use lights::{DiscLightTable, LightTable, RectangleLightTable, SpotTable};
pub(super) use materials::{
    CoverageTable, MaterialRef, MaterialTable, OpticsTable, PhongTable, RefractTable,
};
pub(super) use meshes::{MeshOrName, MeshTable};
pub(super) use nodes::{NodeTable, TransformTable};
pub(super) use objects::{
    BoxTable, ConeTable, CylinderTable, DiscTable, EllipsoidTable, ObjectTable, PlaneTable,
    RectangleTable, SphereTable, TorusTable, TriangleTable,
};

pub(super) use backgrounds::{BackgroundTable, ColorOrBackground, NamedBackground, SkyTable};
pub(super) use physical::{FractionOrTexture, PbrTable};
pub(super) use textures::{
    ColorOrTexture, DataMapTable, HeightMapTable, NumberTable, PairTable, PatternTables,
    PictureOrFile, SpaceName, TextureTable,
};

use super::values::{
    AntialiasName, BackdropValue, Bounces, Color, Count, Duration, Factor, FilterName, FrameRate,
    IntegratorName, Noise, Radius, ShadowsName, ShutterTimes, Size, Stops, ToneName, TransferName,
};
use glam::Vec3;
use schemars::JsonSchema;
use serde::Deserialize;
use std::collections::BTreeMap;
use toml::Spanned;

/// A glimray scene. Right-handed, +Y up; lengths in metres or any other unit; colours are linear `[r, g,
/// b]` or sRGB `"#rrggbb"`.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(title = "glimray scene")]
pub(super) struct SceneFile {
    /// The image: size, samples and tone curve. Command-line flags override it.
    #[serde(default)]
    pub output: OutputTable,
    /// The background: a colour, `{ bottom, top }`, `{ picture }`, "sky" or `{ sky }`; default black.
    #[serde(default = "nothing")]
    #[schemars(with = "ColorOrBackground")]
    pub background: Spanned<ColorOrBackground>,
    /// Ambient light, multiplied by the ambient coefficient of materials; default none.
    #[serde(default = "black")]
    pub ambient: Color,
    /// How transparent surfaces affect shadows: they cast full shadows (opaque, the default), or light
    /// passes straight through them (filtered).
    #[serde(default)]
    pub shadows: ShadowsName,
    /// Whether area lights, background, ambient light and planes only show a bare model, so that a turntable replaces
    /// them; default false.
    #[serde(default)]
    pub staged: bool,
    /// The camera. If there is none at all, a camera is added that sees everything.
    #[schemars(with = "Option<CameraTable>")]
    pub camera: Option<Spanned<CameraTable>>,
    /// Several cameras, chosen by `--camera NAME`; the first is the default camera.
    #[serde(default)]
    #[schemars(with = "Vec<CameraTable>")]
    pub cameras: Vec<Spanned<CameraTable>>,
    /// Textures by name, for `{ texture = "NAME" }` instead of a colour of a material.
    #[serde(default)]
    #[schemars(with = "BTreeMap<String, TextureTable>")]
    pub textures: BTreeMap<String, Spanned<TextureTable>>,
    /// Materials by name.
    #[serde(default)]
    #[schemars(with = "BTreeMap<String, MaterialTable>")]
    pub materials: BTreeMap<String, Spanned<MaterialTable>>,
    /// Meshes by name, for `mesh = "NAME"` in objects.
    #[serde(default)]
    #[schemars(with = "BTreeMap<String, MeshTable>")]
    pub meshes: BTreeMap<String, Spanned<MeshTable>>,
    /// Nodes that objects, cameras and lights are attached to by `carried_by`; parents before their
    /// children.
    #[serde(default)]
    #[schemars(with = "Vec<NodeTable>")]
    pub nodes: Vec<Spanned<NodeTable>>,
    /// Groups of objects by name, placed by `group = "NAME"` instead of a surface.
    #[serde(default)]
    #[schemars(with = "BTreeMap<String, Vec<ObjectTable>>")]
    pub groups: BTreeMap<String, Vec<Spanned<ObjectTable>>>,
    /// The surfaces, and placements of groups.
    #[serde(default)]
    #[schemars(with = "Vec<ObjectTable>")]
    pub objects: Vec<Spanned<ObjectTable>>,
    /// The lights.
    #[serde(default)]
    #[schemars(with = "Vec<LightTable>")]
    pub lights: Vec<Spanned<LightTable>>,
    /// Animations, one property each.
    #[serde(default)]
    #[schemars(with = "Vec<AnimationTable>")]
    pub animation: Vec<Spanned<AnimationTable>>,
}

/// The image.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub(super) struct OutputTable {
    /// Width and height in pixels; default [640, 480].
    pub size: Size,
    /// The integrator that samples and bounces are meant for: whitted or path; default whitted.
    pub integrator: IntegratorName,
    /// Samples per pixel; default 64 for paths, 16 with a lens, an area light or an open shutter, otherwise 1.
    pub samples: Option<Count>,
    /// Sample placement: none (all at the centre), stratified, or adaptive, which takes up to `samples`
    /// where there is noise. Default stratified for more than one sample.
    pub antialias: Option<AntialiasName>,
    /// Noise threshold of adaptive sampling: it continues where the estimated error is larger. Measured
    /// on the square root of luminance, where 1 is white; default 0.01.
    pub noise: Noise,
    /// Bounces after the first hit, 0 to 1000; 0 is local shading only; default 16 for paths, otherwise 5.
    pub max_depth: Option<Bounces>,
    /// The reconstruction filter; default box.
    pub filter: FilterName,
    /// The filter's radius in pixels; default 0.5 for box, 1 for tent, 2 for mitchell and 1.5 for the
    /// others.
    pub filter_radius: Option<Radius>,
    /// Factor on the samples of every area light; default 1.
    pub light_samples: Factor,
    /// Exposure in stops, before the tone curve; default 0.
    pub exposure_ev: Stops,
    /// Whether `exposure_ev` adds to an exposure that makes the picture's average a medium grey; default false.
    pub auto_exposure: bool,
    /// The tone curve; default `path_tone` for paths, otherwise none.
    pub tone: Option<ToneName>,
    /// The tone curve of paths where there is no `tone`; default agx.
    pub path_tone: ToneName,
    /// The transfer function of stored values; default srgb.
    pub transfer: TransferName,
    /// Frames per second of an animation; default 24.
    pub fps: FrameRate,
    /// Duration of an animation in seconds; by default it ends at its last key, and ping-pong tracks
    /// complete a cycle.
    pub duration: Option<Duration>,
    /// How long the shutter is open: a fraction of the frame interval, an angle such as "180deg", or
    /// [open, close] in frames; default 0, without motion blur.
    pub shutter: ShutterTimes,
    /// Whether pictures by `integrator` are denoised; default false.
    pub denoise: bool,
    /// What paths from the camera see where there is nothing, directly and through smooth transparent surfaces: a colour,
    /// or "transparent"; default the background. All other light sees the background.
    pub backdrop: Option<BackdropValue>,
}

impl Default for OutputTable {
    fn default() -> Self {
        Self {
            size: Size([640, 480]),
            integrator: IntegratorName::Whitted,
            samples: None,
            antialias: None,
            noise: Noise(0.01),
            max_depth: None,
            filter: FilterName::Box,
            filter_radius: None,
            light_samples: Factor(1.0),
            exposure_ev: Stops(0.0),
            auto_exposure: false,
            tone: None,
            path_tone: ToneName::Agx,
            transfer: TransferName::Srgb,
            fps: FrameRate(24.0),
            duration: None,
            shutter: ShutterTimes([0.0, 0.0]),
            denoise: false,
            backdrop: None,
        }
    }
}

/// The entries of a table in the order of the file, followed by those of overrides.
pub(super) fn in_order<T>(table: &BTreeMap<String, Spanned<T>>) -> Vec<(&String, &Spanned<T>)> {
    let mut entries: Vec<_> = table.iter().collect();
    entries.sort_by_key(|(_, value)| value.span().start);
    entries
}

fn nothing() -> Spanned<ColorOrBackground> {
    Spanned::new(0..0, ColorOrBackground::Color(black()))
}

fn black() -> Color {
    Color(Vec3::ZERO)
}
