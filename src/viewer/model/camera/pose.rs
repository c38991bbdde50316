//! Where a camera is, as angles about a pivot: what can be dragged without rolling, and without a
//! pole to get stuck at.

use crate::scene::Camera;
use glam::{DMat3, DQuat, DVec3};
use std::f64::consts::{FRAC_PI_2, TAU};

/// Of a viewing direction with "up": how near to parallel they may be and still say which way is up.
const POLE: f64 = 1e-3;

/// A camera's place relative to the point that it goes round. Angles are radians, lengths scene units.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pose {
    /// In the middle of the picture, in world space.
    pub pivot: DVec3,
    /// From the eye to the pivot, above 0.
    pub distance: f64,
    /// About the upward axis, counter-clockwise from above. Counts turns.
    pub yaw: f64,
    /// Of the viewing direction above the level plane, in [-π/2, π/2].
    pub pitch: f64,
    /// Of the camera about its viewing direction, counter-clockwise as the camera sees itself.
    pub roll: f64,
    /// What an orthographic picture shows from its lower to its upper edge, above 0.
    pub height: f64,
}

/// What is up, and from where yaw is counted.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Upright {
    /// Of unit length.
    pub axis: DVec3,
    /// From a space in which up is +Y.
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

    /// The axis about which a person will want to orbit who is shown what `camera` shows: the one of
    /// the six along the world's axes of which the camera's own "up" is the projection, else +Y.
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
        // A camera that looks along an axis is level to it whatever is up in the picture, which tells
        // something only for the axis that most scenes have upwards.
        let forward = (camera.look_at - camera.look_from).normalize_or(DVec3::NEG_Z);
        let is_level = |axis: &DVec3| {
            let tells = *axis == DVec3::Y || forward.cross(*axis).length() > POLE;
            tells && Self::new(*axis).pose(camera).roll.abs() < 1e-6
        };
        Self::new(candidates.into_iter().find(is_level).unwrap_or(DVec3::Y))
    }

    /// Where the camera is, with `look_at` as its pivot.
    pub fn pose(&self, camera: &Camera) -> Pose {
        let level_from_world = self.world_from_level.inverse();
        let reach = camera.look_at - camera.look_from;
        let forward = reach.normalize_or(DVec3::NEG_Z);
        let up = forward.cross(camera.up).cross(forward).normalize_or(
            // A camera that looks along its "up" has none; any will do.
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
            // Straight up or down: what is up in the picture tells where it came from.
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

    /// The camera's axes in world space: right, up and back.
    pub fn orientation(&self, pose: &Pose) -> DMat3 {
        DMat3::from_quat(self.world_from_level) * level_orientation(pose.yaw, pose.pitch, pose.roll)
    }

    /// An "up" for a camera at `pose`: the axis itself where that is clear, so that numbers stay
    /// plain.
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
    /// The pose that is a share `k` of the way from this one to `goal`.
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

    /// Whether nobody would see the difference: it is below half a pixel of a picture of a thousand.
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

    /// The same with angles that are reached from `start` by the shorter way round.
    pub(super) fn unwound(self, start: &Self) -> Self {
        let near = |angle: f64, to: f64| angle + ((to - angle) / TAU).round() * TAU;
        Self {
            yaw: near(self.yaw, start.yaw),
            roll: near(self.roll, start.roll),
            ..self
        }
    }

    /// Turns by yaw and pitch, not beyond the poles.
    pub(super) fn turn(&mut self, yaw: f64, pitch: f64) {
        self.yaw += yaw;
        self.pitch = (self.pitch + pitch).clamp(-FRAC_PI_2, FRAC_PI_2);
    }
}
