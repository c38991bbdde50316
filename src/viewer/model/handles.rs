//! Arrows, rings and boxes by which a hand moves, turns and scales what is selected: where they are,
//! which one is under the pointer, and what dragging it makes of a place. Nothing here draws or knows a
//! window; positions in the picture are its pixels from the upper left corner, y down.

mod amounts;

use crate::scene::Camera;
use crate::viewer::model::camera::{project, ray_through};
use crate::viewer::model::objects::{Freedom, Scaling};
use crate::viewer::model::tool::Tool;
use glam::{DAffine3, DMat3, DVec2, DVec3};
use std::f64::consts::{PI, TAU};

/// Lines that a ring is drawn and met by.
const RING_LINES: usize = 64;
/// Where the squares of planes begin and end, as shares of the reach.
const SQUARE: (f64, f64) = (0.28, 0.46);
/// The ring round the line of sight, in reaches.
const OUTER: f64 = 1.2;
/// Sine of the angle between a plane and the line of sight below which the plane tells nothing.
const EDGE_ON: f64 = 0.15;
/// With Ctrl, turns go by this and factors by this.
const SNAP_ANGLE: f64 = PI / 12.0;
const SNAP_FACTOR: f64 = 0.1;
/// With Shift, this share of the hand's way counts.
const FINE: f64 = 0.1;

/// One of the handles. Axes are 0, 1 and 2; that of a plane is its normal.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Part {
    /// Along an axis.
    Axis(usize),
    /// In the plane of the other two.
    Plane(usize),
    /// Round an axis.
    Ring(usize),
    /// In the plane of the picture, round the line of sight, or evenly.
    All,
}

/// Through what the handles are seen.
#[derive(Clone, Copy, Debug)]
pub struct Eye<'a> {
    /// In the world.
    pub camera: &'a Camera,
    /// Of the picture, in its pixels.
    pub size: DVec2,
}

impl Eye<'_> {
    /// Where a point is in the picture; `None` behind the camera.
    pub fn project(&self, point: DVec3) -> Option<DVec2> {
        project(self.camera, point, self.size)
    }

    /// Unit direction of the middle of the picture.
    pub fn forward(&self) -> DVec3 {
        (self.camera.look_at - self.camera.look_from).normalize_or(DVec3::NEG_Z)
    }

    /// How far a point is from the camera along the middle ray; 0 or less behind it.
    pub fn depth(&self, point: DVec3) -> f64 {
        (point - self.camera.look_from).dot(self.forward())
    }

    /// What a pixel is as wide as at a point, in scene units.
    pub fn pixel_at(&self, point: DVec3) -> f64 {
        let height = match self.camera.orthographic_height {
            Some(height) => height,
            None => 2.0 * self.depth(point) * (self.camera.fov_y / 2.0).tan(),
        };
        height / self.size.y
    }

    /// Unit direction in which a point is seen.
    fn toward(&self, point: DVec3) -> DVec3 {
        match self.camera.orthographic_height {
            Some(_) => self.forward(),
            None => (point - self.camera.look_from).normalize_or(DVec3::NEG_Z),
        }
    }
}

/// The handles of something that is selected.
#[derive(Clone, Debug, PartialEq)]
pub struct Handles {
    /// What they do: [`Tool::Move`], [`Tool::Rotate`] or [`Tool::Scale`].
    pub tool: Tool,
    /// Where they meet.
    pub origin: DVec3,
    /// Unit axes: the world's, but those of the thing itself for scaling.
    pub axes: [DVec3; 3],
    /// How long they are, in scene units.
    pub reach: f64,
    /// Those that there are.
    pub parts: Vec<Part>,
}

impl Handles {
    /// The handles of a thing at `place` that are `length` pixels long in the picture; `None` where it is
    /// behind the camera or there is nothing to do with this tool.
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
        // A square that is seen from its edge lies over an arrow, and leads nowhere.
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

    /// The corners of a handle's line in the world, from the origin outwards; those of a plane's square;
    /// none for what is a spot at the origin.
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

    /// The handle under `pointer`, or not farther than `slack` pixels from it.
    pub fn part_at(&self, eye: Eye, pointer: DVec2, slack: f64) -> Option<Part> {
        let mut nearest: Option<(f64, f64, Part)> = None;
        for &part in &self.parts {
            let line = self.line(part, eye);
            let points: Vec<DVec2> = line.iter().filter_map(|p| eye.project(*p)).collect();
            let (distance, depth) = match part {
                Part::All if line.is_empty() => {
                    // A spot is met more easily than the lines that begin at it.
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

/// A handle in the hand.
#[derive(Clone, Debug, PartialEq)]
pub struct Grip {
    /// Which one.
    pub part: Part,
    /// As they were when it was taken.
    pub handles: Handles,
    /// Where the thing was then.
    pub start: DAffine3,
    /// Where the pointer was then.
    from: DVec2,
    /// Where it is, less what Shift holds back.
    to: DVec2,
}

/// What a drag has come to.
#[derive(Clone, Debug, PartialEq)]
pub struct Dragged {
    /// Where the thing is to be.
    pub place: DAffine3,
    /// In words, such as "x +0.25".
    pub told: String,
}

impl Grip {
    /// Takes a handle of a thing that is at `start`.
    pub fn new(part: Part, handles: Handles, start: DAffine3, pointer: DVec2) -> Self {
        Self {
            part,
            handles,
            start,
            from: pointer,
            to: pointer,
        }
    }

    /// Goes with the pointer, `fine` a tenth of the way.
    pub fn follow(&mut self, moved: DVec2, fine: bool) {
        self.to += moved * if fine { FINE } else { 1.0 };
    }

    /// What has become of the thing; `None` where the pointer leads nowhere, such as to the horizon of a
    /// plane. `snap` goes by whole steps.
    pub fn dragged(&self, eye: Eye, snap: bool) -> Option<Dragged> {
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

    /// How far along an axis the hand went.
    fn along(&self, eye: Eye, axis: DVec3) -> Option<(f64, f64)> {
        let at = |position| nearest_on_line(self.ray(eye, position), self.handles.origin, axis);
        Some((at(self.from)?, at(self.to)?))
    }

    fn moved(&self, eye: Eye, snap: bool) -> Option<Dragged> {
        let Handles {
            origin,
            axes,
            reach,
            ..
        } = self.handles;
        let step = 10_f64.powf(reach.log10().floor());
        let whole = |v: f64| if snap { (v / step).round() * step } else { v };
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

    fn turned(&self, eye: Eye, snap: bool) -> Option<Dragged> {
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
            // Seen from its edge a ring is a line along which the hand rolls it.
            let toward = eye.toward(origin);
            let at = |position| on_plane(self.ray(eye, position), origin, toward);
            let way = at(self.to)? - at(self.from)?;
            way.dot(axis.cross(-toward).normalize_or_zero()) / reach
        };
        if snap {
            angle = (angle / SNAP_ANGLE).round() * SNAP_ANGLE;
        }
        Some(self.turned_by(axis, angle))
    }

    fn scaled(&self, eye: Eye, snap: bool) -> Option<Dragged> {
        let mut factor = match self.part {
            Part::Axis(axis) => {
                let (from, to) = self.along(eye, self.handles.axes[axis])?;
                to / from
            }
            // To the right and up is larger: as far as the handles reach doubles it.
            _ => {
                let way = self.to - self.from;
                let length = self.handles.reach / eye.pixel_at(self.handles.origin);
                1.0 + (way.x - way.y) / length
            }
        };
        if snap {
            factor = (factor / SNAP_FACTOR).round() * SNAP_FACTOR;
        }
        Some(self.scaled_by(factor))
    }
}

/// Where on the line through `point` along the unit vector `axis` a ray passes nearest; `None` where
/// they are parallel.
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

/// Where a ray meets a plane ahead of it.
pub fn on_plane((from, direction): (DVec3, DVec3), point: DVec3, normal: DVec3) -> Option<DVec3> {
    let t = (point - from).dot(normal) / direction.dot(normal);
    (t.is_finite() && t > 0.0).then(|| from + direction * t)
}

/// Radians in (−π, π] from one arm to another, counter-clockwise where the axis points at one.
pub fn angle_between(from: DVec3, to: DVec3, axis: DVec3) -> f64 {
    axis.dot(from.cross(to)).atan2(from.dot(to))
}

/// How far `point` is from a line from `a` to `b`.
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
