//! The dialog for saving the scene.

use crate::actions::saving::{browse, is_own, take_reply, target, write};
use crate::ui::context::PanelContext;
use eframe::egui::{self, Button, Ui};

/// Shows why a name is invalid, or what saving will do.
fn say(ui: &mut Ui, trouble: Option<&str>, is_named: bool, (is_there, is_ours): (bool, bool)) {
    let note = match (is_there, is_ours) {
        (true, false) => {
            "This file exists and will be rewritten. Its comments and order will be lost."
        }
        (true, true) => "This file was saved from this window.",
        _ => "A native scene (.toml). Meshes and images are saved as files next to it.",
    };
    let trouble = trouble.or((!is_named).then_some("Enter a name, such as scene.toml."));
    ui.add_space(4.0);
    match trouble {
        Some(trouble) => ui.colored_label(ui.visuals().error_fg_color, trouble),
        None => ui.weak(note),
    };
    ui.add_space(8.0);
}

/// Draws the dialog while it is open.
pub fn show(ui: &mut egui::Ui, context: &mut PanelContext) {
    let session = &mut *context.session;
    let Some(mut saving) = session.editing.saving.take() else {
        return;
    };
    take_reply(session, &mut saving);
    let modal = egui::Modal::new(egui::Id::unique("save scene")).show(ui.ctx(), |ui| {
        ui.set_width(420.0);
        ui.heading("Save the scene");
        ui.add_space(8.0);
        let label = ui.label("File name");
        let edit = ui.horizontal(|ui| {
            let width = ui.available_width() - 90.0;
            let edit = egui::TextEdit::singleline(&mut saving.name).desired_width(width);
            let edit = ui.add(edit).labelled_by(label.id);
            let button = ui.button("Browse…");
            if (button.on_hover_text("Open the system's file dialog")).clicked() {
                browse(session, &mut saving, ui.ctx());
            }
            edit
        });
        let edit = edit.inner;
        super::folder(ui, &saving.name);
        if std::mem::take(&mut saving.is_new) {
            edit.request_focus();
        }
        if edit.changed() {
            saving.trouble = None;
        }
        let is_entered = edit.lost_focus() && ui.input(|input| input.key_pressed(egui::Key::Enter));
        let path = target(&saving.name);
        let is_there = path.as_ref().is_some_and(|path| path.exists());
        let is_ours = is_own(session, path.as_deref());
        say(
            ui,
            saving.trouble.as_deref(),
            path.is_some(),
            (is_there, is_ours),
        );
        let verb = if is_there { "Replace" } else { "Save" };
        let mut is_open = true;
        ui.horizontal(|ui| {
            let is_clicked = ui.add_enabled(path.is_some(), Button::new(verb)).clicked();
            // Replacing another file requires a click, not just Enter.
            let is_wanted = is_clicked || is_entered && (!is_there || is_ours);
            if let Some(path) = path.filter(|_| is_wanted) {
                match write(session, &path) {
                    Ok(()) => is_open = false,
                    Err(why) => saving.trouble = Some(why),
                }
            }
            is_open &= !ui.button("Cancel").clicked();
        });
        is_open
    });
    if modal.inner && !modal.should_close() {
        session.editing.saving = Some(saving);
    }
}
