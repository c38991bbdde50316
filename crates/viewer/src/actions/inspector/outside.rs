//! The ray view: the scene and the inspected rays, seen by a second camera.

use crate::model::camera::{CameraController, project, project_line, ray_through};
use crate::state::inspector::Inspected;
use crate::state::inspector::PARTS;
use crate::state::inspector::Parts;
use crate::state::inspector::rows::{Filter, RayId};
use crate::state::session::Session;
use glam::{DVec2, DVec3};
use glimray_render::{RayKind, TracedRay};
use glimray_scene::Camera;
use std::f64::consts::PI;

/// Maximum number of rays drawn.
pub const MOST_LINES: usize = 8192;

/// Clipping margin around the picture, in pixels.
const MARGIN: f64 = 16.0;
/// Opacity of hidden parts.
const BEHIND: f32 = 0.3;
/// Near distance for clipping, as a fraction of the distance to the pivot.
const NEAR: f64 = 1e-3;

/// Creates the second camera when rays are shown for the first time, beside and slightly above the first
/// camera, so that all rays are visible.
pub fn look_at(session: &mut Session, bounds: Option<(DVec3, DVec3)>) {
    if session.inspector.outside.controller.is_none() {
        frame(session, bounds);
        if let Some(controller) = &mut session.inspector.outside.controller {
            controller.arrive();
        }
    }
}

/// Frames all visible rays.
pub fn frame(session: &mut Session, bounds: Option<(DVec3, DVec3)>) {
    let Some(main) = &session.controller else {
        return;
    };
    let camera = main.camera();
    let inspector = &mut session.inspector;
    let Some(inspected) = &inspector.inspected else {
        return;
    };
    let extent = extent(inspected, &inspector.filter, &camera, main.scene_radius());
    let aspect = inspector.outside.shown.map_or(1.0, |(width, height)| {
        f64::from(width) / f64::from(height.max(1))
    });
    let controller = inspector.outside.controller.get_or_insert_with(|| {
        let mut controller = CameraController::new(&camera, bounds);
        controller.set_up_axis(main.up_axis());
        controller.set_fov_y(0.7);
        if controller.is_orthographic() {
            controller.toggle_orthographic();
        }
        controller.orbit_by(PI / 3.0, -PI / 9.0);
        controller
    });
    controller.frame(extent, aspect);
}

/// Bounding box of the first camera and of all ray ends that are not too far away.
fn extent(inspected: &Inspected, filter: &Filter, camera: &Camera, radius: f64) -> (DVec3, DVec3) {
    let reach = 4.0 * radius.max(camera.look_from.distance(camera.look_at));
    let ends = shown(inspected, filter).filter_map(|(_, ray)| ray.end.map(DVec3::from));
    let near = ends.filter(|end| end.distance(camera.look_from) <= reach);
    let start = (camera.look_from, camera.look_from);
    near.fold(start, |(min, max), end| (min.min(end), max.max(end)))
}

/// The visible rays.
pub fn shown<'a>(
    inspected: &'a Inspected,
    filter: &'a Filter,
) -> impl Iterator<Item = (RayId, &'a TracedRay)> {
    let samples = filter.samples(inspected);
    let rays = samples.flat_map(|sample| {
        let rays = inspected.tree.samples[sample].rays.iter().enumerate();
        rays.map(move |(ray, traced)| ((sample, ray), traced))
    });
    rays.filter(|(id, ray)| filter.has(inspected, *id) && ray.is_traced())
}

/// A ray in the ray view.
#[derive(Clone, Debug, PartialEq)]
pub struct Line {
    /// The ray.
    pub id: RayId,
    /// The kind of the ray.
    pub kind: RayKind,
    /// Whether it is a blocked shadow ray.
    pub blocked: bool,
    /// Start, in pixels from the upper left corner of the picture.
    pub from: DVec2,
    /// End, in pixels.
    pub to: DVec2,
    /// How it ends.
    pub end: End,
    /// The pieces to draw, from the start.
    pub pieces: Vec<Piece>,
    /// The end point of the surface normal.
    pub normal: Option<DVec2>,
}

/// A piece of a ray, in pixels of the picture.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Piece {
    /// Start.
    pub from: DVec2,
    /// End.
    pub to: DVec2,
    /// Opacity in 0..=1: reduced where hidden, and fading out towards infinity.
    pub strength: f32,
}

/// How a ray ends.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum End {
    /// On a surface.
    Surface,
    /// At a light.
    Light,
    /// The ray is infinite.
    Nowhere,
    /// The ray is clipped at the edge of the picture.
    Cut,
}

/// Start and end of a ray in the world. `reach` is the drawn length of infinite rays, in scene units.
pub fn ends(ray: &TracedRay, reach: f64) -> (DVec3, DVec3) {
    let start = DVec3::from(ray.origin);
    let far = start + reach * DVec3::from(ray.direction);
    (start, ray.end.map_or(far, DVec3::from))
}

/// The visible rays as seen by `camera` in a picture of `size`; `reach` is that of [`ends`]. Parts known to
/// be `hidden` are drawn weaker.
pub fn lines(
    inspected: &Inspected,
    filter: &Filter,
    camera: &Camera,
    size: DVec2,
    reach: f64,
    hidden: Option<&Parts>,
) -> Vec<Line> {
    let rays = shown(inspected, filter).take(MOST_LINES);
    let line = |(id, ray)| {
        let hidden = hidden.and_then(|hidden| hidden.get(&id));
        line(id, ray, camera, (size, reach), hidden.map(Vec::as_slice))
    };
    rays.filter_map(line).collect()
}

/// The visible rays as the camera of the picture sees them now, in a picture of `size`. A primary ray from
/// its eye is a point, also if it starts beside the eye, on the lens.
pub fn path(session: &Session, size: DVec2) -> Vec<Line> {
    let inspector = &session.inspector;
    let (Some(inspected), Some(camera)) = (&inspector.inspected, session.camera()) else {
        return Vec::new();
    };
    let reach = inspector.outside.reach();
    let mut lines = lines(inspected, &inspector.filter, &camera, size, reach, None);
    let gap = camera.look_from.distance(inspected.camera().look_from);
    if gap <= NEAR * camera.look_from.distance(camera.look_at) {
        let is_primary = |line: &&mut Line| line.kind == RayKind::Primary;
        for line in lines.iter_mut().filter(is_primary) {
            line.from = line.to;
            line.pieces.clear();
        }
    }
    lines
}

fn line(
    id: RayId,
    ray: &TracedRay,
    camera: &Camera,
    (size, reach): (DVec2, f64),
    hidden: Option<&[bool]>,
) -> Option<Line> {
    let near = NEAR * camera.look_from.distance(camera.look_at);
    let (start, end) = ends(ray, reach);
    let (from, to) = project_line(camera, (start, end), near, (size, MARGIN))?;
    let is_cut = project(camera, end, size).is_none_or(|whole| whole.distance(to) > 0.5);
    let blocked = ray.shadow.as_ref().is_some_and(|shadow| shadow.blocked);
    let surface = ray.hit.as_ref().filter(|_| ray.shadow.is_none() && !is_cut);
    let normal = surface.and_then(|hit| {
        // Approximately the same length anywhere in the picture.
        let length = 0.05 * camera.look_from.distance(end);
        let tip = DVec3::from(hit.position) + length * DVec3::from(hit.normal);
        project(camera, tip, size)
    });
    let is_endless = ray.end.is_none();
    let strength = |part: usize| {
        let visible = match hidden.and_then(|hidden| hidden.get(part)) {
            Some(true) => BEHIND,
            _ => 1.0,
        };
        let way = if is_endless {
            part as f32 / PARTS as f32
        } else {
            0.0
        };
        visible * (1.0 - way)
    };
    let mut pieces = Vec::new();
    let mut first = 0;
    while first < PARTS {
        let own = strength(first);
        let next = (first..PARTS).find(|&part| strength(part) != own);
        let next = next.unwrap_or(PARTS);
        let at = |part: usize| start.lerp(end, part as f64 / PARTS as f64);
        let piece = project_line(camera, (at(first), at(next)), near, (size, MARGIN));
        pieces.extend(piece.map(|(from, to)| Piece {
            from,
            to,
            strength: own,
        }));
        first = next;
    }
    Some(Line {
        id,
        kind: ray.kind,
        blocked,
        from,
        to,
        end: match (ray.end, &ray.shadow) {
            _ if is_cut => End::Cut,
            (None, _) => End::Nowhere,
            (Some(_), Some(_)) if !blocked => End::Light,
            _ => End::Surface,
        },
        pieces,
        normal,
    })
}

/// The frustum of the first camera: its edges in the second camera's picture. `size` is that of the first
/// camera's picture, `depth` the depth of the frustum in scene units.
pub fn frustum(
    first: &Camera,
    size: DVec2,
    depth: f64,
    camera: &Camera,
    outside: DVec2,
) -> Vec<(DVec2, DVec2)> {
    let corners = [
        DVec2::ZERO,
        DVec2::new(size.x, 0.0),
        size,
        DVec2::new(0.0, size.y),
    ];
    let ends = corners.map(|corner| {
        let (origin, direction) = ray_through(first, corner, size);
        (origin, origin + depth * direction)
    });
    let around = (0..4).map(|k| (ends[k].1, ends[(k + 1) % 4].1));
    let near = NEAR * camera.look_from.distance(camera.look_at);
    ends.into_iter()
        .chain(around)
        .filter_map(|edge| project_line(camera, edge, near, (outside, MARGIN)))
        .collect()
}

/// The ray closest to a position in the picture, within `reach` pixels.
pub fn nearest(lines: &[Line], position: DVec2, reach: f64) -> Option<RayId> {
    let distance = |line: &Line| {
        let way = line.to - line.from;
        let share = (position - line.from).dot(way) / way.length_squared().max(1e-12);
        (line.from + way * share.clamp(0.0, 1.0)).distance(position)
    };
    let near = lines.iter().map(|line| (distance(line), line.id));
    let near = near.filter(|(distance, _)| *distance <= reach);
    near.min_by(|a, b| a.0.total_cmp(&b.0)).map(|(_, id)| id)
}
