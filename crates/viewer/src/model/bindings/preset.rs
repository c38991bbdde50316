//! Bindings that match other programs.

use crate::model::bindings::{Action, Trigger};
use crate::model::tool::Tool;
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;

/// A complete set of bindings. Settings files have its name in lower case.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Preset {
    /// Orbit with the left, pan with the middle and zoom with the right button.
    #[default]
    Glimray,
    /// As in Blender: the middle button moves the camera.
    Blender,
    /// As in Maya: Alt and a button move the camera.
    Maya,
}

impl Preset {
    /// All, the default first.
    pub const ALL: [Self; 3] = [Self::Glimray, Self::Blender, Self::Maya];

    /// Name in the window.
    pub fn title(self) -> &'static str {
        match self {
            Self::Glimray => "Glimray",
            Self::Blender => "Blender",
            Self::Maya => "Maya",
        }
    }

    /// The preset's bindings; commands that are missing have no trigger.
    pub(super) fn bindings(self) -> BTreeMap<Action, Vec<Trigger>> {
        let own = match self {
            Self::Glimray => "",
            Self::Blender => BLENDER,
            Self::Maya => MAYA,
        };
        let lines = GLIMRAY.lines().chain(own.lines());
        // Later lines win. A test checks that every line takes effect.
        let listed = lines.filter_map(|line| {
            let (name, list) = line.trim().split_once(':')?;
            Some((Action::from_name(name)?, triggers(list)?))
        });
        let tools = Tool::ALL.iter().filter_map(|tool| {
            let list = tool.entry().shortcuts[self as usize];
            Some((Action::Tool(*tool), triggers(list)?))
        });
        listed.chain(tools).collect()
    }
}

/// The triggers in a list with commas; `None` if one of them is invalid.
fn triggers(list: &str) -> Option<Vec<Trigger>> {
    let names = list.split(',').map(str::trim);
    let names = names.filter(|name| !name.is_empty());
    names.map(|name| name.parse().ok()).collect()
}

// The shortcuts of tools are in the table of tools.
// Digits without modifiers select views, as in Blender and other programs. Debug views need Shift.
pub(super) const GLIMRAY: &str = "
    orbit: Drag left
    pan: Drag middle, Shift+Drag left
    zoom: Wheel, Drag right
    zoom-to-cursor: Ctrl+Wheel, Ctrl+Drag right
    look-around: Ctrl+Drag left
    set-pivot: DoubleClick left
    focus-here: Click middle
    orbit-left: Left
    orbit-right: Right
    orbit-up: Up
    orbit-down: Down
    zoom-in: PageUp
    zoom-out: PageDown
    roll-left: Ctrl+Left
    roll-right: Ctrl+Right
    level: Shift+Home
    walk: Shift+Backtick
    fly-forward: Hold W
    fly-back: Hold S
    fly-left: Hold A
    fly-right: Hold D
    fly-up: Hold E
    fly-down: Hold Q
    fly-faster: Hold Shift
    frame-selection: F
    frame-all: Shift+F
    view-front: 1
    view-back: Ctrl+1
    view-right: 3
    view-left: Ctrl+3
    view-top: 7
    view-bottom: Ctrl+7
    toggle-orthographic: 5
    home: Home
    undo-view: Alt+Z
    redo-view: Shift+Alt+Z
    save-camera: K
    bookmarks: Ctrl+K
    next-camera: CloseBracket
    previous-camera: OpenBracket
    copy-camera: Ctrl+C
    paste-camera: Ctrl+V
    integrator-whitted: Shift+1
    integrator-normals: Shift+2
    integrator-depth: Shift+3
    integrator-ids: Shift+4
    integrator-uv: Shift+5
    integrator-heat: Shift+6
    integrator-samples: Shift+7
    integrator-path: Shift+8
    next-layer: Shift+PageDown
    previous-layer: Shift+PageUp
    false-color: Shift+Y
    split-wipe: X
    side-by-side: Shift+X
    show-difference: Y
    swap-sides: Alt+X
    keep-snapshot: Shift+K
    flip-kept: F6
    next-kept: Shift+F6
    kept-one: Alt+1
    kept-two: Alt+2
    kept-three: Alt+3
    kept-four: Alt+4
    kept-five: Alt+5
    kept-six: Alt+6
    kept-seven: Alt+7
    kept-eight: Alt+8
    open-reference: Ctrl+Shift+O
    exposure-up: Equals, Plus, Shift+Plus
    exposure-down: Minus
    exposure-reset: 0
    next-tone-curve: T
    next-background: Shift+B
    pixel-zoom: Alt+Wheel
    pixel-zoom-in: Alt+PageUp
    pixel-zoom-out: Alt+PageDown
    pixel-zoom-reset: Alt+Home
    pause-render: P
    restart-render: Shift+P
    more-samples: M
    fewer-samples: Shift+M
    film: Ctrl+F12
    play-pause: Space
    step-forward: Period
    step-back: Comma
    first-frame: Alt+Comma
    last-frame: Alt+Period
    play-faster: Shift+Period
    play-slower: Shift+Comma
    toggle-loop: L
    toggle-motion-blur: U
    turn-light: Shift+Drag right
    select: Click left
    select-box: Alt+Drag left, Shift+Alt+Drag left, Ctrl+Alt+Drag left
    picture-menu: Click right
    snap-handles: Hold Ctrl
    toggle-snapping: Alt+S
    fine-handles: Hold Shift
    add: Shift+A
    select-all: Ctrl+A
    select-nothing: Escape
    toggle-visible: V
    rename: F2
    duplicate: Ctrl+D
    delete: Delete, Backspace
    copy-measurements: Shift+Alt+M
    undo: Ctrl+Z
    redo: Ctrl+Shift+Z, Ctrl+Y
    new: Ctrl+N
    open: Ctrl+O
    open-next: Ctrl+PageDown
    open-previous: Ctrl+PageUp
    reload: F5, Ctrl+R
    revert: Shift+F5
    save-scene: Ctrl+S
    save-scene-as: Ctrl+Shift+S
    save-picture: F12, Ctrl+P
    copy-picture: Ctrl+Shift+P
    save-picture-with-overlays: Shift+F12
    help: H, F1
    preferences: Ctrl+Comma
    toggle-panels: N
    toggle-outline: O
    toggle-overlays: Shift+O
    toggle-selection-outline: Alt+O
    toggle-grid: Alt+G
    toggle-wireframe: Alt+E
    toggle-feature-edges: Shift+Alt+E
    toggle-section-handle: Shift+Alt+S
    toggle-lamp-handles: Alt+L
    toggle-inspected-rays: Alt+I
    toggle-statistics: Shift+I
    toggle-theme: F9
    larger-text: Ctrl+Equals, Ctrl+Plus, Ctrl+Shift+Plus
    smaller-text: Ctrl+Minus
    reset-text: Ctrl+0
    full-screen: F11
    quit: Ctrl+Q
";

// S, G and R are tools in this preset, so no letters fly; X deletes.
pub(super) const BLENDER: &str = "
    orbit: Drag middle
    pan: Shift+Drag middle
    zoom: Wheel, Ctrl+Drag middle
    zoom-to-cursor: Ctrl+Wheel
    set-pivot: DoubleClick left, Alt+Click middle
    orbit-left: 4
    orbit-right: 6
    orbit-up: 8
    orbit-down: 2
    roll-left: Shift+4
    roll-right: Shift+6
    fly-forward:
    fly-back:
    fly-left:
    fly-right:
    fly-up:
    fly-down:
    fly-faster:
    frame-selection: Period
    frame-all: Home
    home: 0
    integrator-whitted: Alt+1
    integrator-normals: Alt+2
    integrator-depth: Alt+3
    integrator-ids: Alt+4
    integrator-uv: Alt+5
    integrator-heat: Alt+6
    integrator-samples: Alt+7
    integrator-path: Alt+8
    kept-one: Shift+Alt+1
    kept-two: Shift+Alt+2
    kept-three: Shift+Alt+3
    kept-four: Shift+Alt+4
    kept-five: Shift+Alt+5
    kept-six: Shift+Alt+6
    kept-seven: Shift+Alt+7
    kept-eight: Shift+Alt+8
    split-wipe: W
    side-by-side: Shift+W
    swap-sides: Alt+W
    exposure-reset: Shift+0
    step-forward: Right
    step-back: Left
    first-frame: Shift+Left
    last-frame: Shift+Right
    select-box: Drag left, Shift+Drag left
    toggle-wireframe: Shift+Z
    toggle-visible: H
    select-all: A, Ctrl+A
    duplicate: Shift+D
    delete: X, Delete
    help: F1
";

// Q, W, E and R are tools in this preset, so no letters fly.
pub(super) const MAYA: &str = "
    orbit: Alt+Drag left
    pan: Alt+Drag middle
    zoom: Wheel, Alt+Drag right
    zoom-to-cursor: Ctrl+Wheel, Ctrl+Alt+Drag right
    fly-forward:
    fly-back:
    fly-left:
    fly-right:
    fly-up:
    fly-down:
    fly-faster:
    frame-all: A
    play-pause: Alt+V, Space
    step-forward: Alt+Period
    step-back: Alt+Comma
    first-frame: Shift+Alt+Comma
    last-frame: Shift+Alt+Period
    select-box: Drag left, Shift+Drag left
    toggle-visible: Ctrl+H
    undo: Ctrl+Z, Z
    redo: Ctrl+Shift+Z, Ctrl+Y, Shift+Z
";
