//! Blocks mouse input to the window during a modal transform.

use crate::actions::modal;
use crate::state::session::Session;
use eframe::egui::{self, Id, Order, PointerButton, Sense};

/// Covers the whole window during a modal transform: a click confirms or cancels it.
pub fn show(ctx: &egui::Context, session: &mut Session) {
    if session.editing.modal.is_none() {
        return;
    }
    // Without the picture, the transform is invisible.
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
