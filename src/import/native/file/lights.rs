//! How a native scene describes lights.

use crate::import::native::values::{
    AttenuationName, AxisAngle, AxisRadians, Color, Count, Direction, Extent, NonNegative,
    Positive, Vector,
};
use glam::Vec3;
use schemars::JsonSchema;
use serde::Deserialize;
use toml::Spanned;

/// One light: exactly one of the kinds.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(in crate::import::native) struct LightTable {
    /// The name by which animations find it. No other light has it.
    #[schemars(with = "Option<String>")]
    pub name: Option<Spanned<String>>,
    /// The name of an object that carries it: its place and direction are then as seen from that
    /// object.
    #[schemars(with = "Option<String>")]
    pub carried_by: Option<Spanned<String>>,
    /// Shines from a point to all sides.
    pub point: Option<PointTable>,
    /// Shines along one direction everywhere, like the sun.
    pub directional: Option<DirectionalTable>,
    /// Shines from a point into a cone.
    #[schemars(with = "Option<SpotTable>")]
    pub spot: Option<Spanned<SpotTable>>,
    /// Shines from a rectangle or parallelogram, on one side.
    pub rectangle: Option<RectangleLightTable>,
    /// Shines from a disc, on one side.
    pub disc: Option<DiscLightTable>,
    /// Shines from a sphere to all sides.
    pub sphere: Option<SphereLightTable>,
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
    /// What its axis goes through. Either this or `direction`.
    #[schemars(with = "Option<Vector>")]
    pub look_at: Option<Spanned<Vector>>,
    /// Where its axis points.
    pub direction: Option<Direction>,
    /// Degrees off the axis up to which it has its full strength; 80 % of `outer_deg` if left out.
    #[schemars(with = "Option<AxisAngle>")]
    pub inner_deg: Option<Spanned<AxisAngle>>,
    /// Degrees off the axis from which on it is dark; 30 if left out.
    pub outer_deg: Option<AxisAngle>,
    /// The same as `inner_deg` in radians, in its place.
    #[schemars(with = "Option<AxisRadians>")]
    pub inner: Option<Spanned<AxisRadians>>,
    /// The same as `outer_deg` in radians, in its place.
    #[schemars(with = "Option<AxisRadians>")]
    pub outer: Option<Spanned<AxisRadians>>,
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

/// A light with the extent of a rectangle or parallelogram.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(in crate::import::native) struct RectangleLightTable {
    /// Its middle.
    pub center: Vector,
    /// From its middle to the middle of one side. It shines along edge_u × edge_v. Either both edges
    /// or `look_at` and `size`.
    #[schemars(with = "Option<Vector>")]
    pub edge_u: Option<Spanned<Vector>>,
    /// From its middle to the middle of the other side.
    pub edge_v: Option<Vector>,
    /// What it shines at. It then lies level.
    #[schemars(with = "Option<Vector>")]
    pub look_at: Option<Spanned<Vector>>,
    /// Its width and its height.
    pub size: Option<Extent>,
    /// Its colour; white if left out.
    #[serde(default = "white")]
    pub color: Color,
    /// What the colour is multiplied by to be what a point light at its middle would give, seen from
    /// far away along its normal; 1 if left out, unless there is `radiance`.
    pub intensity: Option<NonNegative>,
    /// What the colour is multiplied by to be the brightness of its surface.
    pub radiance: Option<NonNegative>,
    /// Shadow rays for each shaded point; 16 if left out. With many samples per pixel fewer will do.
    #[serde(default = "sixteen")]
    pub samples: Count,
    /// Whether the light itself is seen; it is if left out.
    #[serde(default = "yes")]
    pub visible: bool,
    /// How it fades with distance; inverse-square if left out, which lets it weaken with the angle
    /// off its normal too.
    #[serde(default)]
    pub attenuation: AttenuationName,
}

/// A light with the extent of a disc.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(in crate::import::native) struct DiscLightTable {
    /// Its middle.
    pub center: Vector,
    /// What it shines at. Either this or `normal`.
    #[schemars(with = "Option<Vector>")]
    pub look_at: Option<Spanned<Vector>>,
    /// The direction in which it shines.
    pub normal: Option<Direction>,
    /// Its radius.
    pub radius: Positive,
    /// Its colour; white if left out.
    #[serde(default = "white")]
    pub color: Color,
    /// What the colour is multiplied by to be what a point light at its middle would give, seen from
    /// far away along its normal; 1 if left out, unless there is `radiance`.
    pub intensity: Option<NonNegative>,
    /// What the colour is multiplied by to be the brightness of its surface.
    pub radiance: Option<NonNegative>,
    /// Shadow rays for each shaded point; 16 if left out. With many samples per pixel fewer will do.
    #[serde(default = "sixteen")]
    pub samples: Count,
    /// Whether the light itself is seen; it is if left out.
    #[serde(default = "yes")]
    pub visible: bool,
    /// How it fades with distance; inverse-square if left out, which lets it weaken with the angle
    /// off its normal too.
    #[serde(default)]
    pub attenuation: AttenuationName,
}

/// A light with the extent of a sphere.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(in crate::import::native) struct SphereLightTable {
    /// Its middle.
    pub center: Vector,
    /// Its radius.
    pub radius: Positive,
    /// Its colour; white if left out.
    #[serde(default = "white")]
    pub color: Color,
    /// What the colour is multiplied by to be what a point light at its middle would give, seen from
    /// far away along its normal; 1 if left out, unless there is `radiance`.
    pub intensity: Option<NonNegative>,
    /// What the colour is multiplied by to be the brightness of its surface.
    pub radiance: Option<NonNegative>,
    /// Shadow rays for each shaded point; 16 if left out. With many samples per pixel fewer will do.
    #[serde(default = "sixteen")]
    pub samples: Count,
    /// Whether the light itself is seen; it is if left out.
    #[serde(default = "yes")]
    pub visible: bool,
    /// How it fades with distance; inverse-square if left out, which lets it weaken with the angle
    /// off its normal too.
    #[serde(default)]
    pub attenuation: AttenuationName,
}

fn white() -> Color {
    Color(Vec3::ONE)
}

fn sixteen() -> Count {
    Count(16)
}

fn yes() -> bool {
    true
}

fn one() -> NonNegative {
    NonNegative(1.0)
}
