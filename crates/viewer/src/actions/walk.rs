//! Walking through the scene: W, A, S, D, Q and E move the camera, the mouse looks, and the wheel changes the speed. Enter and a
//! click keep the view, Escape and a right click return to the one before.

use crate::model::bindings::wheel_steps;
use crate::model::camera::Flight;
use crate::state::session::Session;
use crate::state::walk::Walk;
use eframe::egui::viewport::CursorGrab;
use eframe::egui::{self, Event, InputState, Key, ViewportCommand};
use glam::DVec2;

/// Factor on the speed per step of the wheel.
const WHEEL: f64 = 1.25;
/// Factor on the speed while Shift is held.
const FASTER: f64 = 4.0;
/// Points that the pointer may be away from the middle of the picture before it is put back there.
const AWAY: f32 = 60.0;

/// Begins a walk, if there is a picture.
pub fn begin(session: &mut Session, ctx: &egui::Context) {
    let (Some(controller), Some(_)) = (&session.controller, session.viewport) else {
        (session.messages).notify("There is no picture to walk in yet");
        return;
    };
    session.camera_history.note(controller, true);
    session.drag = None;
    session.walk = Some(Walk {
        before: session.camera_history.clone(),
        pace: 1.0,
    });
    egui::Popup::close_all(ctx);
    ctx.memory_mut(|memory| memory.stop_text_input());
    // The second one is for systems without the first.
    for grab in [CursorGrab::Confined, CursorGrab::Locked] {
        ctx.send_viewport_cmd(ViewportCommand::CursorGrab(grab));
    }
}

/// Ends a walk. Without `keeps`, the camera returns to where it began.
pub fn end(session: &mut Session, ctx: &egui::Context, keeps: bool) {
    let Some(walk) = session.walk.take() else {
        return;
    };
    free_pointer(ctx);
    if let Some(controller) = &mut session.controller {
        controller.fly(Flight::default());
        match keeps {
            true => session.camera_history.note(controller, true),
            false => session.camera_history.return_to(walk.before, controller),
        }
    }
    session.moved();
}

/// Lets the pointer leave the window.
pub(super) fn free_pointer(ctx: &egui::Context) {
    ctx.send_viewport_cmd(ViewportCommand::CursorGrab(CursorGrab::None));
}

/// Handles the input of a frame. Returns whether there is a walk, which takes all keys.
pub fn input(session: &mut Session, ctx: &egui::Context) -> bool {
    let Some(walk) = &mut session.walk else {
        return false;
    };
    let (ends, is_focused) = ctx.input(|input| {
        let steps: f64 = input.events.iter().map(wheel_steps).sum();
        walk.pace = (walk.pace * WHEEL.powf(steps)).clamp(Walk::PACES[0], Walk::PACES[1]);
        let keeps = input.key_pressed(Key::Enter);
        let ends = keeps || input.key_pressed(Key::Escape);
        (ends.then_some(keeps), input.focused)
    });
    if let (Some(viewport), Some(controller)) = (session.viewport, &mut session.controller) {
        let moved = ctx.input(|input| {
            let pointer = &input.pointer;
            // Not all systems tell the motion of a mouse whose pointer is held.
            pointer.motion().unwrap_or(pointer.delta())
        });
        if moved != egui::Vec2::ZERO {
            let moved = DVec2::new(moved.x.into(), moved.y.into());
            let height = f64::from(viewport.rect.height());
            controller.look(moved, DVec2::splat(height));
            session.last_motion = session.now;
        }
        controller.fly(ctx.input(|input| flight(input, walk.pace)));
        put_back(ctx, viewport.rect.center());
    }
    let ends = ends.or((!is_focused || session.viewport.is_none()).then_some(true));
    if let Some(keeps) = ends {
        end(session, ctx, keeps);
    }
    // A widget with the focus would take them too.
    ctx.input_mut(|input| {
        input
            .events
            .retain(|event| !matches!(event, Event::Key { .. } | Event::Text(_)))
    });
    true
}

/// Keeps the pointer in the window where it moves freely: the motion of the mouse is known without it.
fn put_back(ctx: &egui::Context, middle: egui::Pos2) {
    let (pointer, has_motion) = ctx.input(|input| {
        let pointer = &input.pointer;
        (pointer.latest_pos(), pointer.motion().is_some())
    });
    if has_motion && pointer.is_some_and(|at| at.distance(middle) > AWAY) {
        ctx.send_viewport_cmd(ViewportCommand::CursorPosition(middle));
    }
}

fn flight(input: &InputState, pace: f64) -> Flight {
    let axis =
        |more, less| f64::from(i8::from(input.key_down(more)) - i8::from(input.key_down(less)));
    Flight {
        right: axis(Key::D, Key::A),
        up: axis(Key::E, Key::Q),
        forward: axis(Key::W, Key::S),
        pace: match input.modifiers.shift {
            true => FASTER * pace,
            false => pace,
        },
    }
}
