//! Animation: curves and the properties that they drive.

use glam::{DQuat, DVec3};

/// A curve and the properties that it drives. A property has at most one track.
#[derive(Clone, Debug, PartialEq)]
pub struct Track {
    /// At least one; all of the type of the curve's values.
    pub targets: Vec<Target>,
    /// The curve.
    pub curve: Curve,
}

/// A named animation of a model.
#[derive(Clone, Debug, PartialEq)]
pub struct Clip {
    /// Empty if the file gives none.
    pub name: String,
    /// How long it takes; `None` if its tracks are not among the scene's.
    pub seconds: Option<f64>,
}

/// A property that a track drives. The numbers are indices into the [`super::Scene`]'s lists.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Target {
    /// A property of a [`super::Node`].
    Node(usize, NodeProperty),
    /// A property of a [`super::Camera`].
    Camera(usize, CameraProperty),
    /// A property of a [`super::Light`].
    Light(usize, LightProperty),
    /// A property of a [`super::Material`]: its emission, or a coefficient of its [`super::Phong`] BSDF. Coefficients of other BSDFs
    /// are those of [`super::Material::classical`].
    Material(usize, MaterialProperty),
    /// A property of the [`super::MetallicRoughness`] of a material. Classical colours that are derived from it follow, but not those
    /// that a file gives or that were computed from several maps.
    Layer(usize, LayerProperty),
    /// A property of the [`super::UvTransform`] of a texture; what has no track has its default.
    Texture(usize, TextureProperty),
    /// The weight of a morph target, a scalar: the index of a [`super::Deformation`], and that of one of
    /// its targets.
    Weight(usize, usize),
}

/// An animatable property of a node.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum NodeProperty {
    /// A vector.
    Translation,
    /// A rotation.
    Rotation,
    /// A vector of radians about x, then y, then z. Unlike rotations, angles can turn by more than half a
    /// turn between two keys.
    Angles,
    /// A vector; no component of a key is 0.
    Scale,
    /// A scalar: visible from 0.5 upwards. Constant while the shutter is open.
    Visible,
}

/// An animatable property of a camera.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum CameraProperty {
    /// A vector.
    LookFrom,
    /// A vector.
    LookAt,
    /// A vector.
    Up,
    /// A scalar, in radians.
    FovY,
    /// A scalar; ignored by perspective cameras.
    OrthographicHeight,
    /// A scalar; ignored by pinhole cameras.
    FocusDistance,
    /// A scalar; ignored by pinhole cameras.
    LensRadius,
}

/// An animatable property of a light.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum LightProperty {
    /// A vector: the light's position or centre. Ignored by directional lights.
    Position,
    /// A vector of any length but 0: the direction of directional and spot lights, or the normal of a
    /// disc. Ignored by others.
    Direction,
    /// A vector: linear Rec. 709; replaces [`super::Light::color`].
    Color,
    /// A scalar: factor on its colour.
    Intensity,
    /// A scalar: on from 0.5 upwards. Constant while the shutter is open.
    On,
}

/// An animatable property of a material. `Shininess`, `Opacity` and `Ior` are scalars, all others
/// vectors. Materials are constant while the shutter is open.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[expect(
    missing_docs,
    reason = "they are named after the members of Material and Phong"
)]
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

/// An animatable property of a [`super::MetallicRoughness`]. Constant while the shutter is open.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum LayerProperty {
    /// A vector: linear Rec. 709.
    BaseColor,
    /// A scalar: [`super::Material::alpha`].
    Alpha,
    /// A scalar.
    Metallic,
    /// A scalar.
    Roughness,
    /// A scalar.
    Ior,
    /// A scalar.
    Transmission,
    /// A scalar: factor on [`super::Material::emission`], after any other track of it.
    EmissionStrength,
}

/// An animatable property of a [`super::UvTransform`]. Constant while the shutter is open.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum TextureProperty {
    /// A vector whose z is ignored.
    Offset,
    /// A scalar, in radians.
    Rotation,
    /// A vector whose z is ignored.
    Scale,
}

impl TextureProperty {
    /// All of them.
    pub const ALL: [Self; 3] = [Self::Offset, Self::Rotation, Self::Scale];
}

/// Values over time.
#[derive(Clone, Debug, PartialEq)]
pub struct Curve {
    /// Seconds; finite, each greater than the one before; at least one.
    pub times: Vec<f64>,
    /// One value per time. With [`Interpolation::Hermite`] three: the incoming tangent, the value, and
    /// the outgoing tangent; tangents are per second.
    pub values: Values,
    /// How values between two keys are interpolated.
    pub interpolation: Interpolation,
    /// Timing between two keys; used by [`Interpolation::Linear`] only.
    pub easing: Easing,
    /// The value before the first and after the last key.
    pub beyond: Beyond,
}

/// The values of a [`Curve`]; all finite.
#[derive(Clone, Debug, PartialEq)]
pub enum Values {
    /// Numbers.
    Scalar(Vec<f64>),
    /// Positions, directions, sizes, angles or colours.
    Vector(Vec<DVec3>),
    /// Unit quaternions; tangents may have any length.
    Rotation(Vec<DQuat>),
}

/// How values between two keys are interpolated.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Interpolation {
    /// Constant: the earlier key's value.
    Step,
    /// Linear; for rotations along the shorter arc at constant speed.
    #[default]
    Linear,
    /// A cubic through the keys. Its tangent at a key is that of the parabola through the key and its two
    /// neighbours (Catmull and Rom 1974, for unevenly spaced keys). With [`Beyond::Repeat`] and equal
    /// first and last values it is smooth across the repetition.
    CatmullRom,
    /// A cubic with given tangents, like glTF's CUBICSPLINE.
    Hermite,
}

/// Timing between two keys.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum Easing {
    /// Constant speed.
    #[default]
    None,
    /// CSS's `cubic-bezier(x1, y1, x2, y2)`: progress as a function of time, both as fractions; x1 and x2
    /// in [0, 1].
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

/// The value before the first and after the last key.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Beyond {
    /// Hold: the value of the nearest key.
    #[default]
    Hold,
    /// Repeat from the start. At the end of each run the last key counts.
    Repeat,
    /// Alternate between forward and backward.
    PingPong,
}
