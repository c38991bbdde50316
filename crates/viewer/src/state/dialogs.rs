//! The state of dialogs.

use crate::viewer::model::bindings::Action;
use crate::viewer::model::preferences::{Preferences, Theme};
use eframe::egui::Rect;
use std::collections::BTreeMap;

/// A dialog over the window.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Dialog {
    /// Keyboard shortcuts.
    Shortcuts,
    /// Theme, scale and defaults.
    Preferences,
    /// The hint of the first run.
    Hint,
    /// All messages.
    Messages,
    /// Bookmarked views.
    Cameras,
}

/// The open dialogs and their state.
#[derive(Default)]
pub struct Dialogs {
    pub(in crate::viewer) open: Vec<Dialog>,
    /// The state of the shortcuts dialog.
    pub bindings: ShortcutsDialog,
    pub(in crate::viewer) names: Names,
    pub(in crate::viewer) is_resetting: bool,
    /// Whether a field had the keyboard in the last frame: egui clears the focus before Escape is seen.
    pub(in crate::viewer) had_keyboard: bool,
    pub(in crate::viewer) preferences_file: PreferencesFile,
}

impl Dialogs {
    /// Whether a dialog is open.
    pub fn is_open(&self, dialog: Dialog) -> bool {
        self.open.contains(&dialog)
    }

    /// Opens a dialog, above the others.
    pub fn open(&mut self, dialog: Dialog) {
        self.close(dialog);
        self.open.push(dialog);
    }

    /// Closes a dialog.
    pub fn close(&mut self, dialog: Dialog) {
        self.open.retain(|known| *known != dialog);
    }

    /// Resets what was applied to the previous window.
    pub fn reopened(&mut self) {
        self.preferences_file.window_reopened();
    }

    /// Opens a dialog, or closes it if it is open.
    pub fn toggle(&mut self, dialog: Dialog) {
        match self.is_open(dialog) {
            true => self.close(dialog),
            false => self.open(dialog),
        }
    }
}

/// Edited names by their previous names.
pub type Names = BTreeMap<String, String>;

/// The state of the shortcuts dialog.
#[derive(Default)]
pub struct ShortcutsDialog {
    pub(in crate::viewer) search: String,
    /// The command that waits for a trigger.
    pub(in crate::viewer) capture: Option<Capture>,
    /// Why the last trigger was rejected.
    pub(in crate::viewer) refusal: Option<(Action, String)>,
}

/// A command that waits for its new trigger.
#[derive(Clone, Copy)]
pub struct Capture {
    pub(in crate::viewer) action: Action,
    pub(in crate::viewer) adds: bool,
    /// Screen area in which buttons and the wheel count.
    pub(in crate::viewer) place: Option<Rect>,
    /// Whether the click that started it is over.
    pub(in crate::viewer) is_ready: bool,
}

impl ShortcutsDialog {
    /// Whether a command waits for a trigger.
    pub fn awaits(&self) -> bool {
        self.capture.is_some()
    }
}

/// The state of the settings file.
#[derive(Default)]
pub struct PreferencesFile {
    pub(in crate::viewer) written: Option<Preferences>,
    /// Time of the last check, by the window's clock in seconds.
    pub(in crate::viewer) looked: Option<f64>,
    pub(in crate::viewer) has_failed: bool,
    pub(in crate::viewer) is_begun: bool,
    /// Whether the layout must be stored.
    pub(in crate::viewer) is_due: bool,
    /// The theme and scale applied to the window.
    pub(in crate::viewer) applied: Option<(Theme, f32)>,
}

impl PreferencesFile {
    /// Applies theme and scale again, because the window was created again.
    pub fn window_reopened(&mut self) {
        self.applied = None;
    }
}
