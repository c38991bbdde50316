//! The background override.

use crate::ui::context::PanelContext;
use crate::ui::panels::setting_rows::reset_button;
use eframe::egui::{self, Ui};
use glam::Vec3;
use glimray_render::Integrator;
use glimray_scene::{Backdrop, Background};

/// Initial linear radiance of a new background.
const GREY: Vec3 = Vec3::splat(0.18);
const SKY: Vec3 = Vec3::new(0.25, 0.45, 0.9);

pub fn background(ui: &mut Ui, context: &mut PanelContext) {
    let session = &mut context.session;
    let is_picture = (session.scene())
        .is_some_and(|scene| matches!(scene.background, Background::Picture { .. }));
    let look = &mut session.view;
    let tip = match is_picture {
        true => "What rays see when they hit no object. The scene uses an image or a sky",
        false => "What rays see when they hit no object",
    };
    let name = |background: &Option<Background>| match background {
        None => "From the scene",
        Some(Background::Color(_)) => "Colour",
        Some(Background::Gradient { .. }) => "Gradient",
        Some(Background::Picture { .. }) => "Image",
    };
    let choices = [
        None,
        Some(Background::Color(GREY)),
        Some(Background::Gradient {
            bottom: GREY,
            top: SKY,
        }),
    ];
    let label = ui.label("Background").on_hover_text(tip);
    let chosen = name(&look.background);
    ui.horizontal(|ui| {
        egui::ComboBox::from_id_salt("background")
            .selected_text(chosen)
            .show_ui(ui, |ui| {
                for choice in choices {
                    let is_chosen = name(&choice) == chosen;
                    if ui.selectable_label(is_chosen, name(&choice)).clicked() && !is_chosen {
                        look.background = choice;
                    }
                }
            })
            .response
            .labelled_by(label.id)
            .on_hover_text(tip);
        if look.background.is_some() && reset_button(ui, "background").clicked() {
            look.background = None;
        }
    });
    ui.end_row();
    match &mut look.background {
        Some(Background::Color(light)) => color(ui, "Colour", light),
        Some(Background::Gradient { bottom, top }) => {
            color(ui, "Below", bottom);
            color(ui, "Above", top);
        }
        _ => {}
    }
}

/// The backdrop, seen by camera paths instead of the background.
pub fn backdrop(ui: &mut Ui, context: &mut PanelContext) {
    let settings = &mut context.session.view.settings;
    if settings.integrator != Integrator::Path {
        return;
    }
    let tip = "What the camera sees where there is nothing, also through clear glass. Mirrors and light keep the \
               background";
    let choices = [
        ("The background", Backdrop::Background),
        ("Colour", Backdrop::Color(Vec3::ONE)),
        ("Transparent", Backdrop::Transparent),
    ];
    let kind = std::mem::discriminant::<Backdrop>;
    let own = kind(&settings.backdrop);
    let chosen = choices.iter().find(|(_, choice)| kind(choice) == own);
    let label = ui.label("Backdrop").on_hover_text(tip);
    egui::ComboBox::from_id_salt("backdrop")
        .selected_text(chosen.map_or("", |(name, _)| name))
        .show_ui(ui, |ui| {
            for (name, choice) in choices {
                let is_chosen = kind(&choice) == own;
                if ui.selectable_label(is_chosen, name).clicked() && !is_chosen {
                    settings.backdrop = choice;
                }
            }
        })
        .response
        .labelled_by(label.id)
        .on_hover_text(tip);
    ui.end_row();
    if let Backdrop::Color(light) = &mut settings.backdrop {
        color(ui, "Seen colour", light);
    }
}

fn color(ui: &mut Ui, name: &str, light: &mut Vec3) {
    let tip = format!("{name}: linear radiance, red, green and blue from 0 to 1");
    let label = ui.label(name).on_hover_text(&tip);
    let mut rgb = light.to_array();
    let response = ui.color_edit_button_rgb(&mut rgb).labelled_by(label.id);
    response.widget_info(|| egui::WidgetInfo::labeled(egui::Role::ColorWell, true, name));
    if response.on_hover_text(tip).changed() {
        *light = Vec3::from_array(rgb);
    }
    ui.end_row();
}
