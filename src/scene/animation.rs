//! What changes over time: curves, and the properties that they drive.

use glam::{DQuat, DVec3};

/// A curve and the properties that follow it. A property has at most one track.
#[derive(Clone, Debug, PartialEq)]
pub struct Track {
    /// At least one; all of the kind that the curve's values are of.
    pub targets: Vec<Target>,
    /// What they follow.
    pub curve: Curve,
}

/// A property that a track drives. Indices are those of the [`super::Scene`]'s lists.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Target {
    /// Of a [`super::Node`].
    Node(usize, NodeProperty),
    /// Of a [`super::Camera`].
    Camera(usize, CameraProperty),
    /// Of a [`super::Light`].
    Light(usize, LightProperty),
    /// Of a [`super::Material`].
    Material(usize, MaterialProperty),
}

/// What of a node can move.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum NodeProperty {
    /// A vector.
    Translation,
    /// A rotation.
    Rotation,
    /// A vector of radians to turn round x, then y, then z: unlike rotations these can make more
    /// than half a turn between two keys.
    Angles,
    /// A vector; no component of a key is 0.
    Scale,
    /// A scalar: visible from 0.5 upwards. While the shutter is open it keeps its first value.
    Visible,
}

/// What of a camera can change.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum CameraProperty {
    /// A vector.
    LookFrom,
    /// A vector.
    LookAt,
    /// A vector.
    Up,
    /// A scalar, in radians.
    FovY,
    /// A scalar; of no effect on cameras with perspective.
    OrthographicHeight,
    /// A scalar; of no effect on a pinhole.
    FocusDistance,
    /// A scalar; of no effect on a pinhole.
    LensRadius,
}

/// What of a light can change.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum LightProperty {
    /// A vector: where it is, or its centre. Of no effect on directional lights.
    Position,
    /// A vector of any length but 0: where directional and spot lights shine, or the normal of a
    /// disc. Of no effect on others.
    Direction,
    /// A vector: linear Rec. 709, in place of [`super::Light::color`].
    Color,
    /// A scalar that multiplies its colour.
    Intensity,
    /// A scalar: on from 0.5 upwards. While the shutter is open it keeps its first value.
    On,
}

/// What of a material can change. Vectors but `Shininess`, `Opacity` and `Ior`, which are scalars.
/// Materials stay the same while the shutter is open.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[expect(missing_docs, reason = "they are named after the members of Material")]
pub enum MaterialProperty {
    Diffuse,
    Specular,
    Shininess,
    Ambient,
    Emission,
    Reflect,
    Transmit,
    Opacity,
    Ior,
    Absorption,
}

/// Values over time.
#[derive(Clone, Debug, PartialEq)]
pub struct Curve {
    /// Seconds; finite, each greater than the one before; at least one.
    pub times: Vec<f64>,
    /// One for each time; with [`Interpolation::Hermite`] three for each: the tangent by which it is
    /// reached, the value, and the tangent by which it is left, per second.
    pub values: Values,
    /// How values between two keys come about.
    pub interpolation: Interpolation,
    /// How the way from one key to the next is paced; of effect on [`Interpolation::Linear`].
    pub easing: Easing,
    /// What holds before the first and after the last key.
    pub beyond: Beyond,
}

/// The values of a [`Curve`]; all finite.
#[derive(Clone, Debug, PartialEq)]
pub enum Values {
    /// Numbers.
    Scalar(Vec<f64>),
    /// Points, directions, sizes, angles or colours.
    Vector(Vec<DVec3>),
    /// Of unit length, but for tangents.
    Rotation(Vec<DQuat>),
}

/// How values between two keys come about.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Interpolation {
    /// The earlier key's value.
    Step,
    /// A straight way; for rotations the shorter arc at constant speed.
    #[default]
    Linear,
    /// A cubic through the keys, whose tangents are those of the parabola through a key and its two
    /// neighbours (Catmull and Rom 1974, for times at any distance). With [`Beyond::Repeat`] and
    /// equal first and last values it goes on smoothly.
    CatmullRom,
    /// A cubic by given tangents, as glTF's CUBICSPLINE.
    Hermite,
}

/// How the way from one key to the next is paced.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum Easing {
    /// At constant speed.
    #[default]
    None,
    /// CSS's `cubic-bezier(x1, y1, x2, y2)`: the fraction of the way by the fraction of the time; x1 and
    /// x2 in [0, 1].
    Bezier([f64; 4]),
}

impl Easing {
    /// CSS's `ease-in`.
    pub const IN: Self = Self::Bezier([0.42, 0.0, 1.0, 1.0]);
    /// CSS's `ease-out`.
    pub const OUT: Self = Self::Bezier([0.0, 0.0, 0.58, 1.0]);
    /// CSS's `ease-in-out`.
    pub const IN_OUT: Self = Self::Bezier([0.42, 0.0, 0.58, 1.0]);
}

/// What holds before the first and after the last key.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Beyond {
    /// The value of the nearest key.
    #[default]
    Hold,
    /// The same again.
    Repeat,
    /// There and back again.
    PingPong,
}
