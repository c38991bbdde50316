//! Editing overlays of the picture: the outline of the selection and its handles.

mod lamp;

use crate::actions::editing;
use crate::model::bindings::Action;
use crate::model::handles::{Grip, Handles, LENGTH, Part};
use crate::model::modal::Modal;
use crate::model::objects;
use crate::model::objects::Id;
use crate::model::snapping::Snap;
use crate::model::tool::Tool;
use crate::model::viewport::Viewport;
use crate::state::session::Session;
use crate::ui::silhouette;
use crate::ui::world_painter::{SHADE, WorldPainter};
use eframe::egui::{self, Color32, Painter, Pos2, Shape, Stroke};
use glam::{DAffine3, DVec3};
use glimray_scene::{Camera, Frame, Geometry, ObjectRef, Scene, corners};

/// The distance for hit testing, in points.
pub(in crate::ui) const SLACK: f32 = 7.0;
/// Colours of x, y and z: legible on black and on white.
pub(in crate::ui) const COLORS: [Color32; 3] = [
    Color32::from_rgb(235, 64, 72),
    Color32::from_rgb(96, 178, 30),
    Color32::from_rgb(58, 128, 246),
];
/// Most things that are outlined one by one.
const MOST_OUTLINES: usize = 256;
const ALL: Color32 = Color32::from_gray(235);
const HOT: Color32 = Color32::from_rgb(255, 214, 64);

/// Draws the selection and its handles, and handles drags of them. Returns whether the mouse is consumed.
pub fn overlay(
    session: &mut Session,
    response: &egui::Response,
    painter: &Painter,
    viewport: Viewport,
) -> bool {
    let (Some(scene), Some(camera)) = (session.scene().cloned(), session.camera()) else {
        let_go(session);
        return false;
    };
    let mut selected = session.selected();
    selected.retain(|id| objects::is_there(&scene, *id));
    if selected.is_empty() {
        let_go(session);
        return false;
    }
    if !session.shows_overlays && session.editing.modal.is_none() {
        let_go(session);
        return false;
    }
    let view = WorldPainter::new(painter, viewport, &camera);
    let (eye, time) = (view.eye, session.playback.time);
    if session.preferences.overlays.outline {
        let marks = silhouette::draw(session, &view, &selected);
        let firm = outlines(session, &scene, &marks.firm, &view);
        view.lines(&firm, silhouette::LEAD);
        let faint = outlines(session, &scene, &marks.faint, &view);
        view.thin_lines(&faint, silhouette::OTHER.gamma_multiply(0.5));
    }
    if lamp::handles(session, &scene, &selected, response, &view) {
        return true;
    }
    let moved = objects::movable(&scene, &selected);
    let tool = session.tool;
    let common = objects::common_place(&scene, &moved, time);
    let (Some((place, free)), true) = (common, tool.entry().has_handles) else {
        let_go(session);
        return false;
    };
    let pixels = |points: f32| viewport.length(egui::vec2(points, 0.0)).x;
    let Some(handles) = Handles::new(tool, place, free, eye, pixels(LENGTH)) else {
        session.editing.modal = None;
        return false;
    };
    let ctx = &response.ctx;
    let (pointer, pressed) =
        ctx.input(|input| (input.pointer.latest_pos(), input.pointer.press_origin()));
    let (is_fine, snap) = held(session, ctx);
    let part_at = |at: Pos2| handles.part_at(eye, viewport.position(at), pixels(SLACK));
    if response.drag_started_by(egui::PointerButton::Primary)
        && let Some(pressed) = pressed
        && let Some(part) = part_at(pressed)
    {
        let grip = Grip::new(part, handles.clone(), place, viewport.position(pressed));
        session.editing.grip = Some((grip, pressed));
    }
    if let Some(modal) = &session.editing.modal
        && session.editing.grip.is_none()
        && let Some(from) = modal.begins_at(pointer, viewport.rect)
    {
        let grip = Grip::new(Part::All, handles.clone(), place, viewport.position(from));
        session.editing.grip = Some((grip, from));
    }
    if session.editing.grip.is_none()
        && session
            .editing
            .modal
            .as_ref()
            .is_some_and(|m| m.is_confirmed)
    {
        // A move that is confirmed before it began.
        session.editing.modal = None;
    }
    let Some((mut grip, last)) = session.editing.grip.take() else {
        let hovered = pointer.filter(|_| response.hovered()).and_then(part_at);
        draw_handles(&view, &handles, hovered, None);
        if hovered.is_some() {
            ctx.set_cursor_icon(egui::CursorIcon::Grab);
        }
        return false;
    };
    let now = pointer.unwrap_or(last);
    grip.move_pointer(viewport.length(now - last), is_fine);
    let mut modal = session.editing.modal.take();
    let dragged = match &modal {
        Some(modal) => {
            grip.part = modal.part(&grip.handles);
            let exact = modal.amount().map(|amount| grip.by(eye, amount));
            exact.or_else(|| grip.dragged(eye, snap))
        }
        None => grip.dragged(eye, snap),
    };
    let mut shown = handles;
    if let Some(dragged) = dragged {
        let is_news = match &mut modal {
            Some(modal) => modal.place.replace(dragged.place).unwrap_or(place) != dragged.place,
            None => now != last,
        };
        if is_news {
            let verb = match tool {
                Tool::Move => "move",
                Tool::Rotate => "rotate",
                _ => "scale",
            };
            let name = format!("{verb} {}", session.labels(&moved));
            let change = dragged.place * grip.start.inverse();
            session.drag_change(&name, |scene| match moved.as_slice() {
                [id] => objects::set_place(scene, *id, dragged.place, time),
                several => objects::transform(scene, several, change, time),
            });
        }
        shown.origin = dragged.place.translation;
        let at = now + egui::vec2(18.0, -18.0);
        match modal
            .as_ref()
            .map(Modal::typed)
            .filter(|typed| !typed.is_empty())
        {
            Some(typed) => view.text(at, &format!("{}   [{typed}]", dragged.label)),
            None => view.text(at, &dragged.label),
        };
    }
    ctx.set_cursor_icon(egui::CursorIcon::Grabbing);
    draw_handles(&view, &shown, Some(grip.part), None);
    match modal {
        Some(modal) if !modal.is_confirmed => {
            session.editing.grip = Some((grip, now));
            session.editing.modal = Some(modal);
        }
        None if response.dragged_by(egui::PointerButton::Primary) => {
            session.moved();
            session.editing.grip = Some((grip, now));
        }
        _ => {
            if let Some(document) = &mut session.document {
                document.release();
            }
        }
    }
    true
}

/// Whether a drag is slow, and how it is rounded: by the keys that are held, and the switch of the toolbar.
pub(in crate::ui) fn held(session: &Session, ctx: &egui::Context) -> (bool, Snap) {
    let bindings = &session.preferences.bindings;
    let [is_fine, is_other] = ctx.input(|input| {
        [Action::FineHandles, Action::SnapHandles].map(|action| bindings.is_held(action, input))
    });
    let snap = match (session.preferences.snaps != is_other, is_fine) {
        (false, _) => Snap::Off,
        (true, false) => Snap::Whole,
        (true, true) => Snap::Fine,
    };
    (is_fine, snap)
}

/// Ends drags without a selection.
fn let_go(session: &mut Session) {
    session.editing.grip = None;
    session.editing.lamp = None;
    session.editing.modal = None;
}

/// Draws handles in the colours of their axes or in one colour, the one under the cursor highlighted.
pub(in crate::ui) fn draw_handles(
    view: &WorldPainter,
    handles: &Handles,
    hot: Option<Part>,
    tint: Option<Color32>,
) {
    let mut parts = handles.parts.clone();
    // The nearest part is drawn last.
    let depth = |part: &Part| match part {
        Part::Axis(axis) => view
            .eye
            .depth(handles.origin + handles.axes[*axis] * handles.reach),
        Part::All => f64::NEG_INFINITY,
        _ => view.eye.depth(handles.origin),
    };
    parts.sort_by(|a, b| depth(b).total_cmp(&depth(a)));
    for part in parts {
        draw_handle(view, handles, part, hot == Some(part), tint);
    }
}

fn draw_handle(
    view: &WorldPainter,
    handles: &Handles,
    part: Part,
    is_hot: bool,
    tint: Option<Color32>,
) {
    let own = match part {
        Part::Axis(axis) | Part::Plane(axis) | Part::Ring(axis) => COLORS[axis],
        Part::All => ALL,
    };
    let color = if is_hot { HOT } else { tint.unwrap_or(own) };
    let line = handles.line(part, view.eye);
    let points: Option<Vec<Pos2>> = (line.iter())
        .map(|point| Some(view.viewport.point(view.eye.project(*point)?)))
        .collect();
    let Some(points) = points else {
        return;
    };
    let stroke = |points: Vec<Pos2>| {
        let shade = Stroke::new(5.0, SHADE);
        view.painter.add(Shape::line(points.clone(), shade));
        view.painter
            .add(Shape::line(points, Stroke::new(3.0, color)));
    };
    match part {
        Part::Axis(_) => {
            let (from, to) = (points[0], points[1]);
            stroke(vec![from, to]);
            let way = (to - from).normalized();
            let side = way.rot90();
            let tip = match handles.tool {
                Tool::Scale => {
                    let (way, side) = (way * 5.0, side * 5.0);
                    vec![
                        to + way + side,
                        to + way - side,
                        to - way - side,
                        to - way + side,
                    ]
                }
                _ => vec![to + way * 12.0, to + side * 5.5, to - side * 5.5],
            };
            let shape = Shape::convex_polygon(tip, color, Stroke::new(1.0, SHADE));
            view.painter.add(shape);
        }
        Part::Plane(_) => {
            let fill = color.gamma_multiply(if is_hot { 0.8 } else { 0.45 });
            let shape = Shape::convex_polygon(points, fill, Stroke::new(1.0, color));
            view.painter.add(shape);
        }
        Part::All if points.is_empty() => {
            if let Some(at) = view.eye.project(handles.origin) {
                let at = view.viewport.point(at);
                view.painter.circle(at, 6.5, color, Stroke::new(1.5, SHADE));
            }
        }
        Part::Ring(_) | Part::All => stroke(points),
    }
}

/// The outlines of what is selected, in world space; one box around all if they are too many to tell apart.
fn outlines(
    session: &mut Session,
    scene: &Scene,
    ids: &[Id],
    view: &WorldPainter,
) -> Vec<[DVec3; 2]> {
    let frame = scene.frame(session.playback.time);
    if ids.len() <= MOST_OUTLINES {
        return (ids.iter())
            .flat_map(|id| edges(session, scene, &frame, *id, view))
            .collect();
    }
    let places = ids
        .iter()
        .filter_map(|id| objects::place_in(scene, &frame, *id));
    let corners = places.map(|place| place.translation);
    let boxed = corners.fold(None, |bounds: Option<(DVec3, DVec3)>, point| {
        let (min, max) = bounds.unwrap_or((point, point));
        Some((min.min(point), max.max(point)))
    });
    boxed.map_or(Vec::new(), |bounds| cuboid(bounds, DAffine3::IDENTITY))
}

/// The outline of something, in world space.
fn edges(
    session: &mut Session,
    scene: &Scene,
    frame: &Frame,
    id: Id,
    view: &WorldPainter,
) -> Vec<[DVec3; 2]> {
    let place = objects::place_in(scene, frame, id);
    match (id, place) {
        (Id::Object(ObjectRef::Instance(index)), Some(place)) => {
            let mesh = &scene.meshes[scene.instances[index].mesh];
            let bounds = session.editing.bounds_of(mesh);
            bounds.map_or(Vec::new(), |bounds| cuboid(bounds, place))
        }
        (Id::Object(ObjectRef::Shape(index)), Some(place)) => {
            let unit = match scene.shapes[index].geometry {
                Geometry::Sphere { .. } => Some((DVec3::NEG_ONE, DVec3::ONE)),
                Geometry::Plane { .. } => {
                    Some((DVec3::new(-1.0, 0.0, -1.0), DVec3::new(1.0, 0.0, 1.0)))
                }
                Geometry::Placed { canonical, .. } => Geometry::Placed {
                    canonical,
                    world_from_canonical: DAffine3::IDENTITY,
                }
                .bounds(),
            };
            unit.map_or(Vec::new(), |bounds| cuboid(bounds, place))
        }
        (Id::Object(ObjectRef::Light(index)), Some(_)) => {
            frame.lights.get(index).map_or(Vec::new(), |light| {
                lamp::shown(session, view, light.kind).lines(view.eye)
            })
        }
        (Id::Node(_), Some(place)) => {
            let arm = 0.5;
            (DVec3::AXES.into_iter())
                .map(|axis| [-axis * arm, axis * arm].map(|end| place.transform_point3(end)))
                .collect()
        }
        (Id::Camera(index), _) => {
            let camera = editing::camera_in_world(scene, index, session.playback.time);
            let is_seen_through = session.camera().is_some_and(|seen| seen == camera);
            match is_seen_through {
                true => Vec::new(),
                false => pyramid(&camera),
            }
        }
        _ => Vec::new(),
    }
}

pub(in crate::ui) fn cuboid(bounds: (DVec3, DVec3), place: DAffine3) -> Vec<[DVec3; 2]> {
    let corners = corners(bounds).map(|corner| place.transform_point3(corner));
    let edges = (0..8).flat_map(|i| [1, 2, 4].map(|bit| (i, i | bit)));
    edges
        .filter(|(a, b)| a != b)
        .map(|(a, b): (usize, usize)| [corners[a], corners[b]])
        .collect()
}

/// The frustum of a camera, a quarter as deep as its view distance, with aspect 3:2.
fn pyramid(camera: &Camera) -> Vec<[DVec3; 2]> {
    let size = glam::DVec2::new(3.0, 2.0);
    let length = 0.25 * camera.look_from.distance(camera.look_at);
    let corners = [(0.0, 0.0), (3.0, 0.0), (3.0, 2.0), (0.0, 2.0)].map(|(x, y)| {
        let at = glam::DVec2::new(x, y);
        let (from, direction) = crate::model::camera::ray_through(camera, at, size);
        (from, from + direction * length)
    });
    let next = corners.iter().cycle().skip(1);
    let rim = corners.iter().zip(next).map(|(a, b)| [a.1, b.1]);
    let sides = corners.iter().map(|(from, to)| [*from, *to]);
    sides.chain(rim).collect()
}
