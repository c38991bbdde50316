//! The overlays of the tools. The handles of the selection are in `overlay.rs`.

use crate::model::handles::Eye;
use crate::model::tool::Tool;
use crate::model::viewport::Viewport;
use crate::state::session::Session;
use crate::ui::panels::rays;
use crate::ui::world_painter::{SHADE, WorldPainter};
use eframe::egui::{Color32, Painter, Stroke, StrokeKind, vec2};
use glimray_app::legend::number;

/// The colour of measurements.
const MEASURE: Color32 = Color32::from_rgb(255, 214, 64);

/// Draws the overlay of the active tool.
pub fn draw(painter: &Painter, session: &Session, viewport: Viewport) {
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
        Tool::Select | Tool::Region | Tool::Move | Tool::Rotate | Tool::Scale => {}
    }
}

/// Draws the measured points, the line between them and its length.
fn measurement(painter: &Painter, session: &Session, viewport: Viewport) {
    let Some(camera) = session.camera() else {
        return;
    };
    let view = WorldPainter {
        painter,
        viewport,
        eye: Eye {
            camera: &camera,
            size: viewport.extent(),
        },
    };
    let line = session.tool_state.measured_line();
    if let Some(ends) = line {
        view.lines(&[ends], MEASURE);
    }
    for point in &session.tool_state.measured {
        if let Some(at) = view.eye.project(*point) {
            let border = Stroke::new(1.5, SHADE);
            painter.circle(viewport.point(at), 4.0, MEASURE, border);
        }
    }
    if let Some([a, b]) = line
        && let Some([from, to]) = view.segment([a, b])
    {
        let beside = from.lerp(to, 0.5) + vec2(8.0, -8.0);
        view.text(beside, &number(a.distance(b) as f32));
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
