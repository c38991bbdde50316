//! The native format. The docs of these types are the descriptions in the JSON Schema, so they address
//! authors of scenes.

mod animation;
mod backgrounds;
mod cameras;
mod groups;
mod keys;
mod lights;
mod materials;
mod meshes;
mod nodes;
mod objects;
mod physical;
mod section;
mod textures;

pub(crate) use super::values::Spanned;
pub(crate) use animation::*;
pub(crate) use backgrounds::*;
pub(crate) use cameras::*;
pub(crate) use groups::*;
pub(crate) use keys::*;
pub(crate) use lights::*;
pub(crate) use materials::*;
pub(crate) use meshes::*;
pub(crate) use nodes::*;
pub(crate) use objects::*;
pub(crate) use physical::*;
pub(crate) use section::*;
pub(crate) use textures::*;

use super::values::{
    AntialiasName, BackdropValue, Bounces, Color, Count, Duration, Factor, FilterName, FrameRate,
    IntegratorName, Noise, Radius, ShadowsName, ShutterTimes, Size, Stops, ToneName, TransferName,
};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize, Serializer};
use std::collections::BTreeMap;

/// A glimray scene. Right-handed, +Y up; lengths in metres or any other unit; colours are linear `[r, g,
/// b]` or sRGB `"#rrggbb"`.
#[derive(Debug, Default, Deserialize, Serialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
#[schemars(title = "glimray scene")]
pub(crate) struct SceneFile {
    /// The image: size, samples and tone curve. Command-line flags override it.
    pub output: OutputTable,
    /// The background: a colour, `{ bottom, top }`, `{ picture }`, a built-in environment such as "sky" or "studio",
    /// `{ environment }` or `{ sky }`; default black.
    pub background: Option<Spanned<ColorOrBackground>>,
    /// Ambient light, multiplied by the ambient coefficient of materials; default none.
    pub ambient: Option<Color>,
    /// How transparent surfaces affect shadows: they cast full shadows (opaque, the default), or light
    /// passes straight through them (filtered).
    pub shadows: Option<ShadowsName>,
    /// The plane beyond which the scene is cut away; default none.
    pub section: Option<SectionTable>,
    /// Whether area lights, background, ambient light and planes only show a bare model, so that a turntable replaces
    /// them; default false.
    pub staged: Option<bool>,
    /// The camera. If there is none at all, a camera is added that sees everything.
    pub camera: Option<Spanned<CameraTable>>,
    /// Several cameras, chosen by `--camera NAME`; the first is the default camera.
    pub cameras: Vec<Spanned<CameraTable>>,
    /// Textures by name, for `{ texture = "NAME" }` instead of a colour of a material.
    #[serde(serialize_with = "ordered")]
    pub textures: BTreeMap<String, Spanned<TextureTable>>,
    /// Materials by name.
    #[serde(serialize_with = "ordered")]
    pub materials: BTreeMap<String, Spanned<MaterialTable>>,
    /// Meshes by name, for `mesh = "NAME"` in objects.
    #[serde(serialize_with = "ordered")]
    pub meshes: BTreeMap<String, Spanned<MeshTable>>,
    /// Nodes that objects, cameras and lights are attached to by `carried_by`; parents before their
    /// children.
    pub nodes: Vec<Spanned<NodeTable>>,
    /// Groups of objects by name, placed by `group = "NAME"` instead of a surface.
    pub groups: BTreeMap<String, Vec<Spanned<ObjectTable>>>,
    /// The surfaces, and placements of groups.
    pub objects: Vec<Spanned<ObjectTable>>,
    /// The lights.
    pub lights: Vec<Spanned<LightTable>>,
    /// Animations, one property each.
    pub animation: Vec<Spanned<AnimationTable>>,
}

/// The image.
#[derive(Debug, Default, Deserialize, Serialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct OutputTable {
    /// Width and height in pixels; default [640, 480].
    pub size: Option<Size>,
    /// The integrator that samples and bounces are meant for: whitted or path; default whitted.
    pub integrator: Option<IntegratorName>,
    /// Samples per pixel; default 64 for paths, 16 with a lens, an area light or an open shutter, otherwise 1.
    pub samples: Option<Count>,
    /// Sample placement: none (all at the centre), stratified, or adaptive, which takes up to `samples`
    /// where there is noise. Default stratified for more than one sample.
    pub antialias: Option<AntialiasName>,
    /// Noise threshold of adaptive sampling: it continues where the estimated error is larger. Measured
    /// on the square root of luminance, where 1 is white; default 0.01.
    pub noise: Option<Noise>,
    /// Bounces after the first hit, 0 to 1000; 0 is local shading only; default 16 for paths, otherwise 5.
    pub max_depth: Option<Bounces>,
    /// The reconstruction filter; default box.
    pub filter: Option<FilterName>,
    /// The filter's radius in pixels; default 0.5 for box, 1 for tent, 2 for mitchell and 1.5 for the
    /// others.
    pub filter_radius: Option<Radius>,
    /// Factor on the samples of every area light; default 1.
    pub light_samples: Option<Factor>,
    /// Exposure in stops, before the tone curve; default 0.
    pub exposure_ev: Option<Stops>,
    /// Whether `exposure_ev` adds to an exposure that makes the picture's average a medium grey; default false.
    pub auto_exposure: Option<bool>,
    /// The tone curve; default `path_tone` for paths, otherwise none.
    pub tone: Option<ToneName>,
    /// The tone curve of paths where there is no `tone`; default agx.
    pub path_tone: Option<ToneName>,
    /// The transfer function of stored values; default srgb.
    pub transfer: Option<TransferName>,
    /// Frames per second of an animation; default 24.
    pub fps: Option<FrameRate>,
    /// Duration of an animation in seconds; by default it ends at its last key, and ping-pong tracks
    /// complete a cycle.
    pub duration: Option<Duration>,
    /// How long the shutter is open: a fraction of the frame interval, an angle such as "180deg", or
    /// [open, close] in frames; default 0, without motion blur.
    pub shutter: Option<ShutterTimes>,
    /// Whether pictures by `integrator` are denoised; default false.
    pub denoise: Option<bool>,
    /// What paths from the camera see where there is nothing, directly and through smooth transparent surfaces: a colour,
    /// or "transparent"; default the background. All other light sees the background.
    pub backdrop: Option<BackdropValue>,
}

/// Writes the entries of a table in their order.
fn ordered<T: Serialize, S: Serializer>(
    table: &BTreeMap<String, Spanned<T>>,
    serializer: S,
) -> Result<S::Ok, S::Error> {
    serializer.collect_map(in_order(table))
}

/// The entries of a table in the order of the file, followed by those of overrides.
pub(in crate::import::native) fn in_order<T>(
    table: &BTreeMap<String, Spanned<T>>,
) -> Vec<(&String, &Spanned<T>)> {
    let mut entries: Vec<_> = table.iter().collect();
    entries.sort_by_key(|(_, value)| value.span().start);
    entries
}
