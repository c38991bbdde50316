//! What the mouse does in the picture.

use super::bindings::Action;
use super::inspector;
use super::navigation::Rig;
use super::question;
use super::session::Session;
use super::viewport::Viewport;
use eframe::egui::{self, LayerId, PointerButton, Pos2};

/// All that a mouse may have.
const BUTTONS: [PointerButton; 5] = [
    PointerButton::Primary,
    PointerButton::Middle,
    PointerButton::Secondary,
    PointerButton::Extra1,
    PointerButton::Extra2,
];

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

/// Hands the mouse in the picture to the camera, by the bindings. What a tool or a handle takes for
/// itself does not come here.
pub fn navigate(session: &mut Session, response: &egui::Response, viewport: Viewport) {
    let ctx = &response.ctx;
    let (modifiers, pointer) = ctx.input(|input| (input.modifiers, input.pointer.interact_pos()));
    let bindings = session.preferences.bindings.clone();
    for button in BUTTONS {
        if response.drag_started_by(button)
            && let (Some(from), Some(action)) = (pointer, bindings.drag(button, modifiers))
        {
            session.drag = Some(Drag { action, from });
        }
        if response.double_clicked_by(button) {
            click(session, bindings.double_click(button, modifiers), pointer);
        } else if response.clicked_by(button) {
            click(session, bindings.click(button, modifiers), pointer);
        }
    }
    if !session.clicked.is_empty() {
        ctx.request_repaint();
    }
    if let (Some(drag), Some(to)) = (session.drag, pointer) {
        let from = to - response.drag_delta();
        if from != to
            && let Some(rig) = &mut session.rig
        {
            follow(rig, drag, viewport, from, to);
            session.moved();
        }
        if response.drag_stopped() {
            session.drag = None;
        }
    }
    if response.hovered() {
        let turned = ctx.input(|input| bindings.wheel(input));
        wheel(session, &turned, pointer, viewport);
    }
}

fn wheel(
    session: &mut Session,
    turned: &[(Action, f64)],
    pointer: Option<Pos2>,
    viewport: Viewport,
) {
    for &(action, steps) in turned {
        if let Some(rig) = &mut session.rig {
            let at = pointer
                .filter(|_| action == Action::ZoomToCursor)
                .map(|point| rig.point_at(viewport.position(point), viewport.extent()));
            rig.zoom(steps, at);
            session.moved();
        }
    }
}

/// Moves the camera by a drag from one point of the screen to another.
pub fn follow(rig: &mut Rig, drag: Drag, viewport: Viewport, from: Pos2, to: Pos2) {
    let size = viewport.extent();
    let (start, end) = (viewport.position(from), viewport.position(to));
    let moved = end - start;
    match drag.action {
        Action::Orbit => rig.orbit(moved, size),
        Action::Pan => rig.pan(start, end, size, None),
        Action::LookAround => rig.look(moved, size),
        Action::Zoom => rig.drag_zoom(moved, size, None),
        Action::ZoomToCursor => {
            let at = rig.point_at(viewport.position(drag.from), size);
            rig.drag_zoom(moved, size, Some(at));
        }
        _ => {}
    }
}

/// Carries out a command about what is under the cursor, where a key gave it. Whether it is one.
pub fn perform(action: Action, session: &mut Session, ctx: &egui::Context) -> bool {
    if !is_pick(action) {
        return false;
    }
    let pointer = ctx.pointer_hover_pos();
    let pointer = pointer.filter(|point| ctx.layer_id_at(*point) == Some(LayerId::background()));
    match (pointer.zip(session.viewport)).and_then(|(point, view)| view.pixel(point)) {
        Some(pixel) => pick(session, action, pixel),
        None => (session.notices).tell("Point at something in the picture first"),
    }
    true
}

/// What a click is bound to; a plain one belongs to the tool.
fn click(session: &mut Session, action: Option<Action>, pointer: Option<Pos2>) {
    let pixel = (pointer.zip(session.viewport)).and_then(|(point, view)| view.pixel(point));
    match (action, pixel) {
        (Some(action), Some(pixel)) if is_pick(action) => pick(session, action, pixel),
        (Some(action), _) if !is_pick(action) => session.clicked.push(action),
        _ => {}
    }
}

fn is_pick(action: Action) -> bool {
    matches!(
        action,
        Action::SetPivot | Action::FocusHere | Action::Select
    )
}

fn pick(session: &mut Session, action: Action, pixel: [u32; 2]) {
    let purpose = match action {
        Action::Select if session.tool == Tool::Inspect => {
            inspector::inspect(session, pixel);
            return;
        }
        Action::SetPivot => Purpose::Pivot,
        Action::FocusHere => Purpose::Focus,
        _ => Purpose::Select,
    };
    session.ask(move |studio| question::pick(studio, pixel, purpose));
}
