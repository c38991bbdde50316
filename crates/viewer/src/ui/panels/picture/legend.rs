//! The colour legends of views that show a quantity or luminance, and of error maps.

use crate::ui::panels::icon;
use crate::worker::error_map::{ErrorMap, Measure};
use crate::worker::progressive_image::Shown;
use eframe::egui::{
    self, Align2, Color32, FontId, Mesh, Rect, Sense, Shape, Stroke, StrokeKind, vec2,
};
use glimray_app::false_color;
use glimray_app::legend::{ERRORS, number, sentence, stops};
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
    let [least, most] = range.map(number);
    // The range excludes a few outliers at both ends.
    let (least, most) = match quantity {
        Quantity::Samples => (least, most),
        _ => (format!("≤ {least}"), format!("≥ {most}")),
    };
    let told = format!("Legend: {}", sentence(quantity, range));
    let texts = [(0.0, least), (0.5, quantity.unit().to_owned()), (1.0, most)];
    let colors = |bar| gradient(bar, stops(quantity));
    place(ui, painter, (rect, is_right), &texts, colors, &told);
}

/// Draws the legend of an error map in the lower left corner of `rect`.
pub fn errors(ui: &egui::Ui, painter: &egui::Painter, map: ErrorMap, rect: Rect) {
    let most = number(1.0 / map.gain);
    let end = match map.measure {
        // There is no more.
        Measure::Flip if map.gain <= 1.0 => most.clone(),
        _ => format!("≥ {most}"),
    };
    let title = map.measure.title();
    let told = format!("Legend: {title} from 0 (black) to {most} (pale yellow)");
    let texts = [(0.0, "0".to_owned()), (1.0, end)];
    let colors = |bar| gradient(bar, ERRORS);
    place(ui, painter, (rect, false), &texts, colors, &told);
}

/// Draws the legend of luminance in false colours.
pub fn stops_of_light(ui: &egui::Ui, painter: &egui::Painter, place_of: (Rect, bool)) {
    let [first, last] = false_color::ENDS;
    let count = (last - first + 1) as f32;
    let texts: Vec<_> = (first..=last)
        .filter(|stop| stop % 3 == 0)
        .map(|stop| {
            let text = match stop {
                0 => "0 EV".to_owned(),
                stop if stop == first => format!("≤ −{}", -stop),
                stop if stop == last => format!("≥ +{stop}"),
                stop if stop < 0 => format!("−{}", -stop),
                stop => format!("+{stop}"),
            };
            (((stop - first) as f32 + 0.5) / count, text)
        })
        .collect();
    let told = format!(
        "Legend: luminance in stops from middle grey (0.18), {first} to +{last} EV, one colour each"
    );
    let cells = |bar: Rect| {
        let mut mesh = Mesh::default();
        let width = bar.width() / count;
        for (index, &[red, green, blue]) in false_color::COLORS.iter().enumerate() {
            let corner = bar.min + vec2(index as f32 * width, 0.0);
            let cell = Rect::from_min_size(corner, vec2(width, bar.height()));
            mesh.add_colored_rect(cell, Color32::from_rgb(red, green, blue));
        }
        Shape::mesh(mesh)
    };
    place(ui, painter, place_of, &texts, cells, &told);
}

/// Draws a bar in a lower corner of `rect`, and below it texts, each at its place from 0 to 1. `told` is what a screen reader
/// says.
fn place(
    ui: &egui::Ui,
    painter: &egui::Painter,
    (rect, is_right): (Rect, bool),
    texts: &[(f32, String)],
    colors: impl FnOnce(Rect) -> Shape,
    told: &str,
) {
    let font = FontId::proportional(12.0);
    let height = ui.fonts_mut(|fonts| fonts.row_height(&font));
    let size = BAR + vec2(2.0 * MARGIN, 3.0 * MARGIN + 2.0 + height);
    let corner = match is_right {
        true => Align2::RIGHT_BOTTOM.anchor_size(rect.right_bottom() - vec2(8.0, 8.0), size),
        false => Align2::LEFT_BOTTOM.anchor_size(rect.left_bottom() + vec2(8.0, -8.0), size),
    };
    painter.rect_filled(corner, 4.0, Color32::from_black_alpha(190));
    let bar = Rect::from_min_size(corner.min + vec2(MARGIN, MARGIN), BAR);
    painter.add(colors(bar));
    let edge = Stroke::new(1.0, Color32::from_gray(160));
    painter.rect_stroke(bar, 0.0, edge, StrokeKind::Outside);
    let below = bar.max.y + MARGIN;
    for (at, text) in texts {
        let galley = painter.layout_no_wrap(text.clone(), font.clone(), Color32::WHITE);
        let width = galley.size().x;
        let middle = bar.min.x + at * bar.width() - width / 2.0;
        // Texts at the ends stay below the bar.
        let x = middle.clamp(bar.min.x, bar.max.x - width);
        painter.galley(egui::pos2(x, below), galley, Color32::WHITE);
    }
    let id = ui.scope_id().with(("legend", is_right));
    let response = ui.interact(corner.intersect(painter.clip_rect()), id, Sense::hover());
    response.widget_info(|| egui::WidgetInfo::labeled(egui::Role::Label, true, told));
    icon::named(&response, told);
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
