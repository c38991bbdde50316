//! Animated jumps of the camera.

use crate::model::camera::{CameraController, Known, MARGIN, NEAREST, Pose, Side, pivot};
use glam::DVec3;
use glimray_scene::Camera;
use std::f64::consts::{FRAC_PI_2, PI};

impl CameraController {
    /// Makes `point` the pivot and moves it to the centre without rotating or zooming.
    pub fn recentre(&mut self, point: DVec3) {
        let back = self.upright.orientation(&self.now).z_axis;
        let depth = (self.now.pivot - point).dot(back) + self.now.distance;
        let mut start = self.now;
        if self.orthographic && self.clear {
            start.pivot += back * (point - start.pivot).dot(back);
        } else if depth > 0.0 {
            start.pivot += back * (start.distance - depth);
            start.distance = depth;
        } else {
            return;
        }
        self.now = start;
        self.goal = Pose {
            pivot: point,
            ..start
        };
    }

    /// Frames the box in a picture of `aspect` (width over height): centred, as near as possible, with a
    /// margin of 5 % at the tightest edges.
    pub fn frame(&mut self, (min, max): (DVec3, DVec3), aspect: f64) {
        let axes = self.upright.orientation(&self.goal);
        let center = min.midpoint(max);
        let upwards = self.tangent() * (1.0 - MARGIN);
        let (mut distance, mut half_height) = (0.0_f64, 0.0_f64);
        for corner in 0..8 {
            let side = |bit: usize| [min[bit], max[bit]][corner >> bit & 1];
            let p = DVec3::new(side(0), side(1), side(2)) - center;
            let p = axes.transpose() * p;
            // As far above the axis as a picture of width 1 would have it above.
            let off = p.y.abs().max(p.x.abs() / aspect);
            distance = distance.max(off / upwards + p.z);
            half_height = half_height.max(off);
        }
        self.goal.pivot = center;
        if half_height > 0.0 || distance > 0.0 {
            self.goal.height = 2.0 * half_height.max(NEAREST * distance) / (1.0 - MARGIN);
            self.goal.distance = distance.max(NEAREST * half_height);
        }
        self.clear = true;
    }

    /// Switches to a view from one side around the same pivot.
    pub fn look_from(&mut self, side: Side) {
        let (yaw, pitch) = match side {
            Side::Front => (0.0, 0.0),
            Side::Back => (PI, 0.0),
            Side::Right => (FRAC_PI_2, 0.0),
            Side::Left => (-FRAC_PI_2, 0.0),
            Side::Top => (0.0, -FRAC_PI_2),
            Side::Bottom => (0.0, FRAC_PI_2),
        };
        let goal = Pose {
            yaw,
            pitch,
            roll: 0.0,
            ..self.goal
        };
        self.goal = goal.unwound(&self.now);
        // Avoids a remaining full turn of roll.
        self.now.roll -= self.goal.roll;
        self.goal.roll = 0.0;
        self.clear = true;
    }

    /// The side from which [`CameraController::look_from`] looks against `way`, a direction in world space.
    pub fn side_towards(&self, way: DVec3) -> Side {
        let level = self.upright.level(way);
        let size = level.abs();
        let (most, sides) = if size.y >= size.x && size.y >= size.z {
            (level.y, [Side::Top, Side::Bottom])
        } else if size.x >= size.z {
            (level.x, [Side::Right, Side::Left])
        } else {
            (level.z, [Side::Front, Side::Back])
        };
        sides[usize::from(most < 0.0)]
    }

    /// Toggles between perspective and orthographic. The size of objects at the pivot is preserved.
    pub fn toggle_orthographic(&mut self) {
        let tangent = self.tangent();
        for pose in [&mut self.now, &mut self.goal] {
            if self.orthographic {
                pose.distance = pose.height / (2.0 * tangent);
            } else {
                pose.height = 2.0 * tangent * pose.distance;
            }
        }
        self.orthographic = !self.orthographic;
        self.clear = true;
    }

    /// Returns to the scene's own camera.
    pub fn go_home(&mut self) {
        self.home.pose = self.go(&self.home.camera.clone(), self.home.reach);
    }

    /// Moves to `camera`, which is in world space, and matches it exactly on arrival.
    pub fn go_to(&mut self, camera: &Camera) {
        let reach = self.home.reach.filter(|_| *camera == self.home.camera);
        self.visit(camera, reach);
    }

    /// [`CameraController::go_to`] for a camera whose file names no point to look at.
    pub fn go_to_without_aim(&mut self, camera: &Camera) {
        self.visit(camera, Some(pivot::reach(camera, self.bounds)));
    }

    pub(super) fn visit(&mut self, camera: &Camera, reach: Option<f64>) {
        let pose = self.go(camera, reach);
        self.visited = Some(Known {
            camera: camera.clone(),
            pose,
            reach,
            is_clear: false,
        });
    }

    fn go(&mut self, camera: &Camera, reach: Option<f64>) -> Pose {
        self.stop();
        let pose = (self.upright).pose_with(camera, reach).unwound(&self.now);
        let orthographic = camera.orthographic_height.is_some();
        if orthographic && !self.orthographic {
            self.now.height = 2.0 * self.tangent() * self.now.distance;
        } else if self.orthographic && !orthographic {
            self.now.distance = self.now.height / (2.0 * (camera.fov_y / 2.0).tan());
        }
        self.orthographic = orthographic;
        self.clear = false;
        self.fov_y = camera.fov_y;
        self.lens = camera.lens;
        self.name.clone_from(&camera.name);
        self.goal = pose;
        pose
    }
}
