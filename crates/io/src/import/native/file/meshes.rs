//! Meshes in a native scene.

use super::Spanned;
use crate::import::native::values::either;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// The mesh in a file.
#[derive(Clone, Debug, Deserialize, Serialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct MeshTable {
    /// The path of an OBJ or PLY file in the scene's folder or below.
    pub file: Spanned<String>,
    /// Names of the materials that the property `material` of a PLY file's vertices refers to, counted
    /// from 0. Without that property, the first applies to the whole mesh.
    pub materials: Option<Vec<Spanned<String>>>,
}

either! {
    /// The name of a mesh under [meshes], or a mesh.
    MeshOrName { Name(String), Table(MeshTable) },
    "the name of a mesh, or a table with its `file`",
    str: Name, map: Table
}
