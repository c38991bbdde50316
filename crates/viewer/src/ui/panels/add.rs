//! The menu of what can be added to the scene: in the menu bar, and at the cursor.

use crate::actions::{adding, materials};
use crate::model::adding::Addition;
use crate::model::material_presets::MaterialPreset;
use crate::state::session::Session;
use eframe::egui::containers::menu::menu_style;
use eframe::egui::{self, LayerId, Popup, PopupKind, Ui};

/// The entries of the menu.
pub fn entries(ui: &mut Ui, session: &mut Session) {
    ui.add_enabled_ui(session.scene().is_some(), |ui| {
        list(ui, session, &Addition::SURFACES);
        ui.separator();
        list(ui, session, &Addition::LIGHTS);
        ui.separator();
        list(ui, session, &[Addition::Camera]);
        ui.menu_button("Material", |ui| presets(ui, session));
        if ui.button("Model from a file…").clicked() {
            ui.close();
            adding::ask_model(session, ui.ctx());
        }
    });
}

/// The ready-made materials.
fn presets(ui: &mut Ui, session: &mut Session) {
    let tip = "Add this material. The selected objects get it";
    for preset in MaterialPreset::ALL {
        if ui.button(preset.title()).on_hover_text(tip).clicked() {
            ui.close();
            materials::add(session, preset);
        }
    }
}

fn list(ui: &mut Ui, session: &mut Session, additions: &[Addition]) {
    for &what in additions {
        if ui.button(what.title()).clicked() {
            ui.close();
            adding::add(session, what);
        }
    }
}

/// Draws the menu at the cursor while it is open.
pub fn at_cursor(ctx: &egui::Context, session: &mut Session) {
    Popup::new(
        adding::menu_id(),
        ctx.clone(),
        session.editing.adding_at,
        LayerId::background(),
    )
    .kind(PopupKind::Menu)
    .style(menu_style)
    .layout(egui::Layout::top_down_justified(egui::Align::Min))
    .open_memory(None)
    .accessible_name("Add")
    .show(|ui| entries(ui, session));
}
