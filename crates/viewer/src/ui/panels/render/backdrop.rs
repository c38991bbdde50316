//! The backdrop, seen by camera paths instead of the background.

use crate::model::view_settings::ViewSettings;
use crate::ui::panels::row::row;
use eframe::egui::{self, Ui};
use glam::Vec3;
use glimray_scene::Backdrop;

/// The rows of the backdrop of path-traced pictures.
pub fn backdrop(ui: &mut Ui, look: &mut ViewSettings) {
    let tip = "What the camera sees where there is nothing, also through clear glass. Mirrors and light keep the \
               background";
    let choices = [
        ("Same as lighting", Backdrop::Background),
        ("Colour", Backdrop::Color(Vec3::ONE)),
        ("Transparent", Backdrop::Transparent),
    ];
    let backdrop = &mut look.settings.backdrop;
    let kind = std::mem::discriminant::<Backdrop>;
    let own = kind(backdrop);
    let chosen = choices.iter().find(|(_, choice)| kind(choice) == own);
    row(ui, ("Backdrop", tip), |ui, label| {
        let list = egui::ComboBox::from_id_salt("backdrop")
            .truncate()
            .selected_text(chosen.map_or("", |(name, _)| name))
            .show_ui(ui, |ui| {
                for (name, choice) in choices {
                    let is_chosen = kind(&choice) == own;
                    if ui.selectable_label(is_chosen, name).clicked() && !is_chosen {
                        *backdrop = choice;
                    }
                }
            });
        if let Some(label) = label {
            list.response.labelled_by(label).on_hover_text(tip);
        }
    });
    if let Backdrop::Color(light) = backdrop {
        color(ui, light);
    }
}

fn color(ui: &mut Ui, light: &mut Vec3) {
    let name = "Seen colour";
    let tip = "Linear radiance, red, green and blue from 0 to 1";
    row(ui, (name, tip), |ui, _| {
        let mut rgb = light.to_array();
        let response = ui.color_edit_button_rgb(&mut rgb);
        response.widget_info(|| egui::WidgetInfo::labeled(egui::Role::ColorWell, true, name));
        if response.on_hover_text(tip).changed() {
            *light = Vec3::from_array(rgb);
        }
    });
}
