//! Continuous motion: animated jumps and flying.

use crate::model::camera::{CameraController, Flight, GLIDE, INERTIA};
use glam::DVec3;

impl CameraController {
    /// Sets the direction to fly in; the default stops.
    pub fn fly(&mut self, flight: Flight) {
        self.flight = flight;
    }

    pub(super) fn stop(&mut self) {
        self.velocity = DVec3::ZERO;
        self.flight = Flight::default();
    }

    /// Advances by `seconds`, 0 or more. Returns whether the camera moved.
    pub fn advance(&mut self, seconds: f64) -> bool {
        let before = (self.now, self.goal);
        self.glide(seconds);
        self.drift(seconds);
        before != (self.now, self.goal)
    }

    /// Finishes all motion at its goal.
    pub fn arrive(&mut self) {
        self.stop();
        self.now = self.goal;
    }

    fn glide(&mut self, seconds: f64) {
        if self.now == self.goal {
            return;
        }
        self.now = (self.now).towards(&self.goal, -(-seconds / GLIDE).exp_m1());
        if self.now.is_near(&self.goal, self.fov_y) {
            self.now = self.goal;
        }
    }

    /// Integrates the flight: the velocity v approaches the target w as w + (v - w) e^(-t / τ).
    fn drift(&mut self, seconds: f64) {
        if !self.is_flying() && self.velocity == DVec3::ZERO {
            return;
        }
        let Flight {
            right,
            up,
            forward,
            pace,
        } = self.flight;
        let speed = 0.5 * self.scene_radius() * pace;
        let axes = self.upright.orientation(&self.now);
        let wanted = axes * DVec3::new(right, up, -forward) * speed;
        let decay = (-seconds / INERTIA).exp();
        let off = self.velocity - wanted;
        let mut way = wanted * seconds + off * (INERTIA * (1.0 - decay));
        self.velocity = wanted + off * decay;
        if !self.is_flying() && self.velocity.length() < 1e-3 * self.scene_radius() {
            self.velocity = DVec3::ZERO;
        }
        if self.orthographic {
            // Moving closer does not change an orthographic view, so its height is scaled instead.
            let ahead = -way.dot(axes.z_axis);
            let factor = (-ahead / self.scene_radius()).exp();
            self.now.height *= factor;
            self.goal.height *= factor;
            way += axes.z_axis * ahead;
        }
        self.now.pivot += way;
        self.goal.pivot += way;
    }
}
