//! What a native scene may say. These types are the format: their docs are the JSON Schema's
//! descriptions, so they speak to whoever writes a scene.

mod animation;
mod cameras;
mod groups;
mod keys;
mod lights;
mod materials;
mod meshes;
mod nodes;
mod objects;
mod textures;

pub(super) use animation::{AnimationTable, InterpolationName, PropertyName};
pub(super) use cameras::{CameraTable, LensTable, LookAt};
pub(super) use groups::{GridTable, PointsTable, RepeatTable, RingTable, ScatterTable};
pub(super) use keys::{Key, KeyValue};
pub(super) use lights::{DiscLightTable, LightTable, RectangleLightTable, SpotTable};
pub(super) use materials::{MaterialRef, MaterialTable, OpticsTable, RefractTable};
pub(super) use meshes::{MeshOrName, MeshTable};
pub(super) use nodes::{NodeTable, TransformTable};
pub(super) use objects::{
    BoxTable, ConeTable, CylinderTable, DiscTable, EllipsoidTable, ObjectTable, PlaneTable,
    RectangleTable, SphereTable, TorusTable, TriangleTable,
};

pub(super) use textures::{
    BackgroundTable, ColorOrBackground, ColorOrTexture, PairTable, PatternTables, PictureOrFile,
    SpaceName, TextureTable,
};

use super::values::{
    AntialiasName, Bounces, Color, Count, Duration, Factor, FilterName, FrameRate, Noise, Radius,
    ShadowsName, ShutterTimes, Size, Stops, ToneName, TransferName,
};
use glam::Vec3;
use schemars::JsonSchema;
use serde::Deserialize;
use std::collections::BTreeMap;
use toml::Spanned;

/// A glimray scene. Right-handed, +Y up; lengths in metres or any one unit; colours are linear
/// `[r, g, b]` or sRGB `"#rrggbb"`.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(title = "glimray scene")]
pub(super) struct SceneFile {
    /// The picture: its size, samples and tone. Flags of the command line win over it.
    #[serde(default)]
    pub output: OutputTable,
    /// What rays see that hit nothing: a colour, `{ bottom, top }` or `{ picture }`. Black if left
    /// out.
    #[serde(default = "nothing")]
    #[schemars(with = "ColorOrBackground")]
    pub background: Spanned<ColorOrBackground>,
    /// Light that is everywhere, multiplied by the ambient coefficient of a material. None if left
    /// out.
    #[serde(default = "black")]
    pub ambient: Color,
    /// Whether what is transparent throws a full shadow (opaque, if left out), or light goes straight
    /// through it (filtered).
    #[serde(default)]
    pub shadows: ShadowsName,
    /// Whether lights, background and ambient light only show a bare model, so that a turntable puts
    /// its own in their place; false if left out.
    #[serde(default)]
    pub staged: bool,
    /// The camera. If there is none at all, one is placed that sees everything.
    #[schemars(with = "Option<CameraTable>")]
    pub camera: Option<Spanned<CameraTable>>,
    /// Several cameras, chosen by `--camera NAME`; the first is the default.
    #[serde(default)]
    #[schemars(with = "Vec<CameraTable>")]
    pub cameras: Vec<Spanned<CameraTable>>,
    /// Textures by name, for `{ texture = "NAME" }` in place of a colour of a material.
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
    /// What carries objects, cameras and lights, by `carried_by`; each behind those that carry it.
    #[serde(default)]
    #[schemars(with = "Vec<NodeTable>")]
    pub nodes: Vec<Spanned<NodeTable>>,
    /// Groups of objects by name, to be placed by `group = "NAME"` in place of a surface.
    #[serde(default)]
    #[schemars(with = "BTreeMap<String, Vec<ObjectTable>>")]
    pub groups: BTreeMap<String, Vec<Spanned<ObjectTable>>>,
    /// The surfaces, and the groups that are placed.
    #[serde(default)]
    #[schemars(with = "Vec<ObjectTable>")]
    pub objects: Vec<Spanned<ObjectTable>>,
    /// The lights.
    #[serde(default)]
    #[schemars(with = "Vec<LightTable>")]
    pub lights: Vec<Spanned<LightTable>>,
    /// What changes over time, one property each.
    #[serde(default)]
    #[schemars(with = "Vec<AnimationTable>")]
    pub animation: Vec<Spanned<AnimationTable>>,
}

/// The picture.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub(super) struct OutputTable {
    /// Width and height in pixels; [640, 480] if left out.
    pub size: Size,
    /// Samples per pixel; if left out 16 with a lens, a light with extent or an open shutter, else 1.
    pub samples: Option<Count>,
    /// Where samples lie: none (all at the centre), stratified, or adaptive, which spends up to
    /// `samples` where there is noise. Stratified for more than one sample if left out.
    pub antialias: Option<AntialiasName>,
    /// Adaptive sampling goes on where the estimated error is more than this, on the square root of
    /// luminance, on which 1 is white; 0.01 if left out.
    pub noise: Noise,
    /// Bounces after the first hit, 0 to 1000; 0 is local shading only. 5 if left out.
    pub max_depth: Bounces,
    /// What samples round a pixel's centre are weighted by; box if left out.
    pub filter: FilterName,
    /// How far the filter reaches, in pixels; if left out 0.5 for box, 1 for tent, 2 for mitchell and
    /// 1.5 for the others.
    pub filter_radius: Option<Radius>,
    /// Multiplies the samples of every area light; 1 if left out.
    pub light_samples: Factor,
    /// Exposure in stops, before the tone curve; 0 if left out.
    pub exposure_ev: Stops,
    /// The tone curve; none if left out.
    pub tone: ToneName,
    /// The transfer function of stored values; srgb if left out.
    pub transfer: TransferName,
    /// Frames per second of an animation; 24 if left out.
    pub fps: FrameRate,
    /// How many seconds an animation lasts; if left out, until the last key and, there and back, for
    /// what goes to and fro.
    pub duration: Option<Duration>,
    /// How long the shutter is open while things move: a fraction of the time from frame to frame, an
    /// angle such as "180deg", or [open, close] in frames. 0, without blur, if left out.
    pub shutter: ShutterTimes,
}

impl Default for OutputTable {
    fn default() -> Self {
        Self {
            size: Size([640, 480]),
            samples: None,
            antialias: None,
            noise: Noise(0.01),
            max_depth: Bounces(5),
            filter: FilterName::Box,
            filter_radius: None,
            light_samples: Factor(1.0),
            exposure_ev: Stops(0.0),
            tone: ToneName::None,
            transfer: TransferName::Srgb,
            fps: FrameRate(24.0),
            duration: None,
            shutter: ShutterTimes([0.0, 0.0]),
        }
    }
}

/// The entries of a table in the order in which the file has them, those of overrides last.
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
