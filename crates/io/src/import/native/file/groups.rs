//! Repetition in a native scene.

use super::Spanned;
use crate::import::native::values::{
    Copies, Direction, GridCount, NonNegative, Number, ScaleRange, Seed, Vector,
};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Copies of an object or group, arranged by exactly one of grid, ring, scatter and points. Each copy is
/// first transformed by `transform`, then moved to its place.
#[derive(Debug, Default, Deserialize, Serialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct RepeatTable {
    /// In rows, columns and layers.
    pub grid: Option<GridTable>,
    /// Around an axis.
    pub ring: Option<Box<RingTable>>,
    /// At random positions in a box.
    pub scatter: Option<Box<ScatterTable>>,
    /// At the points of a file.
    pub points: Option<PointsTable>,
}

/// Copies at the points of a file, in the file's order.
#[derive(Debug, Deserialize, Serialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct PointsTable {
    /// The path of a PLY file in the scene's folder or below: each vertex translates a copy by x, y and
    /// z. If the vertices have the nine properties xx, xy, xz, yx, yy, yz, zx, zy and zz, these are the
    /// images of the copy's x axis (xx, xy, xz), y axis and z axis.
    pub file: Spanned<String>,
}

/// Rows, columns and layers of copies.
#[derive(Debug, Deserialize, Serialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct GridTable {
    /// Number of copies along x, y and z, each 1 or more.
    pub count: GridCount,
    /// Distance between neighbours along x, y and z.
    pub step: Vector,
    /// Whether the grid is centred on the object's position instead of starting there; default false.
    pub centered: Option<bool>,
}

/// Copies around an axis through the origin.
#[derive(Debug, Deserialize, Serialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct RingTable {
    /// Number of copies, 1 or more.
    pub count: Copies,
    /// Distance of each copy from the axis; default 0, which leaves it to `transform`.
    pub radius: Option<NonNegative>,
    /// The axis; the copies are arranged counter-clockwise when it points at you; default [0, 1, 0]. The
    /// first copy lies towards +x, or -y for an axis along x.
    pub axis: Option<Direction>,
    /// Angle of the first copy in degrees; default 0.
    pub start_deg: Option<Number>,
    /// Degrees from the first to the last copy; default: evenly around a full turn.
    pub arc_deg: Option<Number>,
    /// Whether copies turn with the ring, so that all show the same side to the axis; default true.
    pub turned: Option<bool>,
}

/// Copies at random positions. The same seed gives the same positions on every machine, and a larger
/// count only adds copies.
#[derive(Debug, Deserialize, Serialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct ScatterTable {
    /// Number of copies, 1 or more.
    pub count: Copies,
    /// The random seed, a whole number; default 0.
    pub seed: Option<Seed>,
    /// The minimum corner of the box.
    pub min: Vector,
    /// The maximum corner of the box; no coordinate is less than that of `min`.
    pub max: Spanned<Vector>,
    /// Largest random rotation in degrees, in either direction, about the x, then the y, then the z axis;
    /// default none.
    pub turn_deg: Option<Vector>,
    /// Smallest and largest random scale factor, above 0; default 1.
    pub scale: Option<ScaleRange>,
}
