//! The camera that a person moves: a pose that follows the hand at once, and glides to what is
//! jumped to. Nothing here draws or knows a window; positions in the picture are in any unit, from its
//! upper left corner, y down.
//!
//! * What is smooth approaches its goal as e^(-t / τ), which does not depend on how time is cut into
//!   frames.
//! * A camera that was not touched, or has come home, is the scene's own to the last bit, and so is
//!   every number of one that was pasted.
//! * Orthographic pictures that a person asks for are taken from in front of everything; only a scene's
//!   own orthographic camera cuts what is behind it.

mod goals;
mod motion;
mod pose;
mod project;

pub use pose::{Pose, Upright};
pub use project::{project, project_line, ray_through};

use crate::scene::{Camera, Lens};
use glam::{DVec2, DVec3};
use std::f64::consts::PI;

/// Seconds in which all but 1/e of a glide is done.
const GLIDE: f64 = 0.08;
/// The same for getting under way and stopping when flying.
const INERTIA: f64 = 0.12;
/// What one step of the wheel multiplies distances by.
const WHEEL: f64 = 0.85;
/// Powers of e by which a drag over the whole height of the picture zooms.
const DRAG_ZOOM: f64 = 3.0;
/// Share of the picture that stays free round what is framed.
const MARGIN: f64 = 0.05;
/// How near and how far away the pivot may be, in radii of the scene.
const NEAREST: f64 = 1e-6;
const FARTHEST: f64 = 1e4;

/// A view along an axis. "Front" looks along −Z where +Y is up, and along +Y where +Z is.
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

/// Where someone wants to fly: each component in [-1, 1], and how fast.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Flight {
    /// To the camera's right.
    pub right: f64,
    /// To the camera's up.
    pub up: f64,
    /// Along the viewing direction.
    pub forward: f64,
    /// Factor on the speed, above 0; at 1 it takes two seconds to cross the scene's radius.
    pub pace: f64,
}

/// A camera, and where it is on its way to.
#[derive(Clone, Debug)]
pub struct CameraController {
    upright: Upright,
    now: Pose,
    goal: Pose,
    /// Of the flight, in world space.
    velocity: DVec3,
    flight: Flight,
    fov_y: f64,
    orthographic: bool,
    /// Whether an orthographic eye stands off so far that everything is before it.
    clear: bool,
    lens: Option<Lens>,
    name: String,
    /// Where Home leads to.
    home: Known,
    /// The last camera that was gone to.
    visited: Option<Known>,
    /// Of what there is to see.
    bounds: Option<(DVec3, DVec3)>,
}

/// A camera that came from elsewhere, and what this rig is like when it is exactly there.
#[derive(Clone, Debug)]
struct Known {
    camera: Camera,
    pose: Pose,
}

impl CameraController {
    /// A rig that starts at `camera`, which is in world space, as in [`crate::scene::Frame`].
    /// `bounds` are those of what there is to see: flying and limits go by their size.
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
            },
            visited: None,
            bounds,
        }
    }

    /// The camera as it is now, in world space.
    pub fn camera(&self) -> Camera {
        self.camera_at(&self.now)
    }

    /// The camera as it will be when all movement has ended.
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
            node: None,
            target: None,
        }
    }

    fn is_at(&self, known: &Known, pose: &Pose) -> bool {
        let Known {
            camera,
            pose: place,
        } = known;
        let projection = (camera.fov_y, camera.orthographic_height.is_some());
        pose == place
            && projection == (self.fov_y, self.orthographic)
            && !(self.orthographic && self.clear)
            && camera.lens == self.lens
    }

    /// From the eye to the pivot.
    fn stand_off(&self, pose: &Pose) -> f64 {
        match self.bounds {
            Some((min, max)) if self.orthographic && self.clear => {
                let reach = (pose.pivot - min).abs().max((pose.pivot - max).abs());
                pose.distance.max(reach.length() * 1.01)
            }
            _ => pose.distance,
        }
    }

    /// Half the picture's height at the distance 1.
    fn tangent(&self) -> f64 {
        (self.fov_y / 2.0).tan()
    }

    /// Height of what is seen at `depth` along the viewing direction.
    fn span(&self, pose: &Pose, depth: f64) -> f64 {
        if self.orthographic {
            pose.height
        } else {
            2.0 * self.tangent() * depth
        }
    }

    /// Half the diagonal of what there is to see, above 0.
    pub fn scene_radius(&self) -> f64 {
        let radius = self.bounds.map(|(min, max)| (max - min).length() / 2.0);
        (radius.filter(|radius| *radius > 0.0)).unwrap_or(self.home.pose.distance)
    }

    /// What the camera goes round.
    pub fn pivot(&self) -> DVec3 {
        self.goal.pivot
    }

    /// Whether the projection is orthographic.
    pub fn is_orthographic(&self) -> bool {
        self.orthographic
    }

    /// What is up, of unit length.
    pub fn up_axis(&self) -> DVec3 {
        self.upright.axis
    }

    /// Whether the camera will be elsewhere after the next [`CameraController::advance`].
    pub fn is_moving(&self) -> bool {
        self.now != self.goal || self.velocity != DVec3::ZERO || self.is_flying()
    }

    fn is_flying(&self) -> bool {
        let Flight {
            right, up, forward, ..
        } = self.flight;
        (right, up, forward) != (0.0, 0.0, 0.0)
    }

    /// Whether the camera is the scene's own.
    pub fn is_home(&self) -> bool {
        self.is_at(&self.home, &self.now) && self.is_at(&self.home, &self.goal)
    }

    /// Tells what there is to see, after it has changed.
    pub fn set_bounds(&mut self, bounds: Option<(DVec3, DVec3)>) {
        self.bounds = bounds;
    }

    /// Tells that the scene's own camera is `camera` now, because time went on or the scene was
    /// edited. A rig at home stays at home; one that has been moved stays where it is.
    pub fn set_home(&mut self, camera: &Camera) {
        if self.home.camera == *camera {
            return;
        }
        if self.is_home() {
            // Who is about to fly away is not held back.
            *self = Self {
                velocity: self.velocity,
                flight: self.flight,
                ..Self::new(camera, self.bounds)
            };
        } else {
            let pose = self.upright.pose(camera);
            self.home = Known {
                camera: camera.clone(),
                pose,
            };
        }
    }

    /// Chooses what is up, upright at once.
    pub fn set_up_axis(&mut self, axis: DVec3) {
        let camera = self.destination();
        self.upright = Upright::new(axis);
        self.goal = Pose {
            roll: 0.0,
            ..self.upright.pose(&camera)
        };
        self.now = self.goal;
        // What was known is known by other angles now.
        self.home.pose = self.upright.pose(&self.home.camera);
        self.visited = None;
    }

    /// Sets the vertical field of view in radians, in (0, π); what is at the pivot keeps its size.
    pub fn set_fov_y(&mut self, fov_y: f64) {
        let before = self.tangent();
        // Whole numbers of the unit in which files and flags have it: what is copied is exact.
        let degrees = fov_y.to_degrees().clamp(0.1, 170.0);
        self.fov_y = degrees.to_radians();
        let factor = before / self.tangent();
        if !self.orthographic {
            self.now.distance *= factor;
            self.goal.distance *= factor;
        }
    }

    /// Makes what is as far away as `point` sharp; without a lens everything is.
    pub fn focus_on(&mut self, point: DVec3) {
        let camera = self.camera();
        let forward = (camera.look_at - camera.look_from).normalize_or(DVec3::NEG_Z);
        let distance = (point - camera.look_from).dot(forward);
        if let Some(lens) = &mut self.lens
            && distance > f64::from(f32::MIN_POSITIVE)
        {
            lens.focus_distance = distance;
        }
    }

    /// Goes round the pivot by a drag in a picture of `size`: half a turn for its height.
    pub fn orbit(&mut self, drag: DVec2, size: DVec2) {
        let turn = -PI * drag / size.y;
        for pose in [&mut self.now, &mut self.goal] {
            pose.turn(turn.x, turn.y);
        }
    }

    /// Goes round the pivot by angles in radians, gliding.
    pub fn orbit_by(&mut self, yaw: f64, pitch: f64) {
        self.goal.turn(yaw, pitch);
    }

    /// Looks about from where the eye is; the picture's edge-to-edge angle for its height.
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

    /// Turns the camera about its viewing direction, counter-clockwise, by radians.
    pub fn roll(&mut self, angle: f64) {
        self.now.roll += angle;
        self.goal.roll += angle;
    }

    /// Glides back to where up is up.
    pub fn level(&mut self) {
        let level = Pose {
            roll: 0.0,
            ..self.goal
        };
        self.now = self.now.unwound(&level);
        self.goal.roll = 0.0;
    }

    /// Shifts the camera so that what was at `from` is at `to`: `anchor`, a point in world space, if
    /// one is known, else what lies as deep as the pivot.
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

    /// Zooms by steps of a wheel, gliding; more than 0 is nearer. `at` is what stays where it is in the
    /// picture: `None` is the middle.
    pub fn zoom(&mut self, steps: f64, at: Option<DVec3>) {
        let factor = self.allowed(WHEEL.powf(steps));
        let mut goal = self.goal;
        self.scale(&mut goal, factor, at);
        self.goal = goal;
    }

    /// Zooms by a drag upwards in a picture of `size`, at once.
    pub fn drag_zoom(&mut self, drag: DVec2, size: DVec2, at: Option<DVec3>) {
        let factor = self.allowed((DRAG_ZOOM * drag.y / size.y).exp());
        let (mut now, mut goal) = (self.now, self.goal);
        self.scale(&mut now, factor, at);
        self.scale(&mut goal, factor, at);
        (self.now, self.goal) = (now, goal);
    }

    /// The point at `cursor` as deep as the pivot: for zooming to the cursor where no surface is.
    pub fn point_at(&self, cursor: DVec2, size: DVec2) -> DVec3 {
        let axes = self.upright.orientation(&self.goal);
        let span = self.span(&self.goal, self.goal.distance);
        let off = (cursor - size / 2.0) / size.y * span;
        self.goal.pivot + axes.x_axis * off.x - axes.y_axis * off.y
    }

    /// The factor, if it leads not too near and not too far; else one that leads just there.
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

    /// Multiplies what lies between the eye and the point `at` by a factor: all directions to that
    /// point stay as they are.
    fn scale(&self, pose: &mut Pose, factor: f64, at: Option<DVec3>) {
        let mut way = at.map_or(DVec3::ZERO, |point| pose.pivot - point);
        if self.orthographic {
            pose.height *= factor;
            // Depth makes no difference there; the pivot keeps its own.
            way = way.reject_from(self.upright.orientation(pose).z_axis);
        } else {
            pose.distance *= factor;
        }
        pose.pivot += way * (factor - 1.0);
    }
}
