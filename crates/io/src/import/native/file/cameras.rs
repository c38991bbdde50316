//! Cameras in a native scene.

use super::Spanned;
use crate::import::native::values::{
    Corners, Distance, Number, Positive, Upwards, Vector, ViewAngle, ViewRadians, either, or,
};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// A pinhole or thin-lens camera.
#[derive(Debug, Deserialize, Serialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct CameraTable {
    /// The name for `--camera` and for animations.
    pub name: Option<String>,
    /// Its position.
    pub look_from: Vector,
    /// The point at the centre of the image, or the name of an object whose origin the camera follows.
    pub look_at: Spanned<LookAt>,
    /// The name of an object or node that the camera is attached to: `look_from`, `look_at` and `up` are
    /// then in its space.
    pub carried_by: Option<Spanned<String>>,
    /// The up direction; default [0, 1, 0].
    pub up: Option<Spanned<Upwards>>,
    /// The vertical field of view in degrees; default 60.
    pub fov_y_deg: Option<Spanned<ViewAngle>>,
    /// The same in radians, instead of `fov_y_deg`.
    pub fov_y: Option<ViewRadians>,
    /// The height of the visible region in scene units: makes the camera orthographic. Geometry behind
    /// `look_from` is then not visible, and `fov_y_deg` has no effect.
    pub orthographic: Option<Positive>,
    /// The distance along the viewing direction at which the camera begins to see, in scene units; default 0.
    pub near: Option<Distance>,
    /// The distance beyond which it sees nothing but the background, greater than `near`; default no limit.
    pub far: Option<Spanned<Positive>>,
    /// Whether it is the default camera, which is otherwise the first one; default false.
    pub default: Option<bool>,
    /// The lens, for depth of field; everything is in focus without it.
    pub lens: Option<Spanned<LensTable>>,
}

either! {
    /// A point, or the name of an object.
    LookAt { Point(Vector), Object(String) },
    "a point [x, y, z], or the name of an object",
    seq: Point, str: Object
}

/// A thin lens. Points nearer or farther than the plane of focus are blurred.
#[derive(Debug, Default, Deserialize, Serialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct LensTable {
    /// The radius of its aperture in scene units. Either this or `f_number`.
    pub radius: Option<Positive>,
    /// The focal length over the diameter of the aperture, as on a photographic lens, for scenes in
    /// metres. Smaller values blur more.
    pub f_number: Option<Positive>,
    /// The height of the film or sensor in millimetres. Together with the field of view it determines the
    /// focal length for `f_number`; default 24, as in a 35 mm camera.
    pub sensor_height_mm: Option<Spanned<Positive>>,
    /// The distance of the plane of focus along the viewing direction. Either this or `focus_on`;
    /// default: the distance of `look_at` at rest.
    pub focus_distance: Option<Positive>,
    /// A point in the plane of focus.
    pub focus_on: Option<Spanned<Vector>>,
    /// The number of corners of the aperture, 3 or more, at distance `radius` from its centre; default: a
    /// circle.
    pub blades: Option<Corners>,
    /// Rotation of the aperture in degrees, counter-clockwise; default 0, with a corner on the right.
    pub blade_rotation_deg: Option<Spanned<Number>>,
    /// The same in radians, instead of `blade_rotation_deg`.
    pub blade_rotation: Option<Number>,
}

impl CameraTable {
    /// The vertical field of view in degrees where a file gives none.
    pub const FOV_Y_DEG: f64 = 60.0;

    /// The vertical field of view in radians.
    pub fn angle_of_view(&self) -> f64 {
        let degrees = self.fov_y_deg.as_ref().map_or(Self::FOV_Y_DEG, |it| it.0);
        or(self.fov_y, degrees.to_radians())
    }
}
