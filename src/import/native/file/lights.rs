//! How a native scene describes lights.

use crate::import::native::values::{
    AttenuationName, AxisAngle, Color, Direction, NonNegative, Vector,
};
use glam::Vec3;
use schemars::JsonSchema;
use serde::Deserialize;
use toml::Spanned;

/// One light: exactly one of point, directional and spot.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(in crate::import::native) struct LightTable {
    /// Shines from a point to all sides.
    pub point: Option<PointTable>,
    /// Shines along one direction everywhere, like the sun.
    pub directional: Option<DirectionalTable>,
    /// Shines from a point into a cone.
    pub spot: Option<SpotTable>,
}

/// A point light.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(in crate::import::native) struct PointTable {
    /// Where it is.
    pub position: Vector,
    /// Its colour; white if left out.
    #[serde(default = "white")]
    pub color: Color,
    /// What the colour is multiplied by; 1 if left out.
    #[serde(default = "one")]
    pub intensity: NonNegative,
    /// How it fades with distance; inverse-square if left out.
    #[serde(default)]
    pub attenuation: AttenuationName,
}

/// A light at infinity.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(in crate::import::native) struct DirectionalTable {
    /// Where its light goes.
    pub direction: Direction,
    /// Its colour; white if left out.
    #[serde(default = "white")]
    pub color: Color,
    /// What the colour is multiplied by; 1 if left out.
    #[serde(default = "one")]
    pub intensity: NonNegative,
}

/// A spot light.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(in crate::import::native) struct SpotTable {
    /// Where it is.
    pub position: Vector,
    /// What its axis goes through.
    #[schemars(with = "Vector")]
    pub look_at: Spanned<Vector>,
    /// Degrees off the axis up to which it has its full strength; 80 % of `outer_deg` if left out.
    #[schemars(with = "Option<AxisAngle>")]
    pub inner_deg: Option<Spanned<AxisAngle>>,
    /// Degrees off the axis from which on it is dark; 30 if left out.
    #[serde(default = "thirty")]
    pub outer_deg: AxisAngle,
    /// Its colour; white if left out.
    #[serde(default = "white")]
    pub color: Color,
    /// What the colour is multiplied by; 1 if left out.
    #[serde(default = "one")]
    pub intensity: NonNegative,
    /// How it fades with distance; inverse-square if left out.
    #[serde(default)]
    pub attenuation: AttenuationName,
}

fn white() -> Color {
    Color(Vec3::ONE)
}

fn one() -> NonNegative {
    NonNegative(1.0)
}

fn thirty() -> AxisAngle {
    AxisAngle(30.0)
}
