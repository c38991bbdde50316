//! Objects in a native scene: surfaces and their transforms.

use super::Spanned;
use super::groups::RepeatTable;
use super::materials::MaterialRef;
use super::meshes::MeshOrName;
use super::nodes::TransformTable;
use crate::import::native::values::{Direction, Distance, Extent, Positive, Radii, Triple, Vector};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// A surface or a group of objects: exactly one of sphere, ellipsoid, plane, disc, rectangle, box,
/// cylinder, cone, torus, triangle, mesh and group.
#[derive(Debug, Default, Deserialize, Serialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct ObjectTable {
    /// A unique name. The window lists the object by it; animations, cameras and lights refer to it.
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
    pub mesh: Option<Spanned<MeshOrName>>,
    /// The name of a group under [groups], whose objects are placed.
    pub group: Option<Spanned<String>>,
    /// A material or the name of one; not for groups. Default light grey, or the materials of the mesh
    /// file.
    pub material: Option<Spanned<MaterialRef>>,
    /// Its transform.
    pub transform: Option<Spanned<TransformTable>>,
    /// The name of the parent node under [[nodes]]. Not for members of groups, which are attached to
    /// their group.
    pub carried_by: Option<Spanned<String>>,
    /// Copies of it; each is first transformed by `transform`.
    pub repeat: Option<Spanned<RepeatTable>>,
    /// Whether it is visible; default true. The state at rest if it is animated.
    pub visible: Option<bool>,
}

/// A sphere.
#[derive(Debug, Deserialize, Serialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct SphereTable {
    /// Its centre.
    pub center: Vector,
    /// Its radius, greater than 0.
    pub radius: Positive,
}

/// An ellipsoid aligned with the axes, before its transform.
#[derive(Debug, Default, Deserialize, Serialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct EllipsoidTable {
    /// Its centre; default the origin.
    pub center: Option<Vector>,
    /// Its radii along x, y and z, each greater than 0; default 1.
    pub radii: Option<Radii>,
}

/// An infinite plane.
#[derive(Debug, Deserialize, Serialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct PlaneTable {
    /// Any point on it.
    pub point: Vector,
    /// The direction that it faces; default [0, 1, 0].
    pub normal: Option<Direction>,
}

/// A disc, or a ring if it has a hole.
#[derive(Debug, Deserialize, Serialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct DiscTable {
    /// Its centre.
    pub center: Vector,
    /// The direction that it faces; default [0, 1, 0].
    pub normal: Option<Direction>,
    /// Its radius, greater than 0.
    pub radius: Positive,
    /// The radius of its hole, less than `radius`; default no hole.
    pub inner_radius: Option<Spanned<Distance>>,
}

/// A rectangle: either two edges, or a size and a normal.
#[derive(Debug, Deserialize, Serialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct RectangleTable {
    /// Its centre.
    pub center: Spanned<Vector>,
    /// One whole edge, along which u grows; together with `edge_v`.
    pub edge_u: Option<Spanned<Vector>>,
    /// The other whole edge, along which v grows. On the front side, the turn from `edge_u` to `edge_v`
    /// is counter-clockwise. Edges that are not perpendicular make a parallelogram.
    pub edge_v: Option<Spanned<Vector>>,
    /// Width and height, each greater than 0, instead of the edges. Seen from the front with +y upwards,
    /// the width is level; for a rather flat rectangle it is along x.
    pub size: Option<Extent>,
    /// The direction that it faces, together with `size`; default [0, 1, 0].
    pub normal: Option<Spanned<Direction>>,
}

/// A box aligned with the axes, before its transform.
#[derive(Debug, Deserialize, Serialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct BoxTable {
    /// The minimum corner.
    pub min: Vector,
    /// The maximum corner; each coordinate is greater than that of `min`.
    pub max: Spanned<Vector>,
}

/// A cylinder.
#[derive(Debug, Deserialize, Serialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct CylinderTable {
    /// The centre of one end.
    pub from: Vector,
    /// The centre of the other end.
    pub to: Spanned<Vector>,
    /// Its radius, greater than 0.
    pub radius: Positive,
    /// Whether it has no caps; default false.
    pub open: Option<bool>,
}

/// A cone or frustum.
#[derive(Debug, Deserialize, Serialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct ConeTable {
    /// The centre of one end.
    pub from: Vector,
    /// The centre of the other end: the tip, unless `to_radius` is given.
    pub to: Spanned<Vector>,
    /// The radius at `from`, 0 or more.
    pub from_radius: Spanned<Distance>,
    /// The radius at `to`, 0 or more; default 0. At least one of the two radii is greater than 0.
    pub to_radius: Option<Distance>,
    /// Whether it has no caps; default false.
    pub open: Option<bool>,
}

/// A torus.
#[derive(Debug, Deserialize, Serialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct TorusTable {
    /// Its centre.
    pub center: Vector,
    /// Its axis of rotation; default [0, 1, 0].
    pub axis: Option<Direction>,
    /// From the centre to the centre of the tube, greater than 0.
    pub major_radius: Positive,
    /// The radius of the tube, greater than 0 and at most `major_radius`.
    pub minor_radius: Spanned<Positive>,
}

/// A triangle.
#[derive(Debug, Deserialize, Serialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct TriangleTable {
    /// Its three corners.
    pub vertices: Triple<Vector>,
    /// The normals at its corners, for smooth shading; default flat.
    pub normals: Option<Triple<Direction>>,
    /// Names of the materials at its corners, interpolated across the triangle, instead of `material`.
    pub materials: Option<Triple<Spanned<String>>>,
}
