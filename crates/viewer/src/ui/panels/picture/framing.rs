//! The frame of the scene's own size over a picture of other proportions.

use crate::model::viewport::Viewport;
use crate::ui::panels::icon;
use crate::ui::panels::picture::caption::label;
use crate::ui::panels::sign::{self, Sign};
use eframe::egui::{
    self, Align2, Color32, Painter, Pos2, Role, Sense, Stroke, StrokeKind, WidgetInfo, vec2,
};

/// Proportions that differ by less than this share are the same.
const SAME: f32 = 0.005;

/// Draws the frame of a picture of the scene's `size` over the picture at `viewport`. Both have the same height,
/// because the field of view is vertical. Of a frame that is wider than the window, a sign in the corner tells.
pub fn framing(ui: &egui::Ui, painter: &Painter, viewport: Viewport, size: (u32, u32)) {
    let aspect = |(width, height): (u32, u32)| width as f32 / height.max(1) as f32;
    let ratio = aspect(size) / aspect(viewport.size);
    if (ratio - 1.0).abs() < SAME {
        return;
    }
    let (width, height) = size;
    let rect = viewport.framing(size);
    let visible = rect.intersect(viewport.rect).intersect(painter.clip_rect());
    if ratio > 1.0 {
        let told = format!("Scene size {width}×{height} shows more on both sides");
        wider(ui, painter, visible.right_bottom(), &told);
        return;
    }
    let dark = Stroke::new(3.0, Color32::from_black_alpha(120));
    let light = Stroke::new(1.0, Color32::from_gray(230));
    painter.rect_stroke(rect, 0.0, dark, StrokeKind::Middle);
    painter.rect_stroke(rect, 0.0, light, StrokeKind::Middle);
    let name = format!("Scene size {width}×{height}");
    label(painter, visible.right_bottom(), Align2::RIGHT_BOTTOM, name);
}

/// A sign with a tooltip.
fn wider(ui: &egui::Ui, painter: &Painter, corner: Pos2, told: &str) {
    let rect = Align2::RIGHT_BOTTOM.anchor_size(corner - vec2(8.0, 8.0), vec2(24.0, 20.0));
    painter.rect_filled(rect, 4.0, Color32::from_black_alpha(160));
    sign::draw(painter, Sign::Framing, rect.center(), Color32::WHITE);
    let id = ui.scope_id().with(("scene size", corner.x.round() as i32));
    let response = ui.interact(rect, id, Sense::hover());
    response.widget_info(|| WidgetInfo::labeled(Role::Label, true, told));
    icon::named(&response, told);
    response.on_hover_text(told);
}
