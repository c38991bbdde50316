//! The frame of the scene's own size over a picture of other proportions.

use crate::model::viewport::Viewport;
use crate::ui::panels::picture::caption::label;
use eframe::egui::{Align2, Color32, Painter, Stroke, StrokeKind};

/// Proportions that differ by less than this share are the same.
const SAME: f32 = 0.005;

/// Draws the frame of a picture of the scene's `size` over the picture at `viewport`. Both have the same height,
/// because the field of view is vertical. A frame wider than the window is named in a label.
pub fn framing(painter: &Painter, viewport: Viewport, size: (u32, u32)) {
    let aspect = |(width, height): (u32, u32)| width as f32 / height.max(1) as f32;
    let ratio = aspect(size) / aspect(viewport.size);
    if (ratio - 1.0).abs() < SAME {
        return;
    }
    let (width, height) = size;
    let rect = viewport.framing(size);
    let visible = rect.intersect(viewport.rect).intersect(painter.clip_rect());
    let name = match ratio > 1.0 {
        true => format!("Scene size {width}×{height} shows more on both sides"),
        false => format!("Scene size {width}×{height}"),
    };
    if ratio < 1.0 {
        let dark = Stroke::new(3.0, Color32::from_black_alpha(120));
        let light = Stroke::new(1.0, Color32::from_gray(230));
        painter.rect_stroke(rect, 0.0, dark, StrokeKind::Middle);
        painter.rect_stroke(rect, 0.0, light, StrokeKind::Middle);
    }
    label(painter, visible.right_bottom(), Align2::RIGHT_BOTTOM, name);
}
