//! Handles for moving, rotating and scaling the selection: their geometry, hit testing and dragging. This
//! module neither draws nor knows a window. Positions are in pixels of the picture from its upper left
//! corner, y down.

mod amounts;
pub mod lamp;

use crate::model::camera::{distance_along, project, ray_through};
use crate::model::objects::{Freedom, Scaling};
use crate::model::snapping::{Snap, grid_step};
use crate::model::tool::Tool;
use glam::{DAffine3, DMat3, DVec2, DVec3};
use glimray_scene::Camera;
use std::f64::consts::{PI, TAU};

/// Length of handles on the screen, in points.
pub const LENGTH: f32 = 84.0;
/// Segments of a ring.
const RING_LINES: usize = 64;
/// Start and end of the plane squares, as fractions of the handle length.
const SQUARE: (f64, f64) = (0.28, 0.46);
/// Radius of the view ring, as a factor on the handle length.
const OUTER: f64 = 1.2;
/// Sine of the angle between plane and viewing direction below which a plane handle is unusable.
const EDGE_ON: f64 = 0.15;
/// Snapping steps for angles and factors, and finer ones.
const SNAP_ANGLE: f64 = PI / 12.0;
const FINE_ANGLE: f64 = PI / 36.0;
const SNAP_FACTOR: f64 = 0.1;
const FINE_FACTOR: f64 = 0.01;
/// Fraction of the motion that counts in fine mode.
const FINE: f64 = 0.1;

/// A handle. Axes are 0, 1 and 2; a plane is named by its normal.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Part {
    /// Along an axis.
    Axis(usize),
    /// In the plane perpendicular to an axis.
    Plane(usize),
    /// Around an axis.
    Ring(usize),
    /// In the plane of the picture, around the viewing direction, or uniformly.
    All,
}

/// The view in which the handles are used.
#[derive(Clone, Copy, Debug)]
pub struct Eye<'a> {
    /// The camera in world space.
    pub camera: &'a Camera,
    /// Size of the picture in pixels.
    pub size: DVec2,
}

impl Eye<'_> {
    /// Projects a point into the picture; `None` behind the camera.
    pub fn project(&self, point: DVec3) -> Option<DVec2> {
        project(self.camera, point, self.size)
    }

    /// The viewing direction, of unit length.
    pub fn forward(&self) -> DVec3 {
        (self.camera.look_at - self.camera.look_from).normalize_or(DVec3::NEG_Z)
    }

    /// Depth of a point along the viewing direction; 0 or less behind the camera.
    pub fn depth(&self, point: DVec3) -> f64 {
        (point - self.camera.look_from).dot(self.forward())
    }

    /// The size of a pixel at a point, in scene units.
    pub fn pixel_at(&self, point: DVec3) -> f64 {
        let height = match self.camera.orthographic_height {
            Some(height) => height,
            None => 2.0 * self.depth(point) * (self.camera.fov_y / 2.0).tan(),
        };
        height / self.size.y
    }

    /// The point of a line in the world that a position in the picture shows, and its distance from where the ray through that
    /// position begins.
    pub fn distance_along(&self, line: (DVec3, DVec3), at: DVec2) -> Option<(DVec3, f64)> {
        let distance = distance_along(self.camera, line, at, self.size)?;
        let (origin, direction) = ray_through(self.camera, at, self.size);
        Some((origin + direction * distance, distance))
    }

    /// Unit direction from the camera to a point.
    fn toward(&self, point: DVec3) -> DVec3 {
        match self.camera.orthographic_height {
            Some(_) => self.forward(),
            None => (point - self.camera.look_from).normalize_or(DVec3::NEG_Z),
        }
    }
}

/// The handles of the selection.
#[derive(Clone, Debug, PartialEq)]
pub struct Handles {
    /// The tool: [`Tool::Move`], [`Tool::Rotate`] or [`Tool::Scale`].
    pub tool: Tool,
    /// The common origin of the handles.
    pub origin: DVec3,
    /// Unit axes: the world's, or the object's own for scaling.
    pub axes: [DVec3; 3],
    /// Length of the handles in scene units.
    pub reach: f64,
    /// The available handles.
    pub parts: Vec<Part>,
}

impl Handles {
    /// The handles of an object at `place`, `length` pixels long in the picture; `None` behind the camera or
    /// if the tool does not apply.
    pub fn new(
        tool: Tool,
        place: DAffine3,
        freedom: Freedom,
        eye: Eye,
        length: f64,
    ) -> Option<Self> {
        let axes = [0, 1, 2];
        let mut parts: Vec<Part> = match tool {
            Tool::Move if freedom.translate => (axes.map(Part::Axis).into_iter())
                .chain(axes.map(Part::Plane))
                .collect(),
            Tool::Rotate if freedom.rotate => axes.map(Part::Ring).to_vec(),
            Tool::Scale if freedom.scale == Scaling::Uneven => axes.map(Part::Axis).to_vec(),
            Tool::Scale if freedom.scale == Scaling::Even => Vec::new(),
            _ => return None,
        };
        parts.push(Part::All);
        let origin = place.translation;
        eye.project(origin)?;
        let own = |axis: usize| {
            place
                .matrix3
                .col(axis)
                .normalize_or(DMat3::IDENTITY.col(axis))
        };
        let axes = match tool {
            Tool::Scale => axes.map(own),
            _ => DVec3::AXES,
        };
        // A square seen edge-on would cover an arrow and cannot be dragged.
        let toward = eye.toward(origin);
        parts.retain(|part| match part {
            Part::Plane(axis) => axes[*axis].dot(toward).abs() > EDGE_ON,
            _ => true,
        });
        Some(Self {
            tool,
            origin,
            axes,
            reach: eye.pixel_at(origin) * length,
            parts,
        })
    }

    /// The points of a handle in world space: from the origin outwards, or the corners of a plane's square;
    /// empty for the spot at the origin.
    pub fn line(&self, part: Part, eye: Eye) -> Vec<DVec3> {
        match part {
            Part::Axis(axis) => vec![self.origin, self.origin + self.axes[axis] * self.reach],
            Part::Plane(axis) => {
                let (u, v) = (self.axes[(axis + 1) % 3], self.axes[(axis + 2) % 3]);
                let (near, far) = (SQUARE.0 * self.reach, SQUARE.1 * self.reach);
                [(near, near), (far, near), (far, far), (near, far)]
                    .map(|(a, b)| self.origin + u * a + v * b)
                    .to_vec()
            }
            Part::Ring(axis) => self.circle(self.axes[axis], self.reach),
            Part::All if self.tool == Tool::Rotate => {
                self.circle(eye.toward(self.origin), OUTER * self.reach)
            }
            Part::All => Vec::new(),
        }
    }

    fn circle(&self, normal: DVec3, radius: f64) -> Vec<DVec3> {
        let (u, v) = normal.any_orthonormal_pair();
        let point = |i| {
            let (sin, cos) = (TAU * i as f64 / RING_LINES as f64).sin_cos();
            self.origin + (u * cos + v * sin) * radius
        };
        (0..=RING_LINES).map(point).collect()
    }

    /// The handle within `slack` pixels of `pointer`.
    pub fn part_at(&self, eye: Eye, pointer: DVec2, slack: f64) -> Option<Part> {
        let mut nearest: Option<(f64, f64, Part)> = None;
        for &part in &self.parts {
            let line = self.line(part, eye);
            let points: Vec<DVec2> = line.iter().filter_map(|p| eye.project(*p)).collect();
            let (distance, depth) = match part {
                Part::All if line.is_empty() => {
                    // The spot has priority over the lines that start at it.
                    let spot = eye.project(self.origin)?;
                    ((spot.distance(pointer) - slack).max(0.0), f64::NEG_INFINITY)
                }
                Part::Plane(_) if points.len() == 4 => {
                    let inside = is_inside(&points, pointer);
                    (if inside { 0.0 } else { f64::INFINITY }, 0.0)
                }
                _ => {
                    let segments = points.windows(2).zip(&line);
                    let near = segments
                        .map(|(ends, at)| (distance_to(ends[0], ends[1], pointer), eye.depth(*at)));
                    near.min_by(|a, b| a.0.total_cmp(&b.0))
                        .unwrap_or((f64::INFINITY, 0.0))
                }
            };
            let is_nearer = nearest.is_none_or(|(d, z, _)| (distance, depth) < (d, z));
            if distance <= slack && is_nearer {
                nearest = Some((distance, depth, part));
            }
        }
        nearest.map(|(.., part)| part)
    }
}

/// A handle that is being dragged.
#[derive(Clone, Debug, PartialEq)]
pub struct Grip {
    /// The handle.
    pub part: Part,
    /// The handles when the drag started.
    pub handles: Handles,
    /// The object's transform when the drag started.
    pub start: DAffine3,
    /// The pointer when the drag started.
    from: DVec2,
    /// The effective pointer, with fine motion applied.
    to: DVec2,
}

/// The result of a drag.
#[derive(Clone, Debug, PartialEq)]
pub struct Dragged {
    /// The new transform of the object.
    pub place: DAffine3,
    /// A description, such as "x +0.25".
    pub label: String,
}

impl Grip {
    /// Starts to drag a handle of an object at `start`.
    pub fn new(part: Part, handles: Handles, start: DAffine3, pointer: DVec2) -> Self {
        Self {
            part,
            handles,
            start,
            from: pointer,
            to: pointer,
        }
    }

    /// Moves by a pointer motion; `fine` applies a tenth of it.
    pub fn move_pointer(&mut self, moved: DVec2, fine: bool) {
        self.to += moved * if fine { FINE } else { 1.0 };
    }

    /// The resulting transform; `None` where the pointer has no solution, such as beyond the horizon of a
    /// plane.
    pub fn dragged(&self, eye: Eye, snap: Snap) -> Option<Dragged> {
        match self.handles.tool {
            Tool::Move => self.moved(eye, snap),
            Tool::Rotate => self.turned(eye, snap),
            Tool::Scale => self.scaled(eye, snap),
            _ => None,
        }
    }

    fn ray(&self, eye: Eye, position: DVec2) -> (DVec3, DVec3) {
        ray_through(eye.camera, position, eye.size)
    }

    /// Distance dragged along an axis.
    fn along(&self, eye: Eye, axis: DVec3) -> Option<(f64, f64)> {
        let at = |position| nearest_on_line(self.ray(eye, position), self.handles.origin, axis);
        Some((at(self.from)?, at(self.to)?))
    }

    fn moved(&self, eye: Eye, snap: Snap) -> Option<Dragged> {
        let Handles {
            origin,
            axes,
            reach,
            ..
        } = self.handles;
        let step = grid_step(reach / f64::from(LENGTH));
        let whole = |v: f64| snap.round(v, step, step / 10.0);
        let in_plane = |normal| {
            let at = |position| on_plane(self.ray(eye, position), origin, normal);
            Some(at(self.to)? - at(self.from)?)
        };
        let way = match self.part {
            Part::Axis(axis) => {
                let (from, to) = self.along(eye, axes[axis])?;
                axes[axis] * whole(to - from)
            }
            Part::Plane(axis) => {
                let way = in_plane(axes[axis])?;
                let others = [(axis + 1) % 3, (axis + 2) % 3];
                others
                    .map(|other| axes[other] * whole(way.dot(axes[other])))
                    .into_iter()
                    .sum()
            }
            _ => DVec3::from(in_plane(eye.forward())?.to_array().map(whole)),
        };
        Some(self.moved_by(way))
    }

    fn turned(&self, eye: Eye, snap: Snap) -> Option<Dragged> {
        let Handles {
            origin,
            axes,
            reach,
            ..
        } = self.handles;
        let axis = match self.part {
            Part::Ring(axis) => axes[axis],
            // Counter-clockwise in the picture.
            _ => -eye.toward(origin),
        };
        let mut angle = if eye.toward(origin).dot(axis).abs() > EDGE_ON {
            let arm = |position| Some(on_plane(self.ray(eye, position), origin, axis)? - origin);
            angle_between(arm(self.from)?, arm(self.to)?, axis)
        } else {
            // A ring seen edge-on is dragged as a line.
            let toward = eye.toward(origin);
            let at = |position| on_plane(self.ray(eye, position), origin, toward);
            let way = at(self.to)? - at(self.from)?;
            way.dot(axis.cross(-toward).normalize_or_zero()) / reach
        };
        angle = snap.round(angle, SNAP_ANGLE, FINE_ANGLE);
        Some(self.turned_by(axis, angle))
    }

    fn scaled(&self, eye: Eye, snap: Snap) -> Option<Dragged> {
        let mut factor = match self.part {
            Part::Axis(axis) => {
                let (from, to) = self.along(eye, self.handles.axes[axis])?;
                to / from
            }
            // Right and up enlarge: one handle length doubles the size.
            _ => {
                let way = self.to - self.from;
                let length = self.handles.reach / eye.pixel_at(self.handles.origin);
                1.0 + (way.x - way.y) / length
            }
        };
        factor = snap.round(factor, SNAP_FACTOR, FINE_FACTOR);
        Some(self.scaled_by(factor))
    }
}

/// The parameter of the point on the line through `point` along the unit vector `axis` that is closest to a
/// ray; `None` if they are parallel.
pub fn nearest_on_line(
    (from, direction): (DVec3, DVec3),
    point: DVec3,
    axis: DVec3,
) -> Option<f64> {
    let off = point - from;
    let cos = axis.dot(direction);
    let sin_squared = 1.0 - cos * cos;
    (sin_squared > 1e-6).then(|| (cos * off.dot(direction) - off.dot(axis)) / sin_squared)
}

/// Intersection of a ray with a plane ahead of it.
pub fn on_plane((from, direction): (DVec3, DVec3), point: DVec3, normal: DVec3) -> Option<DVec3> {
    let t = (point - from).dot(normal) / direction.dot(normal);
    (t.is_finite() && t > 0.0).then(|| from + direction * t)
}

/// Angle in (−π, π] between two vectors, counter-clockwise as seen against the axis.
pub fn angle_between(from: DVec3, to: DVec3, axis: DVec3) -> f64 {
    axis.dot(from.cross(to)).atan2(from.dot(to))
}

/// Distance of `point` from the segment from `a` to `b`.
fn distance_to(a: DVec2, b: DVec2, point: DVec2) -> f64 {
    let along = b - a;
    let share = (point - a).dot(along) / along.length_squared();
    let share = if share.is_finite() {
        share.clamp(0.0, 1.0)
    } else {
        0.0
    };
    (a + along * share).distance(point)
}

/// Whether a point is in a convex polygon.
fn is_inside(corners: &[DVec2], point: DVec2) -> bool {
    let next = corners.iter().cycle().skip(1);
    let sides = corners.iter().zip(next);
    let sides: Vec<f64> = sides.map(|(a, b)| (*b - *a).perp_dot(point - *a)).collect();
    sides.iter().all(|side| *side >= 0.0) || sides.iter().all(|side| *side <= 0.0)
}
