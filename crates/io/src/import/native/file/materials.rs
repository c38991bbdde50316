//! Materials in a native scene.

use super::Spanned;
use super::physical::PbrTable;
use super::textures::{ColorOrTexture, DataMapTable, HeightMapTable};
use crate::import::native::values::{
    Absorption, Fraction, FresnelName, MixingName, NonNegative, Positive, Priority,
    RefractiveIndex, either,
};
use glimray_scene::Phong;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// The index of refraction of `reflect` and `refract` where they give none.
pub(crate) const IOR: f32 = 1.5;

/// The appearance of a surface.
#[derive(Clone, Debug, Default, Deserialize, Serialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct MaterialTable {
    /// Phong coefficients; by default those of a matte light grey, or those that show `pbr`.
    pub phong: Option<PhongTable>,
    /// A physically based material; default none.
    pub pbr: Option<Spanned<PbrTable>>,
    /// Mirror reflection; default none.
    pub reflect: Option<ReflectTable>,
    /// Refraction; default none.
    pub refract: Option<Spanned<RefractTable>>,
    /// Reflection and transmission specified directly, instead of `reflect` and `refract`, for
    /// combinations that those cannot express.
    pub optics: Option<Spanned<OpticsTable>>,
    /// Bumps of the surface that only light shows; default none.
    pub normal_map: Option<Spanned<DataMapTable>>,
    /// Bumps by the height of the surface, which has slopes; default none.
    pub height_map: Option<Spanned<HeightMapTable>>,
    /// Where ambient light does not reach; default none.
    pub occlusion_map: Option<Spanned<DataMapTable>>,
    /// Whether transmitted light goes straight on, as through a window pane: the surface encloses no medium. Default
    /// false.
    pub thin: Option<bool>,
    /// Whether paths from the camera see only the shadows on it, where the picture is transparent: with `backdrop =
    /// "transparent"` of the output. All other light sees the material. Default false.
    pub shadow_catcher: Option<bool>,
    /// Holes in the surface, such as those between the leaves of a picture of foliage; default none.
    pub coverage: Option<CoverageTable>,
    /// The light that it emits, in radiance of any strength; default none.
    pub emission: Option<Spanned<ColorOrTexture>>,
    /// Whether both sides are lit alike (the default), or only the side that the normal points to.
    pub two_sided: Option<bool>,
    /// Whether the back of a two-sided surface emits as its front does (the default), or not at all. The front is the
    /// side that the normal points to.
    pub two_sided_emission: Option<bool>,
}

/// How much of a surface is there. Rays, also shadow rays, pass the rest in a straight line.
#[derive(Clone, Debug, Default, Deserialize, Serialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct CoverageTable {
    /// The fraction that is there, 0 to 1; default 1.
    pub alpha: Option<Fraction>,
    /// A texture whose alpha multiplies `alpha`; only pictures have one.
    pub map: Option<Spanned<ColorOrTexture>>,
    /// If given, the surface is there where alpha is at least this, 0 to 1, and nowhere else.
    pub mask: Option<Fraction>,
}

/// Mirror reflection. It weakens ambient and diffuse light by the reflected fraction.
#[derive(Clone, Debug, Default, Deserialize, Serialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct ReflectTable {
    /// The reflected fraction, 0 to 1; default 1.
    pub amount: Option<Fraction>,
    /// Factor on reflected light; default white.
    pub color: Option<Spanned<ColorOrTexture>>,
    /// How reflection depends on the angle: none (constant, like metals; the default), or exact or
    /// schlick, like varnish.
    pub fresnel: Option<FresnelName>,
    /// The index of refraction of the varnish if `fresnel` is not none; default 1.5.
    pub ior: Option<RefractiveIndex>,
}

/// Refraction, and the reflection at the boundary of a dielectric volume. Its inside is the side that the
/// normals point away from.
#[derive(Clone, Debug, Default, Deserialize, Serialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct RefractTable {
    /// The fraction of light that is transmitted or reflected; ambient and diffuse light get the rest. 0
    /// to 1; default 1.
    pub amount: Option<Fraction>,
    /// The index of refraction inside; default 1.5.
    pub ior: Option<RefractiveIndex>,
    /// Factor on light that passes through the surface; default white.
    pub color: Option<Spanned<ColorOrTexture>>,
    /// Absorption coefficient per unit length and channel: exp(-absorption * length) is transmitted.
    /// Default none.
    pub absorption: Option<Absorption>,
    /// How reflection depends on the angle: exact (Fresnel's equations; the default), schlick, or none.
    pub fresnel: Option<FresnelName>,
    /// Among overlapping dielectric volumes the one of the highest priority counts; among equals the one
    /// entered last. Default 0.
    pub priority: Option<Priority>,
}

/// Reflection and transmission, each specified by itself.
#[derive(Clone, Debug, Default, Deserialize, Serialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct OpticsTable {
    /// Factor on reflected light, with `fresnel` its value at grazing angles; default black.
    pub reflect: Option<Spanned<ColorOrTexture>>,
    /// Factor on transmitted light; default black.
    pub transmit: Option<Spanned<ColorOrTexture>>,
    /// The weight of ambient and diffuse light if `mixing` is layer, 0 to 1; default 1.
    pub opacity: Option<Fraction>,
    /// The index of refraction inside, above 0; default 1.
    pub ior: Option<Positive>,
    /// The absorption coefficient, as in `refract`.
    pub absorption: Option<Absorption>,
    /// How reflection depends on the angle: none (the default), exact or schlick.
    pub fresnel: Option<FresnelName>,
    /// The priority among overlapping dielectric volumes, as in `refract`.
    pub priority: Option<Priority>,
    /// How local, reflected and transmitted light are combined: layer (the default), sum or blend.
    pub mixing: Option<MixingName>,
}

/// Phong coefficients.
#[derive(Clone, Debug, Default, Deserialize, Serialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct PhongTable {
    /// The diffuse colour; default light grey.
    pub diffuse: Option<Spanned<ColorOrTexture>>,
    /// The colour of highlights; default none.
    pub specular: Option<Spanned<ColorOrTexture>>,
    /// The exponent of highlights; higher values make them smaller; default 32.
    pub shininess: Option<NonNegative>,
    /// Factor on ambient light; default: the diffuse colour.
    pub ambient: Option<Spanned<ColorOrTexture>>,
}

impl PhongTable {
    /// The coefficients that an empty table gives.
    pub fn plain() -> Phong {
        Phong {
            shininess: 32.0,
            ..Phong::default()
        }
    }
}

either! {
    /// The name of a material, or a material.
    MaterialRef { Name(String), Inline(Box<MaterialTable>) },
    "the name of a material, or a table",
    str: Name, map: Inline
}
