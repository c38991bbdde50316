//! Cameras in a native scene.

use crate::import::native::values::{
    Corners, Direction, Distance, Number, Positive, Upwards, Vector, ViewAngle, ViewRadians,
};
use schemars::JsonSchema;
use serde::Deserialize;
use serde::de::{self, Deserializer, SeqAccess, Visitor};
use std::fmt;
use toml::Spanned;

/// A pinhole or thin-lens camera.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(in crate::import::native) struct CameraTable {
    /// The name for `--camera` and for animations.
    #[serde(default)]
    pub name: String,
    /// Its position.
    pub look_from: Vector,
    /// The point at the centre of the image, or the name of an object whose origin the camera follows.
    #[schemars(with = "LookAt")]
    pub look_at: Spanned<LookAt>,
    /// The name of an object or node that the camera is attached to: `look_from`, `look_at` and `up` are
    /// then in its space.
    #[schemars(with = "Option<String>")]
    pub carried_by: Option<Spanned<String>>,
    /// The up direction; default [0, 1, 0].
    #[schemars(with = "Option<Direction>")]
    pub up: Option<Spanned<Upwards>>,
    /// The vertical field of view in degrees; default 60.
    #[schemars(with = "Option<ViewAngle>")]
    pub fov_y_deg: Option<Spanned<ViewAngle>>,
    /// The same in radians, instead of `fov_y_deg`.
    pub fov_y: Option<ViewRadians>,
    /// The height of the visible region in scene units: makes the camera orthographic. Geometry behind
    /// `look_from` is then not visible, and `fov_y_deg` has no effect.
    pub orthographic: Option<Positive>,
    /// The distance along the viewing direction at which the camera begins to see, in scene units; default 0.
    pub near: Option<Distance>,
    /// The distance beyond which it sees nothing but the background, greater than `near`; default no limit.
    #[schemars(with = "Option<Positive>")]
    pub far: Option<Spanned<Positive>>,
    /// Whether it is the default camera, which is otherwise the first one; default false.
    #[serde(default)]
    pub default: bool,
    /// The lens, for depth of field; everything is in focus without it.
    #[schemars(with = "Option<LensTable>")]
    pub lens: Option<Spanned<LensTable>>,
}

/// A point, or the name of an object.
#[derive(Debug, JsonSchema)]
#[schemars(untagged)]
pub(in crate::import::native) enum LookAt {
    Point(Vector),
    Object(String),
}

impl<'de> Deserialize<'de> for LookAt {
    // By hand: serde's untagged enums lose the position of an error.
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct PointOrName;
        impl<'de> Visitor<'de> for PointOrName {
            type Value = LookAt;
            fn expecting(&self, f: &mut fmt::Formatter) -> fmt::Result {
                f.write_str("a point [x, y, z], or the name of an object")
            }
            fn visit_str<E: de::Error>(self, name: &str) -> Result<LookAt, E> {
                Ok(LookAt::Object(name.to_owned()))
            }
            fn visit_seq<A: SeqAccess<'de>>(self, seq: A) -> Result<LookAt, A::Error> {
                let seq = de::value::SeqAccessDeserializer::new(seq);
                Vector::deserialize(seq).map(LookAt::Point)
            }
        }
        deserializer.deserialize_any(PointOrName)
    }
}

/// A thin lens. Points nearer or farther than the plane of focus are blurred.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(in crate::import::native) struct LensTable {
    /// The radius of its aperture in scene units. Either this or `f_number`.
    pub radius: Option<Positive>,
    /// The focal length over the diameter of the aperture, as on a photographic lens, for scenes in
    /// metres. Smaller values blur more.
    pub f_number: Option<Positive>,
    /// The height of the film or sensor in millimetres. Together with the field of view it determines the
    /// focal length for `f_number`; default 24, as in a 35 mm camera.
    #[schemars(with = "Option<Positive>")]
    pub sensor_height_mm: Option<Spanned<Positive>>,
    /// The distance of the plane of focus along the viewing direction. Either this or `focus_on`;
    /// default: the distance of `look_at` at rest.
    pub focus_distance: Option<Positive>,
    /// A point in the plane of focus.
    #[schemars(with = "Option<Vector>")]
    pub focus_on: Option<Spanned<Vector>>,
    /// The number of corners of the aperture, 3 or more, at distance `radius` from its centre; default: a
    /// circle.
    pub blades: Option<Corners>,
    /// Rotation of the aperture in degrees, counter-clockwise; default 0, with a corner on the right.
    #[schemars(with = "Option<f64>")]
    pub blade_rotation_deg: Option<Spanned<Number>>,
    /// The same in radians, instead of `blade_rotation_deg`.
    #[schemars(with = "Option<f64>")]
    pub blade_rotation: Option<Number>,
}

impl CameraTable {
    /// The vertical field of view in radians.
    pub fn angle_of_view(&self) -> f64 {
        let degrees = self
            .fov_y_deg
            .as_ref()
            .map_or(60.0, |angle| angle.get_ref().0);
        self.fov_y.map_or(degrees.to_radians(), |angle| angle.0)
    }
}
