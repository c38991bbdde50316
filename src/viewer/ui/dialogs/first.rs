//! What to do first.

use crate::viewer::model::bindings::Action;
use crate::viewer::state::dialogs::Dialog;
use crate::viewer::state::session::Session;
use eframe::egui::{self, Align2, Grid, RichText};

/// What is worth knowing, in the order in which one needs it.
const FIRST: [(Action, &str); 6] = [
    (Action::Orbit, "go round"),
    (Action::Pan, "shift"),
    (Action::Zoom, "come nearer"),
    (Action::SetPivot, "go round what is there"),
    (Action::FrameAll, "see all of it"),
    (Action::Help, "all bindings"),
];

/// Draws it. Whether it stays.
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
                    ui.label(RichText::new("drop a file").strong());
                    ui.label("open a scene, a model or a picture of the surroundings");
                    ui.end_row();
                });
            ui.add_space(4.0);
            ui.horizontal(|ui| {
                stays = !ui.button("Got it").clicked();
                ui.button("Other hands…")
                    .on_hover_text("Blender's or Maya's bindings")
                    .clicked()
            })
            .inner
        });
    if opens.and_then(|it| it.inner) == Some(true) {
        session.dialogs.open(Dialog::Preferences);
    }
    stays
}
