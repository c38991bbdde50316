//! Animations in a native scene.

use super::Spanned;
use super::keys::Key;
use crate::import::native::values::{Pace, words};
use PropertyName as P;
use glimray_scene::{
    Beyond, CameraProperty, Interpolation, LightProperty, MaterialProperty, NodeProperty,
};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// An animated property of an object, camera, light or material. It overrides the value in the target's
/// own table.
#[derive(Debug, Deserialize, Serialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct AnimationTable {
    /// The name of an object, including all of its copies, or of a node. Exactly one of `object`,
    /// `objects`, `camera`, `light` and `material`.
    pub object: Option<Spanned<String>>,
    /// The names of several objects or nodes, instead of `object`.
    pub objects: Option<Vec<Spanned<String>>>,
    /// The name of a camera.
    pub camera: Option<Spanned<String>>,
    /// The name of a light.
    pub light: Option<Spanned<String>>,
    /// The name of a material under [materials].
    pub material: Option<Spanned<String>>,
    /// The property.
    pub property: Spanned<PropertyName>,
    /// How values between two keys are interpolated; default linear, or step for true and false.
    pub interpolation: Option<Spanned<InterpolationName>>,
    /// Timing between two keys with linear interpolation; default constant speed.
    pub easing: Option<Spanned<Pace>>,
    /// The value before the first and after the last key; default hold.
    pub beyond: Option<BeyondName>,
    /// Values at given times, in ascending order of time.
    pub keys: Spanned<Vec<Key>>,
}

/// An animatable property.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Deserialize, Serialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub(crate) enum PropertyName {
    /// Translation of an object, as in `transform`.
    Translate,
    /// Rotation of an object by a quaternion [x, y, z, w], instead of `rotate_deg`.
    Rotation,
    /// Angles of an object in degrees, as in `transform`; may exceed a full turn.
    RotateDeg,
    /// Angles of an object in radians, instead of `rotate_deg`.
    Angles,
    /// Scale of an object, as in `transform`.
    Scale,
    /// Whether an object is visible.
    Visible,
    /// Position of a camera.
    LookFrom,
    /// Point that a camera looks at, if it is no object.
    LookAt,
    /// Upward direction of a camera.
    Up,
    /// Vertical field of view of a camera in degrees.
    FovYDeg,
    /// Vertical field of view of a camera in radians, instead of `fov_y_deg`.
    FovY,
    /// Height of the picture of an orthographic camera.
    Orthographic,
    /// Distance of the plane in focus of a camera with a lens.
    FocusDistance,
    /// Radius of the lens of a camera.
    LensRadius,
    /// Position or centre of a light that is not directional.
    Position,
    /// Direction of a directional or spot light, or normal of a disc.
    Direction,
    /// Colour of a light.
    Color,
    /// Intensity of a light: replaces its `intensity` or `radiance`.
    Intensity,
    /// Whether a light shines.
    On,
    /// Diffuse colour of a material.
    Diffuse,
    /// Specular colour of a material.
    Specular,
    /// Shininess of a material.
    Shininess,
    /// Ambient colour of a material; follows `diffuse` if the material's table does not give it.
    Ambient,
    /// Radiance that a material emits.
    Emission,
    /// Fraction of light that a material reflects, `amount` times `color`.
    Reflect,
    /// Fraction of light that a material transmits, `amount` times `color`.
    Transmit,
    /// Weight of ambient and diffuse light, 1 − `amount` of `refract`.
    Opacity,
    /// Index of refraction of a material.
    Ior,
    /// Absorption of a material.
    Absorption,
}

words! {
    /// How values between two keys are interpolated.
    InterpolationName for Interpolation {
        /// Constant until the next key.
        Step,
        /// Linear; for rotations along the shorter arc, at constant speed.
        Linear,
        /// A smooth curve through all keys (Catmull and Rom).
        Cubic = CatmullRom,
        /// A smooth curve with the tangents given at the keys.
        Hermite,
    }
}

words! {
    /// The value before the first and after the last key.
    BeyondName for Beyond {
        /// The value of the nearest key.
        Hold,
        /// Repeats from the start. The last key is shown at the end of the first run.
        Repeat,
        /// Alternates between forward and backward.
        PingPong,
    }
}

/// Defines the properties of one kind of target, each by one word, or by one in degrees and one in radians, and the
/// function from a property to its words.
macro_rules! properties {
    ($all:ident, $words:ident: $type:ident { $($property:ident: $($word:ident)|+,)* }) => {
        #[doc = concat!("The words of each [`", stringify!($type), "`].")]
        pub(crate) const $all: &[(P, $type)] = &[$($((P::$word, $type::$property),)+)*];

        #[doc = concat!("The words of a [`", stringify!($type), "`].")]
        pub(crate) fn $words(property: $type) -> &'static [P] {
            match property {
                $($type::$property => &[$(P::$word),+],)*
            }
        }
    };
}

properties! {
    OF_NODES, of_node: NodeProperty {
        Translation: Translate,
        Rotation: Rotation,
        Angles: RotateDeg | Angles,
        Scale: Scale,
        Visible: Visible,
    }
}

properties! {
    OF_CAMERAS, of_camera: CameraProperty {
        LookFrom: LookFrom,
        LookAt: LookAt,
        Up: Up,
        FovY: FovYDeg | FovY,
        OrthographicHeight: Orthographic,
        FocusDistance: FocusDistance,
        LensRadius: LensRadius,
    }
}

properties! {
    OF_LIGHTS, of_light: LightProperty {
        Position: Position,
        Direction: Direction,
        Color: Color,
        Intensity: Intensity,
        On: On,
    }
}

properties! {
    OF_MATERIALS, of_material: MaterialProperty {
        Diffuse: Diffuse,
        Specular: Specular,
        Shininess: Shininess,
        Ambient: Ambient,
        Emission: Emission,
        Reflect: Reflect,
        Transmit: Transmit,
        Opacity: Opacity,
        Ior: Ior,
        Absorption: Absorption,
    }
}
