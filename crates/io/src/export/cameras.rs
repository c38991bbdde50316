//! The cameras of a scene.

use super::{Writer, exact};
use crate::import::native::file::{CameraTable, LensTable, LookAt};
use crate::import::native::values::{
    Corners, Distance, Number, Positive, Upwards, ViewAngle, ViewRadians, differing,
};
use glam::DVec3;
use glimray_scene::{Camera, Lens};

impl Writer<'_> {
    pub fn camera(&self, index: usize, camera: &Camera) -> CameraTable {
        let name = &self.names.cameras[index];
        let is_default = index > 0 && index == self.scene.camera_index;
        let look_at = match camera.target {
            Some(node) => LookAt::Object(self.names.nodes[node].clone()),
            None => LookAt::Point(camera.look_at.into()),
        };
        let is_read = |degrees: &f64| ViewAngle::range().contains(degrees);
        let (degrees, radians) = exact::angle(camera.fov_y, is_read);
        let degrees = degrees.filter(|degrees| *degrees != CameraTable::FOV_Y_DEG);
        let (near, far) = camera.clip;
        CameraTable {
            name: (!name.is_empty()).then(|| name.clone()),
            look_from: camera.look_from.into(),
            look_at: look_at.into(),
            carried_by: self.names.node(camera.node),
            up: differing::<_, Upwards>(camera.up, DVec3::Y).map(Into::into),
            fov_y_deg: degrees.map(|it| ViewAngle(it).into()),
            fov_y: radians.map(ViewRadians),
            orthographic: camera.orthographic_height.map(Positive),
            near: (near > 0.0).then_some(Distance(near)),
            far: (far < f64::INFINITY).then(|| Positive(far).into()),
            default: is_default.then_some(true),
            lens: camera.lens.as_ref().map(|it| lens(it).into()),
        }
    }
}

fn lens(lens: &Lens) -> LensTable {
    let (degrees, radians) = exact::angle(lens.blade_rotation, |_| true);
    let degrees = degrees.and_then(|degrees| differing::<_, Number>(degrees, 0.0));
    LensTable {
        radius: Some(lens.radius.into()),
        focus_distance: Some(lens.focus_distance.into()),
        blades: (lens.blade_count > 0).then_some(Corners(lens.blade_count)),
        blade_rotation_deg: degrees.map(Into::into),
        blade_rotation: radians.map(Number),
        ..LensTable::default()
    }
}
