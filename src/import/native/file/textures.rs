//! How a native scene describes colours that vary, and what is behind everything.

use crate::import::native::values::{
    Angle, Color, Matrix, NonNegative, Number, Octaves, Scale, Vector,
};
use glam::Vec3;
use schemars::JsonSchema;
use serde::Deserialize;
use serde::de::{self, Deserializer, MapAccess, SeqAccess, Visitor};
use std::fmt;
use toml::Spanned;

/// A table with a pattern and its place in it, and what else is in front.
macro_rules! with_pattern {
    ($(#[$doc:meta])* $name:ident { $($more:tt)* }) => {
        $(#[$doc])*
        #[derive(Clone, Debug, Default, Deserialize, JsonSchema)]
        #[serde(deny_unknown_fields, default)]
        pub(in crate::import::native) struct $name {
            $($more)*
            /// Unit cubes of two colours by turns, `a` from [0, 0, 0] to [1, 1, 1].
            pub checker: Option<PairTable>,
            /// Layers of two colours along x: `a` over the first half of every unit, `b` over the
            /// other.
            pub stripes: Option<PairTable>,
            /// From `a` at x = 0 and below evenly to `b` at x = 1 and beyond.
            pub gradient: Option<PairTable>,
            /// Clouds between `a` and `b`, about one unit large.
            pub noise: Option<NoiseTable>,
            /// A picture, repeated over every unit of u and v.
            #[schemars(with = "Option<PictureOrFile>")]
            pub picture: Option<Spanned<PictureOrFile>>,
            /// What the pattern is laid over; the surface's u and v for a picture, the world for all
            /// others if left out.
            pub space: Option<SpaceName>,
            /// How large the pattern is: a factor for all axes, or one for each; not 0.
            pub scale: Option<Scale>,
            /// Degrees to turn the pattern round the x, then the y, then the z axis,
            /// counter-clockwise when the axis points at you.
            pub rotate_deg: Option<Vector>,
            /// How far to move the pattern.
            pub translate: Option<Vector>,
            /// In place of these three, the way back: where the x, the y and the z axis of what the
            /// pattern is laid over are in the pattern as vectors, and its origin as a point.
            pub pattern_from_space: Option<Matrix>,
        }

        impl $name {
            /// What says where the colours come from and go to.
            pub fn pattern(&self) -> PatternTables<'_> {
                PatternTables {
                    checker: self.checker.as_ref(),
                    stripes: self.stripes.as_ref(),
                    gradient: self.gradient.as_ref(),
                    noise: self.noise.as_ref(),
                    picture: self.picture.as_ref(),
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
    /// A texture: exactly one of checker, stripes, gradient, noise and picture. It is scaled first,
    /// then rotated, then moved.
    TextureTable {}
}

with_pattern! {
    /// A colour that varies over the surface: a texture by its name, or exactly one of checker,
    /// stripes, gradient, noise and picture.
    ColorTable {
        /// The name of a texture under [textures].
        #[schemars(with = "Option<String>")]
        pub texture: Option<Spanned<String>>,
        /// What the texture is multiplied by; white if left out.
        pub color: Option<Color>,
    }
}

/// The pattern of a table, and where it is.
pub(in crate::import::native) struct PatternTables<'a> {
    pub checker: Option<&'a PairTable>,
    pub stripes: Option<&'a PairTable>,
    pub gradient: Option<&'a PairTable>,
    pub noise: Option<&'a NoiseTable>,
    pub picture: Option<&'a Spanned<PictureOrFile>>,
    pub space: Option<SpaceName>,
    pub scale: Option<Scale>,
    pub rotate_deg: Option<Vector>,
    pub translate: Option<Vector>,
    pub pattern_from_space: Option<Matrix>,
}

/// Two colours.
#[derive(Clone, Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub(in crate::import::native) struct PairTable {
    /// One colour; white if left out.
    pub a: Color,
    /// The other; black if left out.
    pub b: Color,
}

/// Clouds.
#[derive(Clone, Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub(in crate::import::native) struct NoiseTable {
    /// One colour; white if left out.
    pub a: Color,
    /// The other; black if left out.
    pub b: Color,
    /// How many layers there are, each half as large and half as strong as the one before: 1 to 16;
    /// 4 if left out.
    pub octaves: Octaves,
}

/// The path of a picture (PNG, JPEG, HDR or EXR) from the scene's folder downwards, or a table.
#[derive(Clone, Debug, JsonSchema)]
#[schemars(untagged)]
pub(in crate::import::native) enum PictureOrFile {
    File(String),
    Table(PictureTable),
}

impl<'de> Deserialize<'de> for PictureOrFile {
    // By hand: serde's untagged enums lose the place of an error.
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct NameOrTable;
        impl<'de> Visitor<'de> for NameOrTable {
            type Value = PictureOrFile;
            fn expecting(&self, f: &mut fmt::Formatter) -> fmt::Result {
                f.write_str("the name of a picture file, or a table")
            }
            fn visit_str<E: de::Error>(self, name: &str) -> Result<PictureOrFile, E> {
                Ok(PictureOrFile::File(name.to_owned()))
            }
            fn visit_map<A: MapAccess<'de>>(self, map: A) -> Result<PictureOrFile, A::Error> {
                let table = de::value::MapAccessDeserializer::new(map);
                PictureTable::deserialize(table).map(PictureOrFile::Table)
            }
        }
        deserializer.deserialize_any(NameOrTable)
    }
}

/// A picture file, and how it is looked up.
#[derive(Clone, Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(in crate::import::native) struct PictureTable {
    /// The path of a PNG, JPEG, HDR or EXR file, from the scene's folder downwards.
    #[schemars(with = "String")]
    pub file: Spanned<String>,
    /// Whether texels have hard edges instead of blending; false if left out.
    #[serde(default)]
    pub nearest: bool,
}

impl Default for PairTable {
    fn default() -> Self {
        Self {
            a: Color(Vec3::ONE),
            b: Color(Vec3::ZERO),
        }
    }
}

impl Default for NoiseTable {
    fn default() -> Self {
        let PairTable { a, b } = PairTable::default();
        Self {
            a,
            b,
            octaves: Octaves(4),
        }
    }
}

/// What a pattern is laid over.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub(in crate::import::native) enum SpaceName {
    /// The point in the world: the pattern is carved out of a block.
    World,
    /// The surface's own u and v, as x and y: of a model as its file says, of a triangle from its
    /// first corner to its second and third.
    Uv,
}

/// What rays see that hit nothing: either `bottom` and `top`, or `picture`.
#[derive(Clone, Debug, Default, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub(in crate::import::native) struct BackgroundTable {
    /// The colour straight down; towards `top` it changes evenly with height.
    pub bottom: Option<Color>,
    /// The colour straight up.
    pub top: Option<Color>,
    /// The path of an equirectangular picture (PNG, JPEG, HDR or EXR), from the scene's folder
    /// downwards. Its middle lies in the direction -z, +x to the right of it, its upper edge
    /// straight up.
    #[schemars(with = "Option<String>")]
    pub picture: Option<Spanned<String>>,
    /// What the picture is multiplied by; 1 if left out.
    pub strength: Option<NonNegative>,
    /// Degrees to turn the picture round the y axis, counter-clockwise from above; 0 if left out.
    pub rotation_deg: Option<Angle>,
    /// The same in radians, in place of `rotation_deg`.
    #[schemars(with = "Option<f64>")]
    pub rotation: Option<Number>,
}

/// A colour, or a table in its place.
macro_rules! color_or {
    ($(#[$doc:meta])* $name:ident($table:ty), $expected:literal) => {
        $(#[$doc])*
        #[derive(Clone, Debug, JsonSchema)]
        #[schemars(untagged)]
        pub(in crate::import::native) enum $name {
            Color(Color),
            Table(Box<$table>),
        }

        impl<'de> Deserialize<'de> for $name {
            // By hand: serde's untagged enums lose the place of an error.
            fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
                struct ColorOrTable;
                impl<'de> Visitor<'de> for ColorOrTable {
                    type Value = $name;
                    fn expecting(&self, f: &mut fmt::Formatter) -> fmt::Result {
                        f.write_str($expected)
                    }
                    fn visit_str<E: de::Error>(self, text: &str) -> Result<$name, E> {
                        Color::deserialize(de::value::StrDeserializer::new(text)).map($name::Color)
                    }
                    fn visit_seq<A: SeqAccess<'de>>(self, seq: A) -> Result<$name, A::Error> {
                        let seq = de::value::SeqAccessDeserializer::new(seq);
                        Color::deserialize(seq).map($name::Color)
                    }
                    fn visit_map<A: MapAccess<'de>>(self, map: A) -> Result<$name, A::Error> {
                        let map = de::value::MapAccessDeserializer::new(map);
                        <$table>::deserialize(map).map(|table| $name::Table(Box::new(table)))
                    }
                }
                deserializer.deserialize_any(ColorOrTable)
            }
        }
    };
}

color_or!(
    /// A colour, or a texture.
    ColorOrTexture(ColorTable),
    "a colour ([r, g, b] or \"#rrggbb\") or a texture"
);

color_or!(
    /// One colour, a gradient from bottom to top, or a picture.
    ColorOrBackground(BackgroundTable),
    "a colour ([r, g, b] or \"#rrggbb\"), a gradient or a picture"
);

/// A colour that is not in the file.
pub(in crate::import::native) fn plain(color: Vec3) -> Spanned<ColorOrTexture> {
    Spanned::new(0..0, ColorOrTexture::Color(Color(color)))
}
