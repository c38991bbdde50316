//! The tools of the mouse in the picture, in one table.
//!
//! A new tool is a row here. The compiler then asks for its behaviour in `actions/tools.rs` and for its overlay in
//! `ui/tools.rs`; its command, its shortcuts, its menu entry and its button follow from the row, and its sign is asked for in
//! `ui/panels/sign.rs`.

use super::region;
use eframe::egui::Pos2;
use glam::DVec3;

/// A row of the table of tools.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct ToolEntry {
    /// Identifier in settings files of the command that activates it. It never changes.
    pub name: &'static str,
    /// The tool's name in menus.
    pub title: &'static str,
    /// The tool's purpose: one line without a full stop.
    pub description: &'static str,
    /// The triggers of its command in each preset, in the order of `Preset::ALL`, separated by commas.
    pub shortcuts: [&'static str; 3],
    /// The menu that it is in.
    pub menu: ToolMenu,
    /// Whether it shows handles at the selection.
    pub has_handles: bool,
}

/// The menus with tools.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ToolMenu {
    /// The menu "Edit".
    Edit,
    /// The menu "Render".
    Render,
}

macro_rules! tools {
    ($($(#[$attribute:meta])* $tool:ident { $($field:ident: $value:expr,)* })*) => {
        /// The meaning of a click or drag that is not bound to the camera.
        #[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Hash)]
        pub enum Tool {
            $($(#[$attribute])* $tool,)*
        }

        impl Tool {
            /// All, in the order of the table.
            pub const ALL: &[Self] = &[$(Self::$tool,)*];

            /// The tool's row of the table.
            pub const fn entry(self) -> &'static ToolEntry {
                match self { $(Self::$tool => &ToolEntry { $($field: $value,)* },)* }
            }
        }
    };
}

tools! {
    /// A click selects the object under the cursor.
    #[default]
    Select {
        name: "select-mode",
        title: "Select tool",
        description: "Select tool: click an object to select it",
        shortcuts: ["C", "C", "Q"],
        menu: ToolMenu::Edit,
        has_handles: false,
    }
    /// A drag selects what is in a rectangle.
    Box {
        name: "box-select",
        title: "Box select",
        description: "Box select: drag a rectangle; Shift adds, Ctrl removes",
        shortcuts: ["Alt+B", "B", "Alt+B"],
        menu: ToolMenu::Edit,
        has_handles: false,
    }
    /// Handles move the selection.
    Move {
        name: "move-tool",
        title: "Move tool",
        description: "Move tool: drag a handle to move the selection",
        shortcuts: ["G", "G", "W"],
        menu: ToolMenu::Edit,
        has_handles: true,
    }
    /// Handles rotate the selection.
    Rotate {
        name: "rotate-tool",
        title: "Rotate tool",
        description: "Rotate tool: drag a ring to rotate the selection",
        shortcuts: ["R", "R", "E"],
        menu: ToolMenu::Edit,
        has_handles: true,
    }
    /// Handles scale the selection.
    Scale {
        name: "scale-tool",
        title: "Scale tool",
        description: "Scale tool: drag a handle to scale the selection",
        shortcuts: ["Z", "S", "R"],
        menu: ToolMenu::Edit,
        has_handles: true,
    }
    /// A click shows the rays of the pixel under the cursor.
    Inspect {
        name: "inspect-rays",
        title: "Ray inspector",
        description: "Ray inspector: click a pixel to show its rays",
        shortcuts: ["I", "I", "I"],
        menu: ToolMenu::Edit,
        has_handles: false,
    }
    /// Two clicks measure the distance between two points.
    Measure {
        name: "measure",
        title: "Measure tool",
        description: "Measure tool: click two points to show their distance",
        shortcuts: ["Alt+M", "Alt+M", "Alt+M"],
        menu: ToolMenu::Edit,
        has_handles: false,
    }
    /// A drag selects the render region.
    Region {
        name: "region-render",
        title: "Render region",
        description: "Render a region, or clear it",
        shortcuts: ["B", "Ctrl+B", "B"],
        menu: ToolMenu::Render,
        has_handles: false,
    }
}

/// The state of tools between frames.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct ToolState {
    /// The edge or corner of the render region that is being dragged.
    pub region: Option<region::Grip>,
    /// The points of the current measurement in world space, at most two.
    pub measured: Vec<DVec3>,
    /// The ends of the measurements before it.
    pub kept: Vec<[DVec3; 2]>,
    /// The rectangle that is being drawn.
    pub frame: Option<BoxDrag>,
    /// The index of the camera whose focus the next click sets.
    pub focuses: Option<usize>,
}

impl ToolState {
    /// Adds a point to the measurement; a third one starts another and keeps this one.
    pub fn measure(&mut self, point: DVec3) {
        self.kept.extend(self.measured_line());
        if self.measured.len() == 2 {
            self.measured.clear();
        }
        self.measured.push(point);
    }

    /// All measurements, the oldest first.
    pub fn measurements(&self) -> Vec<[DVec3; 2]> {
        let last = self.measured_line();
        self.kept.iter().copied().chain(last).collect()
    }

    /// Removes the last measurement, or its first point. Returns whether there was one.
    pub fn remove_measurement(&mut self) -> bool {
        match self.measured.is_empty() {
            true => self.kept.pop().is_some(),
            false => {
                self.measured.clear();
                true
            }
        }
    }

    /// Both measured points; `None` before there are two.
    pub fn measured_line(&self) -> Option<[DVec3; 2]> {
        self.measured[..].try_into().ok()
    }
}

/// A rectangle that is being drawn, on the screen.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BoxDrag {
    /// Where the drag began.
    pub from: Pos2,
    /// Where the pointer is.
    pub to: Pos2,
    /// How the objects in the rectangle change the selection.
    pub mode: BoxMode,
}

/// The effect of a rectangle on the selection.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum BoxMode {
    /// Selects nothing else.
    Only,
    /// Adds what is in it.
    Add,
    /// Takes out what is in it.
    Remove,
}

/// The purpose of a pick.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Purpose {
    /// Set the pivot.
    Pivot,
    /// Set the pivot of a camera without aim, which keeps its view.
    Aim,
    /// Set the focus.
    Focus,
    /// Set the focus of the scene's camera with this index.
    FocusOf(usize),
    /// Aim the lamp at it whose aim was dropped there.
    AimLamp,
    /// Select it.
    Select,
    /// Measure the distance from or to what this pixel shows.
    Measure([u32; 2]),
    /// Tell what the menu is about.
    Menu,
    /// Tell what a material is dragged over.
    Hover,
    /// Give it the material with this index.
    Assign(usize),
}
