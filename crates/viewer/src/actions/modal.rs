//! Modal transforms as in Blender: a key starts them, the object follows the pointer without a button, X, Y
//! and Z constrain the axis (with Shift the plane), digits set the amount, and Enter or a click confirms.
//! Escape or a right click cancels.

use crate::model::bindings::{Action, Preset};
use crate::model::modal::Modal;
use crate::model::objects;
use crate::model::tool::Tool;
use crate::state::session::Session;
use eframe::egui::{Event, Key};

/// Activates a tool with handles. With Blender's bindings, that starts a modal transform of the selection.
pub fn activate(session: &mut Session, tool: Tool) {
    session.tool = tool;
    let scene = session.scene().cloned();
    let has_place =
        scene.is_some_and(|scene| !objects::movable(&scene, &session.selected()).is_empty());
    let is_blender = session.preferences.bindings.preset() == Preset::Blender;
    if is_blender && has_place && session.viewport.is_some() && session.editing.grip.is_none() {
        session.editing.modal = Some(Modal::default());
    }
}

/// Lets the selection, which was just made, follow the pointer in the picture as part of the same step. Escape leaves it
/// where it is.
pub fn place_new(session: &mut Session) {
    session.tool = Tool::Move;
    if let Some(document) = &mut session.document
        && session.viewport.is_some()
    {
        document.go_on();
        session.editing.grip = None;
        session.editing.modal = Some(Modal::in_picture());
    }
}

/// Passes a key to the modal transform. Returns whether there is one, which consumes all keys.
pub fn key(session: &mut Session, event: &Event) -> bool {
    let action = session.preferences.bindings.pressed_by(event);
    let Some(modal) = &mut session.editing.modal else {
        return false;
    };
    let &Event::Key {
        key,
        pressed: true,
        modifiers,
        ..
    } = event
    else {
        return true;
    };
    let other = match action {
        Some(Action::Tool(tool)) if tool.entry().has_handles => Some(tool),
        _ => None,
    };
    match key {
        Key::X => modal.limit(0, modifiers.shift),
        Key::Y => modal.limit(1, modifiers.shift),
        Key::Z => modal.limit(2, modifiers.shift),
        Key::Enter => modal.is_confirmed = true,
        Key::Escape => cancel(session),
        _ => match other {
            Some(tool) => {
                cancel(session);
                activate(session, tool);
            }
            None => modal.type_key(key),
        },
    }
    true
}

/// Cancels a drag of a handle or of the light, or a modal transform.
pub fn cancel(session: &mut Session) {
    session.drag = None;
    session.editing.grip = None;
    session.editing.lamp = None;
    session.editing.section = None;
    session.editing.modal = None;
    if let Some(document) = &mut session.document {
        document.cancel();
    }
    session.moved();
}
