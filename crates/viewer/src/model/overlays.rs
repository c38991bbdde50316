//! The overlays of the picture, in one table.

use crate::model::bindings::Action;
use serde::{Deserialize, Serialize};

/// Which overlays are shown, as long as overlays are shown at all.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Overlays {
    /// The outline of the selection.
    pub outline: bool,
    /// The grid on the ground.
    pub grid: bool,
    /// All edges of meshes.
    pub wireframe: bool,
    /// The edges of meshes at their borders, at creases and between materials.
    pub features: bool,
    /// The handle of the section plane.
    pub section: bool,
    /// The handles of the selected lamp.
    pub lamps: bool,
    /// The inspected rays.
    pub rays: bool,
}

impl Default for Overlays {
    fn default() -> Self {
        Self {
            outline: true,
            grid: false,
            wireframe: false,
            features: false,
            section: true,
            lamps: true,
            rays: true,
        }
    }
}

/// An overlay, as menus list it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct OverlayEntry {
    /// The name in menus.
    pub title: &'static str,
    /// The command that shows or hides it.
    pub action: Action,
}

impl Overlays {
    /// All overlays, in the order of menus.
    pub const ALL: [OverlayEntry; 7] = [
        entry("Selection outline", Action::ToggleOutlines),
        entry("Grid", Action::ToggleGrid),
        entry("Wireframe", Action::ToggleWireframe),
        entry("Feature edges", Action::ToggleFeatureEdges),
        entry("Section handle", Action::ToggleSectionHandle),
        entry("Lamp handles", Action::ToggleLampHandles),
        entry("Inspected rays", Action::ToggleInspectedRays),
    ];

    /// The setting of a command; `None` for other commands.
    pub fn of(&mut self, action: Action) -> Option<&mut bool> {
        match action {
            Action::ToggleOutlines => Some(&mut self.outline),
            Action::ToggleGrid => Some(&mut self.grid),
            Action::ToggleWireframe => Some(&mut self.wireframe),
            Action::ToggleFeatureEdges => Some(&mut self.features),
            Action::ToggleSectionHandle => Some(&mut self.section),
            Action::ToggleLampHandles => Some(&mut self.lamps),
            Action::ToggleInspectedRays => Some(&mut self.rays),
            _ => None,
        }
    }

    /// Whether edges of meshes are drawn.
    pub fn has_edges(&self) -> bool {
        self.wireframe || self.features
    }
}

const fn entry(title: &'static str, action: Action) -> OverlayEntry {
    OverlayEntry { title, action }
}
