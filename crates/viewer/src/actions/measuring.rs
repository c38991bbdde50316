//! Measurements between points of surfaces, which snap to vertices.

use crate::actions::sight;
use crate::model::camera::project;
use crate::model::edges;
use crate::model::objects;
use crate::model::sight::Limits;
use crate::model::tool::Tool;
use crate::model::viewport::Viewport;
use crate::state::session::Session;
use crate::state::sight::{Seen, Snapped};
use eframe::egui;
use glam::{DVec2, DVec3};
use glimray_app::legend::number;
use glimray_scene::{CanonicalShape, Frame, Geometry, ObjectRef, Scene, corners};
use std::collections::BTreeSet;
use std::sync::Arc;

/// How near the pointer must be to a vertex, in points of the screen.
const REACH: f32 = 8.0;
/// The most vertices near the pointer that are looked at while it moves.
const MOST_VERTICES: usize = 100_000;
/// How much farther than the surface under the pointer a vertex may be while it is not known what hides it, as a share of the
/// distance.
const SLACK: f64 = 0.02;

/// Measures from or to the nearest vertex, or else what the pixel shows.
pub fn picked(session: &mut Session, pixel: [u32; 2], hit: Option<(DVec3, Option<ObjectRef>)>) {
    let surface = hit.map(|(point, _)| point);
    let Some(point) = vertex_at(session, pixel, surface).or(surface) else {
        return (session.messages).notify("Nothing is under the cursor");
    };
    session.tool_state.measure(point);
    if let Some([a, b]) = session.tool_state.measured_line() {
        let distance = number(a.distance(b) as f32);
        session.messages.notify(format!("Distance: {distance}"));
    }
}

/// The vertex that a click on a pixel would take, if it is quickly found.
pub fn vertex_under(session: &Session, pixel: [u32; 2]) -> Option<DVec3> {
    let (scene, viewport) = (session.scene()?, session.viewport?);
    let seen = sight::current(session)?;
    let known = session.sight.snapped.take().filter(|known| {
        Arc::ptr_eq(&known.seen, &seen) && (known.viewport, known.pixel) == (viewport, pixel)
    });
    let known = known.unwrap_or_else(|| {
        let counts = near(&seen, pixel, viewport).into_iter();
        let counts = counts.map(|object| match object {
            ObjectRef::Instance(index) => scene.meshes[scene.instances[index].mesh].positions.len(),
            _ => 0,
        });
        let is_quick = counts.sum::<usize>() <= MOST_VERTICES;
        Snapped {
            vertex: is_quick.then(|| vertex_at(session, pixel, None)).flatten(),
            seen,
            viewport,
            pixel,
        }
    });
    let vertex = known.vertex;
    session.sight.snapped.replace(Some(known));
    vertex
}

/// Removes the last measurement while the tool is active. Returns whether there was one.
pub fn remove(session: &mut Session) -> bool {
    session.tool == Tool::Measure && session.tool_state.remove_measurement()
}

/// Copies all measurements: a line each, with both points, the distance and its parts along the axes.
pub fn copy(session: &mut Session, ctx: &egui::Context) {
    let lines = session.tool_state.measurements();
    if lines.is_empty() {
        return (session.messages)
            .notify("Nothing is measured. Click two points with the measure tool");
    }
    let mut text = String::from("from x\ty\tz\tto x\ty\tz\tdistance\tdx\tdy\tdz\n");
    for [a, b] in &lines {
        let way = *b - *a;
        let numbers = [a.to_array(), b.to_array()].concat().into_iter();
        let numbers = numbers.chain([way.length()]).chain(way.to_array());
        let numbers: Vec<_> = numbers.map(|it| number(it as f32)).collect();
        text += &numbers.join("\t");
        text.push('\n');
    }
    ctx.copy_text(text);
    let count = match lines.len() {
        1 => "1 measurement".to_owned(),
        count => format!("{count} measurements"),
    };
    session.messages.notify(format!("Copied {count}"));
}

/// The middle of a pixel, and how far from it vertices may be, in pixels.
fn circle([x, y]: [u32; 2], viewport: Viewport) -> (DVec2, f64) {
    let reach = viewport.length(egui::vec2(REACH, 0.0)).x;
    (DVec2::new(f64::from(x) + 0.5, f64::from(y) + 0.5), reach)
}

/// The objects that can be seen around a pixel.
fn near(seen: &Seen, pixel: [u32; 2], viewport: Viewport) -> BTreeSet<ObjectRef> {
    let (at, reach) = circle(pixel, viewport);
    seen.sight.objects_in(at - reach, at + reach)
}

/// The vertex nearest to the middle of a pixel, within reach, not cut away and not hidden.
fn vertex_at(session: &Session, pixel: [u32; 2], surface: Option<DVec3>) -> Option<DVec3> {
    let (scene, camera, viewport) = (session.scene()?, session.camera()?, session.viewport?);
    let (at, reach) = circle(pixel, viewport);
    let limits = Limits::of(scene, &camera);
    let seen = sight::current(session);
    let eye = camera.look_from;
    let forward = (camera.look_at - eye).normalize_or(DVec3::NEG_Z);
    let depth = |point: DVec3| match camera.orthographic_height {
        Some(_) => (point - eye).dot(forward),
        None => point.distance(eye),
    };
    let farthest = surface.map_or(f64::INFINITY, |point| depth(point) * (1.0 + SLACK));
    let mut nearest: Option<(f64, DVec3)> = None;
    let mut look_at = |point: DVec3| {
        let Some(place) = project(&camera, point, viewport.extent()) else {
            return;
        };
        let off = place.distance(at);
        let is_nearer = nearest.is_none_or(|(least, _)| off < least);
        if off > reach || !is_nearer || !limits.contain(point) {
            return;
        }
        let is_seen = match &seen {
            Some(seen) => seen.sight.shows(place, depth(point)),
            None => depth(point) <= farthest,
        };
        if is_seen {
            nearest = Some((off, point));
        }
    };
    let candidates = match &seen {
        Some(seen) => near(seen, pixel, viewport),
        None => (0..scene.instances.len())
            .map(ObjectRef::Instance)
            .collect(),
    };
    let frame = scene.frame(session.playback.time);
    for object in candidates {
        vertices(scene, &frame, object, &mut look_at);
    }
    nearest.map(|(_, point)| point)
}

/// Passes the vertices of an object in world space to `look_at`.
fn vertices(scene: &Scene, frame: &Frame, object: ObjectRef, look_at: &mut impl FnMut(DVec3)) {
    match object {
        ObjectRef::Instance(index) => {
            let instance = &scene.instances[index];
            let mesh = instance.mesh;
            let place = edges::world_from_mesh(scene, frame, instance);
            match edges::moved(scene, frame, mesh) {
                Some(moved) => {
                    (moved.into_iter()).for_each(|it| look_at(place.transform_point3(it)))
                }
                None => {
                    for position in &scene.meshes[mesh].positions {
                        look_at(place.transform_point3(position.as_dvec3()));
                    }
                }
            }
        }
        ObjectRef::Shape(index) => {
            let flat = match scene.shapes[index].geometry {
                Geometry::Placed {
                    canonical: CanonicalShape::Box,
                    ..
                } => 1.0,
                Geometry::Placed {
                    canonical: CanonicalShape::Rectangle,
                    ..
                } => 0.0,
                _ => return,
            };
            let place = objects::place_in(scene, frame, objects::Id::Object(object));
            let place = place.unwrap_or_default();
            let half = DVec3::new(1.0, flat, 1.0);
            for corner in corners((-half, half)) {
                look_at(place.transform_point3(corner));
            }
        }
        ObjectRef::Light(_) => {}
    }
}
