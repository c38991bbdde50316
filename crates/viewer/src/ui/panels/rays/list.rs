//! The rows of the tree. Only visible rows are drawn.

use crate::state::inspector::ray_labels;
use crate::state::inspector::rows::{RayId, Row};
use crate::state::session::Session;
use crate::ui::panels::rays::paint;
use crate::ui::panels::row::HEADING;
use eframe::egui::{self, Align, Layout, RichText, Sense, vec2};
use glimray_app::ray_text::{color, ray_sum};

/// Indentation per level in points, and the maximum number of levels.
const INDENT: f32 = 11.0;
const MAX_LEVELS: usize = 16;
/// Space for the scroll bar, which overlays the list.
const SCROLL_BAR: f32 = 8.0;
/// Width of the collapse button.
const FOLD: f32 = 14.0;

/// Draws the tree.
pub fn list(ui: &mut egui::Ui, session: &mut Session) {
    ui.horizontal(|ui| {
        let unfold = ui.small_button("Expand all");
        if unfold.on_hover_text("Show all rays").clicked() {
            session.inspector.fold_all(false);
        }
        let fold = ui.small_button("Collapse all");
        if fold.on_hover_text("Hide the rays below others").clicked() {
            session.inspector.fold_all(true);
        }
    });
    headers(ui);
    let height = ui.spacing().interact_size.y;
    ui.spacing_mut().item_spacing.y = 1.0;
    let selected = session.inspector.selected;
    let scrolls = std::mem::take(&mut session.inspector.scrolls);
    let rows = session.inspector.rows();
    let count = rows.len();
    let is_selected = |row: &Row| matches!(row, Row::Ray { id, .. } if Some(*id) == selected);
    let at = (rows.iter().position(is_selected)).filter(|_| scrolls);
    let mut area = egui::ScrollArea::vertical()
        .id_salt("rays")
        .auto_shrink(false);
    if let Some(at) = at {
        let middle = (ui.available_height() - height) / 2.0;
        let offset = at as f32 * (height + 1.0) - middle;
        area = area.vertical_scroll_offset(offset.max(0.0));
    }
    area.show_rows(ui, height, count, |ui, range| {
        for place in range {
            let Some(row) = session.inspector.rows().get(place).copied() else {
                break;
            };
            let line = vec2(ui.available_width(), height);
            ui.allocate_ui_with_layout(line, Layout::left_to_right(Align::Center), |ui| {
                ui.set_min_size(line);
                show(ui, session, row);
            });
        }
    });
}

/// The column headers.
fn headers(ui: &mut egui::Ui) {
    let header = |text: &str| egui::Label::new(RichText::new(text).size(HEADING).strong());
    ui.horizontal(|ui| {
        ui.add(header("Ray"));
        ui.with_layout(Layout::right_to_left(Align::Center), |ui| {
            ui.add_space(SCROLL_BAR);
            ui.add(header("Light"))
                .on_hover_text("The light that the ray adds to the pixel");
            ui.add(header("Length"))
                .on_hover_text("Length of the ray, in scene units");
        });
    });
}

fn show(ui: &mut egui::Ui, session: &mut Session, row: Row) {
    match row {
        Row::Sample(sample) => heading(ui, session, sample),
        Row::Ray {
            id,
            level,
            has_children,
        } => ray(ui, session, (id, level, has_children)),
        Row::Detail { id, level, place } => detail(ui, session, (id, level, place)),
    }
}

fn indent(ui: &mut egui::Ui, level: usize) {
    ui.add_space(level.min(MAX_LEVELS) as f32 * INDENT);
}

fn heading(ui: &mut egui::Ui, session: &Session, sample: usize) {
    let exposure = session.view.tone.exposure_ev;
    let inspected = session.inspector.inspected.as_ref();
    let Some(tree) = inspected.and_then(|inspected| inspected.tree.samples.get(sample)) else {
        return;
    };
    let count = tree.ray_count;
    ui.strong(format!("Sample {}", tree.sample));
    ui.weak(match count {
        1 => "1 ray".to_owned(),
        _ => format!("{count} rays"),
    });
    if tree.dropped {
        ui.weak("dropped: not finite, or brighter than 10^12");
    }
    ui.with_layout(Layout::right_to_left(Align::Center), |ui| {
        ui.add_space(SCROLL_BAR);
        let sum = ray_sum(tree).as_vec3().into();
        let swatch = paint::swatch(ui, sum, exposure);
        swatch.on_hover_text(format!(
            "Contribution {} (linear radiance), weight {}",
            color(sum),
            tree.weight
        ));
    });
}

fn ray(ui: &mut egui::Ui, session: &mut Session, (id, level, has_children): (RayId, usize, bool)) {
    let exposure = session.view.tone.exposure_ev;
    let inspector = &mut session.inspector;
    let Some(inspected) = inspector.inspected.as_ref() else {
        return;
    };
    let Some(ray) = inspected.ray(id) else {
        return;
    };
    let (added, length) = (ray.contribution, ray_labels::length(ray));
    let headline = ray_labels::headline(inspected, ray);
    let (kind, blocked) = (ray.kind, ray.shadow.as_ref().is_some_and(|s| s.blocked));
    indent(ui, level);
    ui.spacing_mut().item_spacing.x = 4.0;
    let is_folded = inspector.folded.contains(&id);
    if !has_children {
        ui.add_space(FOLD + 4.0);
    } else if paint::fold(ui, is_folded, id, FOLD).clicked() {
        inspector.fold(id);
    }
    paint::icon(ui, kind, blocked);
    let mut is_hovered = false;
    ui.with_layout(Layout::right_to_left(Align::Center), |ui| {
        ui.add_space(SCROLL_BAR);
        let swatch = paint::swatch(ui, added, exposure);
        swatch.on_hover_text(format!("Contribution {} (linear radiance)", color(added)));
        let length = ui.add(egui::Label::new(RichText::new(length).monospace().weak()));
        length.on_hover_text("Length of the ray, in scene units");
        ui.with_layout(Layout::left_to_right(Align::Center), |ui| {
            let is_selected = inspector.selected == Some(id);
            let line = vec2(ui.available_width(), 0.0);
            let button = egui::Button::selectable(is_selected, headline.as_str());
            // Full width, with its text on the left.
            let response = ui.add(button.truncate().right_text("").min_size(line));
            let name = format!("Ray {}: {headline}", id.1);
            response.widget_info(|| {
                egui::WidgetInfo::selected(egui::Role::Button, true, is_selected, &name)
            });
            is_hovered = response.hovered();
            if response.clicked() {
                inspector.toggle(id);
            }
        });
    });
    if is_hovered {
        inspector.hovers = Some(id);
    }
}

fn detail(ui: &mut egui::Ui, session: &Session, (id, level, place): (RayId, usize, usize)) {
    let Some(inspected) = session.inspector.inspected.as_ref() else {
        return;
    };
    let details = inspected
        .ray(id)
        .map(|ray| ray_labels::details(inspected, ray));
    let Some((what, value)) = details.and_then(|details| details.into_iter().nth(place)) else {
        return;
    };
    indent(ui, level);
    ui.add_space(2.0 * FOLD + 8.0);
    let (bar, _) = ui.allocate_exact_size(vec2(2.0, ui.available_height()), Sense::hover());
    (ui.painter()).rect_filled(bar, 0.0, ui.visuals().selection.bg_fill);
    let line = format!("{what}: {value}");
    ui.weak(what);
    let label = ui.add(egui::Label::new(RichText::new(value).monospace()).truncate());
    label.on_hover_text(line);
}
