//! Commands and keys of dialogs.

use crate::model::bindings::{Action, Trigger};
use crate::state::dialogs::Dialog;
use crate::state::session::Session;
use eframe::egui::{self, Key, Popup};

/// Whether keys belong to a dialog or leave a field, so that they perform no commands. Escape closes a
/// question.
pub fn take_keys(session: &mut Session, ctx: &egui::Context) -> bool {
    // An open menu is closed first.
    let is_escape = ctx.input(|input| input.key_pressed(Key::Escape)) && !Popup::is_any_open(ctx);
    // These handle Escape themselves.
    if session.editing.is_asking() || session.dialogs.bindings.awaits() {
        return true;
    }
    if is_asking(session) {
        if is_escape {
            close_uppermost(session);
        }
        return true;
    }
    is_escape && session.dialogs.had_keyboard
}

/// Whether a dialog is open that waits for an answer.
pub fn is_asking(session: &Session) -> bool {
    let files = &session.files;
    let is_typing = files.typed.is_some()
        || files.typed_model.is_some()
        || files.texturing.is_typing()
        || session.comparing.typed.is_some();
    let is_saving = files.saving.is_some() || files.film.is_some();
    session.editing.is_asking() || files.undecided.is_some() || is_saving || is_typing
}

/// Closes the uppermost dialog. Returns whether there was one.
pub fn close_uppermost(session: &mut Session) -> bool {
    let files = &mut session.files;
    if files.undecided.take().is_some() {
        return true;
    }
    if files.film.take().is_some() || files.saving.take().is_some() {
        return true;
    }
    if files.typed.take().is_some() || files.typed_model.take().is_some() {
        return true;
    }
    if files.texturing.is_typing() {
        files.texturing.opening = None;
        return true;
    }
    if session.comparing.typed.take().is_some() {
        return true;
    }
    match session.dialogs.open.pop() {
        Some(dialog) => {
            closed(session, dialog);
            true
        }
        None => false,
    }
}

/// Called when a dialog is closed.
pub fn closed(session: &mut Session, dialog: Dialog) {
    if dialog == Dialog::Hint {
        session.preferences.hint_seen = true;
    }
}

/// Replaces the trigger of a command, or adds one.
///
/// # Errors
/// Another command has the trigger, or it does not suit this command: why, in a sentence.
pub fn rebind(
    session: &mut Session,
    action: Action,
    trigger: Trigger,
    adds: bool,
) -> Result<(), String> {
    let bindings = &mut session.preferences.bindings;
    let taken = bindings.taken_by(&trigger, action);
    if let Some(other) = taken.first() {
        return Err(format!(
            "{} is already used by “{}”. Change that shortcut first.",
            trigger.label(cfg!(target_os = "macos")),
            other.description()
        ));
    }
    let mut triggers = match adds {
        true => bindings.triggers(action).to_vec(),
        false => Vec::new(),
    };
    if !triggers.contains(&trigger) {
        triggers.push(trigger);
    }
    bindings.set(action, triggers)
}
