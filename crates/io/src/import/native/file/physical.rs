//! The metallic-roughness model in a native scene.

use super::Spanned;
use super::textures::{ColorOrTexture, DataMapTable, NumberTable};
use crate::import::native::values::{
    Angle, BodyIndex, Color, Dispersion, FilmIndex, Fraction, NonNegative, Positive, Priority,
    Thicknesses, either,
};
use glam::Vec3;
use glimray_scene::MetallicRoughness;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// A physically based material: the metallic-roughness model of glTF 2.0 with its extensions. Path tracing shows all of
/// it. The classical integrator shows it by a highlight, a mirror and a diffuse colour, unless `phong` or `optics` say
/// what it shows instead; of the textures it shows those of `base_color`, `metallic`, `roughness` and `transmission`.
#[derive(Clone, Debug, Default, Deserialize, Serialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct PbrTable {
    /// The colour of a dielectric's body, or of a metal's reflection, 0 to 1; default light grey.
    pub base_color: Option<Spanned<ColorOrTexture>>,
    /// Factor on `base_color`, such as the colour of a model's vertices, 0 to 1; default white.
    pub tint: Option<Spanned<Color>>,
    /// 0 for a dielectric (the default), 1 for a metal. A texture has it in blue.
    pub metallic: Option<Spanned<FractionOrTexture>>,
    /// The roughness of the surface, 0 to 1, the square root of the microfacets' width; default 0.5. A texture has it in
    /// green.
    pub roughness: Option<Spanned<FractionOrTexture>>,
    /// The index of refraction of a dielectric, at least 1; default 1.5.
    pub ior: Option<BodyIndex>,
    /// Factor on the reflection of a dielectric; default 1. A picture has it in alpha.
    pub specular: Option<Spanned<FractionOrTexture>>,
    /// The colour of this reflection along the normal; default white.
    pub specular_color: Option<Spanned<ColorOrTexture>>,
    /// The fraction of the light in a dielectric's body that passes through; default 0. A texture has it in red.
    pub transmission: Option<Spanned<FractionOrTexture>>,
    /// 0 for a thin wall, which does not refract (the default); above 0 the surface encloses a volume, which does.
    pub thickness: Option<NonNegative>,
    /// The colour that white light has after `attenuation_distance` in the volume, 0 to 1; default white.
    pub attenuation_color: Option<Spanned<Color>>,
    /// A length, above 0; by default light is not attenuated.
    pub attenuation_distance: Option<Positive>,
    /// Among overlapping volumes the one of the highest priority counts, as in `refract`. Default 0.
    pub priority: Option<Priority>,
    /// The strength of a clear coat; default 0. A texture has it in red.
    pub clearcoat: Option<Spanned<FractionOrTexture>>,
    /// Its roughness; default 0. A texture has it in green.
    pub clearcoat_roughness: Option<Spanned<FractionOrTexture>>,
    /// Its own normal map, as `normal_map` of the material, which does not tilt the coat.
    pub clearcoat_normal_map: Option<Spanned<DataMapTable>>,
    /// The colour of a layer of fibres, as on velvet, 0 to 1; default black: none.
    pub sheen_color: Option<Spanned<ColorOrTexture>>,
    /// Its roughness; default 0. A picture has it in alpha.
    pub sheen_roughness: Option<Spanned<FractionOrTexture>>,
    /// The strength of a thin film, whose colours change with the angle; default 0. A texture has it in red.
    pub iridescence: Option<Spanned<FractionOrTexture>>,
    /// The film's index of refraction, at least 1; default 1.3.
    pub iridescence_ior: Option<FilmIndex>,
    /// Its thinnest and its thickest part in nanometres; the latter without a map. With a map the former may be the thicker
    /// one. Default [100, 400].
    pub iridescence_thickness: Option<Spanned<Thicknesses>>,
    /// Where it is how thick, between the two: a texture, in green, without a `value`.
    pub iridescence_thickness_map: Option<Spanned<NumberTable>>,
    /// How much longer highlights are along one direction, 0 to 1; default 0. A texture has it in blue, and the direction in
    /// red and green, from -1 to 1 for 0 to 1.
    pub anisotropy: Option<Spanned<FractionOrTexture>>,
    /// That direction in degrees, counter-clockwise from the direction of u, on models; default 0.
    pub anisotropy_rotation_deg: Option<Angle>,
    /// How much the index of refraction depends on the wavelength: 20 divided by Abbe's number; default 0.
    pub dispersion: Option<Dispersion>,
    /// The fraction of the diffuse light that leaves on the other side; default 0. A picture has it in alpha.
    pub diffuse_transmission: Option<Spanned<FractionOrTexture>>,
    /// Its colour, 0 to 1; default white.
    pub diffuse_transmission_color: Option<Spanned<ColorOrTexture>>,
    /// Whether it shines with its base colour instead of being lit, unless the material has an `emission`; default
    /// false.
    pub unlit: Option<bool>,
}

impl PbrTable {
    /// The parameters that an empty table gives: a light grey dielectric.
    pub fn plain() -> MetallicRoughness {
        MetallicRoughness {
            base_color: Vec3::splat(0.8),
            metallic: 0.0,
            roughness: 0.5,
            ..MetallicRoughness::default()
        }
    }
}

either! {
    /// A fraction, or a texture of fractions.
    FractionOrTexture { Fraction(Fraction), Table(Box<NumberTable>) },
    "a number between 0 and 1, or a texture",
    number: Fraction, map: Table
}
