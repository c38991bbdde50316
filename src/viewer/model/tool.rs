//! The tools of the mouse in the picture.

use super::bindings::Action;
use eframe::egui::Pos2;

/// The action of a click or drag that is not bound to the camera.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Tool {
    /// A click selects what is under it.
    #[default]
    Select,
    /// A click shows the rays of the pixel under it.
    Inspect,
    /// A drag selects the render region.
    Region,
    /// Handles move the selection.
    Move,
    /// Handles rotate the selection.
    Rotate,
    /// Handles scale the selection.
    Scale,
}

/// The purpose of a pick.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Purpose {
    /// Set the pivot.
    Pivot,
    /// Set the focus.
    Focus,
    /// Select it.
    Select,
}

/// A drag in the picture.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Drag {
    /// The action, chosen when it started.
    pub action: Action,
    /// The current position on the screen.
    pub from: Pos2,
}
