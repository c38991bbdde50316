//! The rays of a pixel as a tree with their contributions.

mod drawing;
mod list;
mod paint;
pub mod space;

pub use drawing::path;

use crate::actions::inspector;
use crate::actions::inspector::export;
use crate::model::tool::Tool;
use crate::state::inspector::Inspected;
use crate::state::inspector::rows;
use crate::state::session::Session;
use crate::ui::context::PanelContext;
use crate::ui::panels::row::row;
use eframe::egui::{self, Align, Id, Layout};
use glam::DVec3;
use glimray_app::ray_text::{color, ray_sum, weighted_sum};

/// Gap between controls, in points.
const GAP: f32 = 4.0;
/// Widths of the button that inspects a pixel and of the slider of bounces, in points.
const INSPECT: f32 = 60.0;
const SLIDER: f32 = 48.0;
/// Maximum number of bounces with swatches.
const MOST_SWATCHES: usize = 24;

/// The pixel, the filter, the rays and their sum.
pub fn rays(ui: &mut egui::Ui, context: &mut PanelContext) {
    let session = &mut *context.session;
    let margin = egui::Margin::symmetric(8, 6);
    egui::Panel::top("which rays")
        .frame(egui::Frame::NONE.inner_margin(margin))
        .show_separator_line(true)
        .show(ui, |ui| {
            pixel(ui, session);
            if session.inspector.inspected.is_some() {
                sample(ui, session);
                bounces(ui, session);
            }
        });
    if session.inspector.inspected.is_none() {
        ui.add_space(12.0);
        ui.vertical_centered(|ui| {
            ui.weak("Use the ray inspector and click the picture to see the rays of a pixel.");
        });
        return;
    }
    egui::Panel::bottom("sum of rays")
        .frame(egui::Frame::NONE.inner_margin(margin))
        .show(ui, |ui| sum(ui, session));
    egui::CentralPanel::default()
        .frame(egui::Frame::NONE.inner_margin(margin))
        .show(ui, |ui| list::list(ui, session));
}

/// The inspector tool and the pixel.
fn pixel(ui: &mut egui::Ui, session: &mut Session) {
    let (width, height) = session.picture_size();
    ui.horizontal_wrapped(|ui| {
        let has_tool = session.tool == Tool::Inspect;
        let tool = ui.selectable_label(has_tool, "Inspect rays");
        if (tool.on_hover_text("Click a pixel in the picture to show its rays")).clicked() {
            session.tool = if has_tool {
                Tool::Select
            } else {
                Tool::Inspect
            };
        }
        let follow = ui.checkbox(&mut session.inspector.follows, "Follow the cursor");
        follow.on_hover_text("With this tool, inspect the pixel under the cursor without a click");
        let path = ui.checkbox(&mut session.preferences.overlays.rays, "Path in picture");
        path.on_hover_text("Draw these rays over the picture while the inspector is active");
        if session.inspector.is_waiting() {
            ui.spinner();
        }
    });
    let mut pixel = session.inspector.pixel.unwrap_or([width / 2, height / 2]);
    let mut is_wished = false;
    let tip = "Column and row of the pixel, from 0 at the upper left corner";
    row(ui, ("Pixel", tip), |ui, _| {
        let each = (ui.available_width() - INSPECT) / 2.0 - GAP;
        let size = egui::vec2(each.max(0.0), ui.spacing().interact_size.y);
        for (name, value, length) in [("Column", 0, width), ("Row", 1, height)] {
            let drag = egui::DragValue::new(&mut pixel[value]).range(0..=length.saturating_sub(1));
            let drag = ui.add_sized(size, drag).accessible_name(name);
            let text = format!("{name} of the pixel, from 0 at the upper left corner");
            is_wished |= drag.on_hover_text(text).changed();
        }
        let again = ui.button("Inspect");
        let again = again.on_hover_text("Trace the rays of this pixel in the current picture");
        is_wished |= again.clicked();
    });
    if is_wished {
        inspector::inspect(session, pixel);
    }
    if inspector::is_stale(session) {
        let colour = ui.visuals().warn_fg_color;
        ui.colored_label(colour, "The picture has changed. Inspect again.");
    }
}

/// A row of the grid with several fields, which wrap where the panel is narrow.
fn fields(ui: &mut egui::Ui, label: (&str, &str), fields: impl FnOnce(&mut egui::Ui, Option<Id>)) {
    row(ui, label, |ui, label| {
        ui.horizontal_wrapped(|ui| {
            ui.spacing_mut().item_spacing.x = GAP;
            fields(ui, label);
        });
    });
}

/// The sample filter.
fn sample(ui: &mut egui::Ui, session: &mut Session) {
    let inspector = &mut session.inspector;
    let Some(inspected) = &inspector.inspected else {
        return;
    };
    let count = inspected.tree.samples.len();
    let before = inspector.filter;
    let mut shown = inspector.filter.sample.unwrap_or(0);
    let is_one = inspector.filter.sample.is_some();
    let mut all = !is_one;
    fields(ui, ("Sample", "Whose rays are shown"), |ui, label| {
        ui.add_enabled_ui(is_one, |ui| {
            let step = |ui: &mut egui::Ui, sign: &str, name: &str| {
                let button = ui.button(sign).on_hover_text(name);
                button.widget_info(|| {
                    egui::WidgetInfo::labeled(egui::Role::Button, ui.is_enabled(), name)
                });
                button.clicked()
            };
            if step(ui, "<", "Previous sample") {
                shown = shown.checked_sub(1).unwrap_or(count - 1);
            }
            let drag = ui.add(egui::DragValue::new(&mut shown).range(0..=count - 1));
            let drag = match label {
                Some(label) => drag.labelled_by(label),
                None => drag,
            };
            drag.on_hover_text("Index of the sample, from 0");
            if step(ui, ">", "Next sample") {
                shown = (shown + 1) % count;
            }
        });
        ui.label(format!("of {count}"));
        ui.checkbox(&mut all, "All samples")
            .on_hover_text("Show the rays of every sample of the pixel");
    });
    inspector.filter.sample = (!all).then_some(shown);
    if !inspected.is_final {
        ui.weak("Adaptive sampling may still add samples to this pixel.");
    }
    if inspector.filter != before {
        inspector.selected = None;
        inspector.changed();
    }
}

/// The bounce filter, with the contribution of each bounce.
fn bounces(ui: &mut egui::Ui, session: &mut Session) {
    let exposure = session.view.tone.exposure_ev;
    let inspector = &mut session.inspector;
    let Some(inspected) = &inspector.inspected else {
        return;
    };
    let before = inspector.filter;
    let most = inspected.max_bounces();
    let sums = rows::by_bounce(inspected, inspector.filter.sample);
    let tip = "Hide rays after more reflections and refractions than this";
    fields(ui, ("Up to bounce", tip), |ui, label| {
        let mut shown = inspector.filter.bounces.min(most);
        ui.spacing_mut().slider_width = SLIDER;
        let slider = egui::Slider::new(&mut shown, 0..=most).show_value(false);
        let slider = ui.add_enabled(most > 0, slider).on_hover_text(tip);
        if let Some(label) = label {
            slider.labelled_by(label);
        }
        ui.label(format!("{shown} of {most}"));
        inspector.filter.bounces = if shown == most { u32::MAX } else { shown };
        ui.checkbox(&mut inspector.filter.shadows, "Shadow rays")
            .on_hover_text("Show shadow rays");
    });
    let tip = "Top: the contribution of a bounce. Bottom: the sum up to it";
    fields(ui, ("Contribution", tip), |ui, _| {
        ui.spacing_mut().item_spacing.x = 3.0;
        let mut sum = DVec3::ZERO;
        for (bounce, added) in sums.iter().enumerate().take(MOST_SWATCHES) {
            sum += *added;
            let shown = inspector.filter.bounces as usize >= bounce;
            if paint::bounce(ui, (bounce, *added, sum), shown, exposure).clicked() {
                let is_last = bounce as u32 == most;
                inspector.filter.bounces = if is_last { u32::MAX } else { bounce as u32 };
            }
        }
    });
    if inspector.filter != before {
        inspector.changed();
    }
}

/// The sum of the rays, the pixel, and the exports.
fn sum(ui: &mut egui::Ui, session: &mut Session) {
    let exposure = session.view.tone.exposure_ev;
    let Some(inspected) = &session.inspector.inspected else {
        return;
    };
    let tree = &inspected.tree;
    let one = session.inspector.filter.sample;
    let mut line = |name: String, value: DVec3, hint: &str| {
        ui.horizontal(|ui| {
            paint::swatch(ui, value.as_vec3().into(), exposure);
            ui.label(name).on_hover_text(hint);
            ui.with_layout(Layout::right_to_left(Align::Center), |ui| {
                let text = color(value.as_vec3().into());
                let label = ui.add(egui::Label::new(text.as_str()).truncate());
                label.on_hover_text(format!("{text} (linear radiance: red, green, blue)"));
            });
        });
    };
    if let Some(sample) = one.and_then(|sample| tree.samples.get(sample)) {
        let hint = "Sum over all rays of this sample, including hidden ones";
        line(
            format!("Sum of sample {}", sample.sample),
            ray_sum(sample),
            hint,
        );
    }
    let hint = "Weighted mean over all samples";
    let name = match tree.samples.len() {
        1 => "Sum of 1 sample".to_owned(),
        count => format!("Sum of {count} samples"),
    };
    line(name, weighted_sum(tree), hint);
    let [x, y] = tree.pixel;
    let value = glam::Vec3::from(tree.value).as_dvec3();
    line(
        format!("Pixel {x},{y}"),
        value,
        "The value in the finished picture",
    );
    let missing: usize = (tree.samples.iter())
        .map(|sample| sample.ray_count - sample.rays.len())
        .sum();
    if missing > 0 {
        ui.weak(format!("{missing} more rays did not fit into the buffer."));
    }
    actions(ui, session);
}

fn actions(ui: &mut egui::Ui, session: &mut Session) {
    ui.add_space(2.0);
    ui.horizontal_wrapped(|ui| {
        let json = ui.button("Save JSON…");
        if (json.on_hover_text("Save the tree in the format of `glimray explain --json`")).clicked()
        {
            export::save(session, export::Format::Json, ui.ctx());
        }
        let obj = ui.button("Save OBJ…");
        if (obj.on_hover_text("Save the rays as lines for 3D applications")).clicked() {
            export::save(session, export::Format::Obj, ui.ctx());
        }
        let is_stale = inspector::is_stale(session);
        let copy = ui.add_enabled(!is_stale, egui::Button::new("Copy as command"));
        let copy = copy
            .on_hover_text("Copy the command line that prints these rays")
            .on_disabled_hover_text("The picture has changed. Inspect again");
        if copy.clicked() {
            copy_command(ui, session);
        }
    });
}

fn copy_command(ui: &egui::Ui, session: &mut Session) {
    let inspector = &session.inspector;
    let sample = inspector.filter.sample.zip(inspector.inspected.as_ref());
    let several = |inspected: &Inspected| inspected.tree.samples.len() > 1;
    let sample = sample.filter(|(_, inspected)| several(inspected));
    let sample = sample.map(|(place, inspected)| inspected.tree.samples[place].sample);
    match export::command(session, sample) {
        Ok(command) => {
            ui.ctx().copy_text(command.line);
            session.messages.notify(match &command.left_out[..] {
                [] => "Copied the command".to_owned(),
                left_out => format!(
                    "Copied the command. It cannot express: {}",
                    left_out.join(", ")
                ),
            });
        }
        Err(why) => session.messages.warn(why),
    }
}
