//! Moving, rotating and scaling as in Blender: a key begins it, the thing follows the pointer without a
//! button, X, Y and Z limit it to an axis (with Shift: to the plane of the other two), digits say how much,
//! and Enter or a click ends it. Escape or a right click takes it back.

use super::super::bindings::{Action, Preset};
use super::super::objects;
use super::super::session::Session;
use super::super::tools::Tool;
use super::handles::{Handles, Part};
use eframe::egui::{self, Event, Id, Key, Order, PointerButton, Sense};
use glam::DAffine3;

/// A movement that a key began.
#[derive(Clone, Debug, Default)]
pub struct Modal {
    /// The axis of the limit, and whether that is the plane across it.
    limit: Option<(usize, bool)>,
    /// A number so far.
    typed: String,
    /// Where the thing was put last.
    pub place: Option<DAffine3>,
    /// Whether it ends with the next place.
    pub is_confirmed: bool,
}

impl Modal {
    /// The handle that does the same. Where the thing has no such freedom, that for all directions.
    pub fn part(&self, handles: &Handles) -> Part {
        let wanted = match (handles.tool, self.limit) {
            (_, None) => Part::All,
            (Tool::Rotate, Some((axis, _))) => Part::Ring(axis),
            (_, Some((axis, false))) => Part::Axis(axis),
            (_, Some((axis, true))) => Part::Plane(axis),
        };
        match handles.parts.contains(&wanted) {
            true => wanted,
            false => Part::All,
        }
    }

    /// The number that was typed.
    pub fn amount(&self) -> Option<f64> {
        self.typed.parse().ok()
    }

    /// The number as far as it was typed.
    pub fn typed(&self) -> &str {
        &self.typed
    }

    fn limit(&mut self, axis: usize, is_plane: bool) {
        // The second time it is taken back.
        let limit = Some((axis, is_plane));
        self.limit = if self.limit == limit { None } else { limit };
    }

    fn type_key(&mut self, key: Key) {
        match key {
            Key::Minus => match self.typed.strip_prefix('-') {
                Some(rest) => self.typed = rest.to_owned(),
                None => self.typed.insert(0, '-'),
            },
            Key::Period | Key::Comma if !self.typed.contains('.') => self.typed.push('.'),
            Key::Backspace => _ = self.typed.pop(),
            _ => {
                let digits = [
                    Key::Num0,
                    Key::Num1,
                    Key::Num2,
                    Key::Num3,
                    Key::Num4,
                    Key::Num5,
                    Key::Num6,
                    Key::Num7,
                    Key::Num8,
                    Key::Num9,
                ];
                let digit = digits.into_iter().position(|digit| digit == key);
                self.typed.extend(digit.map(|digit| digit.to_string()));
            }
        }
    }
}

/// Takes up a tool. With Blender's bindings that moves what is selected at once.
pub fn take(session: &mut Session, tool: Tool) {
    session.tool = tool;
    let scene = session.scene().cloned();
    let time = session.playback.time;
    let has_place = (session.selection.zip(scene))
        .is_some_and(|(id, scene)| objects::place(&scene, id, time).is_some());
    let is_blender = session.preferences.bindings.preset() == Preset::Blender;
    if is_blender && has_place && session.viewport.is_some() && session.editing.grip.is_none() {
        session.editing.modal = Some(Modal::default());
    }
}

/// Gives a key to the movement that is under way. Whether there is one, which takes all keys.
pub fn key(session: &mut Session, event: &Event) -> bool {
    let action = session.preferences.bindings.pressed_by(event);
    let Some(modal) = &mut session.editing.modal else {
        return false;
    };
    let &Event::Key {
        key,
        pressed: true,
        modifiers,
        ..
    } = event
    else {
        return true;
    };
    let other = match action {
        Some(Action::MoveTool) => Some(Tool::Move),
        Some(Action::RotateTool) => Some(Tool::Rotate),
        Some(Action::ScaleTool) => Some(Tool::Scale),
        _ => None,
    };
    match key {
        Key::X => modal.limit(0, modifiers.shift),
        Key::Y => modal.limit(1, modifiers.shift),
        Key::Z => modal.limit(2, modifiers.shift),
        Key::Enter => modal.is_confirmed = true,
        Key::Escape => cancel(session),
        _ => match other {
            Some(tool) => {
                cancel(session);
                take(session, tool);
            }
            None => modal.type_key(key),
        },
    }
    true
}

/// Takes back what is being dragged, by a handle or without one.
pub fn cancel(session: &mut Session) {
    session.editing.grip = None;
    session.editing.modal = None;
    if let Some(document) = &mut session.document {
        document.cancel();
    }
    session.moved();
}

/// Lies over the whole window while a movement is under way: clicks end it and do nothing else.
pub fn shield(ctx: &egui::Context, session: &mut Session) {
    if session.editing.modal.is_none() {
        return;
    }
    // Nobody sees where the thing is.
    if session.viewport.is_none() {
        cancel(session);
        return;
    }
    let area = egui::Area::new(Id::unique("movement")).order(Order::Foreground);
    let area = area.fixed_pos(ctx.content_rect().min);
    let response = area.show(ctx, |ui| {
        ui.allocate_response(ctx.content_rect().size(), Sense::click_and_drag())
    });
    let response = response.inner;
    let ends = |button| response.clicked_by(button) || response.drag_stopped_by(button);
    if ends(PointerButton::Secondary) {
        cancel(session);
    } else if ends(PointerButton::Primary)
        && let Some(modal) = &mut session.editing.modal
    {
        modal.is_confirmed = true;
        ctx.request_repaint();
    }
}
