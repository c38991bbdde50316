//! Objects in a native scene: surfaces and their transforms.

use super::groups::RepeatTable;
use super::materials::MaterialRef;
use super::meshes::MeshOrName;
use super::nodes::TransformTable;
use crate::import::native::values::{Direction, Length, Positive, Vector, elements};
use glam::DVec3;
use schemars::JsonSchema;
use serde::Deserialize;
use serde::de::Deserializer;
use toml::Spanned;

/// A surface or a group of objects: exactly one of sphere, ellipsoid, plane, disc, rectangle, box,
/// cylinder, cone, torus, triangle, mesh and group.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(in crate::import::native) struct ObjectTable {
    /// A unique name, for animations, cameras and lights.
    #[schemars(with = "Option<String>")]
    pub name: Option<Spanned<String>>,
    /// A sphere.
    pub sphere: Option<SphereTable>,
    /// An ellipsoid.
    pub ellipsoid: Option<Box<EllipsoidTable>>,
    /// An infinite plane.
    pub plane: Option<PlaneTable>,
    /// A disc, or a ring.
    pub disc: Option<Box<DiscTable>>,
    /// A rectangle or parallelogram.
    pub rectangle: Option<Box<RectangleTable>>,
    /// A box aligned with the axes, before its transform.
    #[serde(rename = "box")]
    pub cuboid: Option<Box<BoxTable>>,
    /// A cylinder.
    pub cylinder: Option<Box<CylinderTable>>,
    /// A cone, or a frustum (a truncated cone).
    pub cone: Option<Box<ConeTable>>,
    /// A torus.
    pub torus: Option<Box<TorusTable>>,
    /// A triangle.
    pub triangle: Option<Box<TriangleTable>>,
    /// The triangles of an OBJ or PLY file, or the name of a mesh under [meshes].
    #[schemars(with = "Option<MeshOrName>")]
    pub mesh: Option<Spanned<MeshOrName>>,
    /// The name of a group under [groups], whose objects are placed.
    #[schemars(with = "Option<String>")]
    pub group: Option<Spanned<String>>,
    /// A material or the name of one; not for groups. Default light grey, or the materials of the mesh
    /// file.
    #[schemars(with = "Option<MaterialRef>")]
    pub material: Option<Spanned<MaterialRef>>,
    /// Its transform.
    #[schemars(with = "Option<TransformTable>")]
    pub transform: Option<Spanned<TransformTable>>,
    /// The name of the parent node under [[nodes]]. Not for members of groups, which are attached to
    /// their group.
    #[schemars(with = "Option<String>")]
    pub carried_by: Option<Spanned<String>>,
    /// Copies of it; each is first transformed by `transform`.
    #[schemars(with = "Option<RepeatTable>")]
    pub repeat: Option<Spanned<RepeatTable>>,
    /// Whether it is visible; default true. The state at rest if it is animated.
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

/// An ellipsoid aligned with the axes, before its transform.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub(in crate::import::native) struct EllipsoidTable {
    /// Its centre; default the origin.
    pub center: Vector,
    /// Its radii along x, y and z, each greater than 0; default 1.
    #[serde(deserialize_with = "three_radii")]
    pub radii: [Positive; 3],
}

impl Default for EllipsoidTable {
    fn default() -> Self {
        Self {
            center: Vector(DVec3::ZERO),
            radii: [Positive(1.0); 3],
        }
    }
}

/// An infinite plane.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(in crate::import::native) struct PlaneTable {
    /// Any point on it.
    pub point: Vector,
    /// The direction that it faces; default [0, 1, 0].
    #[serde(default = "upwards")]
    pub normal: Direction,
}

/// A disc, or a ring if it has a hole.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(in crate::import::native) struct DiscTable {
    /// Its centre.
    pub center: Vector,
    /// The direction that it faces; default [0, 1, 0].
    #[serde(default = "upwards")]
    pub normal: Direction,
    /// Its radius, greater than 0.
    pub radius: Positive,
    /// The radius of its hole, less than `radius`; default no hole.
    #[schemars(with = "Option<Length>")]
    pub inner_radius: Option<Spanned<Length>>,
}

/// A rectangle: either two edges, or a size and a normal.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(in crate::import::native) struct RectangleTable {
    /// Its centre.
    #[schemars(with = "Vector")]
    pub center: Spanned<Vector>,
    /// One whole edge, along which u grows; together with `edge_v`.
    #[schemars(with = "Option<Direction>")]
    pub edge_u: Option<Spanned<Vector>>,
    /// The other whole edge, along which v grows. On the front side, the turn from `edge_u` to `edge_v`
    /// is counter-clockwise. Edges that are not perpendicular make a parallelogram.
    #[schemars(with = "Option<Direction>")]
    pub edge_v: Option<Spanned<Vector>>,
    /// Width and height, each greater than 0, instead of the edges. Seen from the front with +y upwards,
    /// the width is level; for a rather flat rectangle it is along x.
    #[serde(default, deserialize_with = "maybe_two")]
    pub size: Option<[Positive; 2]>,
    /// The direction that it faces, together with `size`; default [0, 1, 0].
    #[schemars(with = "Option<Direction>")]
    pub normal: Option<Spanned<Direction>>,
}

/// A box aligned with the axes, before its transform.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(in crate::import::native) struct BoxTable {
    /// The minimum corner.
    pub min: Vector,
    /// The maximum corner; each coordinate is greater than that of `min`.
    #[schemars(with = "Vector")]
    pub max: Spanned<Vector>,
}

/// A cylinder.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(in crate::import::native) struct CylinderTable {
    /// The centre of one end.
    pub from: Vector,
    /// The centre of the other end.
    #[schemars(with = "Vector")]
    pub to: Spanned<Vector>,
    /// Its radius, greater than 0.
    pub radius: Positive,
    /// Whether it has no caps; default false.
    #[serde(default)]
    pub open: bool,
}

/// A cone or frustum.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(in crate::import::native) struct ConeTable {
    /// The centre of one end.
    pub from: Vector,
    /// The centre of the other end: the tip, unless `to_radius` is given.
    #[schemars(with = "Vector")]
    pub to: Spanned<Vector>,
    /// The radius at `from`, 0 or more.
    #[schemars(with = "Length")]
    pub from_radius: Spanned<Length>,
    /// The radius at `to`, 0 or more; default 0. At least one of the two radii is greater than 0.
    #[serde(default = "tip")]
    pub to_radius: Length,
    /// Whether it has no caps; default false.
    #[serde(default)]
    pub open: bool,
}

/// A torus.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(in crate::import::native) struct TorusTable {
    /// Its centre.
    pub center: Vector,
    /// Its axis of rotation; default [0, 1, 0].
    #[serde(default = "upwards")]
    pub axis: Direction,
    /// From the centre to the centre of the tube, greater than 0.
    pub major_radius: Positive,
    /// The radius of the tube, greater than 0 and at most `major_radius`.
    #[schemars(with = "Positive")]
    pub minor_radius: Spanned<Positive>,
}

/// A triangle.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(in crate::import::native) struct TriangleTable {
    /// Its three corners.
    #[serde(deserialize_with = "three")]
    pub vertices: [Vector; 3],
    /// The normals at its corners, for smooth shading; default flat.
    #[serde(default, deserialize_with = "maybe_three")]
    pub normals: Option<[Direction; 3]>,
    /// Names of the materials at its corners, interpolated across the triangle, instead of `material`.
    #[serde(default, deserialize_with = "maybe_three")]
    #[schemars(with = "Option<[String; 3]>")]
    pub materials: Option<[Spanned<String>; 3]>,
}

// Serde's own arrays ignore surplus elements.
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

fn three_radii<'de, D: Deserializer<'de>>(from: D) -> Result<[Positive; 3], D::Error> {
    elements(from, "three radii [x, y, z]")
}

fn maybe_two<'de, D: Deserializer<'de>>(from: D) -> Result<Option<[Positive; 2]>, D::Error> {
    elements(from, "two numbers [width, height]").map(Some)
}

fn tip() -> Length {
    Length(0.0)
}

fn upwards() -> Direction {
    Direction(DVec3::Y)
}

fn yes() -> bool {
    true
}
