//! Materials that are dropped on an object in the picture.

use crate::actions::materials;
use crate::model::viewport::Viewport;
use crate::state::dropping::Dragged;
use crate::state::session::Session;
use eframe::egui;

/// Passes a dragged material to the object under the cursor.
pub fn dropping(session: &mut Session, response: &egui::Response, viewport: Viewport) {
    let pointer = response.ctx.pointer_latest_pos();
    let Some(pixel) = pointer.and_then(|point| viewport.pixel(point)) else {
        return;
    };
    let material = |dragged: &Dragged| dragged.material();
    if response
        .dnd_hover_payload::<Dragged>()
        .is_some_and(|dragged| material(&dragged).is_some())
    {
        materials::hover(session, pixel);
    }
    let dropped = response.dnd_release_payload::<Dragged>();
    if let Some(material) = dropped.and_then(|dragged| material(&dragged)) {
        materials::drop_on(session, material, pixel);
    }
}
