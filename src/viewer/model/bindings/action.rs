//! Every command of the viewer.

use crate::render::Integrator;

/// What commands have to do with each other; the order of the table.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Category {
    /// Moving the camera.
    Camera,
    /// Views and cameras kept.
    Views,
    /// What is shown of the scene.
    ViewSettings,
    /// The work on the picture.
    Rendering,
    /// Time.
    Time,
    /// Changing the scene.
    Editing,
    /// Scenes and pictures.
    Files,
    /// The window itself.
    Window,
}

impl Category {
    /// All, in the order of the table.
    pub const ALL: [Self; 8] = [
        Self::Camera,
        Self::Views,
        Self::ViewSettings,
        Self::Rendering,
        Self::Time,
        Self::Editing,
        Self::Files,
        Self::Window,
    ];

    /// As a heading.
    pub fn title(self) -> &'static str {
        match self {
            Self::Camera => "Camera",
            Self::Views => "Views",
            Self::ViewSettings => "Look",
            Self::Rendering => "Rendering",
            Self::Time => "Time",
            Self::Editing => "Editing",
            Self::Files => "Files",
            Self::Window => "Window",
        }
    }
}

/// How a command is given.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Manner {
    /// Once, when a key is pressed; at most a click of the mouse.
    Press,
    /// As long as a key is held.
    Hold,
    /// With the mouse: a drag or a wheel.
    Motion,
}

macro_rules! actions {
    ($($category:ident { $($action:ident $name:literal $manner:ident $text:literal,)* })*) => {
        /// A command of the viewer.
        #[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
        pub enum Action {
            $($(#[doc = $text] $action,)*)*
        }

        impl Action {
            /// All, in the order of the table.
            pub const ALL: &[Self] = &[$($(Self::$action,)*)*];

            /// As settings files have it: never changes.
            pub fn name(self) -> &'static str {
                match self { $($(Self::$action => $name,)*)* }
            }

            /// What it does, in one line without a full stop.
            pub fn description(self) -> &'static str {
                match self { $($(Self::$action => $text,)*)* }
            }

            /// Where it stands in the table.
            pub fn category(self) -> Category {
                match self { $($(Self::$action => Category::$category,)*)* }
            }

            /// How it is given.
            pub fn manner(self) -> Manner {
                match self { $($(Self::$action => Manner::$manner,)*)* }
            }
        }
    };
}

actions! {
    Camera {
        Orbit "orbit" Motion "Go round the pivot",
        Pan "pan" Motion "Shift the camera; the pivot stays under the hand",
        Zoom "zoom" Motion "Come nearer or go away",
        ZoomToCursor "zoom-to-cursor" Motion "Come nearer to what is under the cursor, or go away from it",
        LookAround "look-around" Motion "Turn the camera where it is",
        SetPivot "set-pivot" Press "Make the point under the cursor the pivot, and centre it",
        FocusHere "focus-here" Press "Make what is as far away as the point under the cursor sharp",
        OrbitLeft "orbit-left" Press "Go round the pivot to the left by 15°",
        OrbitRight "orbit-right" Press "Go round the pivot to the right by 15°",
        OrbitUp "orbit-up" Press "Go over the pivot by 15°",
        OrbitDown "orbit-down" Press "Go under the pivot by 15°",
        ZoomIn "zoom-in" Press "Come nearer by a step",
        ZoomOut "zoom-out" Press "Go away by a step",
        RollLeft "roll-left" Press "Roll the camera to the left by 15°",
        RollRight "roll-right" Press "Roll the camera to the right by 15°",
        Level "level" Press "Take all roll away",
        FlyForward "fly-forward" Hold "Fly ahead",
        FlyBack "fly-back" Hold "Fly backwards",
        FlyLeft "fly-left" Hold "Fly to the left",
        FlyRight "fly-right" Hold "Fly to the right",
        FlyUp "fly-up" Hold "Fly upwards",
        FlyDown "fly-down" Hold "Fly downwards",
        FlyFaster "fly-faster" Hold "Fly four times as fast",
    }
    Views {
        FrameSelection "frame-selection" Press "Show all of what is selected, or of the scene",
        FrameAll "frame-all" Press "Show all of the scene",
        ViewFront "view-front" Press "View from the front",
        ViewBack "view-back" Press "View from behind",
        ViewRight "view-right" Press "View from the right",
        ViewLeft "view-left" Press "View from the left",
        ViewTop "view-top" Press "View from above",
        ViewBottom "view-bottom" Press "View from below",
        ToggleOrthographic "toggle-orthographic" Press "Change between perspective and orthographic",
        Home "home" Press "Go back to the scene's camera",
        SaveCamera "save-camera" Press "Keep this camera",
        NextCamera "next-camera" Press "Go to the next camera of the scene, or kept one",
        PreviousCamera "previous-camera" Press "Go to the one before",
        CopyCamera "copy-camera" Press "Copy what is seen as a command line",
        PasteCamera "paste-camera" Press "Take the camera out of a command line",
    }
    ViewSettings {
        IntegratorWhitted "integrator-whitted" Press "Show the picture",
        IntegratorNormals "integrator-normals" Press "Show shading normals",
        IntegratorDepth "integrator-depth" Press "Show distances",
        IntegratorIds "integrator-ids" Press "Show each primitive in its own colour",
        IntegratorUv "integrator-uv" Press "Show texture coordinates",
        IntegratorHeat "integrator-heat" Press "Show how much of the tree rays visit",
        IntegratorSamples "integrator-samples" Press "Show how many samples pixels got",
        SplitWipe "split-wipe" Press "Compare two looks in one picture, with a line to drag",
        SideBySide "side-by-side" Press "Compare two looks side by side",
        SwapSides "swap-sides" Press "Change over the two looks",
        ExposureUp "exposure-up" Press "Brighten by a third of a stop",
        ExposureDown "exposure-down" Press "Darken by a third of a stop",
        ExposureReset "exposure-reset" Press "Take back the scene's own exposure",
        NextToneCurve "next-tone-curve" Press "Take the next tone curve",
        PixelZoom "pixel-zoom" Motion "Magnify the pixels under the cursor",
        PixelZoomIn "pixel-zoom-in" Press "Magnify the pixels under the cursor by a step",
        PixelZoomOut "pixel-zoom-out" Press "Reduce the pixels by a step",
        PixelZoomReset "pixel-zoom-reset" Press "Reset the pixel zoom",
        NextBackground "next-background" Press "Take the next background",
    }
    Rendering {
        PauseRender "pause-render" Press "Pause the render, or go on",
        RestartRender "restart-render" Press "Start the picture again",
        RegionRender "region-render" Press "Render a region only: drag it, or end it",
        MoreSamples "more-samples" Press "Double the samples to be reached",
        FewerSamples "fewer-samples" Press "Halve the samples to be reached",
    }
    Time {
        PlayPause "play-pause" Press "Play the animation, or pause it",
        StepForward "step-forward" Press "Go a frame on",
        StepBack "step-back" Press "Go a frame back",
        FirstFrame "first-frame" Press "Go to the first frame",
        LastFrame "last-frame" Press "Go to the last frame",
        PlayFaster "play-faster" Press "Play twice as fast",
        PlaySlower "play-slower" Press "Play half as fast",
        ToggleLoop "toggle-loop" Press "Play for ever, or once",
        ToggleMotionBlur "toggle-motion-blur" Press "Motion blur on or off",
    }
    Editing {
        Select "select" Press "Select what is under the cursor",
        SelectMode "select-mode" Press "Take the selection tool",
        InspectRays "inspect-rays" Press "Take the ray inspector: a click shows a pixel's rays",
        MoveTool "move-tool" Press "Move what is selected",
        RotateTool "rotate-tool" Press "Rotate what is selected",
        ScaleTool "scale-tool" Press "Scale what is selected",
        SnapHandles "snap-handles" Hold "Drag a handle in whole steps",
        FineHandles "fine-handles" Hold "Drag a handle at a tenth of the pace",
        SelectNothing "select-nothing" Press "Leave the tool, or select nothing",
        ToggleVisible "toggle-visible" Press "Hide or show what is selected",
        Rename "rename" Press "Rename what is selected",
        Duplicate "duplicate" Press "Duplicate what is selected",
        Delete "delete" Press "Delete what is selected",
        Undo "undo" Press "Undo",
        Redo "redo" Press "Redo",
    }
    Files {
        Open "open" Press "Open a scene, a model or a picture of the surroundings",
        OpenNext "open-next" Press "Open the next scene of the folder",
        OpenPrevious "open-previous" Press "Open the one before",
        Reload "reload" Press "Read the scene again",
        Revert "revert" Press "Throw all changes away",
        SaveScene "save-scene" Press "Save the scene",
        SaveSceneAs "save-scene-as" Press "Save the scene under another name",
        SavePicture "save-picture" Press "Save the picture",
        SavePictureWithOverlays "save-picture-with-overlays" Press "Save the picture with what is drawn over it",
    }
    Window {
        Help "help" Press "Show all bindings",
        Preferences "preferences" Press "Show the preferences",
        TogglePanels "toggle-panels" Press "Show or hide all panels",
        ToggleOutline "toggle-outline" Press "Show or hide the outline",
        ToggleOverlays "toggle-overlays" Press "Show or hide what is drawn over the picture",
        ToggleStatistics "toggle-statistics" Press "Show or hide the figures of the render",
        ToggleTheme "toggle-theme" Press "Change between dark and light",
        LargerText "larger-text" Press "Make everything larger",
        SmallerText "smaller-text" Press "Make everything smaller",
        ResetText "reset-text" Press "Take back the screen's own scale",
        FullScreen "full-screen" Press "Full screen on or off",
        Quit "quit" Press "Close the window",
    }
}

impl Action {
    /// Whether it is given while a handle is dragged, when keys that fly or move the camera do not.
    pub fn is_of_handles(self) -> bool {
        matches!(self, Self::SnapHandles | Self::FineHandles)
    }

    /// What it shows, by the integrator's name.
    pub fn integrator(self) -> Option<Integrator> {
        Integrator::named(self.name().strip_prefix("integrator-")?)
    }

    /// The one of that name.
    pub fn from_name(name: &str) -> Option<Self> {
        Self::ALL
            .iter()
            .copied()
            .find(|action| action.name() == name)
    }
}
