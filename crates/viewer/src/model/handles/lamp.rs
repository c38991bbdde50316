//! Handles of one lamp: the point at which it aims, and its size. As for the other handles, this draws nothing; positions in
//! the picture are in its pixels, y down.

use crate::model::handles::{EDGE_ON, Eye, FINE, nearest_on_line, on_plane};
use crate::model::objects::{EditError, Freedom, Id, Scaling, of_light, place, set_place};
use crate::model::snapping::Snap;
use glam::{DAffine3, DQuat, DVec2, DVec3};
use glimray_scene::{Light, LightKind, ObjectRef, Scene};
use std::f64::consts::{FRAC_PI_2, TAU};

/// Segments of a circle.
const CIRCLE: usize = 48;
/// Least angle of the outer cone, in radians: scene files refuse less.
const LEAST_CONE: f64 = 0.1 * std::f64::consts::PI / 180.0;
/// The fine step of angles in radians, and the whole step of lengths as a fraction of their power of ten.
const SNAP_ANGLE: f64 = 5.0 * std::f64::consts::PI / 180.0;
const SNAP_LENGTH: f64 = 0.1;

/// A property of a lamp that a handle drags.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum LampPart {
    /// The direction: that of a point ahead of it.
    Aim,
    /// The width of a rectangle.
    Width,
    /// The height of a rectangle.
    Height,
    /// The radius of a disc or a sphere.
    Radius,
    /// The outer angle of a cone.
    Outer,
    /// The inner angle of a cone.
    Inner,
}

impl LampPart {
    /// The property's name.
    pub fn title(self) -> &'static str {
        match self {
            Self::Aim => "Aim",
            Self::Width => "Width",
            Self::Height => "Height",
            Self::Radius => "Radius",
            Self::Outer => "Outer angle",
            Self::Inner => "Inner angle",
        }
    }
}

/// A lamp as it is shown: its shape and its handles in world space.
#[derive(Clone, Debug, PartialEq)]
pub struct Lamp {
    /// The kind of the lamp in world space.
    pub kind: LightKind,
    /// The middle from which it shines. Lamps that are infinitely far away are shown here.
    pub at: DVec3,
    /// The length in which its direction is shown.
    pub reach: f64,
}

impl Lamp {
    /// The lamp of a kind in world space, whose direction is shown `length` pixels long. `pivot` is the place of those without
    /// one.
    pub fn new(kind: LightKind, eye: Eye, length: f64, pivot: DVec3) -> Self {
        let at = match kind {
            LightKind::Directional { .. } => pivot,
            _ => of_light(&kind).translation,
        };
        Self {
            kind,
            at,
            reach: (eye.pixel_at(at) * length).max(f64::MIN_POSITIVE),
        }
    }

    /// The direction of its light; `None` if it shines everywhere alike.
    pub fn direction(&self) -> Option<DVec3> {
        match self.kind {
            LightKind::Directional { direction } | LightKind::Spot { direction, .. } => {
                Some(direction)
            }
            LightKind::Disc { normal, .. } => Some(normal),
            LightKind::Rectangle { edge_u, edge_v, .. } => {
                Some(edge_u.cross(edge_v).normalize_or(DVec3::Y))
            }
            LightKind::Point { .. } | LightKind::Sphere { .. } => None,
        }
    }

    /// The shape of the lamp: the surface or the cone, a star for a point, arrows for parallel light, and its direction.
    pub fn lines(&self, eye: Eye) -> Vec<[DVec3; 2]> {
        let &Self { at, reach, .. } = self;
        let mut lines = match self.kind {
            LightKind::Point { .. } => star(at, 0.2 * reach),
            LightKind::Directional { direction } => self.arrows(direction),
            LightKind::Spot {
                direction,
                inner,
                outer,
                ..
            } => {
                let mut lines = star(at, 0.1 * reach);
                lines.extend(self.cone(direction, outer, true));
                lines.extend(self.cone(direction, inner, false));
                lines
            }
            LightKind::Rectangle { edge_u, edge_v, .. } => {
                let corners = [(1.0, 1.0), (-1.0, 1.0), (-1.0, -1.0), (1.0, -1.0)]
                    .map(|(u, v)| at + u * edge_u + v * edge_v);
                closed(&corners)
            }
            LightKind::Disc { normal, radius, .. } => circle(at, normal, radius),
            LightKind::Sphere { radius, .. } => {
                let mut lines: Vec<_> = (DVec3::AXES.into_iter())
                    .flat_map(|axis| circle(at, axis, radius))
                    .collect();
                lines.extend(circle(at, eye.toward(at), radius));
                lines
            }
        };
        lines.extend(self.direction().map(|way| [at, at + way * reach]));
        lines
    }

    /// Two rays beside that from the middle, so that the light looks parallel.
    fn arrows(&self, direction: DVec3) -> Vec<[DVec3; 2]> {
        let (u, v) = direction.any_orthonormal_pair();
        let side = 0.15 * self.reach;
        [u, -u, v, -v]
            .map(|way| self.at + side * way)
            .map(|from| [from, from + 0.7 * self.reach * direction])
            .to_vec()
    }

    /// The rim of a cone as far from its tip as the direction is long, with lines to it if it `has_sides`.
    fn cone(&self, direction: DVec3, angle: f64, has_sides: bool) -> Vec<[DVec3; 2]> {
        let (sine, cosine) = angle.sin_cos();
        let middle = self.at + self.reach * cosine * direction;
        let mut lines = circle(middle, direction, self.reach * sine);
        if has_sides {
            let rim: Vec<_> = lines
                .iter()
                .step_by(CIRCLE / 8)
                .map(|line| line[0])
                .collect();
            lines.extend(rim.into_iter().map(|end| [self.at, end]));
        }
        lines
    }

    /// The direction in which sizes that have none are shown: across the picture, at right angles to `axis`.
    fn side(&self, eye: Eye, axis: DVec3) -> DVec3 {
        let across = axis.cross(eye.toward(self.at));
        across
            .try_normalize()
            .unwrap_or(axis.any_orthonormal_vector())
    }

    /// The handles with their places, as far as the lamp has such freedom.
    pub fn handles(&self, eye: Eye, free: Freedom) -> Vec<(LampPart, DVec3)> {
        let &Self { at, reach, .. } = self;
        let mut handles = Vec::new();
        let direction = self.direction().filter(|_| free.rotate);
        handles.extend(direction.map(|way| (LampPart::Aim, at + way * reach)));
        let scales = free.scale != Scaling::None;
        match self.kind {
            LightKind::Rectangle { edge_u, edge_v, .. } if scales => handles.extend([
                (LampPart::Width, at + edge_u),
                (LampPart::Height, at + edge_v),
            ]),
            LightKind::Disc { normal, radius, .. } if scales => {
                handles.push((LampPart::Radius, at + radius * self.side(eye, normal)));
            }
            LightKind::Sphere { radius, .. } if scales => {
                let up = eye
                    .camera
                    .up
                    .reject_from(eye.toward(at))
                    .normalize_or(DVec3::Y);
                handles.push((LampPart::Radius, at + radius * self.side(eye, up)));
            }
            LightKind::Spot {
                direction,
                inner,
                outer,
                ..
            } => {
                let side = self.side(eye, direction);
                let rim = |angle: f64, side: DVec3| {
                    at + reach * (angle.cos() * direction + angle.sin() * side)
                };
                handles.extend([
                    (LampPart::Inner, rim(inner, -side)),
                    (LampPart::Outer, rim(outer, side)),
                ]);
            }
            _ => {}
        }
        handles
    }

    /// The handle within `slack` pixels of `pointer`: the nearest one.
    pub fn part_at(&self, eye: Eye, free: Freedom, pointer: DVec2, slack: f64) -> Option<LampPart> {
        let distances = self
            .handles(eye, free)
            .into_iter()
            .filter_map(|(part, at)| {
                let distance = eye.project(at)?.distance(pointer);
                (distance <= slack).then_some((distance, part))
            });
        let nearest = distances.min_by(|a, b| a.0.total_cmp(&b.0));
        nearest.map(|(_, part)| part)
    }
}

/// A handle of a lamp that is being dragged.
#[derive(Clone, Debug, PartialEq)]
pub struct LampGrip {
    /// Index into [`Scene::lights`].
    pub light: usize,
    /// The handle.
    pub part: LampPart,
    /// The lamp when the drag started.
    pub start: Lamp,
    /// The pointer when the drag started, and now with fine motion applied.
    from: DVec2,
    to: DVec2,
}

/// A new value of a property of a lamp.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum LampChange {
    /// The direction of the lamp, of unit length in world space.
    Direction(DVec3),
    /// The factor on its width, height or radius.
    Factor(f64),
    /// An angle of its cone in radians.
    Angle(f64),
}

impl LampGrip {
    /// Starts to drag a handle.
    pub fn new(light: usize, part: LampPart, start: Lamp, pointer: DVec2) -> Self {
        Self {
            light,
            part,
            start,
            from: pointer,
            to: pointer,
        }
    }

    /// Moves by a pointer motion; `fine` applies a tenth of it.
    pub fn move_pointer(&mut self, moved: DVec2, fine: bool) {
        self.to += moved * if fine { FINE } else { 1.0 };
    }

    /// The change and its description; `None` where the pointer has no solution. `snap` rounds to whole steps.
    pub fn dragged(&self, eye: Eye, snap: Snap) -> Option<(LampChange, String)> {
        let lamp = &self.start;
        let title = self.part.title();
        match (self.part, lamp.kind) {
            (LampPart::Aim, _) => {
                let tip = lamp.at + lamp.direction()? * lamp.reach;
                let shift = self.in_plane(eye, tip, eye.forward())?;
                let way = (tip + shift - lamp.at).try_normalize()?;
                let text = way.to_array().map(|x| format!("{:.2}", x + 0.0)).join(", ");
                Some((LampChange::Direction(way), format!("{title} {text}")))
            }
            (part, LightKind::Rectangle { edge_u, edge_v, .. }) => {
                let edge = if part == LampPart::Width {
                    edge_u
                } else {
                    edge_v
                };
                self.length(eye, edge, 2.0, snap)
            }
            (_, LightKind::Disc { normal, radius, .. }) => {
                self.length(eye, radius * lamp.side(eye, normal), 1.0, snap)
            }
            (_, LightKind::Sphere { radius, .. }) => {
                let up = eye.camera.up.reject_from(eye.toward(lamp.at));
                let side = lamp.side(eye, up.normalize_or(DVec3::Y));
                self.length(eye, radius * side, 1.0, snap)
            }
            (
                part,
                LightKind::Spot {
                    direction,
                    inner,
                    outer,
                    ..
                },
            ) => {
                let side = lamp.side(eye, direction);
                let (start, side, range) = match part {
                    LampPart::Inner => (inner, -side, [0.0, outer]),
                    _ => (outer, side, [LEAST_CONE, FRAC_PI_2]),
                };
                let turned = self.cone_angle(eye, self.to, direction, side, start)?
                    - self.cone_angle(eye, self.from, direction, side, start)?;
                let angle = snap.round(start + turned, 3.0 * SNAP_ANGLE, SNAP_ANGLE);
                let angle = angle.clamp(range[0], range[1]);
                let text = format!("{title} {:.1}°", angle.to_degrees());
                Some((LampChange::Angle(angle), text))
            }
            (_, LightKind::Point { .. } | LightKind::Directional { .. }) => None,
        }
    }

    fn ray(&self, eye: Eye, position: DVec2) -> (DVec3, DVec3) {
        crate::model::camera::ray_through(eye.camera, position, eye.size)
    }

    /// The way dragged in a plane.
    fn in_plane(&self, eye: Eye, point: DVec3, normal: DVec3) -> Option<DVec3> {
        let at = |position| on_plane(self.ray(eye, position), point, normal);
        Some(at(self.to)? - at(self.from)?)
    }

    /// The factor on the length of `arm`, which starts in the middle, and `shown` times its new length.
    fn length(&self, eye: Eye, arm: DVec3, shown: f64, snap: Snap) -> Option<(LampChange, String)> {
        let length = arm.length();
        let axis = arm.try_normalize()?;
        let at = |position| nearest_on_line(self.ray(eye, position), self.start.at, axis);
        let now = shown * (length + at(self.to)? - at(self.from)?);
        let step = SNAP_LENGTH * 10_f64.powf((shown * length).log10().floor());
        let now = snap.round(now, step, 0.1 * step);
        // A lamp without size has no light.
        let now = now.max(1e-3 * shown * length);
        let text = format!("{} {now:.3}", self.part.title());
        Some((LampChange::Factor(now / (shown * length)), text))
    }

    /// The angle from the axis of a cone to the pointer, towards `side`.
    fn cone_angle(
        &self,
        eye: Eye,
        position: DVec2,
        axis: DVec3,
        side: DVec3,
        start: f64,
    ) -> Option<f64> {
        let Lamp { at, reach, .. } = self.start;
        let normal = axis.cross(side);
        if normal.dot(eye.toward(at)).abs() > EDGE_ON {
            let arm = on_plane(self.ray(eye, position), at, normal)? - at;
            return Some(arm.dot(side).atan2(arm.dot(axis)));
        }
        // Seen along its axis, the cone is dragged by its rim.
        let depth = reach * start.cos().max(0.2);
        let middle = at + depth * axis;
        let height = nearest_on_line(self.ray(eye, position), middle, side)?;
        Some(height.atan2(depth))
    }
}

/// Applies a change of a lamp's handle to a light of the scene at `time` seconds.
///
/// # Errors
/// The light is gone, or an animation sets the property. The scene then stays unchanged.
pub fn change_lamp(
    scene: &mut Scene,
    light: usize,
    part: LampPart,
    change: LampChange,
    time: f64,
) -> Result<(), EditError> {
    let id = Id::Object(ObjectRef::Light(light));
    let old = place(scene, id, time).ok_or(EditError::Gone)?;
    match change {
        LampChange::Direction(way) => {
            let now = old.matrix3.y_axis.normalize_or(DVec3::Y);
            let turn = DQuat::from_rotation_arc(now, way);
            let wanted = DAffine3 {
                matrix3: glam::DMat3::from_quat(turn) * old.matrix3,
                translation: old.translation,
            };
            set_place(scene, id, wanted, time)
        }
        LampChange::Factor(factor) => {
            let mut wanted = old;
            match part {
                LampPart::Width => wanted.matrix3.x_axis *= factor,
                LampPart::Height => wanted.matrix3.z_axis *= factor,
                _ => wanted.matrix3 *= factor,
            }
            set_place(scene, id, wanted, time)
        }
        LampChange::Angle(angle) => {
            let light: &mut Light = scene.lights.get_mut(light).ok_or(EditError::Gone)?;
            if let LightKind::Spot { inner, outer, .. } = &mut light.kind {
                match part {
                    LampPart::Inner => *inner = angle.min(*outer),
                    _ => {
                        *outer = angle;
                        *inner = inner.min(angle);
                    }
                }
            }
            Ok(())
        }
    }
}

fn star(at: DVec3, size: f64) -> Vec<[DVec3; 2]> {
    (DVec3::AXES.into_iter())
        .map(|axis| [at - axis * size, at + axis * size])
        .collect()
}

fn circle(middle: DVec3, normal: DVec3, radius: f64) -> Vec<[DVec3; 2]> {
    let (u, v) = normal.normalize_or(DVec3::Y).any_orthonormal_pair();
    let points: Vec<_> = (0..CIRCLE)
        .map(|i| {
            let (sine, cosine) = (TAU * i as f64 / CIRCLE as f64).sin_cos();
            middle + (u * cosine + v * sine) * radius
        })
        .collect();
    closed(&points)
}

/// The lines of a closed polygon.
fn closed(corners: &[DVec3]) -> Vec<[DVec3; 2]> {
    let next = corners.iter().cycle().skip(1);
    corners.iter().zip(next).map(|(a, b)| [*a, *b]).collect()
}
