//! Lights in a native scene.

use crate::import::native::values::{
    AttenuationName, AxisAngle, AxisRadians, Color, ConeAngle, ConeRadians, Count, Direction,
    Extent, NonNegative, Positive, Vector,
};
use glam::Vec3;
use schemars::JsonSchema;
use serde::Deserialize;
use toml::Spanned;

/// A light of exactly one kind.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(in crate::import::native) struct LightTable {
    /// A unique name, for animations.
    #[schemars(with = "Option<String>")]
    pub name: Option<Spanned<String>>,
    /// The name of an object or node that the light is attached to: its position and direction are then
    /// in that object's space.
    #[schemars(with = "Option<String>")]
    pub carried_by: Option<Spanned<String>>,
    /// Shines in all directions from a point.
    pub point: Option<PointTable>,
    /// Shines in one direction everywhere, like the sun.
    pub directional: Option<DirectionalTable>,
    /// Shines from a point into a cone.
    #[schemars(with = "Option<SpotTable>")]
    pub spot: Option<Spanned<SpotTable>>,
    /// Shines from one side of a rectangle or parallelogram.
    pub rectangle: Option<RectangleLightTable>,
    /// Shines from one side of a disc.
    pub disc: Option<DiscLightTable>,
    /// Shines in all directions from a sphere.
    pub sphere: Option<SphereLightTable>,
}

/// A point light.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(in crate::import::native) struct PointTable {
    /// Its position.
    pub position: Vector,
    /// Its colour; default white.
    #[serde(default = "white")]
    pub color: Color,
    /// Factor on the colour; default 1.
    #[serde(default = "one")]
    pub intensity: NonNegative,
    /// How it fades with distance; default inverse-square.
    #[serde(default)]
    pub attenuation: AttenuationName,
}

/// A directional light.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(in crate::import::native) struct DirectionalTable {
    /// The direction in which the light travels.
    pub direction: Direction,
    /// Its colour; default white.
    #[serde(default = "white")]
    pub color: Color,
    /// Factor on the colour; default 1.
    #[serde(default = "one")]
    pub intensity: NonNegative,
}

/// A spot light.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(in crate::import::native) struct SpotTable {
    /// Its position.
    pub position: Vector,
    /// A point on its axis. Either this or `direction`.
    #[schemars(with = "Option<Vector>")]
    pub look_at: Option<Spanned<Vector>>,
    /// The direction of its axis.
    pub direction: Option<Direction>,
    /// Angle from the axis in degrees up to which it has its full intensity; default 80 % of `outer_deg`.
    #[schemars(with = "Option<AxisAngle>")]
    pub inner_deg: Option<Spanned<AxisAngle>>,
    /// Angle from the axis in degrees beyond which it is dark; default 30.
    pub outer_deg: Option<ConeAngle>,
    /// The same as `inner_deg` in radians, instead of it.
    #[schemars(with = "Option<AxisRadians>")]
    pub inner: Option<Spanned<AxisRadians>>,
    /// The same as `outer_deg` in radians, instead of it.
    #[schemars(with = "Option<ConeRadians>")]
    pub outer: Option<Spanned<ConeRadians>>,
    /// Its colour; default white.
    #[serde(default = "white")]
    pub color: Color,
    /// Factor on the colour; default 1.
    #[serde(default = "one")]
    pub intensity: NonNegative,
    /// How it fades with distance; default inverse-square.
    #[serde(default)]
    pub attenuation: AttenuationName,
}

/// An area light: a rectangle or parallelogram.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(in crate::import::native) struct RectangleLightTable {
    /// Its centre.
    pub center: Vector,
    /// From its centre to the middle of one edge. It shines along edge_u × edge_v. Either both edges or
    /// `look_at` and `size`.
    #[schemars(with = "Option<Vector>")]
    pub edge_u: Option<Spanned<Vector>>,
    /// From its centre to the middle of the other edge.
    pub edge_v: Option<Vector>,
    /// The point that it faces. It is then level.
    #[schemars(with = "Option<Vector>")]
    pub look_at: Option<Spanned<Vector>>,
    /// Its width and height.
    pub size: Option<Extent>,
    /// Its colour; default white.
    #[serde(default = "white")]
    pub color: Color,
    /// Factor on the colour, as for a point light at its centre seen from far away along the normal;
    /// default 1, unless `radiance` is given.
    pub intensity: Option<NonNegative>,
    /// Factor on the colour that gives the radiance of its surface.
    pub radiance: Option<NonNegative>,
    /// Shadow rays per shaded point; default 16. Fewer suffice with many samples per pixel.
    #[serde(default = "sixteen")]
    pub samples: Count,
    /// Whether the light itself is visible; default true.
    #[serde(default = "yes")]
    pub visible: bool,
    /// How it fades with distance; default inverse-square, which also weakens it with the angle to its
    /// normal.
    #[serde(default)]
    pub attenuation: AttenuationName,
}

/// An area light: a disc.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(in crate::import::native) struct DiscLightTable {
    /// Its centre.
    pub center: Vector,
    /// The point that it faces. Either this or `normal`.
    #[schemars(with = "Option<Vector>")]
    pub look_at: Option<Spanned<Vector>>,
    /// The direction in which it shines.
    pub normal: Option<Direction>,
    /// Its radius.
    pub radius: Positive,
    /// Its colour; default white.
    #[serde(default = "white")]
    pub color: Color,
    /// Factor on the colour, as for a point light at its centre seen from far away along the normal;
    /// default 1, unless `radiance` is given.
    pub intensity: Option<NonNegative>,
    /// Factor on the colour that gives the radiance of its surface.
    pub radiance: Option<NonNegative>,
    /// Shadow rays per shaded point; default 16. Fewer suffice with many samples per pixel.
    #[serde(default = "sixteen")]
    pub samples: Count,
    /// Whether the light itself is visible; default true.
    #[serde(default = "yes")]
    pub visible: bool,
    /// How it fades with distance; default inverse-square, which also weakens it with the angle to its
    /// normal.
    #[serde(default)]
    pub attenuation: AttenuationName,
}

/// An area light: a sphere.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(in crate::import::native) struct SphereLightTable {
    /// Its centre.
    pub center: Vector,
    /// Its radius.
    pub radius: Positive,
    /// Its colour; default white.
    #[serde(default = "white")]
    pub color: Color,
    /// Factor on the colour, as for a point light at its centre seen from far away; default 1, unless
    /// `radiance` is given.
    pub intensity: Option<NonNegative>,
    /// Factor on the colour that gives the radiance of its surface.
    pub radiance: Option<NonNegative>,
    /// Shadow rays per shaded point; default 16. Fewer suffice with many samples per pixel.
    #[serde(default = "sixteen")]
    pub samples: Count,
    /// Whether the light itself is visible; default true.
    #[serde(default = "yes")]
    pub visible: bool,
    /// How it fades with distance; default inverse-square, which also weakens it with the angle to its
    /// normal.
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
