//! How a native scene describes cameras.

use crate::import::native::values::{
    Corners, Direction, Number, Positive, Upwards, Vector, ViewAngle, ViewRadians,
};
use schemars::JsonSchema;
use serde::Deserialize;
use serde::de::{self, Deserializer, SeqAccess, Visitor};
use std::fmt;
use toml::Spanned;

/// A camera: a pinhole, or with a lens.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(in crate::import::native) struct CameraTable {
    /// The name for `--camera` and for animations.
    #[serde(default)]
    pub name: String,
    /// Where it is.
    pub look_from: Vector,
    /// What is in the middle of the picture: a point, or the name of an object, whose own origin it
    /// then follows.
    #[schemars(with = "LookAt")]
    pub look_at: Spanned<LookAt>,
    /// The name of an object that carries it: `look_from`, `look_at` and `up` are then as seen from
    /// that object.
    #[schemars(with = "Option<String>")]
    pub carried_by: Option<Spanned<String>>,
    /// What is upwards in the picture; [0, 1, 0] if left out.
    #[schemars(with = "Option<Direction>")]
    pub up: Option<Spanned<Upwards>>,
    /// The vertical angle of view in degrees; 60 if left out.
    #[schemars(with = "Option<ViewAngle>")]
    pub fov_y_deg: Option<Spanned<ViewAngle>>,
    /// The same in radians, in place of `fov_y_deg`.
    pub fov_y: Option<ViewRadians>,
    /// The height of what is in the picture, in scene units, for a picture without perspective: an
    /// orthographic one. What is behind `look_from` is then not in it, and `fov_y_deg` does not count.
    pub orthographic: Option<Positive>,
    /// Whether it is the default of several cameras, which otherwise is the first; false if left out.
    #[serde(default)]
    pub default: bool,
    /// What lets only one distance be sharp; all is sharp if left out.
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
    // By hand: serde's untagged enums lose the place of an error.
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

/// A thin lens. What lies nearer or farther than the focus is blurred.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(in crate::import::native) struct LensTable {
    /// The radius of its opening, in scene units. Either this or `f_number`.
    pub radius: Option<Positive>,
    /// The focal length over the diameter of the opening, as on a photographic lens; scene units are
    /// then metres. The smaller, the more blur.
    pub f_number: Option<Positive>,
    /// The height of the film or sensor in millimetres, which with the angle of view gives the focal
    /// length for `f_number`; 24 if left out, as in a 35 mm camera.
    #[schemars(with = "Option<Positive>")]
    pub sensor_height_mm: Option<Spanned<Positive>>,
    /// The distance of what is sharp, along the viewing direction. Either this or `focus_on`; without
    /// both it is that of `look_at`, at first.
    pub focus_distance: Option<Positive>,
    /// A point that is sharp.
    #[schemars(with = "Option<Vector>")]
    pub focus_on: Option<Spanned<Vector>>,
    /// The corners of its opening, 3 or more, which `radius` then reaches to; round if left out.
    pub blades: Option<Corners>,
    /// Degrees by which the opening is turned, counter-clockwise; 0, with a corner to the right, if
    /// left out.
    #[schemars(with = "Option<f64>")]
    pub blade_rotation_deg: Option<Spanned<Number>>,
    /// The same in radians, in place of `blade_rotation_deg`.
    #[schemars(with = "Option<f64>")]
    pub blade_rotation: Option<Number>,
}

impl CameraTable {
    /// The vertical angle of view in radians.
    pub fn angle_of_view(&self) -> f64 {
        let degrees = self
            .fov_y_deg
            .as_ref()
            .map_or(60.0, |angle| angle.get_ref().0);
        self.fov_y.map_or(degrees.to_radians(), |angle| angle.0)
    }
}
