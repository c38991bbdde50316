//! How a native scene describes surfaces and where they are.

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

/// One surface, or a group of objects: exactly one of sphere, ellipsoid, plane, disc, rectangle, box,
/// cylinder, cone, torus, triangle, mesh and group.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(in crate::import::native) struct ObjectTable {
    /// The name by which animations, cameras and lights find it. No other object has it.
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
    /// A box along the axes, before its transform.
    #[serde(rename = "box")]
    pub cuboid: Option<Box<BoxTable>>,
    /// A cylinder.
    pub cylinder: Option<Box<CylinderTable>>,
    /// A cone, or a frustum, which is a cone whose tip is cut off.
    pub cone: Option<Box<ConeTable>>,
    /// A torus.
    pub torus: Option<Box<TorusTable>>,
    /// A triangle.
    pub triangle: Option<Box<TriangleTable>>,
    /// The triangles of an OBJ or PLY file, or the name of a mesh under [meshes].
    #[schemars(with = "Option<MeshOrName>")]
    pub mesh: Option<Spanned<MeshOrName>>,
    /// The name of a group under [groups], whose objects it places.
    #[schemars(with = "Option<String>")]
    pub group: Option<Spanned<String>>,
    /// The name of a material, or a material; not for groups. Light grey if left out, or what the mesh file says.
    #[schemars(with = "Option<MaterialRef>")]
    pub material: Option<Spanned<MaterialRef>>,
    /// Where to put it.
    #[schemars(with = "Option<TransformTable>")]
    pub transform: Option<Spanned<TransformTable>>,
    /// The name of a node under [[nodes]] that carries it: it is placed as seen from there. Not for
    /// members of groups, which their group carries.
    #[schemars(with = "Option<String>")]
    pub carried_by: Option<Spanned<String>>,
    /// Copies of it, placed by `transform` each.
    #[schemars(with = "Option<RepeatTable>")]
    pub repeat: Option<Spanned<RepeatTable>>,
    /// Whether it is in the scene at all (true if left out), at first if that is animated.
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

/// An ellipsoid along the axes, before its transform.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub(in crate::import::native) struct EllipsoidTable {
    /// Its centre; the origin if left out.
    pub center: Vector,
    /// How far it reaches along x, y and z, each greater than 0; 1 if left out.
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
    /// The direction it faces; [0, 1, 0] if left out.
    #[serde(default = "upwards")]
    pub normal: Direction,
}

/// A disc, or a ring if it has a hole.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(in crate::import::native) struct DiscTable {
    /// Its centre.
    pub center: Vector,
    /// The direction it faces; [0, 1, 0] if left out.
    #[serde(default = "upwards")]
    pub normal: Direction,
    /// Its radius, greater than 0.
    pub radius: Positive,
    /// The radius of its hole, less than `radius`; no hole if left out.
    #[schemars(with = "Option<Length>")]
    pub inner_radius: Option<Spanned<Length>>,
}

/// A rectangle: either two edges, or a size and where it faces.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(in crate::import::native) struct RectangleTable {
    /// Its centre.
    #[schemars(with = "Vector")]
    pub center: Spanned<Vector>,
    /// One whole edge, along which u grows; to be given together with `edge_v`.
    #[schemars(with = "Option<Direction>")]
    pub edge_u: Option<Spanned<Vector>>,
    /// The other whole edge, along which v grows. The front is where the turn from `edge_u` to
    /// `edge_v` is counter-clockwise. Edges that are not perpendicular make a parallelogram.
    #[schemars(with = "Option<Direction>")]
    pub edge_v: Option<Spanned<Vector>>,
    /// Width and height, each greater than 0, in place of the edges. Seen from the front, with +y
    /// upwards, the width is level; where it lies rather flat, the width is along x.
    #[serde(default, deserialize_with = "maybe_two")]
    pub size: Option<[Positive; 2]>,
    /// The direction it faces, together with `size`; [0, 1, 0] if left out.
    #[schemars(with = "Option<Direction>")]
    pub normal: Option<Spanned<Direction>>,
}

/// A box along the axes, before its transform.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(in crate::import::native) struct BoxTable {
    /// The corner with the least coordinates.
    pub min: Vector,
    /// The corner with the greatest coordinates, each greater than that of `min`.
    #[schemars(with = "Vector")]
    pub max: Spanned<Vector>,
}

/// A cylinder.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(in crate::import::native) struct CylinderTable {
    /// The middle of one end.
    pub from: Vector,
    /// The middle of the other end.
    #[schemars(with = "Vector")]
    pub to: Spanned<Vector>,
    /// Its radius, greater than 0.
    pub radius: Positive,
    /// Whether its ends are open (false if left out).
    #[serde(default)]
    pub open: bool,
}

/// A cone or frustum.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(in crate::import::native) struct ConeTable {
    /// The middle of one end.
    pub from: Vector,
    /// The middle of the other end: the tip, unless `to_radius` is given.
    #[schemars(with = "Vector")]
    pub to: Spanned<Vector>,
    /// The radius at `from`, 0 or more.
    #[schemars(with = "Length")]
    pub from_radius: Spanned<Length>,
    /// The radius at `to`, 0 or more; 0 if left out. One of the two radii is greater than 0.
    #[serde(default = "tip")]
    pub to_radius: Length,
    /// Whether its ends are open (false if left out).
    #[serde(default)]
    pub open: bool,
}

/// A torus.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(in crate::import::native) struct TorusTable {
    /// Its centre.
    pub center: Vector,
    /// The axis that it goes round; [0, 1, 0] if left out.
    #[serde(default = "upwards")]
    pub axis: Direction,
    /// From the centre to the middle of the tube, greater than 0.
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
    /// The normals at its corners, for smooth shading; flat if left out.
    #[serde(default, deserialize_with = "maybe_three")]
    pub normals: Option<[Direction; 3]>,
    /// Names of the materials at its corners, which blend in between, in place of `material`.
    #[serde(default, deserialize_with = "maybe_three")]
    #[schemars(with = "Option<[String; 3]>")]
    pub materials: Option<[Spanned<String>; 3]>,
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
