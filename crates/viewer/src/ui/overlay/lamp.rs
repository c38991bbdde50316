//! Handles of the selected lamp in the picture: its aim and its size.

use crate::actions::lighting;
use crate::model::handles::lamp::{Lamp, LampGrip, LampPart, change_lamp};
use crate::model::objects::{self, Id};
use crate::model::snapping::Snap;
use crate::model::tool::Tool;
use crate::state::session::Session;
use crate::ui::overlay::{ALL, HOT, SLACK, held};
use crate::ui::silhouette::LEAD;
use crate::ui::world_painter::{SHADE, WorldPainter};
use eframe::egui::{self, Pos2, Stroke, vec2};
use glam::DVec3;
use glimray_scene::{LightKind, ObjectRef, Scene};

/// Length of a direction, in points: longer than the arrows of the move tool.
const REACH: f32 = 130.0;
/// Radius of a handle, in points.
const DOT: f32 = 5.0;

/// A lamp in world space as the picture shows it.
pub fn shown(session: &Session, view: &WorldPainter, kind: LightKind) -> Lamp {
    let length = view.viewport.length(vec2(REACH, 0.0)).x;
    let pivot = session.controller.as_ref().map(|it| it.pivot());
    Lamp::new(kind, view.eye, length, pivot.unwrap_or(DVec3::ZERO))
}

/// Draws the handles of the lamp that alone is selected, and handles drags of them. Returns whether the mouse is consumed.
pub fn handles(
    session: &mut Session,
    scene: &Scene,
    selected: &[Id],
    response: &egui::Response,
    view: &WorldPainter,
) -> bool {
    let &[Id::Object(ObjectRef::Light(index))] = selected else {
        session.editing.lamp = None;
        return false;
    };
    let time = session.playback.time;
    let kind = scene.frame(time).lights.get(index).map(|light| light.kind);
    let is_free = session.editing.grip.is_none() && session.editing.modal.is_none();
    let is_fitting = session.preferences.overlays.lamps
        && (session.tool == Tool::Select || session.tool.entry().has_handles);
    let (Some(kind), true, true) = (kind, is_free, is_fitting) else {
        session.editing.lamp = None;
        return false;
    };
    let lamp = shown(session, view, kind);
    let free = objects::freedom(scene, selected[0]);
    let slack = view.viewport.length(vec2(SLACK, 0.0)).x;
    let part_at = |at: Pos2| lamp.part_at(view.eye, free, view.viewport.position(at), slack);
    let ctx = &response.ctx;
    let (pointer, pressed) =
        ctx.input(|input| (input.pointer.latest_pos(), input.pointer.press_origin()));
    let (is_fine, snap) = held(session, ctx);
    if response.drag_started_by(egui::PointerButton::Primary)
        && let Some(pressed) = pressed
        && let Some(part) = part_at(pressed)
    {
        let from = view.viewport.position(pressed);
        let grip = LampGrip::new(index, part, lamp.clone(), from);
        session.editing.lamp = Some((grip, pressed));
    }
    let held = session.editing.lamp.take();
    let Some((mut grip, last)) = held.filter(|(grip, _)| grip.light == index) else {
        let hot = pointer.filter(|_| response.hovered()).and_then(part_at);
        dots(view, &lamp.handles(view.eye, free), hot);
        if let (Some(part), Some(pointer)) = (hot, pointer) {
            ctx.set_cursor_icon(egui::CursorIcon::Grab);
            view.text(pointer + vec2(18.0, -18.0), part.title());
        }
        return false;
    };
    let now = pointer.unwrap_or(last);
    grip.move_pointer(view.viewport.length(now - last), is_fine);
    if let Some((change, label)) = grip.dragged(view.eye, snap) {
        if now != last {
            let verb = match grip.part {
                LampPart::Aim => "aim",
                _ => "resize",
            };
            let name = format!("{verb} {}", session.label(selected[0]));
            session.drag_change(&name, |scene| {
                change_lamp(scene, index, grip.part, change, time)
            });
        }
        if let (LampPart::Aim, Some(from)) = (grip.part, view.eye.project(lamp.at)) {
            let ends = [view.viewport.point(from), now];
            view.painter.line_segment(ends, Stroke::new(1.0, HOT));
        }
        view.text(now + vec2(18.0, -18.0), &label);
    }
    ctx.set_cursor_icon(egui::CursorIcon::Grabbing);
    dots(view, &lamp.handles(view.eye, free), Some(grip.part));
    if response.dragged_by(egui::PointerButton::Primary) {
        session.moved();
        session.editing.lamp = Some((grip, now));
    } else {
        if let Some(document) = &mut session.document {
            document.release();
        }
        let is_finite = !matches!(lamp.kind, LightKind::Directional { .. });
        if grip.part == LampPart::Aim && is_finite && snap == Snap::Off {
            lighting::aim_at_surface(session, index, view.viewport.pixel(now));
        }
    }
    true
}

fn dots(view: &WorldPainter, handles: &[(LampPart, DVec3)], hot: Option<LampPart>) {
    for (part, at) in handles {
        let Some(at) = view.eye.project(*at) else {
            continue;
        };
        let color = match part {
            _ if hot == Some(*part) => HOT,
            LampPart::Aim => ALL,
            _ => LEAD,
        };
        let at = view.viewport.point(at);
        view.painter.circle(at, DOT, color, Stroke::new(1.5, SHADE));
    }
}
