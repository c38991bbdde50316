//! The overlays of the tools. The handles of the selection are in `overlay.rs`.

use crate::viewer::model::tool::Tool;
use crate::viewer::model::viewport::Viewport;
use crate::viewer::state::session::Session;
use eframe::egui::{Color32, Painter, Stroke, StrokeKind, vec2};

/// Draws the overlay of the active tool.
pub fn draw(painter: &Painter, session: &Session, viewport: Viewport) {
    if !session.shows_overlays {
        return;
    }
    match session.tool {
        Tool::Inspect => {
            if let Some(pixel) = session.inspector.pixel {
                inspected_pixel(painter, pixel, viewport);
            }
        }
        Tool::Select | Tool::Region | Tool::Move | Tool::Rotate | Tool::Scale => {}
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
