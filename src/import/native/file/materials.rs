//! How a native scene describes what surfaces look like.

use super::textures::{ColorOrTexture, plain};
use crate::import::native::values::{
    Absorption, Fraction, FresnelName, MixingName, NonNegative, Positive, Priority, RefractiveIndex,
};
use glam::Vec3;
use schemars::JsonSchema;
use serde::Deserialize;
use serde::de::{self, Deserializer, MapAccess, Visitor};
use std::fmt;
use toml::Spanned;

/// How a surface answers light.
#[derive(Clone, Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub(in crate::import::native) struct MaterialTable {
    /// Phong coefficients.
    pub phong: PhongTable,
    /// What it mirrors; nothing if left out.
    pub reflect: Option<ReflectTable>,
    /// What it lets through, refracted; nothing if left out.
    #[schemars(with = "Option<RefractTable>")]
    pub refract: Option<Spanned<RefractTable>>,
    /// What it mirrors and lets through said directly, for what neither `reflect` nor `refract` can
    /// say, in place of both.
    #[schemars(with = "Option<OpticsTable>")]
    pub optics: Option<Spanned<OpticsTable>>,
    /// The light that it gives off by itself; none if left out.
    #[schemars(with = "ColorOrTexture")]
    pub emission: Spanned<ColorOrTexture>,
    /// Whether both sides are lit alike (true if left out), or only the one the normal points to.
    pub two_sided: bool,
}

impl Default for MaterialTable {
    fn default() -> Self {
        Self {
            phong: PhongTable::default(),
            reflect: None,
            refract: None,
            optics: None,
            emission: plain(Vec3::ZERO),
            two_sided: true,
        }
    }
}

/// What a surface mirrors. Ambient and diffuse light are weakened by as much.
#[derive(Clone, Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub(in crate::import::native) struct ReflectTable {
    /// How much, 0 to 1; 1 if left out.
    pub amount: Fraction,
    /// What mirrored light is multiplied by; white if left out.
    #[schemars(with = "ColorOrTexture")]
    pub color: Spanned<ColorOrTexture>,
    /// How much of it at which angle: none (all at every angle, as metals do; if left out), or exact
    /// or schlick, as varnish does.
    pub fresnel: FresnelName,
    /// The index of refraction of the varnish where `fresnel` is not none; 1.5 if left out.
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

/// What a surface lets through, and mirrors as the boundary of a transparent body, whose inside is
/// where its normals point away from.
#[derive(Clone, Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub(in crate::import::native) struct RefractTable {
    /// How much goes in or is mirrored; the rest is ambient and diffuse light. 0 to 1; 1 if left out.
    pub amount: Fraction,
    /// The index of refraction inside; 1.5 if left out.
    pub ior: RefractiveIndex,
    /// What light is multiplied by that goes through the surface; white if left out.
    #[schemars(with = "ColorOrTexture")]
    pub color: Spanned<ColorOrTexture>,
    /// How much a unit length swallows, for each channel: exp(-absorption * length) is left. None if
    /// left out.
    pub absorption: Absorption,
    /// How much is mirrored at which angle: exact (Fresnel's equations; if left out), schlick, or none.
    pub fresnel: FresnelName,
    /// Where bodies overlap, the one of the highest priority counts, among equals the one entered
    /// last; 0 if left out.
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

/// What a surface mirrors and lets through, each by itself.
#[derive(Clone, Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub(in crate::import::native) struct OpticsTable {
    /// What mirrored light is multiplied by, with `fresnel` at grazing angles; black if left out.
    #[schemars(with = "ColorOrTexture")]
    pub reflect: Spanned<ColorOrTexture>,
    /// What light is multiplied by that goes through; black if left out.
    #[schemars(with = "ColorOrTexture")]
    pub transmit: Spanned<ColorOrTexture>,
    /// The share of ambient and diffuse light where `mixing` is layer, 0 to 1; 1 if left out.
    pub opacity: Fraction,
    /// The index of refraction inside, above 0; 1 if left out.
    pub ior: Positive,
    /// How much a unit length swallows, as in `refract`.
    pub absorption: Absorption,
    /// How much is mirrored at which angle: none (if left out), exact or schlick.
    pub fresnel: FresnelName,
    /// Which of bodies that overlap counts, as in `refract`.
    pub priority: Priority,
    /// How local, mirrored and transmitted light are put together: layer (if left out), sum or blend.
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
    /// The colour of the surface; light grey if left out.
    #[schemars(with = "ColorOrTexture")]
    pub diffuse: Spanned<ColorOrTexture>,
    /// The colour of highlights; none if left out.
    #[schemars(with = "ColorOrTexture")]
    pub specular: Spanned<ColorOrTexture>,
    /// The exponent of highlights: the higher, the smaller; 32 if left out.
    pub shininess: NonNegative,
    /// What the ambient light is multiplied by; the diffuse colour if left out.
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
    // By hand: serde's untagged enums lose the place of an error.
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
