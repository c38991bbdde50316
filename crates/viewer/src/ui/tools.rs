//! The overlays of the tools. The handles of the selection are in `overlay.rs`.

use crate::actions::{lighting, measuring};
use crate::model::environment::BackgroundLight;
use crate::model::tool::{BoxMode, Tool};
use crate::model::viewport::Viewport;
use crate::state::session::Session;
use crate::ui::panels::rays;
use crate::ui::sun_dial::SunDial;
use crate::ui::world_painter::{SHADE, WorldPainter, inside};
use eframe::egui::{Align2, Color32, FontId, Painter, Rect, Stroke, StrokeKind, Vec2, vec2};
use glimray_app::legend::number;

/// Radius of the map of the sky, in points.
const DIAL: f32 = 34.0;
/// The colour of measurements.
const MEASURE: Color32 = Color32::from_rgb(255, 214, 64);

/// Draws the overlay of the active tool.
pub fn draw(painter: &Painter, session: &Session, viewport: Viewport) {
    turned_light(painter, session, viewport);
    frame(painter, session);
    if !session.shows_overlays {
        return;
    }
    match session.tool {
        Tool::Inspect => {
            rays::path(painter, session, viewport);
            if let Some(pixel) = session.inspector.pixel {
                inspected_pixel(painter, pixel, viewport);
            }
        }
        Tool::Measure => measurement(painter, session, viewport),
        Tool::Select | Tool::Box | Tool::Region | Tool::Move | Tool::Rotate | Tool::Scale => {}
    }
}

/// While the light of the background is being turned, shows its numbers beside the pointer, and where the sun stands.
fn turned_light(painter: &Painter, session: &Session, viewport: Viewport) {
    if !lighting::is_turning(session) {
        return;
    }
    let light = session.scene().and_then(|scene| BackgroundLight::of(scene));
    let pointer = painter.ctx().pointer_latest_pos();
    let (Some(light), Some(pointer), Some(camera)) = (light, pointer, session.camera()) else {
        return;
    };
    let view = WorldPainter::new(painter, viewport, &camera);
    let text = view.text(pointer + vec2(18.0, -18.0), &light.label());
    if let Some(sun) = light.sun_deg() {
        let above = text.left_top() + vec2(DIAL, -DIAL - 6.0);
        let place = Rect::from_center_size(above, Vec2::splat(2.0 * DIAL));
        let dial = SunDial {
            center: inside(place, painter.clip_rect()).center(),
            radius: DIAL,
        };
        dial.paint(painter, sun, Some(view.eye.forward()));
    }
}

/// Draws all measurements: their points, the lines between them and their lengths.
fn measurement(painter: &Painter, session: &Session, viewport: Viewport) {
    let Some(camera) = session.camera() else {
        return;
    };
    let view = WorldPainter::new(painter, viewport, &camera);
    let state = &session.tool_state;
    let lines = state.measurements();
    view.lines(&lines, MEASURE);
    let ends = lines.iter().flatten().chain(&state.measured);
    for point in ends {
        if let Some(at) = view.eye.project(*point) {
            let border = Stroke::new(1.5, SHADE);
            painter.circle(viewport.point(at), 4.0, MEASURE, border);
        }
    }
    let pointer = painter.ctx().pointer_hover_pos();
    let pixel = pointer.and_then(|at| viewport.pixel(at));
    let vertex = pixel.and_then(|pixel| measuring::vertex_under(session, pixel));
    if let Some(at) = vertex.and_then(|vertex| view.eye.project(vertex)) {
        let at = viewport.point(at);
        painter.circle_stroke(at, 6.0, Stroke::new(3.0, SHADE));
        painter.circle_stroke(at, 6.0, Stroke::new(1.5, MEASURE));
    }
    let current = state.measured_line();
    for ends in lines {
        let [a, b] = ends;
        let Some([from, to]) = view.segment(ends) else {
            continue;
        };
        let number = |length: f64| number(length as f32);
        let mut text = number(a.distance(b));
        if current == Some(ends) {
            let [x, y, z] = (b - a).to_array().map(number);
            text += &format!("   Δx {x}   Δy {y}   Δz {z}");
        }
        view.text(from.lerp(to, 0.5) + vec2(8.0, -8.0), &text);
    }
}

/// Draws the rectangle of a box selection.
fn frame(painter: &Painter, session: &Session) {
    let Some(drag) = session.tool_state.frame else {
        return;
    };
    let rect = Rect::from_two_pos(drag.from, drag.to);
    let (ink, sign) = match drag.mode {
        BoxMode::Only => (Color32::WHITE, None),
        BoxMode::Add => (Color32::from_rgb(150, 230, 120), Some("+")),
        BoxMode::Remove => (Color32::from_rgb(255, 140, 130), Some("−")),
    };
    painter.rect_filled(rect, 0.0, ink.gamma_multiply(0.08));
    let dark = Stroke::new(3.0, SHADE);
    painter.rect_stroke(rect, 0.0, dark, StrokeKind::Middle);
    let bright = Stroke::new(1.0, ink);
    painter.rect_stroke(rect, 0.0, bright, StrokeKind::Middle);
    if let Some(sign) = sign {
        let at = drag.to + vec2(14.0, 14.0);
        let font = FontId::proportional(20.0);
        painter.text(at, Align2::CENTER_CENTER, sign, font, ink);
    }
}

/// Marks the inspected pixel.
fn inspected_pixel(painter: &Painter, [x, y]: [u32; 2], viewport: Viewport) {
    let pixel = viewport.part([x, y, 1, 1]);
    let frame = pixel.expand(3.0);
    let center = frame.center();
    let reach = frame.width() / 2.0;
    // Light on dark is visible on any picture.
    for (width, ink) in [(3.0, Color32::from_black_alpha(180)), (1.0, Color32::WHITE)] {
        let stroke = Stroke::new(width, ink);
        painter.rect_stroke(frame, 1.0, stroke, StrokeKind::Middle);
        for way in [
            vec2(1.0, 0.0),
            vec2(-1.0, 0.0),
            vec2(0.0, 1.0),
            vec2(0.0, -1.0),
        ] {
            let arm = [center + way * (reach + 2.0), center + way * (reach + 9.0)];
            painter.line_segment(arm, stroke);
        }
    }
}
