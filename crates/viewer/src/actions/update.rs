//! Per-frame updates.

use super::{adding, comparing, editing, files, inspector, lighting, texturing, walk};
use crate::model::camera::CameraController;
use crate::state::pixel_values::PixelValues;
use crate::state::session::Session;
use eframe::egui;

/// Drops requests and drags of the previous window.
pub fn reopened(session: &mut Session) {
    session.dialogs.reopened();
    session.files.reopened();
    session.questions.clear();
    session.comparing.asked = None;
    session.histogram.reopened();
    session.pixel_values = PixelValues::default();
    session.picture_menu = None;
    inspector::reopened(session);
    session.drag = None;
    session.walk = None;
    session.sight.reopened();
    session.tool_state.region = None;
    session.tool_state.frame = None;
    session.editing.grip = None;
    session.editing.lamp = None;
    session.editing.section = None;
    session.editing.modal = None;
}

/// Called every frame.
pub fn update(session: &mut Session, ctx: &egui::Context) {
    let (now, seconds) = ctx.input(|input| (input.time, f64::from(input.stable_dt).min(0.1)));
    // A frame that is drawn again takes no time.
    let seconds = if now > session.now { seconds } else { 0.0 };
    session.now = now;
    let walked = session.walk.is_some();
    take_scene(session);
    if walked && session.walk.is_none() {
        walk::free_pointer(ctx);
    }
    files::update(session, ctx);
    adding::update(session);
    texturing::update(session);
    comparing::update(session);
    inspector::update(session, ctx, seconds);
    editing::update(session, ctx);
    lighting::update(session);
    session.take_refined();
    session.drop_outdated();
    let time = session.playback.time;
    session.playback.advance(seconds);
    if session.playback.time != time {
        session.last_motion = now;
    }
    let is_animated = session.scene().is_some_and(|scene| scene.is_animated());
    let is_home = (session.controller.as_ref()).is_some_and(CameraController::is_home);
    let home = match is_animated && is_home {
        true => session.home_camera(),
        false => None,
    };
    if let Some(controller) = &mut session.controller {
        if let Some(home) = home {
            controller.set_home(&home);
        }
        if controller.advance(seconds) || controller.is_moving() {
            session.last_motion = now;
        }
        // Other widgets than the picture move the camera by drags too.
        let is_held = ctx.input(|input| input.pointer.any_down());
        let rests =
            !controller.is_moving() && session.drag.is_none() && session.walk.is_none() && !is_held;
        session.camera_history.note(controller, rests);
    }
}

/// Called while the window is minimised: rendering continues, without motion.
pub fn update_hidden(session: &mut Session) {
    session.last_motion = f64::NEG_INFINITY;
    session.drag = None;
    take_scene(session);
    session.take_refined();
}

fn take_scene(session: &mut Session) {
    if let Some(opened) = session.take_scene() {
        files::loaded(session, opened);
    }
}
