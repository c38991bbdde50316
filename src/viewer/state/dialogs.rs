//! Which dialogs are open, and what is being done in them.

use crate::viewer::model::bindings::Action;
use crate::viewer::model::preferences::{Preferences, Theme};
use eframe::egui::Rect;
use std::collections::BTreeMap;

/// Something that lies over the window.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Dialog {
    /// All bindings.
    Shortcuts,
    /// Theme, scale and defaults.
    Preferences,
    /// What to do first.
    Hint,
    /// All notices.
    Messages,
    /// The cameras that were kept.
    Cameras,
}

/// Which sheets are open, and what is being done in them.
#[derive(Default)]
pub struct Dialogs {
    pub(in crate::viewer) open: Vec<Dialog>,
    /// The sheet of bindings.
    pub bindings: ShortcutsDialog,
    pub(in crate::viewer) names: Names,
    pub(in crate::viewer) is_resetting: bool,
    /// Whether a field had the keyboard in the last frame: egui takes that away before Escape is seen.
    pub(in crate::viewer) had_keyboard: bool,
    pub(in crate::viewer) kept: Kept,
}

impl Dialogs {
    /// Whether a sheet is open.
    pub fn is_open(&self, sheet: Dialog) -> bool {
        self.open.contains(&sheet)
    }

    /// Opens a sheet, over the others.
    pub fn open(&mut self, sheet: Dialog) {
        self.close(sheet);
        self.open.push(sheet);
    }

    /// Closes a sheet.
    pub fn close(&mut self, sheet: Dialog) {
        self.open.retain(|known| *known != sheet);
    }

    /// Tells that the window is another one, which nothing was told yet.
    pub fn begin(&mut self) {
        self.kept.forget_window();
    }

    pub fn toggle(&mut self, sheet: Dialog) {
        match self.is_open(sheet) {
            true => self.close(sheet),
            false => self.open(sheet),
        }
    }
}

/// Names that are being typed, by what they were.
pub type Names = BTreeMap<String, String>;

/// What is being done in the sheet.
#[derive(Default)]
pub struct ShortcutsDialog {
    pub(in crate::viewer) search: String,
    /// The command that waits for a key, and whether it keeps those that it has.
    pub(in crate::viewer) capture: Option<Capture>,
    /// Why the last key was refused.
    pub(in crate::viewer) refusal: Option<(Action, String)>,
}

#[derive(Clone, Copy)]
pub struct Capture {
    pub(in crate::viewer) action: Action,
    pub(in crate::viewer) adds: bool,
    /// Where buttons and the wheel count, on the screen.
    pub(in crate::viewer) place: Option<Rect>,
    /// The click that began it is over.
    pub(in crate::viewer) is_ready: bool,
}

impl ShortcutsDialog {
    /// Whether a command waits for a key.
    pub fn awaits(&self) -> bool {
        self.capture.is_some()
    }
}

/// What is known of the settings file.
#[derive(Default)]
pub struct Kept {
    pub(in crate::viewer) written: Option<Preferences>,
    /// By the window's clock, in seconds.
    pub(in crate::viewer) looked: Option<f64>,
    pub(in crate::viewer) has_failed: bool,
    pub(in crate::viewer) is_begun: bool,
    /// Whether the panels are to be noted.
    pub(in crate::viewer) is_due: bool,
    /// As the window was told.
    pub(in crate::viewer) applied: Option<(Theme, f32)>,
}

impl Kept {
    pub fn forget_window(&mut self) {
        self.applied = None;
    }
}
