//! The metallic-roughness model in a native scene.

use super::textures::{ColorOrTexture, DataMapTable, NumberTable, plain};
use crate::import::native::values::{
    Angle, BodyIndex, Color, Dispersion, FilmIndex, Fraction, NonNegative, Positive, Priority,
    Thicknesses,
};
use glam::Vec3;
use schemars::JsonSchema;
use serde::Deserialize;
use serde::de::{self, Deserializer, MapAccess, Visitor};
use std::fmt;
use toml::Spanned;

/// A physically based material: the metallic-roughness model of glTF 2.0 with its extensions. Path tracing shows all of
/// it. The classical integrator shows it by a highlight, a mirror and a diffuse colour, unless `phong` or `optics` say
/// what it shows instead; of the textures it shows those of `base_color`, `metallic`, `roughness` and `transmission`.
#[derive(Clone, Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub(in crate::import::native) struct PbrTable {
    /// The colour of a dielectric's body, or of a metal's reflection, 0 to 1; default light grey.
    #[schemars(with = "ColorOrTexture")]
    pub base_color: Spanned<ColorOrTexture>,
    /// Factor on `base_color`, such as the colour of a model's vertices, 0 to 1; default white.
    #[schemars(with = "Color")]
    pub tint: Spanned<Color>,
    /// 0 for a dielectric (the default), 1 for a metal. A texture has it in blue.
    #[schemars(with = "FractionOrTexture")]
    pub metallic: Spanned<FractionOrTexture>,
    /// The roughness of the surface, 0 to 1, the square root of the microfacets' width; default 0.5. A texture has it in
    /// green.
    #[schemars(with = "FractionOrTexture")]
    pub roughness: Spanned<FractionOrTexture>,
    /// The index of refraction of a dielectric, at least 1; default 1.5.
    pub ior: BodyIndex,
    /// Factor on the reflection of a dielectric; default 1. A picture has it in alpha.
    #[schemars(with = "FractionOrTexture")]
    pub specular: Spanned<FractionOrTexture>,
    /// The colour of this reflection along the normal; default white.
    #[schemars(with = "ColorOrTexture")]
    pub specular_color: Spanned<ColorOrTexture>,
    /// The fraction of the light in a dielectric's body that passes through; default 0. A texture has it in red.
    #[schemars(with = "FractionOrTexture")]
    pub transmission: Spanned<FractionOrTexture>,
    /// 0 for a thin wall, which does not refract (the default); above 0 the surface encloses a volume, which does.
    pub thickness: NonNegative,
    /// The colour that white light has after `attenuation_distance` in the volume, 0 to 1; default white.
    #[schemars(with = "Color")]
    pub attenuation_color: Spanned<Color>,
    /// A length, above 0; by default light is not attenuated.
    pub attenuation_distance: Option<Positive>,
    /// Among overlapping volumes the one of the highest priority counts, as in `refract`. Default 0.
    pub priority: Priority,
    /// The strength of a clear coat; default 0. A texture has it in red.
    #[schemars(with = "FractionOrTexture")]
    pub clearcoat: Spanned<FractionOrTexture>,
    /// Its roughness; default 0. A texture has it in green.
    #[schemars(with = "FractionOrTexture")]
    pub clearcoat_roughness: Spanned<FractionOrTexture>,
    /// Its own normal map, as `normal_map` of the material, which does not tilt the coat.
    #[schemars(with = "Option<DataMapTable>")]
    pub clearcoat_normal_map: Option<Spanned<DataMapTable>>,
    /// The colour of a layer of fibres, as on velvet, 0 to 1; default black: none.
    #[schemars(with = "ColorOrTexture")]
    pub sheen_color: Spanned<ColorOrTexture>,
    /// Its roughness; default 0. A picture has it in alpha.
    #[schemars(with = "FractionOrTexture")]
    pub sheen_roughness: Spanned<FractionOrTexture>,
    /// The strength of a thin film, whose colours change with the angle; default 0. A texture has it in red.
    #[schemars(with = "FractionOrTexture")]
    pub iridescence: Spanned<FractionOrTexture>,
    /// The film's index of refraction, at least 1; default 1.3.
    pub iridescence_ior: FilmIndex,
    /// Its thinnest and its thickest part in nanometres; the latter without a map. With a map the former may be the thicker
    /// one. Default [100, 400].
    #[schemars(with = "Thicknesses")]
    pub iridescence_thickness: Spanned<Thicknesses>,
    /// Where it is how thick, between the two: a texture, in green, without a `value`.
    #[schemars(with = "Option<NumberTable>")]
    pub iridescence_thickness_map: Option<Spanned<NumberTable>>,
    /// How much longer highlights are along one direction, 0 to 1; default 0. A texture has it in blue, and the direction in
    /// red and green, from -1 to 1 for 0 to 1.
    #[schemars(with = "FractionOrTexture")]
    pub anisotropy: Spanned<FractionOrTexture>,
    /// That direction in degrees, counter-clockwise from the direction of u, on models; default 0.
    pub anisotropy_rotation_deg: Angle,
    /// How much the index of refraction depends on the wavelength: 20 divided by Abbe's number; default 0.
    pub dispersion: Dispersion,
    /// The fraction of the diffuse light that leaves on the other side; default 0. A picture has it in alpha.
    #[schemars(with = "FractionOrTexture")]
    pub diffuse_transmission: Spanned<FractionOrTexture>,
    /// Its colour, 0 to 1; default white.
    #[schemars(with = "ColorOrTexture")]
    pub diffuse_transmission_color: Spanned<ColorOrTexture>,
    /// Whether it shines with its base colour instead of being lit, unless the material has an `emission`; default
    /// false.
    pub unlit: bool,
}

impl Default for PbrTable {
    fn default() -> Self {
        let color = |color| Spanned::new(0..0, Color(color));
        Self {
            base_color: plain(Vec3::splat(0.8)),
            tint: color(Vec3::ONE),
            metallic: fraction(0.0),
            roughness: fraction(0.5),
            ior: BodyIndex(1.5),
            specular: fraction(1.0),
            specular_color: plain(Vec3::ONE),
            transmission: fraction(0.0),
            thickness: NonNegative(0.0),
            attenuation_color: color(Vec3::ONE),
            attenuation_distance: None,
            priority: Priority(0),
            clearcoat: fraction(0.0),
            clearcoat_roughness: fraction(0.0),
            clearcoat_normal_map: None,
            sheen_color: plain(Vec3::ZERO),
            sheen_roughness: fraction(0.0),
            iridescence: fraction(0.0),
            iridescence_ior: FilmIndex(1.3),
            iridescence_thickness: Spanned::new(0..0, Thicknesses([100.0, 400.0])),
            iridescence_thickness_map: None,
            anisotropy: fraction(0.0),
            anisotropy_rotation_deg: Angle(0.0),
            dispersion: Dispersion(0.0),
            diffuse_transmission: fraction(0.0),
            diffuse_transmission_color: plain(Vec3::ONE),
            unlit: false,
        }
    }
}

/// A fraction, or a texture of fractions.
#[derive(Clone, Debug, JsonSchema)]
#[schemars(untagged)]
pub(in crate::import::native) enum FractionOrTexture {
    Fraction(Fraction),
    Table(Box<NumberTable>),
}

impl<'de> Deserialize<'de> for FractionOrTexture {
    // By hand: serde's untagged enums lose the position of an error.
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct FractionOrTable;
        impl<'de> Visitor<'de> for FractionOrTable {
            type Value = FractionOrTexture;
            fn expecting(&self, f: &mut fmt::Formatter) -> fmt::Result {
                f.write_str("a number between 0 and 1, or a texture")
            }
            fn visit_i64<E: de::Error>(self, value: i64) -> Result<FractionOrTexture, E> {
                self.visit_f64(value as f64)
            }
            fn visit_f64<E: de::Error>(self, value: f64) -> Result<FractionOrTexture, E> {
                Fraction::deserialize(de::value::F64Deserializer::new(value))
                    .map(FractionOrTexture::Fraction)
            }
            fn visit_map<A: MapAccess<'de>>(self, map: A) -> Result<FractionOrTexture, A::Error> {
                let table = de::value::MapAccessDeserializer::new(map);
                NumberTable::deserialize(table).map(|it| FractionOrTexture::Table(Box::new(it)))
            }
        }
        deserializer.deserialize_any(FractionOrTable)
    }
}

/// A default number.
fn fraction(value: f32) -> Spanned<FractionOrTexture> {
    Spanned::new(0..0, FractionOrTexture::Fraction(Fraction(value)))
}
