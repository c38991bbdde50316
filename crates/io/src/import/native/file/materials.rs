//! Materials in a native scene.

use super::physical::PbrTable;
use super::textures::{ColorOrTexture, DataMapTable, HeightMapTable, plain};
use crate::import::native::values::{
    Absorption, Fraction, FresnelName, MixingName, NonNegative, Positive, Priority, RefractiveIndex,
};
use glam::Vec3;
use schemars::JsonSchema;
use serde::Deserialize;
use serde::de::{self, Deserializer, MapAccess, Visitor};
use std::fmt;
use toml::Spanned;

/// The appearance of a surface.
#[derive(Clone, Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub(in crate::import::native) struct MaterialTable {
    /// Phong coefficients; by default those of a matte light grey, or those that show `pbr`.
    pub phong: Option<PhongTable>,
    /// A physically based material; default none.
    #[schemars(with = "Option<PbrTable>")]
    pub pbr: Option<Spanned<PbrTable>>,
    /// Mirror reflection; default none.
    pub reflect: Option<ReflectTable>,
    /// Refraction; default none.
    #[schemars(with = "Option<RefractTable>")]
    pub refract: Option<Spanned<RefractTable>>,
    /// Reflection and transmission specified directly, instead of `reflect` and `refract`, for
    /// combinations that those cannot express.
    #[schemars(with = "Option<OpticsTable>")]
    pub optics: Option<Spanned<OpticsTable>>,
    /// Bumps of the surface that only light shows; default none.
    #[schemars(with = "Option<DataMapTable>")]
    pub normal_map: Option<Spanned<DataMapTable>>,
    /// The same by the height of the surface, which has slopes; default none.
    #[schemars(with = "Option<HeightMapTable>")]
    pub height_map: Option<Spanned<HeightMapTable>>,
    /// Where ambient light does not reach; default none.
    #[schemars(with = "Option<DataMapTable>")]
    pub occlusion_map: Option<Spanned<DataMapTable>>,
    /// Whether transmitted light goes straight on, as through a window pane: the surface encloses no medium. Default
    /// false.
    pub thin: bool,
    /// Whether paths from the camera see only the shadows on it, where the picture is transparent: with `backdrop =
    /// "transparent"` of the output. All other light sees the material. Default false.
    pub shadow_catcher: bool,
    /// Holes in the surface, such as those between the leaves of a picture of foliage; default none.
    pub coverage: Option<CoverageTable>,
    /// The light that it emits, in radiance of any strength; default none.
    #[schemars(with = "Option<ColorOrTexture>")]
    pub emission: Option<Spanned<ColorOrTexture>>,
    /// Whether both sides are lit alike (the default), or only the side that the normal points to.
    pub two_sided: bool,
    /// Whether the back of a two-sided surface emits as its front does (the default), or not at all. The front is the
    /// side that the normal points to.
    pub two_sided_emission: bool,
}

impl Default for MaterialTable {
    fn default() -> Self {
        Self {
            phong: None,
            pbr: None,
            reflect: None,
            refract: None,
            optics: None,
            normal_map: None,
            height_map: None,
            occlusion_map: None,
            thin: false,
            shadow_catcher: false,
            coverage: None,
            emission: None,
            two_sided: true,
            two_sided_emission: true,
        }
    }
}

/// How much of a surface is there. Rays, also shadow rays, pass the rest in a straight line.
#[derive(Clone, Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub(in crate::import::native) struct CoverageTable {
    /// The fraction that is there, 0 to 1; default 1.
    pub alpha: Fraction,
    /// A texture whose alpha multiplies `alpha`; only pictures have one.
    #[schemars(with = "Option<ColorOrTexture>")]
    pub map: Option<Spanned<ColorOrTexture>>,
    /// If given, the surface is there where alpha is at least this, 0 to 1, and nowhere else.
    pub mask: Option<Fraction>,
}

impl Default for CoverageTable {
    fn default() -> Self {
        Self {
            alpha: Fraction(1.0),
            map: None,
            mask: None,
        }
    }
}

/// Mirror reflection. It weakens ambient and diffuse light by the reflected fraction.
#[derive(Clone, Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub(in crate::import::native) struct ReflectTable {
    /// The reflected fraction, 0 to 1; default 1.
    pub amount: Fraction,
    /// Factor on reflected light; default white.
    #[schemars(with = "ColorOrTexture")]
    pub color: Spanned<ColorOrTexture>,
    /// How reflection depends on the angle: none (constant, like metals; the default), or exact or
    /// schlick, like varnish.
    pub fresnel: FresnelName,
    /// The index of refraction of the varnish if `fresnel` is not none; default 1.5.
    pub ior: RefractiveIndex,
}

impl Default for ReflectTable {
    fn default() -> Self {
        Self {
            amount: Fraction(1.0),
            color: plain(Vec3::ONE),
            fresnel: FresnelName::None,
            ior: RefractiveIndex(1.5),
        }
    }
}

/// Refraction, and the reflection at the boundary of a dielectric volume. Its inside is the side that the
/// normals point away from.
#[derive(Clone, Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub(in crate::import::native) struct RefractTable {
    /// The fraction of light that is transmitted or reflected; ambient and diffuse light get the rest. 0
    /// to 1; default 1.
    pub amount: Fraction,
    /// The index of refraction inside; default 1.5.
    pub ior: RefractiveIndex,
    /// Factor on light that passes through the surface; default white.
    #[schemars(with = "ColorOrTexture")]
    pub color: Spanned<ColorOrTexture>,
    /// Absorption coefficient per unit length and channel: exp(-absorption * length) is transmitted.
    /// Default none.
    pub absorption: Absorption,
    /// How reflection depends on the angle: exact (Fresnel's equations; the default), schlick, or none.
    pub fresnel: FresnelName,
    /// Among overlapping dielectric volumes the one of the highest priority counts; among equals the one
    /// entered last. Default 0.
    pub priority: Priority,
}

impl Default for RefractTable {
    fn default() -> Self {
        Self {
            amount: Fraction(1.0),
            ior: RefractiveIndex(1.5),
            color: plain(Vec3::ONE),
            absorption: Absorption(Vec3::ZERO),
            fresnel: FresnelName::Exact,
            priority: Priority(0),
        }
    }
}

/// Reflection and transmission, each specified by itself.
#[derive(Clone, Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub(in crate::import::native) struct OpticsTable {
    /// Factor on reflected light, with `fresnel` its value at grazing angles; default black.
    #[schemars(with = "ColorOrTexture")]
    pub reflect: Spanned<ColorOrTexture>,
    /// Factor on transmitted light; default black.
    #[schemars(with = "ColorOrTexture")]
    pub transmit: Spanned<ColorOrTexture>,
    /// The weight of ambient and diffuse light if `mixing` is layer, 0 to 1; default 1.
    pub opacity: Fraction,
    /// The index of refraction inside, above 0; default 1.
    pub ior: Positive,
    /// The absorption coefficient, as in `refract`.
    pub absorption: Absorption,
    /// How reflection depends on the angle: none (the default), exact or schlick.
    pub fresnel: FresnelName,
    /// The priority among overlapping dielectric volumes, as in `refract`.
    pub priority: Priority,
    /// How local, reflected and transmitted light are combined: layer (the default), sum or blend.
    pub mixing: MixingName,
}

impl Default for OpticsTable {
    fn default() -> Self {
        Self {
            reflect: plain(Vec3::ZERO),
            transmit: plain(Vec3::ZERO),
            opacity: Fraction(1.0),
            ior: Positive(1.0),
            absorption: Absorption(Vec3::ZERO),
            fresnel: FresnelName::None,
            priority: Priority(0),
            mixing: MixingName::Layer,
        }
    }
}

/// Phong coefficients.
#[derive(Clone, Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub(in crate::import::native) struct PhongTable {
    /// The diffuse colour; default light grey.
    #[schemars(with = "ColorOrTexture")]
    pub diffuse: Spanned<ColorOrTexture>,
    /// The colour of highlights; default none.
    #[schemars(with = "ColorOrTexture")]
    pub specular: Spanned<ColorOrTexture>,
    /// The exponent of highlights; higher values make them smaller; default 32.
    pub shininess: NonNegative,
    /// Factor on ambient light; default: the diffuse colour.
    #[schemars(with = "Option<ColorOrTexture>")]
    pub ambient: Option<Spanned<ColorOrTexture>>,
}

impl Default for PhongTable {
    fn default() -> Self {
        Self {
            diffuse: plain(Vec3::splat(0.8)),
            specular: plain(Vec3::ZERO),
            shininess: NonNegative(32.0),
            ambient: None,
        }
    }
}

/// The name of a material, or a material.
#[derive(Debug, JsonSchema)]
#[schemars(untagged)]
pub(in crate::import::native) enum MaterialRef {
    Name(String),
    Inline(Box<MaterialTable>),
}

impl<'de> Deserialize<'de> for MaterialRef {
    // By hand: serde's untagged enums lose the position of an error.
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct NameOrTable;
        impl<'de> Visitor<'de> for NameOrTable {
            type Value = MaterialRef;
            fn expecting(&self, f: &mut fmt::Formatter) -> fmt::Result {
                f.write_str("the name of a material, or a table")
            }
            fn visit_str<E: de::Error>(self, name: &str) -> Result<MaterialRef, E> {
                Ok(MaterialRef::Name(name.to_owned()))
            }
            fn visit_map<A: MapAccess<'de>>(self, map: A) -> Result<MaterialRef, A::Error> {
                let table = de::value::MapAccessDeserializer::new(map);
                MaterialTable::deserialize(table).map(|table| MaterialRef::Inline(Box::new(table)))
            }
        }
        deserializer.deserialize_any(NameOrTable)
    }
}
