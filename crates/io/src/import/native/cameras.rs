//! The cameras of a native scene.

use super::Texts;
use super::file::Spanned;
use super::file::{CameraTable, LensTable, LookAt, SceneFile};
use super::nodes::Nodes;
use crate::import::error::ImportError;
use crate::import::number::in_range;
use crate::import::source::quote;
use glam::DVec3;
use glimray_scene::{Camera, Lens};

/// Limits of the lens radius and of its ratio to the focus distance, within the range of f32.
pub(super) const MAX_RADIUS: f64 = 1e9;
pub(super) const MAX_RATIO: f64 = 1e6;

/// The cameras of `file`, possibly none, and the index of the default camera.
pub(super) fn cameras(
    file: &SceneFile,
    nodes: &Nodes,
    texts: &Texts,
) -> Result<(Vec<Camera>, usize), ImportError> {
    if let (Some(camera), false) = (&file.camera, file.cameras.is_empty()) {
        let why = "there are both `camera` and `cameras`".to_owned();
        return Err(texts.malformed(camera.span(), why, "Use [[cameras]] for all of them"));
    }
    let mut cameras: Vec<Camera> = Vec::new();
    let mut default = None;
    for table in file.camera.iter().chain(&file.cameras) {
        let camera = camera(table.get_ref(), nodes, texts)?;
        if !camera.name.is_empty() && cameras.iter().any(|other| other.name == camera.name) {
            let why = format!("duplicate camera name {}", quote(camera.name.as_bytes()));
            return Err(texts.malformed(table.span(), why, "Rename one of them"));
        }
        if table.default == Some(true) && default.replace(cameras.len()).is_some() {
            let why = "a second camera has `default`".to_owned();
            return Err(texts.malformed(table.span(), why, "Remove one `default`"));
        }
        cameras.push(camera);
    }
    Ok((cameras, default.unwrap_or(0)))
}

fn camera(table: &CameraTable, nodes: &Nodes, texts: &Texts) -> Result<Camera, ImportError> {
    if let (Some(degrees), Some(_)) = (&table.fov_y_deg, table.fov_y) {
        let why = "there are both `fov_y_deg` and `fov_y`".to_owned();
        return Err(texts.malformed(degrees.span(), why, "Leave out one of them"));
    }
    let look_from = table.look_from.0;
    let node = match &table.carried_by {
        Some(name) => Some(nodes.one(name.get_ref(), name.span(), texts)?),
        None => None,
    };
    let (look_at, target) = match table.look_at.get_ref() {
        LookAt::Point(point) => (point.0, None),
        LookAt::Object(name) => {
            let target = nodes.one(name, table.look_at.span(), texts)?;
            let world = nodes.world_from(Some(target)).translation;
            let look_at = nodes.world_from(node).inverse().transform_point3(world);
            (look_at, Some(target))
        }
    };
    let Some(forward) = (look_at - look_from).try_normalize() else {
        let why = "`look_at` is the same point as `look_from`".to_owned();
        return Err(texts.malformed(table.look_at.span(), why, "Move one of them"));
    };
    let up = table.up.as_ref().map_or(DVec3::Y, |up| up.0);
    if forward.cross(up.normalize()).length() < 1e-6 {
        let span = table
            .up
            .as_ref()
            .map_or(table.look_at.span(), Spanned::span);
        let why = "`up` is parallel to the viewing direction".to_owned();
        return Err(texts.malformed(span, why, "Give the camera another `up`"));
    }
    let lens = table
        .lens
        .as_ref()
        .map(|lens| self::lens(lens, table, look_at, texts));
    let (mut near, mut far) = Camera::UNCLIPPED;
    if let Some(distance) = table.near {
        near = distance.0;
    }
    if let Some(distance) = &table.far {
        far = distance.0;
        if far <= near {
            let why = format!("`far` is not beyond `near`, which is {near}");
            return Err(texts.malformed(distance.span(), why, "Make `far` larger"));
        }
    }
    Ok(Camera {
        name: table.name.clone().unwrap_or_default(),
        look_from,
        look_at,
        up,
        fov_y: table.angle_of_view(),
        orthographic_height: table.orthographic.map(|height| height.0),
        lens: lens.transpose()?,
        clip: (near, far),
        node,
        target,
    })
}

/// The lens of a camera that looks at `look_at`.
fn lens(
    lens: &Spanned<LensTable>,
    camera: &CameraTable,
    look_at: DVec3,
    texts: &Texts,
) -> Result<Lens, ImportError> {
    let refuse = |span, why: &str, todo| Err(texts.malformed(span, why.to_owned(), todo));
    let table = lens.get_ref();
    let look_from = camera.look_from.0;
    let forward = (look_at - look_from).normalize();
    let radius = match (table.radius, table.f_number) {
        (Some(radius), None) => {
            if let Some(height) = &table.sensor_height_mm {
                let why = "`sensor_height_mm` has no effect with `radius`";
                return refuse(height.span(), why, "Give `f_number` instead of `radius`");
            }
            radius.0
        }
        (None, Some(f_number)) => {
            let height_mm = table.sensor_height_mm.as_ref().map_or(24.0, |h| h.0);
            let focal_length_mm = height_mm / 2.0 / (camera.angle_of_view() / 2.0).tan();
            focal_length_mm / (2.0 * f_number.0) / 1000.0
        }
        _ => {
            let why = "a lens needs exactly one aperture";
            return refuse(lens.span(), why, "Give it either `radius` or `f_number`");
        }
    };
    let focus_distance = match (table.focus_distance, &table.focus_on) {
        (None, None) => look_at.distance(look_from),
        (Some(distance), None) => distance.0,
        (None, Some(point)) => {
            let distance = (point.0 - look_from).dot(forward);
            if distance < f64::from(f32::MIN_POSITIVE) {
                let why = "`focus_on` is not in front of the camera";
                return refuse(point.span(), why, "Give a point in front of it");
            }
            distance
        }
        (Some(_), Some(point)) => {
            let why = "there are both `focus_distance` and `focus_on`";
            return refuse(point.span(), why, "Leave out one of them");
        }
    };
    let blade_rotation = match (&table.blade_rotation_deg, table.blade_rotation) {
        (Some(degrees), Some(_)) => {
            let why = "there are both `blade_rotation_deg` and `blade_rotation`";
            return refuse(degrees.span(), why, "Leave out one of them");
        }
        (Some(degrees), None) => degrees.0.to_radians(),
        (None, radians) => radians.map_or(0.0, |radians| radians.0),
    };
    if radius > MAX_RADIUS.min(focus_distance * MAX_RATIO) || !in_range(focus_distance) {
        let why = "the lens is out of proportion: its radius must be at most 1e9, and at most a \
                   million times its focus distance";
        return refuse(lens.span(), why, "Make it smaller");
    }
    Ok(Lens {
        radius,
        focus_distance,
        blade_count: table.blades.map_or(0, |blades| blades.0),
        blade_rotation,
    })
}
