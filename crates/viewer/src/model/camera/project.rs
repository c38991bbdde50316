//! Projection between picture and world, matching the renderer's cameras.

use glam::{DMat3, DVec2, DVec3};
use glimray_scene::Camera;

/// Right, up and back of a camera in world space.
fn axes(camera: &Camera) -> DMat3 {
    let forward = (camera.look_at - camera.look_from).normalize_or(DVec3::NEG_Z);
    let right = forward
        .cross(camera.up)
        .normalize_or(forward.any_orthonormal_vector());
    DMat3::from_cols(right, right.cross(forward), -forward)
}

/// The position of `point` in a picture of `size`, from its upper left corner, y down; `None` behind the
/// camera.
pub fn project(camera: &Camera, point: DVec3, size: DVec2) -> Option<DVec2> {
    let p = axes(camera).transpose() * (point - camera.look_from);
    if p.z >= 0.0 {
        return None;
    }
    let span = camera
        .orthographic_height
        .unwrap_or_else(|| -2.0 * p.z * (camera.fov_y / 2.0).tan());
    Some(size / 2.0 + DVec2::new(p.x, -p.y) / span * size.y)
}

/// Projects the line from `from` to `to` as [`project`] does, clipped at depth `near` and at `margin`
/// outside the picture; `None` if nothing is left.
pub fn project_line(
    camera: &Camera,
    (from, to): (DVec3, DVec3),
    near: f64,
    (size, margin): (DVec2, f64),
) -> Option<(DVec2, DVec2)> {
    let forward = -axes(camera).z_axis;
    let depth = |point: DVec3| (point - camera.look_from).dot(forward) - near;
    let (start, end) = (depth(from), depth(to));
    if start < 0.0 && end < 0.0 {
        return None;
    }
    let crossing = || from + (to - from) * (start / (start - end));
    let from = if start < 0.0 { crossing() } else { from };
    let to = if end < 0.0 { crossing() } else { to };
    let (a, b) = (project(camera, from, size)?, project(camera, to, size)?);
    clip(a, b, DVec2::splat(-margin), size + margin)
}

/// How far along its ray the position `at` of a picture of `size` shows a line in the world, in scene units; `None` if the ray
/// runs along the line.
pub fn distance_along(
    camera: &Camera,
    (from, to): (DVec3, DVec3),
    at: DVec2,
    size: DVec2,
) -> Option<f64> {
    let (origin, direction) = ray_through(camera, at, size);
    let (off, way) = (from - origin, to - from);
    // The point of the ray that is nearest to the line.
    let (slope, square) = (direction.dot(way), way.length_squared());
    let share = square - slope * slope;
    let along = (off.dot(direction) * slope - off.dot(way)) / share;
    (share > 1e-9 * square).then(|| off.dot(direction) + slope * along)
}

/// Clips the line from `a` to `b` to a rectangle (Liang and Barsky).
fn clip(a: DVec2, b: DVec2, min: DVec2, max: DVec2) -> Option<(DVec2, DVec2)> {
    let way = b - a;
    let (mut first, mut last) = (0.0_f64, 1.0_f64);
    for axis in 0..2 {
        if way[axis] == 0.0 {
            if !(min[axis]..=max[axis]).contains(&a[axis]) {
                return None;
            }
            continue;
        }
        let [t, u] = [min, max].map(|edge| (edge[axis] - a[axis]) / way[axis]);
        first = first.max(t.min(u));
        last = last.min(t.max(u));
    }
    (first <= last).then(|| (a + way * first, a + way * last))
}

/// The ray through `position` in a picture of `size`: origin and direction of unit length. A lens is treated
/// as a pinhole.
pub fn ray_through(camera: &Camera, position: DVec2, size: DVec2) -> (DVec3, DVec3) {
    let axes = axes(camera);
    let off = (position - size / 2.0) / size.y;
    let off = axes.x_axis * off.x - axes.y_axis * off.y;
    match camera.orthographic_height {
        Some(height) => (camera.look_from + off * height, -axes.z_axis),
        None => {
            let span = 2.0 * (camera.fov_y / 2.0).tan();
            (camera.look_from, (off * span - axes.z_axis).normalize())
        }
    }
}
