//! The table of every command in the viewer.

use crate::model::tool::Tool;
use glimray_render::Integrator;

/// Groups of commands, in the order of the table.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Category {
    /// Camera motion.
    Camera,
    /// Standard views, cameras and bookmarks.
    Views,
    /// View mode, comparison, exposure and background.
    ViewSettings,
    /// Progress and region of the render.
    Rendering,
    /// Playback.
    Time,
    /// Tools of the mouse in the picture.
    Tools,
    /// Selection and edits of the scene.
    Editing,
    /// Opening and saving scenes and pictures.
    Files,
    /// Panels, overlays, theme and size of the interface.
    Window,
}

impl Category {
    /// All, in the order of the table.
    pub const ALL: [Self; 9] = [
        Self::Camera,
        Self::Views,
        Self::ViewSettings,
        Self::Rendering,
        Self::Time,
        Self::Tools,
        Self::Editing,
        Self::Files,
        Self::Window,
    ];

    /// Heading of the group.
    pub fn title(self) -> &'static str {
        match self {
            Self::Camera => "Camera",
            Self::Views => "Views",
            Self::ViewSettings => "View mode",
            Self::Rendering => "Rendering",
            Self::Time => "Time",
            Self::Tools => "Tools",
            Self::Editing => "Editing",
            Self::Files => "Files",
            Self::Window => "Window",
        }
    }
}

/// How a command is triggered.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Manner {
    /// Once, by a key press or a mouse click.
    Press,
    /// For as long as a key is held.
    Hold,
    /// By a mouse drag or the wheel.
    Motion,
}

macro_rules! actions {
    ($($category:ident { $($action:ident $name:literal $manner:ident $text:literal,)* })*) => {
        /// A command of the viewer.
        #[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
        pub enum Action {
            $($(#[doc = $text] $action,)*)*
            /// Activates a tool.
            Tool(Tool),
        }

        /// All except those of tools.
        const LISTED: &[Action] = &[$($(Action::$action,)*)*];

        impl Action {
            /// Identifier in settings files. It never changes.
            pub fn name(self) -> &'static str {
                match self { $($(Self::$action => $name,)*)* Self::Tool(tool) => tool.entry().name }
            }

            /// The command's effect: one line without a full stop.
            pub fn description(self) -> &'static str {
                match self { $($(Self::$action => $text,)*)* Self::Tool(tool) => tool.entry().description }
            }

            /// The command's group.
            pub const fn category(self) -> Category {
                match self { $($(Self::$action => Category::$category,)*)* Self::Tool(_) => Category::Tools }
            }

            /// How it is triggered.
            pub fn manner(self) -> Manner {
                match self { $($(Self::$action => Manner::$manner,)*)* Self::Tool(_) => Manner::Press }
            }
        }
    };
}

actions! {
    Camera {
        Orbit "orbit" Motion "Orbit around the pivot",
        Pan "pan" Motion "Pan",
        Zoom "zoom" Motion "Zoom",
        ZoomToCursor "zoom-to-cursor" Motion "Zoom to the cursor",
        LookAround "look-around" Motion "Look around",
        SetPivot "set-pivot" Press "Set the pivot to the point under the cursor and centre it",
        FocusHere "focus-here" Press "Focus on the point under the cursor",
        OrbitLeft "orbit-left" Press "Orbit left by 15°",
        OrbitRight "orbit-right" Press "Orbit right by 15°",
        OrbitUp "orbit-up" Press "Orbit up by 15°",
        OrbitDown "orbit-down" Press "Orbit down by 15°",
        ZoomIn "zoom-in" Press "Zoom in",
        ZoomOut "zoom-out" Press "Zoom out",
        RollLeft "roll-left" Press "Roll left by 15°",
        RollRight "roll-right" Press "Roll right by 15°",
        Level "level" Press "Level horizon",
        Walk "walk" Press "Walk with W, A, S, D, Q and E, and look with the mouse",
        FlyForward "fly-forward" Hold "Fly forward",
        FlyBack "fly-back" Hold "Fly backward",
        FlyLeft "fly-left" Hold "Fly left",
        FlyRight "fly-right" Hold "Fly right",
        FlyUp "fly-up" Hold "Fly up",
        FlyDown "fly-down" Hold "Fly down",
        FlyFaster "fly-faster" Hold "Fly four times as fast",
    }
    Views {
        FrameSelection "frame-selection" Press "Frame the selection, or the whole scene",
        FrameAll "frame-all" Press "Frame the whole scene",
        ViewFront "view-front" Press "Front view",
        ViewBack "view-back" Press "Back view",
        ViewRight "view-right" Press "Right view",
        ViewLeft "view-left" Press "Left view",
        ViewTop "view-top" Press "Top view",
        ViewBottom "view-bottom" Press "Bottom view",
        ToggleOrthographic "toggle-orthographic" Press "Switch between perspective and orthographic",
        Home "home" Press "Return to the scene's camera",
        UndoView "undo-view" Press "Undo the last camera movement",
        RedoView "redo-view" Press "Redo a camera movement",
        SaveCamera "save-camera" Press "Bookmark view",
        Bookmarks "bookmarks" Press "Show the bookmarked views",
        NextCamera "next-camera" Press "Next camera or bookmark",
        PreviousCamera "previous-camera" Press "Previous camera or bookmark",
        CopyCamera "copy-camera" Press "Copy the view as a command line",
        PasteCamera "paste-camera" Press "Paste the camera from a command line",
    }
    ViewSettings {
        IntegratorWhitted "integrator-whitted" Press "Show the classical picture",
        IntegratorPath "integrator-path" Press "Show the path-traced picture",
        IntegratorNormals "integrator-normals" Press "Show shading normals",
        IntegratorDepth "integrator-depth" Press "Show depth",
        IntegratorIds "integrator-ids" Press "Show primitive IDs",
        IntegratorUv "integrator-uv" Press "Show texture coordinates",
        IntegratorHeat "integrator-heat" Press "Show the BVH heatmap",
        IntegratorSamples "integrator-samples" Press "Show samples per pixel",
        NextLayer "next-layer" Press "Show the next layer of the picture",
        PreviousLayer "previous-layer" Press "Show the previous layer of the picture",
        FalseColor "false-color" Press "Show luminance in false colours, by stops around middle grey",
        SplitWipe "split-wipe" Press "Compare two pictures with a wipe",
        SideBySide "side-by-side" Press "Compare two pictures side by side",
        ShowDifference "show-difference" Press "Show the difference of two pictures",
        SwapSides "swap-sides" Press "Swap comparison sides",
        KeepSnapshot "keep-snapshot" Press "Keep a snapshot of the picture to compare with",
        FlipKept "flip-kept" Press "Flip between the picture and the one that was kept",
        NextKept "next-kept" Press "Show the next kept picture in place of this one",
        Kept1 "kept-one" Press "Flip to the picture that is kept under 1",
        Kept2 "kept-two" Press "Flip to the picture that is kept under 2",
        Kept3 "kept-three" Press "Flip to the picture that is kept under 3",
        Kept4 "kept-four" Press "Flip to the picture that is kept under 4",
        Kept5 "kept-five" Press "Flip to the picture that is kept under 5",
        Kept6 "kept-six" Press "Flip to the picture that is kept under 6",
        Kept7 "kept-seven" Press "Flip to the picture that is kept under 7",
        Kept8 "kept-eight" Press "Flip to the picture that is kept under 8",
        OpenReference "open-reference" Press "Open a reference picture to compare with",
        ExposureUp "exposure-up" Press "Increase exposure by a third of a stop",
        ExposureDown "exposure-down" Press "Decrease exposure by a third of a stop",
        ExposureReset "exposure-reset" Press "Reset to the scene's exposure",
        NextToneCurve "next-tone-curve" Press "Next tone curve",
        PixelZoom "pixel-zoom" Motion "Magnify the pixels under the cursor",
        PixelZoomIn "pixel-zoom-in" Press "Magnify the pixels under the cursor by a step",
        PixelZoomOut "pixel-zoom-out" Press "Reduce the pixels by a step",
        PixelZoomReset "pixel-zoom-reset" Press "Reset the pixel zoom",
        NextBackground "next-background" Press "Next background",
    }
    Rendering {
        PauseRender "pause-render" Press "Pause or resume rendering",
        RestartRender "restart-render" Press "Restart rendering",
        MoreSamples "more-samples" Press "Double the target samples",
        FewerSamples "fewer-samples" Press "Halve the target samples",
        Film "film" Press "Render a film",
    }
    Time {
        PlayPause "play-pause" Press "Play or pause",
        StepForward "step-forward" Press "Next frame",
        StepBack "step-back" Press "Previous frame",
        FirstFrame "first-frame" Press "First frame",
        LastFrame "last-frame" Press "Last frame",
        PlayFaster "play-faster" Press "Double the playback speed",
        PlaySlower "play-slower" Press "Halve the playback speed",
        ToggleLoop "toggle-loop" Press "Toggle looping",
        ToggleMotionBlur "toggle-motion-blur" Press "Toggle motion blur",
    }
    Editing {
        Select "select" Press "Select the object under the cursor",
        TurnLight "turn-light" Motion "Turn the environment; up and down move the sun of a sky",
        SelectBox "select-box" Motion "Select what is in a rectangle; Shift adds, Ctrl removes",
        SnapHandles "snap-handles" Hold "Snap while dragging a handle",
        ToggleSnapping "toggle-snapping" Press "Snap moves, rotations and scales always",
        FineHandles "fine-handles" Hold "Drag a handle at a tenth of the speed, and snap to finer steps",
        Add "add" Press "Add an object, a light, a camera or a model",
        SelectAll "select-all" Press "Select all objects and lights",
        PictureMenu "picture-menu" Press "Show the menu of the point under the cursor",
        SelectNothing "select-nothing" Press "Leave the tool, or deselect",
        ToggleVisible "toggle-visible" Press "Hide or show the selection",
        Rename "rename" Press "Rename the selection",
        Duplicate "duplicate" Press "Duplicate the selection",
        Delete "delete" Press "Delete the selection",
        CopyMeasurements "copy-measurements" Press "Copy the measurements as text",
        Undo "undo" Press "Undo",
        Redo "redo" Press "Redo",
    }
    Files {
        New "new" Press "Make a new scene",
        Open "open" Press "Open a scene, a model or an environment image",
        OpenNext "open-next" Press "Open the next scene in the folder",
        OpenPrevious "open-previous" Press "Open the previous scene in the folder",
        Reload "reload" Press "Reload the scene",
        Revert "revert" Press "Revert all changes",
        SaveScene "save-scene" Press "Save the scene",
        SaveSceneAs "save-scene-as" Press "Save the scene as a new file",
        SavePicture "save-picture" Press "Save the picture",
        CopyPicture "copy-picture" Press "Copy the picture to the clipboard",
        SavePictureWithOverlays "save-picture-with-overlays" Press "Save the picture with overlays",
    }
    Window {
        Help "help" Press "Show keyboard shortcuts",
        Preferences "preferences" Press "Show preferences",
        TogglePanels "toggle-panels" Press "Show or hide all panels",
        ToggleOutline "toggle-outline" Press "Show or hide the outline",
        ToggleOverlays "toggle-overlays" Press "Show or hide overlays",
        ToggleOutlines "toggle-selection-outline" Press "Show or hide the outline of the selection",
        ToggleGrid "toggle-grid" Press "Show or hide the grid",
        ToggleWireframe "toggle-wireframe" Press "Show or hide all edges of meshes",
        ToggleFeatureEdges "toggle-feature-edges" Press "Show or hide borders, creases and edges between materials",
        ToggleSectionHandle "toggle-section-handle" Press "Show or hide the handle of the section plane",
        ToggleLampHandles "toggle-lamp-handles" Press "Show or hide the handles of lamps",
        ToggleInspectedRays "toggle-inspected-rays" Press "Show or hide the inspected rays over the picture",
        ToggleStatistics "toggle-statistics" Press "Show or hide statistics",
        ToggleTheme "toggle-theme" Press "Switch between dark and light",
        LargerText "larger-text" Press "Zoom the interface in",
        SmallerText "smaller-text" Press "Zoom the interface out",
        ResetText "reset-text" Press "Reset the interface zoom",
        FullScreen "full-screen" Press "Toggle full screen",
        Quit "quit" Press "Close the window",
    }
}

/// The actions that flip to kept pictures, by their numbers.
const KEPT: [Action; 8] = [
    Action::Kept1,
    Action::Kept2,
    Action::Kept3,
    Action::Kept4,
    Action::Kept5,
    Action::Kept6,
    Action::Kept7,
    Action::Kept8,
];

impl Action {
    /// All, in the order of the table.
    pub const ALL: &[Self] = &in_order();

    /// Whether it modifies a handle drag. Fly and camera keys are ignored during one.
    pub fn is_of_handles(self) -> bool {
        matches!(self, Self::SnapHandles | Self::FineHandles)
    }

    /// The integrator that it switches to.
    pub fn integrator(self) -> Option<Integrator> {
        Integrator::named(self.name().strip_prefix("integrator-")?)
    }

    /// The action that flips to the kept picture of this number.
    pub fn kept(number: usize) -> Option<Self> {
        number
            .checked_sub(1)
            .and_then(|index| KEPT.get(index).copied())
    }

    /// The number of the kept picture that it flips to.
    pub fn kept_number(self) -> Option<usize> {
        KEPT.iter()
            .position(|kept| *kept == self)
            .map(|index| index + 1)
    }

    /// The action with that name in settings files.
    pub fn from_name(name: &str) -> Option<Self> {
        Self::ALL
            .iter()
            .copied()
            .find(|action| action.name() == name)
    }
}

/// All commands by category: the tools are inserted into the others.
const fn in_order() -> [Action; LISTED.len() + Tool::ALL.len()] {
    let mut all = [Action::Quit; LISTED.len() + Tool::ALL.len()];
    let mut before = 0;
    while (LISTED[before].category() as usize) < Category::Tools as usize {
        before += 1;
    }
    let after = before + Tool::ALL.len();
    let mut at = 0;
    while at < all.len() {
        all[at] = match at {
            _ if at < before => LISTED[at],
            _ if at < after => Action::Tool(Tool::ALL[at - before]),
            _ => LISTED[at - Tool::ALL.len()],
        };
        at += 1;
    }
    all
}
