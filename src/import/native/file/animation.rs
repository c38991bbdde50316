//! How a native scene describes what changes over time.

use super::keys::Key;
use crate::import::native::values::Pace;
use crate::scene::{Beyond, Interpolation};
use schemars::JsonSchema;
use serde::Deserialize;
use toml::Spanned;

/// How one property of an object, camera, light or material changes over time, in place of the value
/// that its own table gives.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(in crate::import::native) struct AnimationTable {
    /// The name of an object, all of whose copies follow, or of a node. Exactly one of `object`,
    /// `objects`, `camera`, `light` and `material`.
    #[schemars(with = "Option<String>")]
    pub object: Option<Spanned<String>>,
    /// The names of several objects or nodes, in place of `object`.
    #[schemars(with = "Option<Vec<String>>")]
    pub objects: Option<Vec<Spanned<String>>>,
    /// The name of a camera.
    #[schemars(with = "Option<String>")]
    pub camera: Option<Spanned<String>>,
    /// The name of a light.
    #[schemars(with = "Option<String>")]
    pub light: Option<Spanned<String>>,
    /// The name of a material under [materials].
    #[schemars(with = "Option<String>")]
    pub material: Option<Spanned<String>>,
    /// What of it changes.
    #[schemars(with = "PropertyName")]
    pub property: Spanned<PropertyName>,
    /// How values between two keys come about; linear if left out, but step for what is true or false.
    #[schemars(with = "Option<InterpolationName>")]
    pub interpolation: Option<Spanned<InterpolationName>>,
    /// How the way from each key to the next is paced where the interpolation is linear; at constant
    /// speed if left out.
    #[schemars(with = "Option<Pace>")]
    pub easing: Option<Spanned<Pace>>,
    /// What holds before the first key and after the last one; hold if left out.
    #[serde(default)]
    pub beyond: BeyondName,
    /// Values at certain times, in the order of time.
    #[schemars(with = "Vec<Key>")]
    pub keys: Spanned<Vec<Key>>,
}

/// A property that changes.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub(in crate::import::native) enum PropertyName {
    /// Of an object, as in `transform`.
    Translate,
    /// Of an object: a quaternion [x, y, z, w], in place of `rotate_deg`.
    Rotation,
    /// Of an object, as in `transform`; may be more than a turn.
    RotateDeg,
    /// The same in radians.
    Angles,
    /// Of an object, as in `transform`.
    Scale,
    /// Of an object: true or false.
    Visible,
    /// Of a camera.
    LookFrom,
    /// Of a camera that does not look at an object.
    LookAt,
    /// Of a camera.
    Up,
    /// Of a camera.
    FovYDeg,
    /// The same in radians.
    FovY,
    /// Of an orthographic camera.
    Orthographic,
    /// Of a camera with a lens.
    FocusDistance,
    /// Of a camera with a lens: its `radius`.
    LensRadius,
    /// Of a light, unless it is directional: its `position` or `center`.
    Position,
    /// Of a directional or spot light where it shines, of a disc its normal.
    Direction,
    /// Of a light.
    Color,
    /// Of a light, in place of its `intensity` or `radiance`.
    Intensity,
    /// Of a light: true or false.
    On,
    /// Of a material.
    Diffuse,
    /// Of a material.
    Specular,
    /// Of a material.
    Shininess,
    /// Of a material; it follows `diffuse` if its table gives none.
    Ambient,
    /// Of a material.
    Emission,
    /// Of a material: the share of the light that it mirrors, `amount` times `color`.
    Reflect,
    /// Of a material: the share of the light that it lets through, `amount` times `color`.
    Transmit,
    /// Of a material: the share of ambient and diffuse light, which is 1 less `amount` of `refract`.
    Opacity,
    /// Of a material: the index of refraction.
    Ior,
    /// Of a material.
    Absorption,
}

/// How values between two keys come about.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub(in crate::import::native) enum InterpolationName {
    /// A key's value holds until the next.
    Step,
    /// The straight way; of rotations the shorter one, at constant speed.
    Linear,
    /// Smoothly through all keys (Catmull and Rom).
    Cubic,
    /// Smoothly, by the tangents of the keys.
    Hermite,
}

impl From<InterpolationName> for Interpolation {
    fn from(name: InterpolationName) -> Self {
        match name {
            InterpolationName::Step => Self::Step,
            InterpolationName::Linear => Self::Linear,
            InterpolationName::Cubic => Self::CatmullRom,
            InterpolationName::Hermite => Self::Hermite,
        }
    }
}

/// What holds before the first key and after the last one.
#[derive(Clone, Copy, Debug, Default, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub(in crate::import::native) enum BeyondName {
    /// The value of the nearest key.
    #[default]
    Hold,
    /// The same over and over.
    Repeat,
    /// There and back, over and over.
    PingPong,
}

impl From<BeyondName> for Beyond {
    fn from(name: BeyondName) -> Self {
        match name {
            BeyondName::Hold => Self::Hold,
            BeyondName::Repeat => Self::Repeat,
            BeyondName::PingPong => Self::PingPong,
        }
    }
}
