//! The state of dialogs.

use crate::model::bindings::Action;
use crate::model::preferences::{Preferences, Theme};
use eframe::egui::{Id, Rect};
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
    /// Files that are being rendered or written.
    Jobs,
}

/// The open dialogs and their state.
#[derive(Default)]
pub struct Dialogs {
    pub(crate) open: Vec<Dialog>,
    /// The state of the shortcuts dialog.
    pub bindings: ShortcutsDialog,
    pub(crate) names: Names,
    pub(crate) is_resetting: bool,
    /// Whether a field had the keyboard in the last frame: egui clears the focus before Escape is seen.
    pub(crate) had_keyboard: bool,
    /// The widget that had the focus when the last frame began.
    pub(crate) focused: Option<Id>,
    pub(crate) preferences_file: PreferencesFile,
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
    pub(crate) search: String,
    /// The command that waits for a trigger.
    pub(crate) capture: Option<Capture>,
    /// Why the last trigger was rejected.
    pub(crate) refusal: Option<(Action, String)>,
}

/// A command that waits for its new trigger.
#[derive(Clone, Copy)]
pub struct Capture {
    pub(crate) action: Action,
    pub(crate) adds: bool,
    /// Screen area in which buttons and the wheel count.
    pub(crate) place: Option<Rect>,
    /// Whether the click that started it is over.
    pub(crate) is_ready: bool,
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
    pub(crate) written: Option<Preferences>,
    /// Time of the last check, by the window's clock in seconds.
    pub(crate) looked: Option<f64>,
    pub(crate) has_failed: bool,
    pub(crate) is_begun: bool,
    /// Whether the layout must be stored.
    pub(crate) is_due: bool,
    /// The theme and scale applied to the window.
    pub(crate) applied: Option<(Theme, f32)>,
}

impl PreferencesFile {
    /// Applies theme and scale again, because the window was created again.
    pub fn window_reopened(&mut self) {
        self.applied = None;
    }
}
