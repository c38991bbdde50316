//! Shows files that were written in the desktop's file manager.

use crate::state::session::Session;
use eframe::egui;
use std::path::Path;
use std::sync::mpsc::TryRecvError;

/// Opens the folder of a file, with the file selected.
pub fn in_folder(session: &mut Session, path: &Path, ctx: &egui::Context) {
    let path = std::path::absolute(path).unwrap_or_else(|_| path.to_owned());
    if !path.exists() {
        let told = format!(
            "Cannot show {}: it does not exist any more.",
            path.display()
        );
        session.messages.warn(told);
        return;
    }
    session.files.shown_in_folder = Some(session.files.manager.show(path, ctx));
}

/// Tells that the file manager could not be opened.
pub(super) fn update(session: &mut Session) {
    let Some(pending) = &session.files.shown_in_folder else {
        return;
    };
    let outcome = match pending.try_recv() {
        Err(TryRecvError::Empty) => return,
        Err(TryRecvError::Disconnected) => Err("Cannot start the file manager.".to_owned()),
        Ok(outcome) => outcome,
    };
    session.files.shown_in_folder = None;
    if let Err(why) = outcome {
        session.messages.warn(why);
    }
}
