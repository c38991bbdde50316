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
    /// Of an object: as in `transform`.
    Translate,
    /// Of an object: a quaternion [x, y, z, w], instead of `rotate_deg`.
    Rotation,
    /// Of an object: as in `transform`; may exceed a full turn.
    RotateDeg,
    /// The same in radians.
    Angles,
    /// Of an object: as in `transform`.
    Scale,
    /// Of an object: true or false.
    Visible,
    /// Of a camera.
    LookFrom,
    /// Of a camera that looks at a point, not at an object.
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
    /// Of a light that is not directional: its `position` or `center`.
    Position,
    /// Of a directional or spot light: its direction; of a disc: its normal.
    Direction,
    /// Of a light.
    Color,
    /// Of a light: replaces its `intensity` or `radiance`.
    Intensity,
    /// Of a light: true or false.
    On,
    /// Of a material.
    Diffuse,
    /// Of a material.
    Specular,
    /// Of a material.
    Shininess,
    /// Of a material; follows `diffuse` if the material's table does not give it.
    Ambient,
    /// Of a material.
    Emission,
    /// Of a material: the fraction of light that it reflects, `amount` times `color`.
    Reflect,
    /// Of a material: the fraction of light that it transmits, `amount` times `color`.
    Transmit,
    /// Of a material: the weight of ambient and diffuse light, 1 − `amount` of `refract`.
    Opacity,
    /// Of a material: the index of refraction.
    Ior,
    /// Of a material.
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
