//! The preview of a material on a ball.

use crate::model::objects::Id;
use crate::state::dropping::Dragged;
use crate::ui::panels::icon::named;
use crate::ui::panels::properties::fields::Fields;
use eframe::egui::{self, Color32, DragAndDrop, Pos2, Rect, Sense, vec2};

/// Side of the picture, in points.
pub const BALL: f32 = 96.0;

/// Draws the preview of the material with this index. It can be dragged onto objects.
pub fn show(fields: &mut Fields, index: usize) {
    let name = format!("Preview of {}", fields.subject);
    fields.draw(|ui, drawing| {
        drawing.ball_of = Some(index);
        ui.vertical_centered(|ui| {
            let sense = Sense::click_and_drag();
            let (rect, response) = ui.allocate_exact_size(vec2(BALL, BALL), sense);
            let whole = Rect::from_min_max(Pos2::ZERO, egui::pos2(1.0, 1.0));
            match drawing.ball {
                Some(texture) => ui.painter().image(texture, rect, whole, Color32::WHITE),
                None => ui
                    .painter()
                    .rect_filled(rect, 0.0, ui.visuals().extreme_bg_color),
            };
            response.widget_info(|| egui::WidgetInfo::labeled(egui::Role::Image, true, &name));
            named(&response, &name);
            if response.drag_started() {
                DragAndDrop::set_payload(ui.ctx(), Dragged(vec![Id::Material(index)]));
            }
            let tip = "The material on a ball. Drag it onto an object to give it to that.";
            response.on_hover_text(tip);
        });
    });
}
