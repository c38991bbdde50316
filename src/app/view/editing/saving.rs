//! Saving the scene as a native file.

use super::super::super::scene_file;
use super::super::files;
use super::super::session::Session;
use super::super::viewer::Desk;
use eframe::egui;
use std::path::{Path, PathBuf};

/// A question where to save.
pub(super) struct Saving {
    name: String,
    /// What stands in the way of that name.
    trouble: Option<String>,
    is_new: bool,
}

/// Saves where the scene was saved before, else asks.
pub(super) fn save(session: &mut Session) {
    match (&session.path, &session.editing.written) {
        (Some(path), Some(written)) if path == written => {
            let path = path.clone();
            if let Err(why) = write(session, &path) {
                session.notices.warn(why);
            }
        }
        _ => ask(session),
    }
}

/// Asks for a name.
pub(super) fn ask(session: &mut Session) {
    if session.scene().is_none() {
        return;
    }
    let path = session.path.clone().unwrap_or("scene.glimray".into());
    session.editing.saving = Some(Saving {
        name: path.with_extension("toml").display().to_string(),
        trouble: None,
        is_new: true,
    });
}

fn write(session: &mut Session, path: &Path) -> Result<(), String> {
    let Some(document) = &mut session.document else {
        return Ok(());
    };
    let written = scene_file::save(path, document.scene(), true).map_err(|e| e.to_string())?;
    document.mark_saved();
    session.preferences.opened(path);
    session.editing.written = Some(path.to_owned());
    let beside = written.len() - 1;
    files::saved(session, written);
    session.notices.tell(match beside {
        0 => format!("Saved {}", path.display()),
        1 => format!("Saved {} and a file beside it", path.display()),
        _ => format!("Saved {} and {beside} files beside it", path.display()),
    });
    Ok(())
}

/// The question where to save, over the window, while it is asked.
pub fn sheet(ui: &mut egui::Ui, desk: &mut Desk) {
    let session = &mut *desk.session;
    let Some(mut saving) = session.editing.saving.take() else {
        return;
    };
    let modal = egui::Modal::new(egui::Id::unique("save scene")).show(ui.ctx(), |ui| {
        ui.set_width(420.0);
        ui.heading("Save the scene");
        ui.add_space(8.0);
        let label = ui.label("File name");
        let edit = egui::TextEdit::singleline(&mut saving.name).desired_width(f32::INFINITY);
        let edit = ui.add(edit).labelled_by(label.id);
        if std::mem::take(&mut saving.is_new) {
            edit.request_focus();
        }
        if edit.changed() {
            saving.trouble = None;
        }
        let is_entered = edit.lost_focus() && ui.input(|input| input.key_pressed(egui::Key::Enter));
        let path = PathBuf::from(saving.name.trim());
        let path = match path.extension() {
            Some(ending) if ending.eq_ignore_ascii_case("toml") => path,
            _ => PathBuf::from(format!("{}.toml", path.display())),
        };
        let is_there = path.exists();
        let is_ours = session.editing.written.as_ref() == Some(&path);
        let note = match (is_there, is_ours) {
            (true, false) => {
                "This file is there: it will be written anew, without its comments and its order."
            }
            (true, true) => "This file was saved from here before.",
            _ => "A native scene (.toml); meshes and pictures go into files beside it.",
        };
        ui.add_space(4.0);
        match &saving.trouble {
            Some(trouble) => ui.colored_label(ui.visuals().error_fg_color, trouble),
            None => ui.weak(note),
        };
        ui.add_space(8.0);
        let verb = if is_there { "Replace" } else { "Save" };
        let mut is_open = true;
        ui.horizontal(|ui| {
            if ui.button(verb).clicked() || is_entered {
                match write(session, &path) {
                    Ok(()) => is_open = false,
                    Err(why) => saving.trouble = Some(why),
                }
            }
            if ui.button("Cancel").clicked() {
                is_open = false;
            }
        });
        is_open
    });
    if modal.inner && !modal.should_close() {
        session.editing.saving = Some(saving);
    }
}
