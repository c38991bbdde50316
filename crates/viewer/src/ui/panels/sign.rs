//! Signs of tools and commands, which are letters of the font of Lucide's icons, and buttons with them.

use crate::model::tool::Tool;
use eframe::egui::{
    self, Align2, Button, Color32, FontFamily, FontId, Painter, Pos2, Response, Role, Ui, vec2,
};
use lucide_icons::Icon;

/// The name of the font of the icons.
pub const ICONS: &str = "icons";
/// Size of a sign, and side of its button, in points.
const SIZE: f32 = 17.0;
pub const SIDE: f32 = 28.0;

/// The effect of a button.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Sign {
    /// Activates a tool.
    Tool(Tool),
    /// Undoes the last edit.
    Undo,
    /// Repeats the edit that was undone.
    Redo,
    /// Rounds moves, rotations and scales.
    Snapping,
    /// Hides what lies over the picture.
    Overlays,
    /// Compares two pictures.
    Compare,
    /// Moves the camera.
    Camera,
    /// The picture shows another part than one of the scene's size.
    Framing,
    /// Plays the animation.
    Play,
    /// Pauses it.
    Pause,
    /// Goes to the next frame, or the previous one.
    Forward,
    Back,
    /// Goes to the first frame, or the last one.
    First,
    Last,
}

impl Sign {
    fn icon(self) -> Icon {
        match self {
            Self::Tool(tool) => match tool {
                Tool::Select => Icon::MousePointer2,
                Tool::Box => Icon::SquareDashedMousePointer,
                Tool::Move => Icon::Move,
                Tool::Rotate => Icon::RotateCw,
                Tool::Scale => Icon::Scaling,
                Tool::Inspect => Icon::Waypoints,
                Tool::Measure => Icon::Ruler,
                Tool::Region => Icon::Crop,
            },
            Self::Undo => Icon::Undo2,
            Self::Redo => Icon::Redo2,
            Self::Snapping => Icon::Magnet,
            Self::Overlays => Icon::Layers,
            Self::Compare => Icon::SquareSplitHorizontal,
            Self::Camera => Icon::Video,
            Self::Framing => Icon::Fullscreen,
            Self::Play => Icon::Play,
            Self::Pause => Icon::Pause,
            Self::Forward => Icon::StepForward,
            Self::Back => Icon::StepBack,
            Self::First => Icon::SkipBack,
            Self::Last => Icon::SkipForward,
        }
    }
}

/// Draws a sign around a point.
pub fn draw(painter: &Painter, sign: Sign, center: Pos2, color: Color32) {
    let font = FontId::new(SIZE, FontFamily::Name(ICONS.into()));
    let letter = char::from(sign.icon());
    painter.text(center, Align2::CENTER_CENTER, letter, font, color);
}

/// A square button with a sign, and the name that is read aloud.
pub fn button(
    ui: &mut Ui,
    sign: Sign,
    name: &str,
    is_selected: bool,
    is_enabled: bool,
) -> Response {
    let widget = Button::new("")
        .selected(is_selected)
        .frame_when_inactive(is_selected)
        .min_size(vec2(SIDE, SIDE));
    let response = ui.add_enabled(is_enabled, widget);
    response
        .widget_info(|| egui::WidgetInfo::selected(Role::Button, is_enabled, is_selected, name));
    let color = match is_selected {
        true => ui.visuals().selection.stroke.color,
        false => ui.style().interact(&response).fg_stroke.color,
    };
    let color = match is_enabled {
        true => color,
        false => ui.visuals().disable(color),
    };
    draw(ui.painter(), sign, response.rect.center(), color);
    response
}
