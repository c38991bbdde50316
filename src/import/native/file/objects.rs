//! How a native scene describes surfaces and where they are.

use super::materials::MaterialRef;
use crate::import::native::values::{Direction, Positive, Scale, Vector, elements};
use glam::DVec3;
use schemars::JsonSchema;
use serde::Deserialize;
use serde::de::Deserializer;
use toml::Spanned;

/// One surface: exactly one of sphere, plane, triangle and mesh.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(in crate::import::native) struct ObjectTable {
    /// A sphere.
    pub sphere: Option<SphereTable>,
    /// An infinite plane.
    pub plane: Option<PlaneTable>,
    /// A triangle.
    pub triangle: Option<Box<TriangleTable>>,
    /// The triangles of an OBJ file.
    pub mesh: Option<MeshTable>,
    /// The name of a material, or a material. Light grey if left out, or what the mesh file says.
    #[schemars(with = "Option<MaterialRef>")]
    pub material: Option<Spanned<MaterialRef>>,
    /// Where to put it.
    #[schemars(with = "Option<TransformTable>")]
    pub transform: Option<Spanned<TransformTable>>,
    /// Whether it is in the scene at all (true if left out).
    #[serde(default = "yes")]
    pub visible: bool,
}

/// A sphere.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(in crate::import::native) struct SphereTable {
    /// Its centre.
    pub center: Vector,
    /// Its radius, greater than 0.
    pub radius: Positive,
}

/// An infinite plane.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(in crate::import::native) struct PlaneTable {
    /// Any point on it.
    pub point: Vector,
    /// The direction it faces; [0, 1, 0] if left out.
    #[serde(default = "upwards")]
    pub normal: Direction,
}

/// A triangle.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(in crate::import::native) struct TriangleTable {
    /// Its three corners.
    #[serde(deserialize_with = "three")]
    pub vertices: [Vector; 3],
    /// The normals at its corners, for smooth shading; flat if left out.
    #[serde(default, deserialize_with = "maybe_three")]
    pub normals: Option<[Direction; 3]>,
    /// Names of the materials at its corners, which blend in between, in place of `material`.
    #[serde(default, deserialize_with = "maybe_three")]
    #[schemars(with = "Option<[String; 3]>")]
    pub materials: Option<[Spanned<String>; 3]>,
}

/// The triangles of a file.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(in crate::import::native) struct MeshTable {
    /// The path of an OBJ file, from the scene's folder downwards.
    #[schemars(with = "String")]
    pub file: Spanned<String>,
}

/// Scaled first, then rotated, then moved.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub(in crate::import::native) struct TransformTable {
    /// How far to move it.
    pub translate: Vector,
    /// Degrees to turn it round the x, then the y, then the z axis of the world,
    /// counter-clockwise when the axis points at you.
    pub rotate_deg: Vector,
    /// A factor for all axes, or one for each; not 0, negative ones mirror.
    pub scale: Scale,
}

impl Default for TransformTable {
    fn default() -> Self {
        Self {
            translate: Vector(DVec3::ZERO),
            rotate_deg: Vector(DVec3::ZERO),
            scale: Scale(DVec3::ONE),
        }
    }
}

// Serde's own arrays ignore elements beyond the last.
fn three<'de, T: Deserialize<'de>, D: Deserializer<'de>>(from: D) -> Result<[T; 3], D::Error> {
    elements(from, "three elements, one for each corner")
}

fn maybe_three<'de, T, D>(from: D) -> Result<Option<[T; 3]>, D::Error>
where
    T: Deserialize<'de>,
    D: Deserializer<'de>,
{
    three(from).map(Some)
}

fn upwards() -> Direction {
    Direction(DVec3::Y)
}

fn yes() -> bool {
    true
}
