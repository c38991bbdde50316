//! The grid that all panels share: labels in the left 40 %, fields in the rest; and the headings of its parts.

use crate::ui::focus_ring;
use eframe::egui::collapsing_header::{CollapsingState, paint_default_icon};
use eframe::egui::{
    self, Align, Align2, FontId, Id, Label, Layout, Rect, Response, Sense, Ui, WidgetInfo, vec2,
};

/// Share of the width that labels have.
const LABELS: f32 = 0.4;
/// Space between a label and its field, in points.
const GAP: f32 = 6.0;
/// Least width of the grid, in points: narrower panels scroll.
const LEAST: f32 = 170.0;
/// Size of the letters of a heading, in points.
pub const HEADING: f32 = 13.0;
/// Space above a heading, in points.
const ABOVE: f32 = 8.0;
/// Width of the triangle that folds a section, in points.
const TRIANGLE: f32 = 10.0;

/// The contents of a panel, with scroll bars where it is too high, or too narrow for the grid.
pub fn scrolled(ui: &mut Ui, contents: impl FnOnce(&mut Ui)) {
    egui::ScrollArea::both().auto_shrink(false).show(ui, |ui| {
        ui.set_min_width(LEAST);
        contents(ui);
        focus_ring::follow(ui);
    });
}

/// A row with a label, which wraps where it is too long, and its fields. These get the label's identifier.
pub fn row<R>(
    ui: &mut Ui,
    (label, tip): (&str, &str),
    fields: impl FnOnce(&mut Ui, Option<Id>) -> R,
) -> R {
    let width = LABELS * ui.available_width() - GAP;
    ui.horizontal(|ui| {
        ui.spacing_mut().item_spacing.x = GAP;
        let size = vec2(width.max(0.0), ui.spacing().interact_size.y);
        let centred = Layout::left_to_right(Align::Center);
        let label = ui.allocate_ui_with_layout(size, centred, |ui| {
            ui.set_min_size(size);
            let label = (!label.is_empty()).then(|| ui.add(Label::new(label).wrap()));
            label.map(|label| label.on_hover_text(tip).id)
        });
        ui.spacing_mut().item_spacing.x = 3.0;
        ui.spacing_mut().combo_width = ui.available_width();
        fields(ui, label.inner)
    })
    .inner
}

/// A heading: flush left, with space above it.
pub fn heading(ui: &mut Ui, text: &str) {
    ui.add_space(ABOVE);
    let size = vec2(ui.available_width(), ui.spacing().interact_size.y);
    let (rect, response) = ui.allocate_exact_size(size, Sense::hover());
    response.widget_info(|| WidgetInfo::labeled(egui::Role::Label, true, text));
    write_heading(ui, rect, text);
}

/// A part of a panel whose heading folds it.
pub fn section(ui: &mut Ui, title: &str, is_open: bool, contents: impl FnOnce(&mut Ui)) {
    ui.add_space(ABOVE);
    let size = vec2(ui.available_width(), ui.spacing().interact_size.y);
    let id = ui.make_persistent_id(title);
    let (rect, heading) = ui.allocate_exact_size(size, Sense::click());
    let mut state = CollapsingState::load_with_default_open(ui.ctx(), id, is_open);
    if heading.clicked() {
        state.toggle(ui);
    }
    let is_open = state.is_open();
    heading
        .widget_info(|| WidgetInfo::selected(egui::Role::DisclosureTriangle, true, is_open, title));
    if heading.hovered() {
        let fill = ui.visuals().widgets.hovered.weak_bg_fill;
        ui.painter()
            .rect_filled(rect.expand2(vec2(4.0, 0.0)), 3.0, fill);
    }
    write_heading(ui, rect, title);
    let mut triangle: Response = heading.clone();
    let center = rect.right_center() - vec2(TRIANGLE, 0.0);
    triangle.rect = Rect::from_center_size(center, vec2(TRIANGLE, TRIANGLE));
    paint_default_icon(ui, state.openness(ui.ctx()), &triangle);
    state.show_body_unindented(ui, contents);
}

/// Writes the text of a heading twice, a fraction of a point apart: the font has no bold letters.
pub fn write_heading(ui: &Ui, rect: Rect, text: &str) {
    let color = ui.visuals().strong_text_color();
    let painter = ui.painter().with_clip_rect(rect.intersect(ui.clip_rect()));
    for shift in [0.0, 0.4] {
        let at = rect.left_center() + vec2(shift, 0.0);
        let font = FontId::proportional(HEADING);
        painter.text(at, Align2::LEFT_CENTER, text, font, color);
    }
}
