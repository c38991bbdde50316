//! The focus of the keyboard: a ring round the widget that has it, whoever painted it, and its place in view.

use eframe::egui::style::ScrollAnimation;
use eframe::egui::{self, Id, Stroke, StrokeKind};

/// Draws the ring. Call this after all widgets of the frame.
pub fn show(ctx: &egui::Context) {
    let focused = ctx.memory(|memory| memory.focused());
    let Some(widget) = focused.and_then(|id| ctx.read_response(id)) else {
        return;
    };
    let rect = widget.rect.intersect(widget.interact_rect);
    if !rect.is_positive() {
        return;
    }
    let visuals = ctx.global_style().visuals.clone();
    let painter = ctx.layer_painter(widget.layer_id);
    // Two tones are visible on any picture.
    for (width, color) in [
        (3.5, visuals.extreme_bg_color),
        (2.0, visuals.selection.stroke.color),
    ] {
        painter.rect_stroke(rect, 3.0, Stroke::new(width, color), StrokeKind::Inside);
    }
}

/// Scrolls to the widget that got the focus. Call this at the end of what a scroll area contains.
pub fn follow(ui: &egui::Ui) {
    let focused = ui.memory(|memory| memory.focused());
    let id = ui.scope_id().with("focus");
    let before: Option<Option<Id>> = ui.data(|data| data.get_temp(id));
    ui.data_mut(|data| data.insert_temp(id, focused));
    let Some(widget) = focused.filter(|_| before != Some(focused)) else {
        return;
    };
    if let Some(widget) = ui.ctx().read_response(widget)
        && widget.layer_id == ui.layer_id()
        && ui.min_rect().contains_rect(widget.rect)
        && !ui.clip_rect().contains_rect(widget.rect)
    {
        ui.scroll_to_rect_animation(widget.rect, None, ScrollAnimation::none());
    }
}
