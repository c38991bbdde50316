//! What the mouse does in the picture where it does not move the camera.

use super::bindings::Action;
use eframe::egui::Pos2;

/// What a click or a drag in the picture does, where it is not the camera's.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Tool {
    /// A click selects what is under it.
    #[default]
    Select,
    /// A click shows the rays of the pixel under it.
    Inspect,
    /// A drag chooses the region to be rendered.
    Region,
    /// Handles move what is selected.
    Move,
    /// Handles rotate what is selected.
    Rotate,
    /// Handles scale what is selected.
    Scale,
}

/// Why someone wants to know what is under a pixel.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Purpose {
    /// To go round it.
    Pivot,
    /// To make it sharp.
    Focus,
    /// To select it.
    Select,
}

/// What is being dragged in the picture.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Drag {
    /// Chosen when it began.
    pub action: Action,
    /// Where it began, on the screen.
    pub from: Pos2,
}
