//! Saving the scene as a native file.

use crate::actions::files;
use crate::actions::files::cameras;
use crate::model::file_dialog::{self, Reply, Request, SCENES};
use crate::state::editing::Saving;
use crate::state::session::Session;
use eframe::egui;
use glimray_app::{inputs, scene_file};
use std::path::{Path, PathBuf};

/// Saves to the file that was saved before, else asks.
pub fn save(session: &mut Session) {
    match session.path.clone() {
        Some(path) if is_own(session, Some(&path)) => {
            if let Err(why) = write(session, &path) {
                session.messages.warn(why);
            }
        }
        _ => ask(session),
    }
}

/// Asks for a file name.
pub fn ask(session: &mut Session) {
    if session.scene().is_none() {
        return;
    }
    let path = session.path.clone().unwrap_or("scene.glimray".into());
    session.editing.saving = Some(Saving {
        name: path.with_extension("toml").display().to_string(),
        trouble: None,
        is_new: true,
        asked: None,
    });
}

/// Opens a file dialog for the name of a scene.
pub fn browse(session: &Session, saving: &mut Saving, ctx: &egui::Context) {
    let path = target(&saving.name).unwrap_or_default();
    let request = Request::save("Save the scene", SCENES, &path);
    saving.asked = Some(session.files.dialogs.ask(request, ctx));
}

/// Takes the name that was chosen in the file dialog.
pub fn take_reply(session: &mut Session, saving: &mut Saving) {
    match file_dialog::take_reply(&mut saving.asked) {
        Some(Reply::Chosen(path)) => {
            saving.name = path.to_string_lossy().into_owned();
            saving.trouble = None;
        }
        Some(Reply::Unavailable) => session.messages.warn(files::NO_DIALOG.to_owned()),
        Some(Reply::Cancelled) | None => {}
    }
}

/// Saves the scene as `path`, with its meshes and images in files next to it.
///
/// # Errors
/// The scene uses that file, or it cannot be written: why, in a sentence.
pub fn write(session: &mut Session, path: &Path) -> Result<(), String> {
    let is_scene = session
        .path
        .as_ref()
        .is_some_and(|own| inputs::is_same(own, path));
    if !is_scene && session.files.inputs().contain(path) {
        let path = path.display();
        return Err(format!(
            "Cannot save the scene ({path}): it uses that file. Choose another name."
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
    let told = match beside {
        0 => format!("Saved {}", path.display()),
        1 => format!("Saved {} and one asset file", path.display()),
        _ => format!("Saved {} and {beside} asset files", path.display()),
    };
    session.messages.saved(told, path.to_owned());
    Ok(())
}

/// Whether a file was saved from this window.
pub fn is_own(session: &Session, path: Option<&Path>) -> bool {
    path.is_some() && session.editing.written.as_deref() == path && !session.files.have_changed()
}

/// The path of a name, which may be typed without its extension; `None` if it is empty.
pub fn target(name: &str) -> Option<PathBuf> {
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
