//! Which keys belong to the widget with the focus, and which perform commands.

use crate::actions::editing;
use crate::state::session::Session;
use eframe::egui::{self, Event, Key, Modifiers, Popup};

/// Who gets the keys.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Keyboard {
    /// The commands.
    Commands,
    /// A widget, such as a button or a slider: Tab, the arrows, Space and Enter.
    Widget,
    /// A text, or an open menu: everything but function keys, and Ctrl chords that do not edit text.
    Text,
}

impl Keyboard {
    /// Who gets the keys of this frame. Call this once in each frame.
    pub fn of(session: &mut Session, ctx: &egui::Context) -> Self {
        let focused = ctx.memory(|memory| memory.focused());
        let before = std::mem::replace(&mut session.dialogs.focused, focused);
        if session.editing.modal.is_some() {
            Self::Commands
        } else if Popup::is_any_open(ctx) {
            Self::Text
        } else if editing::keys(session, ctx) || focused.is_none() {
            Self::Commands
        } else if ctx.text_edit_focused() || focused != before {
            // A number becomes a text in the frame after it gets the focus.
            Self::Text
        } else {
            Self::Widget
        }
    }

    /// Whether a key may perform a command.
    pub fn passes(self, event: &Event) -> bool {
        let Event::Key { key, modifiers, .. } = event else {
            // Cut, copy and paste.
            return self != Self::Text;
        };
        match self {
            Self::Commands => true,
            Self::Widget => !is_of_widgets(*key, *modifiers),
            Self::Text => is_function(*key) || modifiers.command && !edits_text(*key),
        }
    }
}

fn is_function(key: Key) -> bool {
    (Key::F1..=Key::F35).contains(&key)
}

fn is_of_widgets(key: Key, modifiers: Modifiers) -> bool {
    match key {
        Key::Tab => true,
        Key::Space
        | Key::Enter
        | Key::ArrowUp
        | Key::ArrowDown
        | Key::ArrowLeft
        | Key::ArrowRight => !modifiers.any(),
        _ => false,
    }
}

/// Whether a text uses this key with Ctrl.
fn edits_text(key: Key) -> bool {
    matches!(
        key,
        Key::A
            | Key::C
            | Key::H
            | Key::K
            | Key::U
            | Key::V
            | Key::W
            | Key::X
            | Key::Y
            | Key::Z
            | Key::ArrowUp
            | Key::ArrowDown
            | Key::ArrowLeft
            | Key::ArrowRight
            | Key::Home
            | Key::End
            | Key::Backspace
            | Key::Delete
            | Key::Enter
    )
}
