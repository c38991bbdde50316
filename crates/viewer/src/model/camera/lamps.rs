//! Keeps lamps out of the way when something is framed: an area light in front of the scene would hide it.

use super::{CameraController, Known, forward, ray_through};
use glam::{DVec2, DVec3};
use glimray_scene::{Camera, Light, LightKind, corners};
use std::f64::consts::PI;

/// Rays across and down the picture.
const RAYS: [u32; 2] = [24, 18];
/// The share of the picture that lamps may hide.
const LITTLE: f64 = 0.01;
/// The step from one direction that is tried to the next, in radians, and the number of steps to each side, and up and down.
const STEP: f64 = PI / 12.0;
const STEPS: [i32; 2] = [8, 4];

impl CameraController {
    /// [`CameraController::frame`] from the nearest direction in which `lights`, in world space, hide next to nothing.
    pub fn frame_past(&mut self, bounds: (DVec3, DVec3), aspect: f64, lights: &[Light]) {
        let mut turns: Vec<[i32; 2]> = (-STEPS[0]..=STEPS[0])
            .flat_map(|yaw| (-STEPS[1]..=STEPS[1]).map(move |pitch| [yaw, pitch]))
            .collect();
        turns.sort_by_key(|[yaw, pitch]| yaw * yaw + pitch * pitch);
        let mut best: Option<(f64, Self)> = None;
        for [yaw, pitch] in turns {
            let mut turned = self.clone();
            turned.orbit_by(f64::from(yaw) * STEP, f64::from(pitch) * STEP);
            turned.frame(bounds, aspect);
            let camera = turned.destination();
            let hidden = hidden(&camera, aspect, bounds.0.midpoint(bounds.1), lights);
            if best.as_ref().is_none_or(|(least, _)| hidden < *least) {
                best = Some((hidden, turned));
            }
            if hidden <= LITTLE {
                break;
            }
        }
        if let Some((_, turned)) = best {
            *self = turned;
        }
    }
}

impl CameraController {
    /// Looks past the lamps that are nearer than all of `subject`, if they hide more than next to nothing of what is being gone
    /// to: the camera sees from the front of the subject on, until it is moved. Its place and direction stay.
    pub fn see_past(&mut self, subject: (DVec3, DVec3), aspect: f64, lights: &[Light]) {
        let mut camera = self.destination();
        let target = subject.0.midpoint(subject.1);
        let before = hidden(&camera, aspect, target, lights);
        let depths =
            corners(subject).map(|corner| (corner - camera.look_from).dot(forward(&camera)));
        // Rounding must not cut the front off.
        let near = depths.into_iter().fold(f64::INFINITY, f64::min) * (1.0 - 1e-4);
        if before <= LITTLE || near <= camera.clip.0 {
            return;
        }
        camera.clip.0 = near;
        if hidden(&camera, aspect, target, lights) < before {
            self.visited = Some(Known {
                camera,
                pose: self.goal,
                reach: None,
                is_clear: true,
            });
        }
    }
}

/// The share of the picture in which a lamp is nearer than `target`.
fn hidden(camera: &Camera, aspect: f64, target: DVec3, lights: &[Light]) -> f64 {
    let lamps: Vec<_> = (lights.iter())
        .filter(|light| light.visible)
        .map(|light| light.kind)
        .collect();
    if lamps.is_empty() {
        return 0.0;
    }
    let count = RAYS[0] * RAYS[1];
    let is_hidden = |ray: &u32| {
        let [x, y] = [ray % RAYS[0], ray / RAYS[0]].map(f64::from);
        let at = DVec2::new(
            (x + 0.5) / f64::from(RAYS[0]) * aspect,
            (y + 0.5) / f64::from(RAYS[1]),
        );
        let (from, along) = ray_through(camera, at, DVec2::new(aspect, 1.0));
        let depth = (target - from).dot(along);
        let near = camera.clip.0 / along.dot(forward(camera));
        let mut distances = lamps.iter().filter_map(|lamp| distance(lamp, from, along));
        distances.any(|distance| distance > near && distance < depth)
    };
    f64::from((0..count).filter(is_hidden).count() as u32) / f64::from(count)
}

/// The distance along a ray of unit direction to a light with extent; to the middle of a sphere.
fn distance(lamp: &LightKind, from: DVec3, along: DVec3) -> Option<f64> {
    let to_plane = |center: DVec3, normal: DVec3| {
        let distance = (center - from).dot(normal) / along.dot(normal);
        (distance, from + distance * along - center)
    };
    let (distance, is_hit) = match *lamp {
        LightKind::Point { .. } | LightKind::Directional { .. } | LightKind::Spot { .. } => {
            return None;
        }
        LightKind::Rectangle {
            center,
            edge_u,
            edge_v,
        } => {
            let normal = edge_u.cross(edge_v);
            let (distance, at) = to_plane(center, normal);
            let share = |edge: DVec3, other: DVec3| {
                let across = other.cross(normal);
                at.dot(across) / edge.dot(across)
            };
            let is_inside =
                share(edge_u, edge_v).abs() <= 1.0 && share(edge_v, edge_u).abs() <= 1.0;
            (distance, is_inside)
        }
        LightKind::Disc {
            center,
            normal,
            radius,
        } => {
            let (distance, at) = to_plane(center, normal);
            (distance, at.length() <= radius)
        }
        LightKind::Sphere { center, radius } => {
            let distance = (center - from).dot(along);
            let off = from + distance * along - center;
            (distance, off.length() <= radius)
        }
    };
    is_hit.then_some(distance)
}
