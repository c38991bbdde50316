//! Saving the scene as a native file.

use super::super::super::{inputs, scene_file};
use super::super::files::{self, cameras};
use super::super::session::Session;
use super::super::viewer::Desk;
use eframe::egui::{self, Button, Ui};
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
    match session.path.clone() {
        Some(path) if is_own(session, Some(&path)) => {
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
    let is_scene = session
        .path
        .as_ref()
        .is_some_and(|own| inputs::is_same(own, path));
    if !is_scene && session.files.inputs().contain(path) {
        let path = path.display();
        return Err(format!(
            "cannot save the scene ({path}): it reads that file. Choose another name."
        ));
    }
    let Some(document) = &mut session.document else {
        return Ok(());
    };
    let written = scene_file::save(path, document.scene(), true).map_err(|e| e.to_string())?;
    document.mark_saved();
    let before = cameras::key(session);
    session.preferences.copy_cameras(&before, path);
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

/// Whether a file is as it was written from here.
fn is_own(session: &Session, path: Option<&Path>) -> bool {
    path.is_some() && session.editing.written.as_deref() == path && !session.files.have_changed()
}

/// The file of a name, which may be typed without its ending; `None` if there is no name yet.
fn target(name: &str) -> Option<PathBuf> {
    let name = name.trim();
    let path = PathBuf::from(name);
    let is_named = !name.ends_with(std::path::is_separator)
        && (path.file_name()).is_some_and(|name| !name.eq_ignore_ascii_case(".toml"));
    let has_ending = (path.extension()).is_some_and(|ending| ending.eq_ignore_ascii_case("toml"));
    is_named.then(|| match has_ending {
        true => path,
        false => PathBuf::from(format!("{name}.toml")),
    })
}

/// Tells what is in the way of a name, or what becomes of it.
fn say(ui: &mut Ui, trouble: Option<&str>, is_named: bool, (is_there, is_ours): (bool, bool)) {
    let note = match (is_there, is_ours) {
        (true, false) => {
            "This file is there: it will be written anew, without its comments and its order."
        }
        (true, true) => "This file was saved from here before.",
        _ => "A native scene (.toml); meshes and pictures go into files beside it.",
    };
    let trouble = trouble.or((!is_named).then_some("Type a name, such as scene.toml."));
    ui.add_space(4.0);
    match trouble {
        Some(trouble) => ui.colored_label(ui.visuals().error_fg_color, trouble),
        None => ui.weak(note),
    };
    ui.add_space(8.0);
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
            // What would replace a person's own file takes more than a key.
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
