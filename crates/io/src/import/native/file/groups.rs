//! Repetition in a native scene.

use crate::import::native::values::{
    Copies, Direction, GridCount, NonNegative, Number, ScaleRange, Seed, Vector,
};
use glam::DVec3;
use schemars::JsonSchema;
use serde::Deserialize;
use toml::Spanned;

/// Copies of an object or group, arranged by exactly one of grid, ring, scatter and points. Each copy is
/// first transformed by `transform`, then moved to its place.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(in crate::import::native) struct RepeatTable {
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
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(in crate::import::native) struct PointsTable {
    /// The path of a PLY file in the scene's folder or below: each vertex translates a copy by x, y and
    /// z. If the vertices have the nine properties xx, xy, xz, yx, yy, yz, zx, zy and zz, these are the
    /// images of the copy's x axis (xx, xy, xz), y axis and z axis.
    #[schemars(with = "String")]
    pub file: Spanned<String>,
}

/// Rows, columns and layers of copies.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(in crate::import::native) struct GridTable {
    /// Number of copies along x, y and z, each 1 or more.
    pub count: GridCount,
    /// Distance between neighbours along x, y and z.
    pub step: Vector,
    /// Whether the grid is centred on the object's position instead of starting there; default false.
    #[serde(default)]
    pub centered: bool,
}

/// Copies around an axis through the origin.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(in crate::import::native) struct RingTable {
    /// Number of copies, 1 or more.
    pub count: Copies,
    /// Distance of each copy from the axis; default 0, which leaves it to `transform`.
    #[serde(default = "none")]
    pub radius: NonNegative,
    /// The axis; the copies are arranged counter-clockwise when it points at you; default [0, 1, 0]. The
    /// first copy lies towards +x, or -y for an axis along x.
    #[serde(default = "upwards")]
    pub axis: Direction,
    /// Angle of the first copy in degrees; default 0.
    #[serde(default = "zero")]
    #[schemars(with = "f64")]
    pub start_deg: Number,
    /// Degrees from the first to the last copy; default: evenly around a full turn.
    #[schemars(with = "Option<f64>")]
    pub arc_deg: Option<Number>,
    /// Whether copies turn with the ring, so that all show the same side to the axis; default true.
    #[serde(default = "yes")]
    pub turned: bool,
}

/// Copies at random positions. The same seed gives the same positions on every machine, and a larger
/// count only adds copies.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(in crate::import::native) struct ScatterTable {
    /// Number of copies, 1 or more.
    pub count: Copies,
    /// The random seed, a whole number; default 0.
    #[serde(default = "first")]
    pub seed: Seed,
    /// The minimum corner of the box.
    pub min: Vector,
    /// The maximum corner of the box; no coordinate is less than that of `min`.
    #[schemars(with = "Vector")]
    pub max: Spanned<Vector>,
    /// Largest random rotation in degrees, in either direction, about the x, then the y, then the z axis;
    /// default none.
    #[serde(default = "unturned")]
    pub turn_deg: Vector,
    /// Smallest and largest random scale factor, above 0; default 1.
    #[serde(default = "unscaled")]
    pub scale: ScaleRange,
}

fn first() -> Seed {
    Seed(0)
}

fn unscaled() -> ScaleRange {
    ScaleRange([1.0, 1.0])
}

fn none() -> NonNegative {
    NonNegative(0.0)
}

fn zero() -> Number {
    Number(0.0)
}

fn unturned() -> Vector {
    Vector(DVec3::ZERO)
}

fn upwards() -> Direction {
    Direction(DVec3::Y)
}

fn yes() -> bool {
    true
}
