//! Meshes in a native scene.

use schemars::JsonSchema;
use serde::Deserialize;
use serde::de::{self, Deserializer, MapAccess, Visitor};
use std::fmt;
use toml::Spanned;

/// The mesh in a file.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(in crate::import::native) struct MeshTable {
    /// The path of an OBJ or PLY file in the scene's folder or below.
    #[schemars(with = "String")]
    pub file: Spanned<String>,
    /// Names of the materials that the property `material` of a PLY file's vertices refers to, counted
    /// from 0. Without that property, the first applies to the whole mesh.
    #[schemars(with = "Option<Vec<String>>")]
    pub materials: Option<Vec<Spanned<String>>>,
}

/// The name of a mesh under [meshes], or a mesh.
#[derive(Debug, JsonSchema)]
#[schemars(untagged)]
pub(in crate::import::native) enum MeshOrName {
    Name(String),
    Table(MeshTable),
}

impl<'de> Deserialize<'de> for MeshOrName {
    // By hand: serde's untagged enums lose the position of an error.
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct NameOrTable;
        impl<'de> Visitor<'de> for NameOrTable {
            type Value = MeshOrName;
            fn expecting(&self, f: &mut fmt::Formatter) -> fmt::Result {
                f.write_str("the name of a mesh, or a table with its `file`")
            }
            fn visit_str<E: de::Error>(self, name: &str) -> Result<MeshOrName, E> {
                Ok(MeshOrName::Name(name.to_owned()))
            }
            fn visit_map<A: MapAccess<'de>>(self, map: A) -> Result<MeshOrName, A::Error> {
                let table = de::value::MapAccessDeserializer::new(map);
                MeshTable::deserialize(table).map(MeshOrName::Table)
            }
        }
        deserializer.deserialize_any(NameOrTable)
    }
}
