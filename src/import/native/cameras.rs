//! The cameras of a native scene.

use super::Texts;
use super::file::{CameraTable, SceneFile};
use crate::import::error::ImportError;
use crate::import::source::quote;
use crate::scene::Camera;
use glam::DVec3;
use toml::Spanned;

/// The cameras of `file`, of which there may be none.
pub(super) fn cameras(file: &SceneFile, texts: &Texts) -> Result<Vec<Camera>, ImportError> {
    if let (Some(camera), false) = (&file.camera, file.cameras.is_empty()) {
        let why = "there are both `camera` and `cameras`".to_owned();
        return Err(texts.malformed(camera.span(), why, "Use [[cameras]] for all of them"));
    }
    let mut cameras: Vec<Camera> = Vec::new();
    for table in file.camera.iter().chain(&file.cameras) {
        let camera = camera(table.get_ref(), texts)?;
        if !camera.name.is_empty() && cameras.iter().any(|other| other.name == camera.name) {
            let why = format!(
                "a second camera is called {}",
                quote(camera.name.as_bytes())
            );
            return Err(texts.malformed(table.span(), why, "Rename one of them"));
        }
        cameras.push(camera);
    }
    Ok(cameras)
}

fn camera(table: &CameraTable, texts: &Texts) -> Result<Camera, ImportError> {
    let (look_from, look_at) = (table.look_from.0, table.look_at.get_ref().0);
    let Some(forward) = (look_at - look_from).try_normalize() else {
        let why = "`look_at` is the same point as `look_from`".to_owned();
        return Err(texts.malformed(table.look_at.span(), why, "Move one of them"));
    };
    let up = table.up.as_ref().map_or(DVec3::Y, |up| up.get_ref().0);
    if forward.cross(up).length() < 1e-6 {
        let span = table
            .up
            .as_ref()
            .map_or(table.look_at.span(), Spanned::span);
        let why = "`up` is parallel to the viewing direction".to_owned();
        return Err(texts.malformed(span, why, "Give the camera another `up`"));
    }
    Ok(Camera {
        name: table.name.clone(),
        look_from,
        look_at,
        up,
        fov_y: table.fov_y_deg.0.to_radians(),
        lens: None,
    })
}
