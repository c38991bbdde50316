//! The camera at one moment.

use super::NodeState;
use crate::{Camera, CameraProperty, Scene, Target, Value};
use glam::{DAffine3, DVec3};
use std::f64::consts::PI;

/// Distance that the field of view keeps from 0 and π.
const MIN_FOV: f64 = 1e-6;

/// Sine of the smallest angle between the viewing direction and the up vector.
const MIN_TILT: f64 = 1e-9;

impl Scene {
    /// The default camera in world space. A camera attached to a node sees the node's space as it would
    /// without the transform, unless the node scales unevenly: then its viewing direction and up vector
    /// are transformed, and its field of view stays.
    pub(crate) fn camera_at(&self, time: f64, nodes: &[NodeState]) -> Camera {
        self.any_camera_at(self.camera_index, time, nodes)
    }

    /// All cameras at `time` seconds, in world space.
    pub fn cameras_at(&self, time: f64) -> Vec<Camera> {
        let nodes = self.nodes_at(time, time);
        let all = 0..self.cameras.len();
        all.map(|index| self.any_camera_at(index, time, &nodes))
            .collect()
    }

    fn any_camera_at(&self, number: usize, time: f64, nodes: &[NodeState]) -> Camera {
        let rest = &self.cameras[number];
        let mut camera = rest.clone();
        for track in &self.tracks {
            for target in &track.targets {
                if let Target::Camera(index, property) = *target
                    && index == number
                {
                    change(&mut camera, rest, property, track.curve.at(time));
                }
            }
        }

        let mut before = rest.look_at - rest.look_from;
        if let Some(node) = camera.node.take() {
            let world_from_node = nodes[node].world_from_node;
            place(&mut camera, world_from_node);
            before = world_from_node.transform_vector3(before);
        }
        if let Some(node) = camera.target.take() {
            // If the target coincides with the camera, keep the camera's own direction.
            before = camera.look_at - camera.look_from;
            camera.look_at = nodes[node].world_from_node.translation;
        }
        straighten(&mut camera, before);
        camera
    }
}

fn change(camera: &mut Camera, rest: &Camera, property: CameraProperty, value: Value) {
    match (property, value) {
        (CameraProperty::LookFrom, Value::Vector(value)) => camera.look_from = value,
        (CameraProperty::LookAt, Value::Vector(value)) => camera.look_at = value,
        (CameraProperty::Up, Value::Vector(value)) => camera.up = value,
        (CameraProperty::FovY, Value::Scalar(value)) => {
            camera.fov_y = value.clamp(MIN_FOV, PI - MIN_FOV);
        }
        (CameraProperty::OrthographicHeight, Value::Scalar(value)) => {
            if let (Some(height), Some(rest)) =
                (&mut camera.orthographic_height, rest.orthographic_height)
            {
                *height = value.max(1e-6 * rest);
            }
        }
        (CameraProperty::FocusDistance, Value::Scalar(value)) => {
            if let (Some(lens), Some(rest)) = (&mut camera.lens, rest.lens) {
                lens.focus_distance = value.max(1e-6 * rest.focus_distance);
            }
        }
        (CameraProperty::LensRadius, Value::Scalar(value)) => {
            if let (Some(lens), Some(rest)) = (&mut camera.lens, rest.lens) {
                lens.radius = value.max(1e-6 * rest.radius);
            }
        }
        _ => {}
    }
}

/// Transforms a camera by `world_from_node`. The planes of focus and of clipping, the aperture and the height of an
/// orthographic view keep their proportion to the scene; aperture and height scale by the geometric mean
/// of the horizontal and the vertical scale.
fn place(camera: &mut Camera, world_from_node: DAffine3) {
    let vector = |v: DVec3| world_from_node.transform_vector3(v);
    let forward = (camera.look_at - camera.look_from).normalize_or(DVec3::NEG_Z);
    let right = forward.cross(camera.up).try_normalize();
    let right = right.unwrap_or_else(|| forward.any_orthonormal_vector());
    let across = vector(right).cross(vector(right.cross(forward))).length();
    if let Some(lens) = &mut camera.lens {
        lens.focus_distance *= vector(forward).length();
        lens.radius *= across.sqrt();
    }
    if let Some(height) = &mut camera.orthographic_height {
        *height *= across.sqrt();
    }
    let (near, far) = camera.clip;
    let along = vector(forward).length();
    camera.clip = (near * along, far * along);
    camera.look_from = world_from_node.transform_point3(camera.look_from);
    camera.look_at = world_from_node.transform_point3(camera.look_at);
    camera.up = vector(camera.up);
}

/// Restores a valid viewing direction and up vector if motion made them degenerate, as if the camera had
/// just turned away from `before`.
fn straighten(camera: &mut Camera, before: DVec3) {
    let size = camera
        .look_from
        .abs()
        .max(camera.look_at.abs())
        .max_element();
    let forward = camera.look_at - camera.look_from;
    let forward = if forward.length() > f64::EPSILON * size {
        forward.normalize_or(DVec3::NEG_Z)
    } else {
        let forward = before.normalize_or(DVec3::NEG_Z);
        // Far enough away for the sum not to round to the position.
        camera.look_at = camera.look_from + forward * size.max(1.0);
        forward
    };
    let is_clear = |up: DVec3| forward.cross(up).length() > MIN_TILT;
    let up = camera.up.normalize_or_zero();
    if is_clear(up) {
        return;
    }
    // For a camera that tilts down until it looks straight down, the up vector becomes the previous
    // viewing direction; for one that tilts up, the opposite direction.
    let level = before.normalize_or_zero() * -forward.dot(up);
    camera.up = [level, DVec3::Y, DVec3::Z]
        .into_iter()
        .find(|up| is_clear(*up))
        .unwrap_or(DVec3::X);
}
