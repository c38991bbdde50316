//! Blocks mouse input to the window during a modal transform and a walk.

use crate::actions::{modal, walk};
use crate::state::session::Session;
use eframe::egui::{
    self, Align2, Color32, CursorIcon, FontId, Id, Order, PointerButton, Sense, Ui, vec2,
};

/// Covers the whole window during a modal transform or a walk: a click confirms it, a right click cancels it.
pub fn show(ctx: &egui::Context, session: &mut Session) {
    let walks = session.walk.is_some();
    if session.editing.modal.is_none() && !walks {
        return;
    }
    // Without the picture, the transform is invisible.
    if session.viewport.is_none() && !walks {
        modal::cancel(session);
        return;
    }
    let area = egui::Area::new(Id::unique("movement")).order(Order::Foreground);
    let area = area.fixed_pos(ctx.content_rect().min);
    let response = area.show(ctx, |ui| {
        let size = ctx.content_rect().size();
        let response = ui.allocate_response(size, Sense::click_and_drag());
        walk_keys(ui, session);
        response
    });
    let response = response.inner;
    let ends = |button| response.clicked_by(button) || response.drag_stopped_by(button);
    let (confirms, cancels) = (ends(PointerButton::Primary), ends(PointerButton::Secondary));
    if walks {
        ctx.set_cursor_icon(CursorIcon::None);
        if confirms || cancels {
            walk::end(session, ctx, !cancels);
        }
    } else if cancels {
        modal::cancel(session);
    } else if confirms && let Some(modal) = &mut session.editing.modal {
        modal.is_confirmed = true;
        ctx.request_repaint();
    }
}

/// The keys of a walk, at the bottom of the picture.
fn walk_keys(ui: &Ui, session: &Session) {
    let (Some(walk), Some(viewport)) = (&session.walk, session.viewport) else {
        return;
    };
    let speed = format!("speed ×{}", format_args!("{:.2}", walk.pace));
    let text = format!(
        "Walk: W A S D, E up, Q down · mouse looks · Shift faster · wheel {speed} · Enter or click keeps · Esc goes back"
    );
    let width = viewport.rect.width() - 24.0;
    let font = FontId::proportional(13.0);
    let galley = (ui.painter()).layout(text, font, Color32::WHITE, width.max(120.0));
    let at = viewport.rect.center_bottom() - vec2(0.0, 14.0);
    let rect = Align2::CENTER_BOTTOM.anchor_size(at, galley.size());
    let back = Color32::from_black_alpha(190);
    ui.painter()
        .rect_filled(rect.expand2(vec2(8.0, 4.0)), 4.0, back);
    ui.painter().galley(rect.min, galley, Color32::WHITE);
}
