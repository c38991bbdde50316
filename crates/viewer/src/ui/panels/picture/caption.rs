//! Short texts over the picture.

use eframe::egui::{self, Align2, Color32, FontId, Pos2, Rect, Vec2};

/// A text in a corner, to be read on any picture. Returns its rectangle.
pub fn label(painter: &egui::Painter, corner: Pos2, align: Align2, text: String) -> Rect {
    let font = FontId::proportional(13.0);
    let galley = painter.layout_no_wrap(text, font, Color32::WHITE);
    let margin = Vec2::new(6.0, 3.0);
    let inward = |align: egui::Align| match align {
        egui::Align::Max => -8.0,
        _ => 8.0,
    };
    let corner = corner + Vec2::new(inward(align.x()), inward(align.y()));
    let rect = align.anchor_size(corner, galley.size() + 2.0 * margin);
    painter.rect_filled(rect, 4.0, Color32::from_black_alpha(160));
    painter.galley(rect.min + margin, galley, Color32::WHITE);
    rect
}
