//! The hint of the first run.

use crate::model::bindings::Action;
use crate::state::dialogs::Dialog;
use crate::state::session::Session;
use eframe::egui::{self, Align2, Grid, RichText};

/// The first commands to learn.
const FIRST: [(Action, &str); 6] = [
    (Action::Orbit, "Orbit"),
    (Action::Pan, "Pan"),
    (Action::Zoom, "Zoom"),
    (Action::SetPivot, "Set the pivot under the cursor"),
    (Action::FrameAll, "Frame the whole scene"),
    (Action::Help, "Show keyboard shortcuts"),
];

/// Draws the dialog. Returns whether it stays open.
pub fn show(ctx: &egui::Context, session: &mut Session) -> bool {
    let mut stays = true;
    let opens = egui::Window::new("First steps")
        .collapsible(false)
        .resizable(false)
        .anchor(Align2::CENTER_BOTTOM, [0.0, -64.0])
        .show(ctx, |ui| {
            Grid::new("first")
                .num_columns(2)
                .spacing([24.0, 4.0])
                .show(ui, |ui| {
                    for (action, what) in FIRST {
                        let label = session.preferences.bindings.label(action);
                        if !label.is_empty() {
                            ui.label(RichText::new(label).strong());
                            ui.label(what);
                            ui.end_row();
                        }
                    }
                    ui.label(RichText::new("Drop a file").strong());
                    ui.label("Open a scene, a model or an environment image");
                    ui.end_row();
                });
            ui.add_space(4.0);
            ui.horizontal(|ui| {
                stays = !ui.button("Got it").clicked();
                ui.button("Blender or Maya controls…")
                    .on_hover_text("Choose the shortcuts of Blender or Maya")
                    .clicked()
            })
            .inner
        });
    if opens.and_then(|it| it.inner) == Some(true) {
        session.dialogs.open(Dialog::Preferences);
    }
    stays
}
