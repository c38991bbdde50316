//! The interactive camera: drags apply immediately, jumps are animated. This module neither draws nor knows
//! a window. Positions in the picture are in any unit, from its upper left corner, y down.
//!
//! * Smooth motion approaches its goal as e^(-t / τ), independent of the frame rate.
//! * An untouched camera, or one that has returned home, is bit-identical to the scene's camera. A pasted
//!   camera keeps every number exactly.
//! * Orthographic views chosen in the window are taken from in front of all geometry. Only a scene's own
//!   orthographic camera clips what is behind it.

mod goals;
mod history;
mod lamps;
mod motion;
mod pivot;
mod pose;
mod project;

pub use history::CameraHistory;
pub use pose::{Pose, Upright};
pub use project::{distance_along, project, project_line, ray_through};

use glam::{DVec2, DVec3};
use glimray_scene::{Camera, Lens};
use std::f64::consts::PI;

/// Time constant of animated jumps, in seconds.
const GLIDE: f64 = 0.08;
/// Time constant of acceleration and deceleration while flying, in seconds.
const INERTIA: f64 = 0.12;
/// Factor on the distance per wheel step.
const WHEEL: f64 = 0.85;
/// Exponent of the zoom for a drag over the whole height of the picture.
const DRAG_ZOOM: f64 = 3.0;
/// Margin around framed geometry, as a fraction of the picture.
const MARGIN: f64 = 0.05;
/// Smallest and largest distance of the pivot, in scene radii.
const NEAREST: f64 = 1e-6;
const FARTHEST: f64 = 1e4;

/// A view along an axis. "Front" looks along −Z with +Y up, and along +Y with +Z up.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Side {
    /// From the front.
    Front,
    /// From behind.
    Back,
    /// From the right.
    Right,
    /// From the left.
    Left,
    /// From above.
    Top,
    /// From below.
    Bottom,
}

/// The direction to fly in: each component in [-1, 1], and a speed factor.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Flight {
    /// To the camera's right.
    pub right: f64,
    /// To the camera's up.
    pub up: f64,
    /// Along the viewing direction.
    pub forward: f64,
    /// Factor on the speed, above 0. At 1, flying across the scene's radius takes two seconds.
    pub pace: f64,
}

/// A camera with its current pose and its goal.
#[derive(Clone, Debug)]
pub struct CameraController {
    upright: Upright,
    now: Pose,
    goal: Pose,
    /// Velocity of the flight, in world space.
    velocity: DVec3,
    flight: Flight,
    fov_y: f64,
    orthographic: bool,
    /// Whether an orthographic eye is moved back so that everything is in front of it.
    clear: bool,
    lens: Option<Lens>,
    name: String,
    /// The camera that Home returns to.
    home: Known,
    /// The camera of the last jump.
    visited: Option<Known>,
    /// Radius of the visible geometry.
    bounds: Option<(DVec3, DVec3)>,
}

/// A camera that was set exactly, and the pose that stands for it.
#[derive(Clone, Debug)]
struct Known {
    camera: Camera,
    pose: Pose,
    /// The distance of the pivot from a camera that aims at no point.
    reach: Option<f64>,
    /// Whether the window has chosen its planes: it hides nothing that is to be seen.
    is_clear: bool,
}

/// The viewing direction, of unit length.
fn forward(camera: &Camera) -> DVec3 {
    (camera.look_at - camera.look_from).normalize_or(DVec3::NEG_Z)
}

impl Known {
    fn new(upright: &Upright, camera: &Camera, reach: Option<f64>) -> Self {
        Self {
            pose: upright.pose_with(camera, reach),
            camera: camera.clone(),
            reach,
            is_clear: false,
        }
    }
}

impl CameraController {
    /// A controller that starts at `camera`, which is in world space, as in [`glimray_scene::Frame`].
    /// `bounds` are those of the visible geometry; flying speed and limits depend on their size.
    pub fn new(camera: &Camera, bounds: Option<(DVec3, DVec3)>) -> Self {
        let upright = Upright::of(camera);
        let pose = upright.pose(camera);
        Self {
            upright,
            now: pose,
            goal: pose,
            velocity: DVec3::ZERO,
            flight: Flight::default(),
            fov_y: camera.fov_y,
            orthographic: camera.orthographic_height.is_some(),
            clear: false,
            lens: camera.lens,
            name: camera.name.clone(),
            home: Known {
                camera: camera.clone(),
                pose,
                reach: None,
                is_clear: false,
            },
            visited: None,
            bounds,
        }
    }

    /// [`CameraController::new`] for a camera whose file names no point to look at: the pivot is in the middle of the geometry
    /// in front of it, until [`CameraController::aim_at`] knows better.
    pub fn without_aim(camera: &Camera, bounds: Option<(DVec3, DVec3)>) -> Self {
        let mut controller = Self::new(camera, bounds);
        controller.take_reach(pivot::reach(camera, bounds));
        controller
    }

    /// Moves the pivot of a camera without aim to the depth of `point`, which the middle of its picture shows. The view stays
    /// as it is. This has no effect after the camera has been moved, or if the point lies far behind the geometry.
    pub fn aim_at(&mut self, point: DVec3) {
        let camera = &self.home.camera;
        let reach = (point - camera.look_from).dot(forward(camera));
        let is_sensible = reach > 0.0 && reach <= pivot::farthest(camera, self.bounds);
        if self.home.reach.is_some() && self.is_home() && is_sensible {
            self.take_reach(reach);
        }
    }

    fn take_reach(&mut self, reach: f64) {
        self.home = Known::new(&self.upright, &self.home.camera, Some(reach));
        self.now = self.home.pose;
        self.goal = self.home.pose;
    }

    /// The current camera, in world space.
    pub fn camera(&self) -> Camera {
        self.camera_at(&self.now)
    }

    /// The camera after all motion has ended.
    pub fn destination(&self) -> Camera {
        self.camera_at(&self.goal)
    }

    fn camera_at(&self, pose: &Pose) -> Camera {
        let known = [Some(&self.home), self.visited.as_ref()];
        if let Some(known) = (known.into_iter().flatten()).find(|known| self.is_at(known, pose)) {
            return known.camera.clone();
        }
        let back = self.upright.orientation(pose).z_axis;
        Camera {
            name: self.name.clone(),
            look_from: pose.pivot + back * self.stand_off(pose),
            look_at: pose.pivot,
            up: self.upright.up(pose),
            fov_y: self.fov_y,
            orthographic_height: self.orthographic.then_some(pose.height),
            lens: self.lens,
            ..Camera::default()
        }
    }

    fn is_at(&self, known: &Known, pose: &Pose) -> bool {
        let Known {
            camera,
            pose: place,
            is_clear,
            ..
        } = known;
        let projection = (camera.fov_y, camera.orthographic_height.is_some());
        pose == place
            && projection == (self.fov_y, self.orthographic)
            && !(self.orthographic && self.clear && !is_clear)
            && camera.lens == self.lens
    }

    /// Distance from the eye to the pivot.
    fn stand_off(&self, pose: &Pose) -> f64 {
        match self.bounds {
            Some((min, max)) if self.orthographic && self.clear => {
                let reach = (pose.pivot - min).abs().max((pose.pivot - max).abs());
                pose.distance.max(reach.length() * 1.01)
            }
            _ => pose.distance,
        }
    }

    /// Half the height of the view at distance 1.
    fn tangent(&self) -> f64 {
        (self.fov_y / 2.0).tan()
    }

    /// Height of the view at `depth` along the viewing direction.
    fn span(&self, pose: &Pose, depth: f64) -> f64 {
        if self.orthographic {
            pose.height
        } else {
            2.0 * self.tangent() * depth
        }
    }

    /// Half the diagonal of the visible geometry, above 0.
    pub fn scene_radius(&self) -> f64 {
        let radius = self.bounds.map(|(min, max)| (max - min).length() / 2.0);
        (radius.filter(|radius| *radius > 0.0)).unwrap_or(self.home.pose.distance)
    }

    /// The pivot in world space.
    pub fn pivot(&self) -> DVec3 {
        self.goal.pivot
    }

    /// Whether the projection is orthographic.
    pub fn is_orthographic(&self) -> bool {
        self.orthographic
    }

    /// The up axis, of unit length.
    pub fn up_axis(&self) -> DVec3 {
        self.upright.axis
    }

    /// Whether [`CameraController::advance`] will still move the camera.
    pub fn is_moving(&self) -> bool {
        self.now != self.goal || self.velocity != DVec3::ZERO || self.is_flying()
    }

    /// Whether a key that flies is held.
    pub fn is_flying(&self) -> bool {
        let Flight {
            right, up, forward, ..
        } = self.flight;
        (right, up, forward) != (0.0, 0.0, 0.0)
    }

    /// Whether the camera is the scene's own.
    pub fn is_home(&self) -> bool {
        self.is_at(&self.home, &self.now) && self.is_at(&self.home, &self.goal)
    }

    /// Updates the bounds of the visible geometry.
    pub fn set_bounds(&mut self, bounds: Option<(DVec3, DVec3)>) {
        self.bounds = bounds;
    }

    /// Sets the scene's own camera, after a change of time or an edit. A controller at home follows it; one
    /// that has been moved stays. One without aim keeps the distance of its pivot.
    pub fn set_home(&mut self, camera: &Camera) {
        if self.home.camera == *camera {
            return;
        }
        let reach = self.home.reach;
        if self.is_home() {
            // A flight that is about to start is not held back.
            *self = Self {
                velocity: self.velocity,
                flight: self.flight,
                ..Self::new(camera, self.bounds)
            };
            if let Some(reach) = reach {
                self.take_reach(reach);
            }
        } else {
            self.home = Known::new(&self.upright, camera, reach);
        }
    }

    /// Chooses the up axis and levels the camera at once.
    pub fn set_up_axis(&mut self, axis: DVec3) {
        let camera = self.destination();
        self.upright = Upright::new(axis);
        self.goal = Pose {
            roll: 0.0,
            ..self.upright.pose(&camera)
        };
        self.now = self.goal;
        // Exact cameras were stored relative to the old axis.
        self.home = Known::new(&self.upright, &self.home.camera, self.home.reach);
        self.visited = None;
    }

    /// Sets the vertical field of view in radians, in (0, π). The size of objects at the pivot is preserved.
    pub fn set_fov_y(&mut self, fov_y: f64) {
        let before = self.tangent();
        // Rounded in the unit of files and flags, so that copies are exact and 60° stays 60°.
        let degrees = (fov_y.to_degrees() * 1e12).round() / 1e12;
        let degrees = degrees.clamp(0.1, 170.0);
        self.fov_y = degrees.to_radians();
        let factor = before / self.tangent();
        if !self.orthographic {
            self.now.distance *= factor;
            self.goal.distance *= factor;
        }
    }

    /// Focuses on the depth of `point`. Without a lens this has no effect.
    pub fn focus_on(&mut self, point: DVec3) {
        let camera = self.camera();
        let distance = (point - camera.look_from).dot(forward(&camera));
        if let Some(lens) = &mut self.lens
            && distance > f64::from(f32::MIN_POSITIVE)
        {
            lens.focus_distance = distance;
        }
    }

    /// Orbits around the pivot by a drag in a picture of `size`: its height is half a turn.
    pub fn orbit(&mut self, drag: DVec2, size: DVec2) {
        let turn = -PI * drag / size.y;
        for pose in [&mut self.now, &mut self.goal] {
            pose.turn(turn.x, turn.y);
        }
    }

    /// Orbits around the pivot by angles in radians, animated.
    pub fn orbit_by(&mut self, yaw: f64, pitch: f64) {
        self.goal.turn(yaw, pitch);
    }

    /// Looks around from the eye: the picture's height is its vertical field of view.
    pub fn look(&mut self, drag: DVec2, size: DVec2) {
        let turn = -self.fov_y * drag / size.y;
        let upright = self.upright;
        let orthographic = self.orthographic;
        for pose in [&mut self.now, &mut self.goal] {
            let eye = pose.pivot + upright.orientation(pose).z_axis * pose.distance;
            pose.turn(turn.x, turn.y);
            if !orthographic {
                pose.pivot = eye - upright.orientation(pose).z_axis * pose.distance;
            }
        }
    }

    /// Rolls the camera about its viewing direction, counter-clockwise, in radians.
    pub fn roll(&mut self, angle: f64) {
        self.now.roll += angle;
        self.goal.roll += angle;
    }

    /// Levels the horizon, animated.
    pub fn level(&mut self) {
        let level = Pose {
            roll: 0.0,
            ..self.goal
        };
        self.now = self.now.unwound(&level);
        self.goal.roll = 0.0;
    }

    /// Pans so that the point at `from` moves to `to`: `anchor`, a point in world space, if given, else the
    /// point at the depth of the pivot.
    pub fn pan(&mut self, from: DVec2, to: DVec2, size: DVec2, anchor: Option<DVec3>) {
        let axes = self.upright.orientation(&self.now);
        let depth = anchor
            .map(|point| (self.now.pivot - point).dot(axes.z_axis) + self.now.distance)
            .filter(|depth| *depth > 0.0)
            .unwrap_or(self.now.distance);
        let step = (to - from) / size.y * self.span(&self.now, depth);
        let shift = axes.y_axis * step.y - axes.x_axis * step.x;
        self.now.pivot += shift;
        self.goal.pivot += shift;
    }

    /// Zooms by wheel steps, animated; positive is nearer. `at` is the point that stays fixed in the
    /// picture, `None` the centre.
    pub fn zoom(&mut self, steps: f64, at: Option<DVec3>) {
        let factor = self.allowed(WHEEL.powf(steps));
        let mut goal = self.goal;
        self.scale(&mut goal, factor, at);
        self.goal = goal;
    }

    /// Zooms by an upward drag in a picture of `size`, at once.
    pub fn drag_zoom(&mut self, drag: DVec2, size: DVec2, at: Option<DVec3>) {
        let factor = self.allowed((DRAG_ZOOM * drag.y / size.y).exp());
        let (mut now, mut goal) = (self.now, self.goal);
        self.scale(&mut now, factor, at);
        self.scale(&mut goal, factor, at);
        (self.now, self.goal) = (now, goal);
    }

    /// The point at `cursor` at the depth of the pivot: for zooming to the cursor where there is no surface.
    pub fn point_at(&self, cursor: DVec2, size: DVec2) -> DVec3 {
        let axes = self.upright.orientation(&self.goal);
        let span = self.span(&self.goal, self.goal.distance);
        let off = (cursor - size / 2.0) / size.y * span;
        self.goal.pivot + axes.x_axis * off.x - axes.y_axis * off.y
    }

    /// The factor, limited to the range of distances.
    fn allowed(&self, factor: f64) -> f64 {
        let radius = self.scene_radius().max(self.home.pose.distance);
        let at = if self.orthographic {
            self.goal.height
        } else {
            self.goal.distance
        };
        let least = (NEAREST * radius / at).min(1.0);
        let most = (FARTHEST * radius / at).max(1.0);
        factor.clamp(least, most)
    }

    /// Scales the distance between the eye and the point `at` by a factor. Directions to that point stay the
    /// same.
    fn scale(&self, pose: &mut Pose, factor: f64, at: Option<DVec3>) {
        let mut way = at.map_or(DVec3::ZERO, |point| pose.pivot - point);
        if self.orthographic {
            pose.height *= factor;
            // Depth has no effect in orthographic views; the pivot keeps its depth.
            way = way.reject_from(self.upright.orientation(pose).z_axis);
        } else {
            pose.distance *= factor;
        }
        pose.pivot += way * (factor - 1.0);
    }
}
