//! The histogram of the displayed picture.

use crate::actions::histogram;
use crate::model::histogram::{Histogram, LEVELS};
use crate::ui::context::PanelContext;
use crate::worker::progressive_image::PictureSlot;
use eframe::egui::{self, Color32, Mesh, Rect, Sense, Shape, Stroke, Ui, WidgetInfo, vec2};

/// Height of the plot and its greatest width, in points.
const HEIGHT: f32 = 84.0;
const MAX_WIDTH: f32 = 320.0;

/// Draws the histogram, the clipped fractions and the choice of the scale.
pub fn histogram(ui: &mut Ui, context: &mut PanelContext) {
    let width = ui.available_width().min(MAX_WIDTH);
    let (rect, response) = ui.allocate_exact_size(vec2(width, HEIGHT), Sense::hover());
    let shown = context.shown(PictureSlot::Main);
    if let Some(shown) = shown.filter(|_| ui.is_rect_visible(rect))
        && histogram::ask(context.session, &shown.progress)
    {
        ui.ctx().request_repaint();
    }
    let view = &mut context.session.histogram;
    let told = view
        .latest
        .as_deref()
        .map_or("Histogram: no picture yet".to_owned(), sentence);
    response.widget_info(|| WidgetInfo::labeled(egui::Role::Image, true, &told));
    response.on_hover_text(
        "Displayed red, green and blue, after tone mapping, and luminance as a line, from black to white",
    );
    // Coloured light adds up on a dark ground only, in both themes.
    ui.painter().rect_filled(rect, 2.0, Color32::from_gray(16));
    if let Some(histogram) = &view.latest {
        plot(
            ui,
            rect.shrink(2.0),
            &histogram.heights(view.is_logarithmic),
        );
    }
    ui.horizontal(|ui| {
        let [black, white] = (view.latest.as_deref()).map_or([0.0; 2], Histogram::clipped);
        for (name, share, tip) in [
            ("Black", black, "Pixels whose channels are all 0"),
            ("White", white, "Pixels with a channel at 255"),
        ] {
            ui.label(format!("{name} {}", percent(share)))
                .on_hover_text(tip);
        }
        let tip = "Scale the height by the logarithm of the number of pixels";
        ui.checkbox(&mut view.is_logarithmic, "Log")
            .on_hover_text(tip);
    });
}

fn percent(share: f64) -> String {
    format!("{:.1} %", share * 100.0)
}

/// The histogram in words.
fn sentence(histogram: &Histogram) -> String {
    let [black, white] = histogram.clipped().map(percent);
    format!(
        "Histogram: {black} of the pixels are black, {white} are clipped to white, mean luminance {}",
        percent(histogram.mean_luminance())
    )
}

/// Bars of red, green and blue that add up, and the line of luminance.
fn plot(ui: &Ui, rect: Rect, heights: &[[f32; LEVELS]; 4]) {
    let painter = ui.painter_at(rect);
    let x = |level: f32| rect.min.x + rect.width() * level / LEVELS as f32;
    let y = |height: f32| rect.max.y - rect.height() * height;
    let [red, green, blue, luminance] = heights;
    for (heights, [r, g, b]) in [
        (red, [200, 30, 30]),
        (green, [20, 160, 30]),
        (blue, [40, 60, 220]),
    ] {
        let color = Color32::from_rgb_additive(r, g, b);
        let mut mesh = Mesh::default();
        for (level, height) in heights.iter().enumerate() {
            let span = x(level as f32)..=x(level as f32 + 1.0);
            let bar = Rect::from_x_y_ranges(span, y(*height)..=rect.max.y);
            mesh.add_colored_rect(bar, color);
        }
        painter.add(Shape::mesh(mesh));
    }
    let points = luminance.iter().enumerate();
    let points = points.map(|(level, height)| egui::pos2(x(level as f32 + 0.5), y(*height)));
    let line = Stroke::new(1.0, Color32::from_gray(225));
    painter.add(Shape::line(points.collect(), line));
}
