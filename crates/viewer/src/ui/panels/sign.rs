//! Signs of tools and commands, painted because fonts lack them, and buttons with them.

use crate::model::tool::Tool;
use eframe::egui::{self, Button, Color32, Painter, Pos2, Response, Role, Shape, Stroke, Ui, vec2};

/// Half the size of a sign, and the side of its button, in points.
const HALF: f32 = 8.0;
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
}

/// Lines through points from -1 to 1, to the right and downwards.
type Lines = &'static [&'static [(f32, f32)]];

const SELECT: Lines = &[&[
    (-0.5, -0.9),
    (-0.5, 0.6),
    (-0.1, 0.3),
    (0.2, 0.9),
    (0.45, 0.78),
    (0.15, 0.2),
    (0.65, 0.15),
    (-0.5, -0.9),
]];
const BOX: Lines = &[
    &[(-0.9, -0.4), (-0.9, -0.8), (-0.5, -0.8)],
    &[(-0.1, -0.8), (0.4, -0.8)],
    &[(0.9, -0.8), (0.9, -0.3)],
    &[(-0.9, 0.0), (-0.9, 0.6), (-0.4, 0.6)],
    &[
        (0.1, -0.2),
        (0.1, 0.75),
        (0.35, 0.55),
        (0.55, 0.95),
        (0.72, 0.85),
        (0.55, 0.45),
        (0.9, 0.4),
        (0.1, -0.2),
    ],
];
const MOVE: Lines = &[
    &[(-0.95, 0.0), (0.95, 0.0)],
    &[(0.0, -0.95), (0.0, 0.95)],
    &[(-0.65, -0.3), (-0.95, 0.0), (-0.65, 0.3)],
    &[(0.65, -0.3), (0.95, 0.0), (0.65, 0.3)],
    &[(-0.3, -0.65), (0.0, -0.95), (0.3, -0.65)],
    &[(-0.3, 0.65), (0.0, 0.95), (0.3, 0.65)],
];
const ROTATE: Lines = &[
    &[
        (0.62, -0.52),
        (0.4, -0.7),
        (0.0, -0.8),
        (-0.4, -0.7),
        (-0.7, -0.4),
        (-0.8, 0.0),
        (-0.7, 0.4),
        (-0.4, 0.7),
        (0.0, 0.8),
        (0.4, 0.7),
        (0.7, 0.4),
        (0.8, 0.0),
    ],
    &[(0.75, -0.95), (0.68, -0.46), (0.2, -0.45)],
];
const SCALE: Lines = &[
    &[
        (-0.9, 0.1),
        (-0.1, 0.1),
        (-0.1, 0.9),
        (-0.9, 0.9),
        (-0.9, 0.1),
    ],
    &[(0.1, -0.1), (0.9, -0.9)],
    &[(0.35, -0.9), (0.9, -0.9), (0.9, -0.35)],
];
const INSPECT: Lines = &[
    &[(-0.9, -0.75), (0.0, 0.6), (0.9, -0.75)],
    &[(0.4, -0.6), (0.9, -0.75), (0.9, -0.25)],
    &[(-0.9, 0.75), (0.9, 0.75)],
];
const MEASURE: Lines = &[
    &[(-0.9, 0.0), (0.9, 0.0)],
    &[(-0.9, -0.5), (-0.9, 0.5)],
    &[(0.9, -0.5), (0.9, 0.5)],
    &[(-0.3, 0.0), (-0.3, -0.3)],
    &[(0.3, 0.0), (0.3, -0.3)],
];
const REGION: Lines = &[
    &[(-0.9, -0.3), (-0.9, -0.8), (-0.4, -0.8)],
    &[(0.4, -0.8), (0.9, -0.8), (0.9, -0.3)],
    &[(0.9, 0.3), (0.9, 0.8), (0.4, 0.8)],
    &[(-0.4, 0.8), (-0.9, 0.8), (-0.9, 0.3)],
];
const SNAPPING: Lines = &[
    &[
        (-0.8, -0.8),
        (-0.8, 0.1),
        (-0.55, 0.6),
        (0.0, 0.85),
        (0.55, 0.6),
        (0.8, 0.1),
        (0.8, -0.8),
        (0.35, -0.8),
        (0.35, 0.05),
        (0.2, 0.3),
        (0.0, 0.4),
        (-0.2, 0.3),
        (-0.35, 0.05),
        (-0.35, -0.8),
        (-0.8, -0.8),
    ],
    &[(-0.8, -0.4), (-0.35, -0.4)],
    &[(0.35, -0.4), (0.8, -0.4)],
];
const UNDO: Lines = &[
    &[
        (-0.85, -0.3),
        (0.2, -0.3),
        (0.65, -0.1),
        (0.8, 0.3),
        (0.65, 0.65),
        (0.2, 0.8),
        (-0.5, 0.8),
    ],
    &[(-0.4, -0.8), (-0.9, -0.3), (-0.4, 0.2)],
];
const REDO: Lines = &[
    &[
        (0.85, -0.3),
        (-0.2, -0.3),
        (-0.65, -0.1),
        (-0.8, 0.3),
        (-0.65, 0.65),
        (-0.2, 0.8),
        (0.5, 0.8),
    ],
    &[(0.4, -0.8), (0.9, -0.3), (0.4, 0.2)],
];
const OVERLAYS: Lines = &[
    &[
        (0.0, -0.8),
        (0.9, -0.25),
        (0.0, 0.3),
        (-0.9, -0.25),
        (0.0, -0.8),
    ],
    &[(-0.9, 0.25), (0.0, 0.8), (0.9, 0.25)],
];
const COMPARE: Lines = &[
    &[
        (-0.9, -0.7),
        (0.9, -0.7),
        (0.9, 0.7),
        (-0.9, 0.7),
        (-0.9, -0.7),
    ],
    &[(0.0, -0.95), (0.0, 0.95)],
    &[(0.3, -0.3), (0.6, -0.3)],
    &[(0.3, 0.3), (0.6, 0.3)],
];
const CAMERA: Lines = &[
    &[
        (-0.9, -0.55),
        (0.35, -0.55),
        (0.35, 0.55),
        (-0.9, 0.55),
        (-0.9, -0.55),
    ],
    &[(0.35, -0.1), (0.95, -0.45), (0.95, 0.45), (0.35, 0.1)],
];
const FRAMING: Lines = &[
    &[
        (-0.4, -0.7),
        (0.4, -0.7),
        (0.4, 0.7),
        (-0.4, 0.7),
        (-0.4, -0.7),
    ],
    &[(-0.7, -0.3), (-0.95, 0.0), (-0.7, 0.3)],
    &[(0.7, -0.3), (0.95, 0.0), (0.7, 0.3)],
];

fn lines(sign: Sign) -> Lines {
    match sign {
        Sign::Tool(tool) => match tool {
            Tool::Select => SELECT,
            Tool::Box => BOX,
            Tool::Move => MOVE,
            Tool::Rotate => ROTATE,
            Tool::Scale => SCALE,
            Tool::Inspect => INSPECT,
            Tool::Measure => MEASURE,
            Tool::Region => REGION,
        },
        Sign::Undo => UNDO,
        Sign::Redo => REDO,
        Sign::Snapping => SNAPPING,
        Sign::Overlays => OVERLAYS,
        Sign::Compare => COMPARE,
        Sign::Camera => CAMERA,
        Sign::Framing => FRAMING,
    }
}

/// Draws a sign around a point.
pub fn draw(painter: &Painter, sign: Sign, center: Pos2, color: Color32) {
    for points in lines(sign) {
        let points = points.iter().map(|(x, y)| center + HALF * vec2(*x, *y));
        let stroke = Stroke::new(1.4, color);
        painter.add(Shape::line(points.collect(), stroke));
    }
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
