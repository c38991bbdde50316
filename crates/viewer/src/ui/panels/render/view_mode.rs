//! The one list of what the picture shows: integrators, layers of their pictures, and debug views.

use crate::model::view_settings::ViewSettings;
use crate::ui::panels::setting_rows::{line, title};
use eframe::egui::{self, Ui};
use glimray_app::layers::{LAYERS, PictureLayer};
use glimray_app::value_names::INTEGRATORS;
use glimray_render::{Integrator, Shows};

/// A way to show the scene.
type View = (Integrator, PictureLayer);

/// The row with the list.
pub fn view_mode(ui: &mut Ui, look: &mut ViewSettings) {
    let tip = "What is shown: the picture, one of its layers, or a debug view. Numbers are in false colours. The first \
               layer starts the picture over";
    let mut view = shown(look);
    let usual = (look.scene_settings.integrator, PictureLayer::Beauty);
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
    match integrator.entry().has_layers {
        true => (integrator, look.layer),
        false => (integrator, PictureLayer::Beauty),
    }
}

/// Shows something else.
pub fn show(look: &mut ViewSettings, (integrator, layer): View) {
    if shown(look) != (integrator, layer) {
        look.settings.integrator = integrator;
        look.show_layer(layer);
    }
}

/// The name of a view.
pub fn name((integrator, layer): View) -> String {
    match layer {
        PictureLayer::Beauty => integrator.entry().title.to_owned(),
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
                let own = (*integrator, PictureLayer::Beauty);
                ui.selectable_value(view, own, name(own))
                    .on_hover_text(*help);
            }
        }
    };
    entries(ui, view, true);
    if view.0.entry().has_layers {
        ui.weak("Layers of the picture");
        for (_, help, layer) in LAYERS.all() {
            if *layer != PictureLayer::Beauty {
                let own = (view.0, *layer);
                ui.selectable_value(view, own, name(own))
                    .on_hover_text(*help);
            }
        }
    }
    ui.weak("Debug views");
    entries(ui, view, false);
}
