//! The colour legend of a view that shows a quantity, with its range and unit.

use crate::ui::panels::icon;
use crate::worker::progressive_image::Shown;
use eframe::egui::{
    self, Align2, Color32, FontId, Mesh, Rect, Sense, Shape, Stroke, StrokeKind, vec2,
};
use glimray_app::legend::{number, sentence, stops};
use glimray_render::{Integrator, Quantity};

/// Size of the bar and the margin around it, in points.
const BAR: egui::Vec2 = vec2(150.0, 10.0);
const MARGIN: f32 = 8.0;

/// Draws the legend of a picture in `rect`, in its lower left corner, or in the lower right one if
/// `is_right`.
pub fn legend(
    ui: &egui::Ui,
    painter: &egui::Painter,
    shown: &Shown,
    integrator: Integrator,
    (rect, is_right): (Rect, bool),
) {
    let (Some(quantity), Some(range)) = (integrator.quantity(), shown.range) else {
        return;
    };
    let font = FontId::proportional(12.0);
    let text = |text: String| painter.layout_no_wrap(text, font.clone(), Color32::WHITE);
    let [least, most] = range.map(number);
    // The range excludes a few outliers at both ends.
    let (least, most) = match quantity {
        Quantity::Samples => (least, most),
        _ => (format!("≤ {least}"), format!("≥ {most}")),
    };
    let (least, most) = (text(least), text(most));
    let unit = text(quantity.unit().to_owned());
    let size = BAR + vec2(2.0 * MARGIN, 3.0 * MARGIN + 2.0 + least.size().y);
    let corner = match is_right {
        true => Align2::RIGHT_BOTTOM.anchor_size(rect.right_bottom() - vec2(8.0, 8.0), size),
        false => Align2::LEFT_BOTTOM.anchor_size(rect.left_bottom() + vec2(8.0, -8.0), size),
    };
    painter.rect_filled(corner, 4.0, Color32::from_black_alpha(190));
    let bar = Rect::from_min_size(corner.min + vec2(MARGIN, MARGIN), BAR);
    painter.add(gradient(bar, stops(quantity)));
    let edge = Stroke::new(1.0, Color32::from_gray(160));
    painter.rect_stroke(bar, 0.0, edge, StrokeKind::Outside);
    let below = bar.max.y + MARGIN;
    let right = bar.max.x - most.size().x;
    let middle = bar.center().x - unit.size().x / 2.0;
    for (x, galley) in [(bar.min.x, least), (middle, unit), (right, most)] {
        painter.galley(egui::pos2(x, below), galley, Color32::WHITE);
    }
    let id = ui.scope_id().with(("legend", is_right));
    let response = ui.interact(corner.intersect(painter.clip_rect()), id, Sense::hover());
    let told = format!("Legend: {}", sentence(quantity, range));
    response.widget_info(|| egui::WidgetInfo::labeled(egui::Role::Label, true, &told));
    icon::named(&response, &told);
}

/// A bar with a colour gradient.
fn gradient(bar: Rect, colors: &[[u8; 3]]) -> Shape {
    let mut mesh = Mesh::default();
    let last = colors.len().saturating_sub(1).max(1) as f32;
    for (index, &[red, green, blue]) in colors.iter().enumerate() {
        let color = Color32::from_rgb(red, green, blue);
        let x = bar.min.x + bar.width() * index as f32 / last;
        mesh.colored_vertex(egui::pos2(x, bar.min.y), color);
        mesh.colored_vertex(egui::pos2(x, bar.max.y), color);
        if index > 0 {
            let first = 2 * index as u32 - 2;
            mesh.add_triangle(first, first + 1, first + 2);
            mesh.add_triangle(first + 1, first + 2, first + 3);
        }
    }
    Shape::mesh(mesh)
}
