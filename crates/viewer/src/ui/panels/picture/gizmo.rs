//! The axes of the world in a corner of the picture. A click on an end looks along that axis; a drag orbits.

use crate::model::bindings::Action;
use crate::model::camera::Side;
use crate::state::session::Session;
use crate::ui::overlay::COLORS;
use eframe::egui::{
    self, Align2, Color32, FontId, Painter, Pos2, Rect, Response, Sense, Stroke, Ui, Vec2, vec2,
};
use glam::{DVec2, DVec3};
use glimray_scene::Camera;

/// Length of an axis, radius of its end, and distance of the middle from the corner, in points.
const LENGTH: f32 = 26.0;
const END: f32 = 8.0;
const CORNER: Vec2 = vec2(-44.0, 44.0);

/// An end of an axis.
struct End {
    axis: usize,
    is_positive: bool,
    /// The direction in world space.
    way: DVec3,
    at: Pos2,
    /// Towards the eye.
    depth: f64,
}

/// The command that looks from a side.
fn action(side: Side) -> Action {
    match side {
        Side::Front => Action::ViewFront,
        Side::Back => Action::ViewBack,
        Side::Right => Action::ViewRight,
        Side::Left => Action::ViewLeft,
        Side::Top => Action::ViewTop,
        Side::Bottom => Action::ViewBottom,
    }
}

/// Draws the axes in the upper right corner of `room`, and takes the mouse there.
pub fn gizmo(ui: &mut Ui, session: &mut Session, room: Rect) {
    let Some(camera) = session.camera() else {
        return;
    };
    let middle = room.right_top() + CORNER;
    let reach = LENGTH + END;
    let around = Rect::from_center_size(middle, Vec2::splat(2.0 * reach));
    let id = ui.scope_id().with("axes");
    // The mouse only: each end is a button.
    let whole = ui.interact(around, id, Sense::CLICK | Sense::DRAG);
    let painter = ui.painter().clone();
    if whole.hovered() || whole.dragged() {
        painter.circle_filled(middle, reach, Color32::from_black_alpha(90));
    }
    let mut ends = ends(&camera, middle);
    ends.sort_by(|a, b| a.depth.total_cmp(&b.depth));
    orbit(session, &whole, around);
    for end in &ends {
        let Some(controller) = &session.controller else {
            return;
        };
        let action = action(controller.side_towards(end.way));
        let rect = Rect::from_center_size(end.at, Vec2::splat(2.0 * END));
        let name = action.description();
        let response = ui.interact(
            rect,
            id.with((end.axis, end.is_positive)),
            Sense::click_and_drag(),
        );
        response.widget_info(|| egui::WidgetInfo::labeled(egui::Role::Button, true, name));
        orbit(session, &response, around);
        draw(&painter, end, middle, response.hovered());
        let tip = session.preferences.bindings.tip(name, action);
        if response.on_hover_text(tip).clicked() {
            session.clicked.push(action);
        }
    }
}

fn orbit(session: &mut Session, response: &Response, around: Rect) {
    if response.drag_started() {
        session.camera_history.end_gesture();
    }
    let moved = response.drag_delta();
    if response.dragged()
        && moved != Vec2::ZERO
        && let Some(controller) = &mut session.controller
    {
        let size = DVec2::new(around.width().into(), around.height().into());
        controller.orbit(DVec2::new(moved.x.into(), moved.y.into()), 2.0 * size);
        session.moved();
    }
}

/// Both ends of each axis as the camera sees them.
fn ends(camera: &Camera, middle: Pos2) -> Vec<End> {
    let forward = (camera.look_at - camera.look_from).normalize_or(DVec3::NEG_Z);
    let right = forward.cross(camera.up).normalize_or(DVec3::X);
    let up = right.cross(forward);
    let axes = [DVec3::X, DVec3::Y, DVec3::Z].into_iter().enumerate();
    axes.flat_map(|(axis, way)| {
        [1.0, -1.0].map(|sign| {
            let way = way * sign;
            let shift = vec2(way.dot(right) as f32, -way.dot(up) as f32);
            End {
                axis,
                is_positive: sign > 0.0,
                way,
                at: middle + LENGTH * shift,
                depth: -way.dot(forward),
            }
        })
    })
    .collect()
}

fn draw(painter: &Painter, end: &End, middle: Pos2, is_hovered: bool) {
    let color = COLORS[end.axis];
    // Ends that point away are darker.
    let share = if end.depth < -0.1 { 0.65 } else { 1.0 };
    let color = Color32::from_rgb(
        (f32::from(color.r()) * share) as u8,
        (f32::from(color.g()) * share) as u8,
        (f32::from(color.b()) * share) as u8,
    );
    let edge = match is_hovered {
        true => Stroke::new(1.5, Color32::WHITE),
        false => Stroke::new(1.0, Color32::from_black_alpha(140)),
    };
    if end.is_positive {
        painter.line_segment([middle, end.at], Stroke::new(2.5, color));
        painter.circle(end.at, END, color, edge);
        let letter = ["x", "y", "z"][end.axis];
        let font = FontId::proportional(12.0);
        painter.text(end.at, Align2::CENTER_CENTER, letter, font, Color32::BLACK);
    } else {
        painter.circle(end.at, END - 2.0, color.gamma_multiply(0.45), edge);
    }
}
