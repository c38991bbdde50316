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
    (Action::SetPivot, "Set the pivot"),
    (Action::FrameAll, "Frame the whole scene"),
    (Action::Help, "Show keyboard shortcuts"),
];

/// Draws the dialog. Returns whether it stays open.
pub fn show(ctx: &egui::Context, session: &mut Session) -> bool {
    let mut stays = true;
    let opens = egui::Window::new("First steps")
        .collapsible(false)
        .resizable(false)
        .anchor(Align2::LEFT_BOTTOM, [8.0, -36.0])
        .show(ctx, |ui| {
            Grid::new("first")
                .num_columns(2)
                .spacing([12.0, 4.0])
                .show(ui, |ui| {
                    for (action, what) in FIRST {
                        let triggers = session.preferences.bindings.triggers(action);
                        // One way is enough to begin with, and leaves the picture free.
                        if let Some(trigger) = triggers.first() {
                            let label = trigger.label(cfg!(target_os = "macos"));
                            ui.label(RichText::new(label).strong());
                            ui.label(what);
                            ui.end_row();
                        }
                    }
                    ui.label(RichText::new("Drop a file").strong());
                    ui.label("Open a scene or a model");
                    ui.end_row();
                });
            ui.add_space(4.0);
            ui.horizontal(|ui| {
                stays = !ui.button("Got it").clicked();
                ui.button("Blender, Maya…")
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
