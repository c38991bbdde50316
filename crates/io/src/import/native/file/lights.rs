//! Lights in a native scene.

use super::Spanned;
use crate::import::native::values::{
    AttenuationName, AxisAngle, AxisRadians, Color, ConeAngle, ConeRadians, Count, Direction,
    Extent, NonNegative, Positive, Vector,
};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// The shadow rays per shaded point of an area light that gives none.
pub(crate) const LIGHT_SAMPLES: u32 = 16;

/// A light of exactly one kind.
#[derive(Debug, Default, Deserialize, Serialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct LightTable {
    /// A unique name. The window lists the light by it; animations refer to it.
    pub name: Option<Spanned<String>>,
    /// The name of an object or node that the light is attached to: its position and direction are then
    /// in that object's space.
    pub carried_by: Option<Spanned<String>>,
    /// Shines in all directions from a point.
    pub point: Option<PointTable>,
    /// Shines in one direction everywhere, like the sun.
    pub directional: Option<DirectionalTable>,
    /// Shines from a point into a cone.
    pub spot: Option<Spanned<SpotTable>>,
    /// Shines from one side of a rectangle or parallelogram.
    pub rectangle: Option<RectangleLightTable>,
    /// Shines from one side of a disc.
    pub disc: Option<DiscLightTable>,
    /// Shines in all directions from a sphere.
    pub sphere: Option<SphereLightTable>,
}

/// A point light.
#[derive(Debug, Deserialize, Serialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct PointTable {
    /// The position of the light.
    pub position: Vector,
    /// The colour of the light; default white.
    pub color: Option<Color>,
    /// Factor on the colour; default 1.
    pub intensity: Option<NonNegative>,
    /// How it fades with distance; default inverse-square.
    pub attenuation: Option<AttenuationName>,
}

/// A directional light.
#[derive(Debug, Deserialize, Serialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct DirectionalTable {
    /// The direction in which the light travels.
    pub direction: Direction,
    /// The colour of the light; default white.
    pub color: Option<Color>,
    /// Factor on the colour; default 1.
    pub intensity: Option<NonNegative>,
}

/// A spot light.
#[derive(Debug, Deserialize, Serialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct SpotTable {
    /// The position of the light.
    pub position: Vector,
    /// A point on its axis. Either this or `direction`.
    pub look_at: Option<Spanned<Vector>>,
    /// The direction of its axis.
    pub direction: Option<Direction>,
    /// Angle from the axis in degrees up to which it has its full intensity; default 80 % of `outer_deg`.
    pub inner_deg: Option<Spanned<AxisAngle>>,
    /// Angle from the axis in degrees beyond which it is dark; default 30.
    pub outer_deg: Option<ConeAngle>,
    /// Angle in radians, instead of `inner_deg`.
    pub inner: Option<Spanned<AxisRadians>>,
    /// Angle in radians, instead of `outer_deg`.
    pub outer: Option<Spanned<ConeRadians>>,
    /// The colour of the light; default white.
    pub color: Option<Color>,
    /// Factor on the colour; default 1.
    pub intensity: Option<NonNegative>,
    /// How it fades with distance; default inverse-square.
    pub attenuation: Option<AttenuationName>,
}

/// Defines the table of an area light from its docs and its own keys.
macro_rules! area_light {
    ($(#[$doc:meta])* $name:ident { $($own:tt)* }) => {
        $(#[$doc])*
        #[derive(Debug, Deserialize, Serialize, JsonSchema)]
        #[serde(deny_unknown_fields)]
        pub(crate) struct $name {
            $($own)*
            /// The colour of the light; default white.
            pub color: Option<Color>,
            /// Factor on the colour, as for a point light at its centre seen from far away, along the normal if it has one;
            /// default 1, unless `radiance` is given.
            pub intensity: Option<NonNegative>,
            /// Factor on the colour that gives the radiance of its surface.
            pub radiance: Option<NonNegative>,
            /// Shadow rays per shaded point; default 16. Fewer suffice with many samples per pixel.
            pub samples: Option<Count>,
            /// Whether the light itself is visible; default true.
            pub visible: Option<bool>,
            /// How it fades with distance; default inverse-square, which also weakens it with the angle to its normal.
            pub attenuation: Option<AttenuationName>,
        }
    };
}

area_light! {
    /// An area light: a rectangle or parallelogram.
    RectangleLightTable {
        /// The centre of the light.
        pub center: Vector,
        /// From its centre to the middle of one edge. It shines along edge_u × edge_v. Either both edges or
        /// `look_at` and `size`.
        pub edge_u: Option<Spanned<Vector>>,
        /// From its centre to the middle of the other edge.
        pub edge_v: Option<Vector>,
        /// The point that it faces. It is then level.
        pub look_at: Option<Spanned<Vector>>,
        /// Width and height of the rectangle.
        pub size: Option<Extent>,
    }
}

area_light! {
    /// An area light: a disc.
    DiscLightTable {
        /// The centre of the light.
        pub center: Vector,
        /// The point that it faces. Either this or `normal`.
        pub look_at: Option<Spanned<Vector>>,
        /// The direction in which it shines.
        pub normal: Option<Direction>,
        /// The radius of the light.
        pub radius: Positive,
    }
}

area_light! {
    /// An area light: a sphere.
    SphereLightTable {
        /// The centre of the light.
        pub center: Vector,
        /// The radius of the light.
        pub radius: Positive,
    }
}
