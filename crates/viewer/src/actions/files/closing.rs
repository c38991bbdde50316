//! Closing the window.

use crate::state::files::Intent;
use crate::state::session::Session;
use eframe::egui::{self, ViewportCommand};

/// Asks about unsaved changes before closing, and waits for files that are being written unless the user
/// closes again.
pub(super) fn close(session: &mut Session, ctx: &egui::Context) {
    if session.is_device_lost() {
        return;
    }
    let is_writing = session.files.is_writing();
    let is_asked = ctx.input(|input| input.viewport().close_requested());
    if !is_asked || session.files.may_close {
        if session.files.may_close && !is_writing {
            ctx.send_viewport_cmd(ViewportCommand::Close);
        }
        return;
    }
    let intent = match session.has_changes() {
        true => Some(Intent::Close),
        false => (session.files.waits_to_save()).then_some(Intent::CloseUnfinished),
    };
    if intent.is_some() {
        // A minimised window would hide the question.
        for command in [
            ViewportCommand::CancelClose,
            ViewportCommand::Minimized(false),
            ViewportCommand::Focus,
        ] {
            ctx.send_viewport_cmd(command);
        }
        session.files.undecided = intent;
    } else if is_writing {
        ctx.send_viewport_cmd(ViewportCommand::CancelClose);
        session.files.may_close = true;
    }
}
