//! Textures in a native scene.

use super::Spanned;
use crate::import::native::values::{
    Color, Fraction, Matrix, NonNegative, Number, Octaves, Scale, Vector, either, words,
};
use glimray_scene::{Minify, Space, Wrap};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Defines a table with a pattern and its transform, and additional keys.
macro_rules! with_pattern {
    ($(#[$doc:meta])* $name:ident { $($more:tt)* }) => {
        $(#[$doc])*
        #[derive(Clone, Debug, Default, Deserialize, Serialize, JsonSchema)]
        #[serde(deny_unknown_fields)]
        pub(crate) struct $name {
            $($more)*
            /// A checkerboard of unit cubes; `a` from [0, 0, 0] to [1, 1, 1].
            pub checker: Option<PairTable>,
            /// Stripes along x: `a` over the first half of every unit, `b` over the second half.
            pub stripes: Option<PairTable>,
            /// Linear from `a` at x = 0 and below to `b` at x = 1 and beyond.
            pub gradient: Option<PairTable>,
            /// Noise between `a` and `b`, with features of about one unit.
            pub noise: Option<NoiseTable>,
            /// An image, repeated over every unit of u and v.
            pub picture: Option<Spanned<PictureOrFile>>,
            /// The coordinates of the pattern; by default the surface's u and v for a picture, and world
            /// coordinates for all others.
            pub space: Option<SpaceName>,
            /// The scale of the pattern: a factor for all axes, or one for each; not 0.
            pub scale: Option<Scale>,
            /// Rotation of the pattern in degrees about the x, then the y, then the z axis,
            /// counter-clockwise when the axis points at you.
            pub rotate_deg: Option<Vector>,
            /// Translation of the pattern.
            pub translate: Option<Vector>,
            /// Instead of these three, the inverse: the images in the pattern's space of the x, the y and
            /// the z axis as vectors, and of the origin as a point.
            pub pattern_from_space: Option<Matrix>,
        }

        impl $name {
            /// The pattern and its transform.
            pub fn pattern(&self) -> TextureTable {
                TextureTable {
                    checker: self.checker,
                    stripes: self.stripes,
                    gradient: self.gradient,
                    noise: self.noise,
                    picture: self.picture.clone(),
                    space: self.space,
                    scale: self.scale,
                    rotate_deg: self.rotate_deg,
                    translate: self.translate,
                    pattern_from_space: self.pattern_from_space,
                }
            }
        }
    };
}

with_pattern! {
    /// A texture: exactly one of checker, stripes, gradient, noise and picture. It is scaled first, then
    /// rotated, then translated.
    TextureTable {}
}

with_pattern! {
    /// A spatially varying colour: the name of a texture, or exactly one of checker, stripes, gradient,
    /// noise and picture.
    ColorTable {
        /// The name of a texture under [textures].
        pub texture: Option<Spanned<String>>,
        /// Factor on the texture; default white.
        pub color: Option<Color>,
    }
}

with_pattern! {
    /// A spatially varying number: the name of a texture, or exactly one of checker, stripes, gradient, noise and
    /// picture, which is not read as sRGB.
    NumberTable {
        /// The name of a texture under [textures]; a picture there needs `linear = true`.
        pub texture: Option<Spanned<String>>,
        /// Factor on the texture; default 1.
        pub value: Option<Fraction>,
    }
}

/// A map of numbers, for surfaces with u and v: the image is not read as sRGB. In a normal map red, green and blue
/// from 0 to 1 stand for -1 to 1: red along u, green along v, blue along the surface's own normal; models only. In an
/// occlusion map red is the fraction of ambient light that reaches the surface.
#[derive(Clone, Debug, Default, Deserialize, Serialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct DataMapTable {
    /// The image.
    pub picture: Option<Spanned<PictureOrFile>>,
    /// Instead of it, the name of a texture under [textures] with a picture, which needs `linear = true`.
    pub texture: Option<Spanned<String>>,
    /// Factor on the tilt of the normals, or weight of the occlusion, at most 1; default 1.
    pub strength: Option<NonNegative>,
    /// The set of u and v: uv (the default) or second-uv.
    pub space: Option<SpaceName>,
    /// The scale of the image: a factor for both axes, or one for each; not 0.
    pub scale: Option<Scale>,
    /// Rotation of the image in degrees about the x, then the y, then the z axis.
    pub rotate_deg: Option<Vector>,
    /// Translation of the image.
    pub translate: Option<Vector>,
    /// Instead of these three, the inverse, as in a texture.
    pub pattern_from_space: Option<Matrix>,
}

/// A height map.
#[derive(Clone, Debug, Deserialize, Serialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct HeightMapTable {
    /// The image: white is high, black is low. One with colours is taken for a normal map.
    pub picture: Spanned<PictureOrFile>,
    /// The height of white above black, in texels; below 0 if white is low. Default 1.
    pub strength: Option<Number>,
    /// The set of u and v: uv (the default) or second-uv.
    pub space: Option<SpaceName>,
    /// The scale of the image: a factor for both axes, or one for each; not 0.
    pub scale: Option<Scale>,
    /// Rotation of the image in degrees about the x, then the y, then the z axis.
    pub rotate_deg: Option<Vector>,
    /// Translation of the image.
    pub translate: Option<Vector>,
    /// Instead of these three, the inverse, as in a texture.
    pub pattern_from_space: Option<Matrix>,
}

impl HeightMapTable {
    /// The height of white, in texels.
    pub fn height(&self) -> f64 {
        self.strength
            .map_or(1.0, |strength| strength.0.clamp(-1e6, 1e6))
    }

    /// The image and its transform.
    pub fn pattern(&self) -> TextureTable {
        TextureTable {
            picture: Some(self.picture.clone()),
            space: self.space,
            scale: self.scale,
            rotate_deg: self.rotate_deg,
            translate: self.translate,
            pattern_from_space: self.pattern_from_space,
            ..TextureTable::default()
        }
    }
}

impl DataMapTable {
    /// The image and its transform.
    pub fn pattern(&self) -> TextureTable {
        TextureTable {
            picture: self.picture.clone(),
            space: self.space,
            scale: self.scale,
            rotate_deg: self.rotate_deg,
            translate: self.translate,
            pattern_from_space: self.pattern_from_space,
            ..TextureTable::default()
        }
    }
}

/// Two colours.
#[derive(Clone, Copy, Debug, Default, Deserialize, Serialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct PairTable {
    /// First colour; default white.
    pub a: Option<Color>,
    /// Second colour; default black.
    pub b: Option<Color>,
}

/// Noise.
#[derive(Clone, Copy, Debug, Default, Deserialize, Serialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct NoiseTable {
    /// First colour; default white.
    pub a: Option<Color>,
    /// Second colour; default black.
    pub b: Option<Color>,
    /// Number of octaves, each with half the wavelength and half the amplitude of the one before, 1 to
    /// 16; default 4.
    pub octaves: Option<Octaves>,
}

impl NoiseTable {
    /// The number of octaves where a file gives none.
    pub const OCTAVES: u32 = 4;
}

either! {
    /// The path of an image (PNG, JPEG, WebP, KTX2, HDR or EXR) in the scene's folder or below, or a table.
    PictureOrFile { File(String), Table(PictureTable) },
    "the name of a picture file, or a table",
    str: File, map: Table
}

/// An image file, and how it is sampled.
#[derive(Clone, Debug, Deserialize, Serialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct PictureTable {
    /// The path of a PNG, JPEG, WebP, KTX2, HDR or EXR file in the scene's folder or below.
    pub file: Spanned<String>,
    /// Whether the image holds numbers, as of roughness, and not sRGB colours; default false.
    pub linear: Option<bool>,
    /// Whether texels that look larger than a pixel are not interpolated, as in pixel art; default false.
    pub nearest: Option<bool>,
    /// How texels that look smaller than a pixel are filtered; default `"linear-mipmap-linear"`.
    pub minify: Option<MinifyName>,
    /// How the picture continues beyond its edges: for both axes, or for u and v; default `"repeat"`.
    pub wrap: Option<WrapModes>,
}

words! {
    /// How texels that look smaller than a pixel are filtered: in the picture, or in its mipmap, whose levels each have
    /// half the width and height of the one before. The modes are those of OpenGL and glTF.
    MinifyName for Minify {
        /// The nearest texel of the picture.
        Nearest,
        /// Interpolated between texels of the picture.
        Linear,
        /// The nearest texel of the level whose texels are nearest to a pixel in size.
        NearestMipmapNearest,
        /// Interpolated between texels of that level.
        LinearMipmapNearest,
        /// Interpolated between two levels, with the nearest texel of each.
        NearestMipmapLinear,
        /// Interpolated between texels and between levels.
        LinearMipmapLinear,
    }
}

words! {
    /// How a picture continues beyond its edges along one axis.
    WrapName for Wrap {
        /// The picture is repeated.
        Repeat,
        /// The texels of the edge go on.
        Clamp,
        /// The picture is repeated, and every second copy is mirrored.
        Mirror,
    }
}

/// A mode for both axes, or one for u and one for v.
#[derive(Clone, Copy, Debug, Deserialize, Serialize, JsonSchema)]
#[serde(
    untagged,
    expecting = "expected `repeat`, `clamp`, `mirror`, or two of them for u and v"
)]
pub(crate) enum WrapModes {
    Both(WrapName),
    Each([WrapName; 2]),
}

impl WrapModes {
    /// Along u and v.
    pub fn modes(self) -> [Wrap; 2] {
        let names = match self {
            Self::Both(name) => [name; 2],
            Self::Each(names) => names,
        };
        names.map(Into::into)
    }
}

impl From<[Wrap; 2]> for WrapModes {
    fn from([u, v]: [Wrap; 2]) -> Self {
        match u == v {
            true => Self::Both(u.into()),
            false => Self::Each([u.into(), v.into()]),
        }
    }
}

words! {
    /// The coordinates of a pattern.
    SpaceName for Space {
        /// World coordinates: a solid texture.
        World,
        /// The surface's own u and v, as x and y: for a model from its file, for a triangle from its first
        /// corner to its second and third.
        Uv,
        /// The second set of u and v, of models that have one.
        SecondUv,
    }
}

either! {
    /// A colour, or a texture.
    ColorOrTexture { Color(Color), Table(Box<ColorTable>) },
    "a colour ([r, g, b] or \"#rrggbb\") or a texture",
    str: Color, seq: Color, map: Table
}
