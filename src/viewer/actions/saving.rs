//! Saving the scene as a native file.

use crate::app::{inputs, scene_file};
use crate::viewer::actions::files;
use crate::viewer::actions::files::cameras;
use crate::viewer::model::file_dialog::{Reply, Request, SCENES};
use crate::viewer::state::editing::Saving;
use crate::viewer::state::session::Session;
use eframe::egui;
use std::path::{Path, PathBuf};
use std::sync::mpsc::{Receiver, TryRecvError};

/// Saves where the scene was saved before, else asks.
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

/// Asks for a name.
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

/// Opens the desktop's dialog for the name of a scene.
pub fn browse(session: &Session, saving: &mut Saving, ctx: &egui::Context) {
    let path = target(&saving.name).unwrap_or_default();
    let folder = path.parent().filter(|folder| folder.is_dir());
    let request = Request {
        saves: true,
        kind: Some(SCENES),
        title: "Save the scene".to_owned(),
        folder: folder.map(Path::to_owned),
        name: path.file_name().map(|n| n.to_string_lossy().into_owned()),
    };
    saving.asked = Some(session.files.dialogs.ask(request, ctx));
}

/// Takes the name that was chosen in the desktop's dialog.
pub fn take_reply(session: &mut Session, saving: &mut Saving) {
    let Some(reply) = saving.asked.as_ref().map(Receiver::try_recv) else {
        return;
    };
    match reply {
        Err(TryRecvError::Empty) => return,
        Ok(Reply::Chosen(path)) => {
            saving.name = path.to_string_lossy().into_owned();
            saving.trouble = None;
        }
        Ok(Reply::Cancelled) => {}
        Ok(Reply::Unavailable) | Err(TryRecvError::Disconnected) => {
            session.messages.warn(files::NO_DIALOG.to_owned());
        }
    }
    saving.asked = None;
}

/// Writes the scene to a file, and meshes and pictures beside it.
///
/// # Errors
/// The scene reads that file, or it cannot be written: a sentence.
pub fn write(session: &mut Session, path: &Path) -> Result<(), String> {
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
    session.messages.tell(match beside {
        0 => format!("Saved {}", path.display()),
        1 => format!("Saved {} and a file beside it", path.display()),
        _ => format!("Saved {} and {beside} files beside it", path.display()),
    });
    Ok(())
}

/// Whether a file is as it was written from here.
pub fn is_own(session: &Session, path: Option<&Path>) -> bool {
    path.is_some() && session.editing.written.as_deref() == path && !session.files.have_changed()
}

/// The file of a name, which may be typed without its ending; `None` if there is no name yet.
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
