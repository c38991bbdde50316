//! The one list of what the picture shows: integrators, layers of their pictures, and debug views.

use crate::model::view_settings::ViewSettings;
use crate::ui::panels::setting_rows::{line, title};
use eframe::egui::{self, Ui};
use glimray_app::layers::{LAYERS, PictureLayer};
use glimray_app::value_names::INTEGRATORS;
use glimray_render::{Integrator, Shows};

/// A way to show the scene.
#[derive(Clone, Copy, PartialEq)]
pub struct View {
    integrator: Integrator,
    layer: PictureLayer,
    is_false_color: bool,
}

/// The luminance of the picture, by stops.
const FALSE_COLOR: &str = "False colour";

impl View {
    /// The picture of an integrator, or a layer of it.
    fn of(integrator: Integrator, layer: PictureLayer) -> Self {
        Self {
            integrator,
            layer,
            is_false_color: false,
        }
    }
}

/// The row with the list.
pub fn view_mode(ui: &mut Ui, look: &mut ViewSettings) {
    let tip = "What is shown: the picture, one of its layers, or a debug view. Numbers are in false colours. The first \
               layer starts the picture over";
    let mut view = shown(look);
    let usual = View::of(look.scene_settings.integrator, PictureLayer::Beauty);
    line(ui, ("View mode", tip), &mut view, &usual, |ui, view| {
        egui::ComboBox::from_id_salt("view mode")
            .truncate()
            .height(400.0)
            .selected_text(name(*view))
            .show_ui(ui, |ui| list(ui, view))
            .response
    });
    show(look, view);
}

/// The way that is chosen now.
pub fn shown(look: &ViewSettings) -> View {
    let integrator = look.settings.integrator;
    let layer = match integrator.entry().has_layers {
        true => look.layer,
        false => PictureLayer::Beauty,
    };
    View {
        is_false_color: look.false_color && integrator.entry().shows == Shows::Radiance,
        ..View::of(integrator, layer)
    }
}

/// Shows something else.
pub fn show(look: &mut ViewSettings, view: View) {
    if shown(look) != view {
        look.settings.integrator = view.integrator;
        look.show_layer(view.layer);
        look.false_color = view.is_false_color;
    }
}

/// The name of a view.
pub fn name(view: View) -> String {
    match view.layer {
        _ if view.is_false_color => FALSE_COLOR.to_owned(),
        PictureLayer::Beauty => view.integrator.entry().title.to_owned(),
        layer => title(LAYERS.name(&layer)),
    }
}

/// The entries of the list.
pub fn list(ui: &mut Ui, view: &mut View) {
    let entries = |ui: &mut Ui, view: &mut View, is_picture: bool| {
        for (word, help, integrator) in INTEGRATORS.all() {
            // Aliases of the same value are left out.
            if INTEGRATORS.name(integrator) == *word
                && is_picture == (integrator.entry().shows == Shows::Radiance)
            {
                let own = View::of(*integrator, PictureLayer::Beauty);
                ui.selectable_value(view, own, name(own))
                    .on_hover_text(*help);
            }
        }
    };
    entries(ui, view, true);
    if view.integrator.entry().shows == Shows::Radiance {
        let own = View {
            is_false_color: true,
            ..View::of(view.integrator, PictureLayer::Beauty)
        };
        ui.selectable_value(view, own, FALSE_COLOR)
            .on_hover_text("Luminance of the picture by stops around middle grey, after the exposure and before the tone curve");
    }
    if view.integrator.entry().has_layers {
        ui.weak("Layers of the picture");
        for (_, help, layer) in LAYERS.all() {
            if *layer != PictureLayer::Beauty {
                let own = View::of(view.integrator, *layer);
                ui.selectable_value(view, own, name(own))
                    .on_hover_text(*help);
            }
        }
    }
    ui.weak("Debug views");
    entries(ui, view, false);
}
