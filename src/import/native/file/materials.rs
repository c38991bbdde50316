//! How a native scene describes what surfaces look like.

use super::textures::{ColorOrTexture, plain};
use crate::import::native::values::NonNegative;
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
    /// Whether both sides are lit alike (true if left out), or only the one the normal points to.
    pub two_sided: bool,
}

impl Default for MaterialTable {
    fn default() -> Self {
        Self {
            phong: PhongTable::default(),
            two_sided: true,
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
    Inline(MaterialTable),
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
                MaterialTable::deserialize(table).map(MaterialRef::Inline)
            }
        }
        deserializer.deserialize_any(NameOrTable)
    }
}
