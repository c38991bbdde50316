//! The outline of the render region.

use crate::model::viewport::Viewport;
use eframe::egui::{self, Color32, Stroke, StrokeKind};

/// Draws the edges, to be seen on any picture.
pub fn outline(painter: &egui::Painter, viewport: Viewport, region: [u32; 4]) {
    let rect = viewport.part(region);
    let dark = Stroke::new(3.0, Color32::from_black_alpha(140));
    painter.rect_stroke(rect, 0.0, dark, StrokeKind::Middle);
    painter.rect_stroke(
        rect,
        0.0,
        Stroke::new(1.0, Color32::WHITE),
        StrokeKind::Middle,
    );
}
