//! How a native scene repeats what it places.

use crate::import::native::values::{
    Copies, Direction, GridCount, NonNegative, Number, ScaleRange, Seed, Vector,
};
use glam::DVec3;
use schemars::JsonSchema;
use serde::Deserialize;
use toml::Spanned;

/// Copies of an object or group, by exactly one of grid, ring, scatter and points. Each is placed by
/// `transform` first, then brought to its place among the copies.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(in crate::import::native) struct RepeatTable {
    /// In rows, columns and layers.
    pub grid: Option<GridTable>,
    /// Round an axis.
    pub ring: Option<Box<RingTable>>,
    /// At random places in a box.
    pub scatter: Option<Box<ScatterTable>>,
    /// At the points of a file.
    pub points: Option<PointsTable>,
}

/// Copies at the points of a file, in their order.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(in crate::import::native) struct PointsTable {
    /// The path of a PLY file, from the scene's folder downwards: each of its vertices moves a copy by
    /// x, y and z. Where vertices have the nine properties xx, xy, xz, yx, yy, yz, zx, zy and zz, these
    /// are where the copy's own x axis (xx, xy, xz), y axis and z axis go.
    #[schemars(with = "String")]
    pub file: Spanned<String>,
}

/// Rows, columns and layers of copies.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(in crate::import::native) struct GridTable {
    /// How many along x, y and z, each 1 or more.
    pub count: GridCount,
    /// How far it is from one to the next along x, y and z.
    pub step: Vector,
    /// Whether the middle of the grid, instead of its first copy, is where the object would be (false
    /// if left out).
    #[serde(default)]
    pub centered: bool,
}

/// Copies round an axis through the origin.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(in crate::import::native) struct RingTable {
    /// How many, 1 or more.
    pub count: Copies,
    /// How far each is moved away from the axis; 0, which leaves that to `transform`, if left out.
    #[serde(default = "none")]
    pub radius: NonNegative,
    /// What they go round, counter-clockwise when it points at you; [0, 1, 0] if left out. The first
    /// one lies towards +x, or -y with an axis along x.
    #[serde(default = "upwards")]
    pub axis: Direction,
    /// Degrees by which the first one is moved on; 0 if left out.
    #[serde(default = "zero")]
    #[schemars(with = "f64")]
    pub start_deg: Number,
    /// Degrees from the first to the last; a whole turn in equal parts if left out.
    #[schemars(with = "Option<f64>")]
    pub arc_deg: Option<Number>,
    /// Whether they are turned with the ring, so that all show the same side to the axis (true if
    /// left out).
    #[serde(default = "yes")]
    pub turned: bool,
}

/// Copies at random places. The same seed gives the same places everywhere, and a greater count only
/// adds to them.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(in crate::import::native) struct ScatterTable {
    /// How many, 1 or more.
    pub count: Copies,
    /// A whole number that chooses among arrangements; 0 if left out.
    #[serde(default = "first")]
    pub seed: Seed,
    /// The corner with the least coordinates of the box that they are in.
    pub min: Vector,
    /// The corner with the greatest coordinates, none less than that of `min`.
    #[schemars(with = "Vector")]
    pub max: Spanned<Vector>,
    /// Degrees by which each is turned at most, either way, round the x, then the y, then the z axis;
    /// not at all if left out.
    #[serde(default = "unturned")]
    pub turn_deg: Vector,
    /// The least and the greatest factor by which each is scaled, above 0; 1 if left out.
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
