//! Things that are dragged from a panel to another place.

use crate::model::objects::Id;
use crate::state::dropping::{Dragged, Dropping};
use crate::state::session::Session;
use crate::ui::panels::icon;
use eframe::egui::{self, Area, DragAndDrop, Order, Sense, vec2};

/// Notes over what a material is dragged, and shows the material beside the cursor. Called after all panels.
pub fn show(ctx: &egui::Context, session: &mut Session) {
    let dragged = DragAndDrop::payload::<Dragged>(ctx);
    let Some(material) = dragged.and_then(|dragged| dragged.material()) else {
        session.editing.dropping = None;
        return;
    };
    let dropping = session
        .editing
        .dropping
        .get_or_insert(Dropping::new(material));
    let over = dropping.next.take();
    if dropping.over != over {
        dropping.over = over;
        ctx.request_repaint();
    }
    let (Some(at), Some(scene)) = (ctx.pointer_latest_pos(), session.scene().cloned()) else {
        return;
    };
    let label = session.label(Id::Material(material));
    Area::new(egui::Id::unique("dragged material"))
        .order(Order::Tooltip)
        .interactable(false)
        .fixed_pos(at + vec2(14.0, 10.0))
        .show(ctx, |ui| {
            egui::Frame::popup(ui.style()).show(ui, |ui| {
                ui.horizontal(|ui| {
                    let (rect, _) = ui.allocate_exact_size(vec2(14.0, 14.0), Sense::hover());
                    icon::draw(ui, rect, &scene, Id::Material(material), true);
                    ui.label(label);
                });
            });
        });
}
