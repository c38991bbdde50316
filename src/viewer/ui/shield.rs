//! Keeps the mouse from the window while a movement without a button is under way.

use crate::viewer::actions::modal;
use crate::viewer::state::session::Session;
use eframe::egui::{self, Id, Order, PointerButton, Sense};

/// Lies over the whole window while a movement is under way: clicks end it and do nothing else.
pub fn show(ctx: &egui::Context, session: &mut Session) {
    if session.editing.modal.is_none() {
        return;
    }
    // Nobody sees where the thing is.
    if session.viewport.is_none() {
        modal::cancel(session);
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
        modal::cancel(session);
    } else if ends(PointerButton::Primary)
        && let Some(modal) = &mut session.editing.modal
    {
        modal.is_confirmed = true;
        ctx.request_repaint();
    }
}
