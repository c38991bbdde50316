//! The handle of the section plane in the picture: an arrow moves the plane, two rings tilt it.

use crate::model::handles::{Grip, Handles, LENGTH, Part};
use crate::model::tool::Tool;
use crate::model::viewport::Viewport;
use crate::state::session::Session;
use crate::ui::overlay::{SLACK, draw_handles, held};
use crate::ui::world_painter::WorldPainter;
use eframe::egui::{self, Color32, Painter, PointerButton, Pos2, vec2};
use glam::{DAffine3, DMat3, DVec3};
use glimray_app::legend::number;
use glimray_scene::Section;

/// The colour of the handle and of the plane.
const COLOR: Color32 = Color32::from_rgb(64, 200, 220);
/// The radius of the rings, as a share of the arrow's length.
const RINGS: f64 = 0.7;

/// The parts of the handle.
struct Gizmo {
    arrow: Handles,
    rings: Handles,
    /// From the plane's own axes, of which the third is its normal, to the world.
    place: DAffine3,
}

impl Gizmo {
    /// The handle of a plane at the point of it that is nearest to `middle`.
    fn new(section: Section, middle: DVec3, reach: f64) -> Self {
        let (origin, normal) = (section.nearest_to(middle), section.normal);
        let (u, v) = normal.any_orthonormal_pair();
        let handles = |tool, parts, reach| Handles {
            tool,
            origin,
            axes: [u, v, normal],
            reach,
            parts,
        };
        Self {
            arrow: handles(Tool::Move, vec![Part::Axis(2)], reach),
            rings: handles(
                Tool::Rotate,
                vec![Part::Ring(0), Part::Ring(1)],
                RINGS * reach,
            ),
            place: DAffine3::from_mat3_translation(DMat3::from_cols(u, v, normal), origin),
        }
    }

    /// The handles of one part.
    fn of(&self, part: Part) -> &Handles {
        match part {
            Part::Axis(_) => &self.arrow,
            _ => &self.rings,
        }
    }

    /// The part within reach of a point of the screen.
    fn part_at(&self, view: &WorldPainter, at: Pos2) -> Option<Part> {
        let slack = view.viewport.length(vec2(SLACK, 0.0)).x;
        let at = view.viewport.position(at);
        let arrow = self.arrow.part_at(view.eye, at, slack);
        arrow.or_else(|| self.rings.part_at(view.eye, at, slack))
    }

    fn draw(&self, view: &WorldPainter, half: f64, hot: Option<Part>) {
        let corners = [(-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0)]
            .map(|(x, y)| self.place.transform_point3(DVec3::new(x, y, 0.0) * half));
        let next = corners.iter().cycle().skip(1);
        let edges: Vec<_> = corners.iter().zip(next).map(|(a, b)| [*a, *b]).collect();
        let share = if hot.is_some() { 0.9 } else { 0.45 };
        view.thin_lines(&edges, COLOR.gamma_multiply(share));
        draw_handles(view, &self.rings, hot, Some(COLOR));
        draw_handles(view, &self.arrow, hot, Some(COLOR));
    }
}

/// Draws the handle and drags it. Returns whether the mouse is consumed.
pub fn handle(
    session: &mut Session,
    response: &egui::Response,
    painter: &Painter,
    viewport: Viewport,
) -> bool {
    let is_shown = session.shows_overlays
        && session.preferences.overlays.section
        && session.editing.modal.is_none()
        && session.editing.grip.is_none();
    let (scene, camera) = (session.scene().cloned(), session.camera());
    let (Some(scene), Some(camera), true) = (scene, camera, is_shown) else {
        session.editing.section = None;
        return false;
    };
    let Some((section, bounds)) = scene.section.zip(session.editing.subject_of(&scene)) else {
        session.editing.section = None;
        return false;
    };
    let view = WorldPainter::new(painter, viewport, &camera);
    let eye = view.eye;
    let middle = bounds.0.midpoint(bounds.1);
    let half = 0.5 * bounds.0.distance(bounds.1);
    let length = viewport.length(vec2(LENGTH, 0.0)).x;
    let origin = section.nearest_to(middle);
    if eye.project(origin).is_none() {
        session.editing.section = None;
        return false;
    }
    let gizmo = Gizmo::new(section, middle, eye.pixel_at(origin) * length);
    begin(session, response, &view, &gizmo);
    let Some((grip, last)) = session.editing.section.take() else {
        let pointer = response.hover_pos();
        let hovered = pointer.and_then(|at| gizmo.part_at(&view, at));
        gizmo.draw(&view, half, hovered);
        if hovered.is_some() {
            response.ctx.set_cursor_icon(egui::CursorIcon::Grab);
        }
        return false;
    };
    drag(session, response, &view, (gizmo, half), (grip, last));
    true
}

/// Takes the part of the handle on which the button was pressed.
fn begin(session: &mut Session, response: &egui::Response, view: &WorldPainter, gizmo: &Gizmo) {
    let pressed = response.ctx.input(|input| input.pointer.press_origin());
    if response.drag_started_by(PointerButton::Primary)
        && let Some(pressed) = pressed
        && let Some(part) = gizmo.part_at(view, pressed)
    {
        let handles = gizmo.of(part).clone();
        let from = view.viewport.position(pressed);
        let grip = Grip::new(part, handles, gizmo.place, from);
        session.editing.section = Some((grip, pressed));
    }
}

/// Goes on with a drag, and ends it when the button is released.
fn drag(
    session: &mut Session,
    response: &egui::Response,
    view: &WorldPainter,
    (gizmo, half): (Gizmo, f64),
    (mut grip, last): (Grip, Pos2),
) {
    let ctx = &response.ctx;
    let section = session.scene().and_then(|scene| scene.section);
    let (is_fine, snap) = held(session, ctx);
    let now = ctx
        .input(|input| input.pointer.latest_pos())
        .unwrap_or(last);
    grip.move_pointer(view.viewport.length(now - last), is_fine);
    let mut shown = gizmo;
    if let (Some(dragged), Some(section)) = (grip.dragged(view.eye, snap), section) {
        let (to, name, label) = moved(&grip, dragged.place, &dragged.label, section);
        if to != section && now != last {
            session.drag_change(name, |scene| {
                scene.section = Some(to);
                Ok(())
            });
        }
        shown = Gizmo::new(to, dragged.place.translation, shown.arrow.reach);
        view.text(now + vec2(18.0, -18.0), &label);
    }
    ctx.set_cursor_icon(egui::CursorIcon::Grabbing);
    shown.draw(view, half, Some(grip.part));
    if response.dragged_by(PointerButton::Primary) {
        session.moved();
        session.editing.section = Some((grip, now));
    } else if let Some(document) = &mut session.document {
        document.release();
    }
}

/// The plane after a drag, the name of the edit, and what is shown beside the pointer.
fn moved(
    grip: &Grip,
    place: DAffine3,
    label: &str,
    before: Section,
) -> (Section, &'static str, String) {
    match grip.part {
        Part::Axis(_) => {
            let offset = before.normal.dot(place.translation);
            let to = Section { offset, ..before };
            let label = format!("offset {}   {label}", number(offset as f32));
            (to, "move section plane", label)
        }
        _ => {
            let normal = place.matrix3.z_axis.normalize_or(before.normal);
            let to = Section {
                normal,
                offset: normal.dot(place.translation),
            };
            (to, "tilt section plane", label.to_owned())
        }
    }
}
