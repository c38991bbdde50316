//! The layers of a picture file, and their channels.

use super::value_names::ValueNames;
use glimray_io::output::{Channel, ImageLayer};
use glimray_render::{Features, PixelFeatures};
use glimray_scene::image::Image;

/// A layer that a picture file can have.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum PictureLayer {
    /// The picture.
    Beauty,
    /// [`PixelFeatures::albedo`].
    Albedo,
    /// [`PixelFeatures::normal`].
    Normal,
    /// [`PixelFeatures::depth`].
    Depth,
    /// [`PixelFeatures::position`].
    Position,
    /// [`PixelFeatures::uv`].
    Uv,
    /// [`PixelFeatures::object`].
    Object,
    /// [`PixelFeatures::material`].
    Material,
    /// [`PixelFeatures::direct`].
    Direct,
    /// [`PixelFeatures::indirect`].
    Indirect,
    /// [`PixelFeatures::emission`].
    Emission,
    /// [`PixelFeatures::variance`].
    Variance,
    /// [`PixelFeatures::samples`].
    Samples,
}

/// All layers, in the order of files.
pub static LAYERS: ValueNames<PictureLayer> = ValueNames(&[
    ("beauty", "the picture", PictureLayer::Beauty),
    (
        "albedo",
        "colours of surfaces without light, seen through mirrors and clear glass",
        PictureLayer::Albedo,
    ),
    (
        "normal",
        "shading normals in world space, seen through mirrors and clear glass",
        PictureLayer::Normal,
    ),
    (
        "depth",
        "distance from the camera along the ray",
        PictureLayer::Depth,
    ),
    ("position", "points in world space", PictureLayer::Position),
    ("uv", "texture coordinates", PictureLayer::Uv),
    ("object", "numbers of objects, from 1", PictureLayer::Object),
    (
        "material",
        "numbers of materials, from 1",
        PictureLayer::Material,
    ),
    (
        "direct",
        "light that was scattered once",
        PictureLayer::Direct,
    ),
    (
        "indirect",
        "light that was scattered more often",
        PictureLayer::Indirect,
    ),
    (
        "emission",
        "light that was not scattered",
        PictureLayer::Emission,
    ),
    (
        "variance",
        "variance of the mean luminance",
        PictureLayer::Variance,
    ),
    ("samples", "numbers of samples", PictureLayer::Samples),
]);

impl PictureLayer {
    /// The layer's channels, for a picture with these features. `opacity` tells whether the picture has opacity.
    pub fn of(self, beauty: &Image, opacity: bool, features: &Features) -> ImageLayer {
        let layer =
            |names: &[&'static str], is_half: bool, value: fn(&PixelFeatures, usize) -> f32| {
                let channel = |(index, name): (usize, &&'static str)| Channel {
                    name,
                    values: features.pixels.iter().map(|p| value(p, index)).collect(),
                    is_half,
                };
                ImageLayer {
                    name: LAYERS.name(&self),
                    channels: names.iter().enumerate().map(channel).collect(),
                }
            };
        const RGB: &[&str] = &["R", "G", "B"];
        const XYZ: &[&str] = &["X", "Y", "Z"];
        match self {
            Self::Beauty => ImageLayer::color("", beauty, opacity, true),
            Self::Albedo => layer(RGB, true, |pixel, index| pixel.albedo[index]),
            Self::Normal => layer(XYZ, true, |pixel, index| pixel.normal[index]),
            Self::Depth => layer(&["Z"], false, |pixel, _| pixel.depth),
            Self::Position => layer(XYZ, false, |pixel, index| pixel.position[index]),
            Self::Uv => layer(&["U", "V"], false, |pixel, index| pixel.uv[index]),
            Self::Object => layer(&["id"], false, |pixel, _| pixel.object as f32),
            Self::Material => layer(&["id"], false, |pixel, _| pixel.material as f32),
            Self::Direct => layer(RGB, true, |pixel, index| pixel.direct[index]),
            Self::Indirect => layer(RGB, true, |pixel, index| pixel.indirect[index]),
            Self::Emission => layer(RGB, true, |pixel, index| pixel.emission[index]),
            Self::Variance => layer(&["Y"], false, |pixel, _| pixel.variance),
            Self::Samples => layer(&["N"], false, |pixel, _| pixel.samples),
        }
    }
}

/// A denoised picture with the raw one beside it. Most programs show the nameless layer, and the denoised picture is what was
/// asked for.
pub fn beside_raw(denoised: &Image, raw: &Image, opacity: bool) -> Vec<ImageLayer> {
    vec![
        ImageLayer::color("", denoised, opacity, false),
        ImageLayer::color("beauty", raw, opacity, false),
    ]
}
