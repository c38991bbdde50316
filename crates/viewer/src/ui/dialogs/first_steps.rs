//! The hint of the first run.

use crate::model::bindings::Action;
use crate::state::dialogs::Dialog;
use crate::state::layout::{Layout, Panel};
use crate::state::session::Session;
use eframe::egui::{self, Align2, Grid, RichText, vec2};

/// The first commands to learn.
const FIRST: [(Action, &str); 6] = [
    (Action::Orbit, "Orbit"),
    (Action::Pan, "Pan"),
    (Action::Zoom, "Zoom"),
    (Action::SetPivot, "Set the pivot"),
    (Action::FrameAll, "Frame the whole scene"),
    (Action::Help, "Show keyboard shortcuts"),
];

/// Least width of the panels on the left that may lie below the dialog, in points. Narrower ones would be hidden.
const LEFT: f32 = 240.0;

/// Draws the dialog: in the lower left corner of the window, or in small windows over the picture. Returns whether it stays
/// open.
pub fn show(ctx: &egui::Context, session: &mut Session, layout: &Layout) -> bool {
    let mut stays = true;
    let window = ctx.content_rect();
    let small = (layout.rect(Panel::Picture)).filter(|picture| picture.min.x < window.min.x + LEFT);
    let corner = match small {
        Some(picture) => picture.left_bottom() + vec2(8.0, -8.0),
        None => window.left_bottom() + vec2(8.0, -36.0),
    };
    let opens = egui::Window::new("First steps")
        .collapsible(false)
        .resizable(false)
        .movable(false)
        .pivot(Align2::LEFT_BOTTOM)
        .fixed_pos(corner)
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
