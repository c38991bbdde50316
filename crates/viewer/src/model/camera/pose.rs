//! The pose of a camera as angles around a pivot, which can be dragged without roll or gimbal lock.

use super::forward;
use glam::{DMat3, DQuat, DVec3};
use glimray_scene::Camera;
use std::f64::consts::{FRAC_PI_2, TAU};

/// Sine of the angle between viewing direction and up axis below which the up direction is undefined.
const POLE: f64 = 1e-3;

/// A camera's pose relative to its pivot. Angles are in radians, lengths in scene units.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pose {
    /// The pivot: the centre of the picture, in world space.
    pub pivot: DVec3,
    /// Distance from the eye to the pivot, above 0.
    pub distance: f64,
    /// Yaw about the up axis, counter-clockwise from above. Counts full turns.
    pub yaw: f64,
    /// Pitch of the viewing direction above the horizontal plane, in [-π/2, π/2].
    pub pitch: f64,
    /// Roll about the viewing direction, counter-clockwise as seen by the camera.
    pub roll: f64,
    /// Height of an orthographic view, above 0.
    pub height: f64,
}

/// The up axis, and the origin of yaw.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Upright {
    /// The up axis, of unit length.
    pub axis: DVec3,
    /// Rotation from a space with +Y up.
    world_from_level: DQuat,
}

impl Upright {
    /// With yaw 0 a camera looks along −Z for an axis of +Y, and along +Y for one of +Z.
    pub fn new(axis: DVec3) -> Self {
        let axis = axis.normalize_or(DVec3::Y);
        Self {
            axis,
            world_from_level: DQuat::from_rotation_arc(DVec3::Y, axis),
        }
    }

    /// The up axis that suits orbiting from `camera`: the one of the six world axes whose projection is the
    /// camera's up direction, else +Y.
    pub fn of(camera: &Camera) -> Self {
        let up = camera.up.normalize_or(DVec3::Y);
        if up.dot(DVec3::Z) > 1.0 - 1e-9 {
            return Self::new(DVec3::Z);
        }
        let candidates = [
            DVec3::Y,
            DVec3::Z,
            DVec3::X,
            DVec3::NEG_Y,
            DVec3::NEG_Z,
            DVec3::NEG_X,
        ];
        // A camera that looks along an axis is level to it with any roll. That is evidence only for +Y, the up
        // axis of most scenes.
        let forward = (camera.look_at - camera.look_from).normalize_or(DVec3::NEG_Z);
        let is_level = |axis: &DVec3| {
            let tells = *axis == DVec3::Y || forward.cross(*axis).length() > POLE;
            tells && Self::new(*axis).pose(camera).roll.abs() < 1e-6
        };
        Self::new(candidates.into_iter().find(is_level).unwrap_or(DVec3::Y))
    }

    /// The pose of a camera, with `look_at` as the pivot.
    pub fn pose(&self, camera: &Camera) -> Pose {
        let level_from_world = self.world_from_level.inverse();
        let reach = camera.look_at - camera.look_from;
        let forward = reach.normalize_or(DVec3::NEG_Z);
        let up = forward.cross(camera.up).cross(forward).normalize_or(
            // A camera that looks along its up vector has no defined right axis; any will do.
            forward.any_orthonormal_vector(),
        );
        let (f, u) = (level_from_world * forward, level_from_world * up);
        let across = f.x.hypot(f.z);
        let pitch = f.y.atan2(across);
        let (yaw, roll);
        if across > 1e-9 {
            yaw = (-f.x).atan2(-f.z);
            let level = level_orientation(yaw, pitch, 0.0);
            roll = (-u.dot(level.x_axis)).atan2(u.dot(level.y_axis));
        } else {
            // Looking straight up or down, the camera's up vector gives the yaw.
            yaw = (u.x * pitch.signum()).atan2(u.z * pitch.signum());
            roll = 0.0;
        }
        let distance = reach.length();
        let height = camera
            .orthographic_height
            .unwrap_or_else(|| 2.0 * distance * (camera.fov_y / 2.0).tan());
        Pose {
            pivot: camera.look_at,
            distance,
            yaw,
            pitch,
            roll,
            height,
        }
    }

    /// [`Upright::pose`] with the pivot at this distance from the eye, if given.
    pub(super) fn pose_with(&self, camera: &Camera, reach: Option<f64>) -> Pose {
        let Some(reach) = reach else {
            return self.pose(camera);
        };
        self.pose(&Camera {
            look_at: camera.look_from + reach * forward(camera),
            ..camera.clone()
        })
    }

    /// A direction of the world in the space with +Y up.
    pub(super) fn level(&self, way: DVec3) -> DVec3 {
        self.world_from_level.inverse() * way
    }

    /// The camera's axes in world space: right, up and back.
    pub fn orientation(&self, pose: &Pose) -> DMat3 {
        DMat3::from_quat(self.world_from_level) * level_orientation(pose.yaw, pose.pitch, pose.roll)
    }

    /// An up vector for a camera at `pose`: the axis itself where that is defined, so that numbers stay
    /// simple.
    pub fn up(&self, pose: &Pose) -> DVec3 {
        if pose.roll == 0.0 && pose.pitch.cos() > POLE {
            self.axis
        } else {
            self.orientation(pose).y_axis
        }
    }
}

fn level_orientation(yaw: f64, pitch: f64, roll: f64) -> DMat3 {
    DMat3::from_rotation_y(yaw) * DMat3::from_rotation_x(pitch) * DMat3::from_rotation_z(roll)
}

impl Pose {
    /// Interpolates from this pose to `goal` by `k` in [0, 1].
    pub(super) fn towards(&self, goal: &Self, k: f64) -> Self {
        let mix = |a: f64, b: f64| a + (b - a) * k;
        Self {
            pivot: self.pivot.lerp(goal.pivot, k),
            distance: mix(self.distance, goal.distance),
            yaw: mix(self.yaw, goal.yaw),
            pitch: mix(self.pitch, goal.pitch),
            roll: mix(self.roll, goal.roll),
            height: mix(self.height, goal.height),
        }
    }

    /// Whether the difference is invisible: below half a pixel in a picture 1000 pixels high.
    pub(super) fn is_near(&self, other: &Self, fov_y: f64) -> bool {
        const SHARE: f64 = 5e-4;
        let angle = SHARE * fov_y.min(1.0);
        let ratio = |a: f64, b: f64| (a - b).abs() <= SHARE * b.abs();
        let span = self.height.min(2.0 * self.distance * (fov_y / 2.0).tan());
        self.pivot.distance(other.pivot) <= SHARE * span
            && ratio(self.distance, other.distance)
            && ratio(self.height, other.height)
            && (self.yaw - other.yaw).abs() <= angle
            && (self.pitch - other.pitch).abs() <= angle
            && (self.roll - other.roll).abs() <= angle
    }

    /// This pose with angles reached from `start` the shorter way round.
    pub(super) fn unwound(self, start: &Self) -> Self {
        let near = |angle: f64, to: f64| angle + ((to - angle) / TAU).round() * TAU;
        Self {
            yaw: near(self.yaw, start.yaw),
            roll: near(self.roll, start.roll),
            ..self
        }
    }

    /// Rotates by yaw and pitch, limited at the poles.
    pub(super) fn turn(&mut self, yaw: f64, pitch: f64) {
        self.yaw += yaw;
        self.pitch = (self.pitch + pitch).clamp(-FRAC_PI_2, FRAC_PI_2);
    }
}
