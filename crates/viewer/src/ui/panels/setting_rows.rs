//! Rows of settings with a reset button, and titles of command-line values.

use crate::ui::panels::row::row;
use eframe::egui::{self, Response, RichText, Ui, WidgetInfo};
use glimray_app::settings::{Row, Setting};
use glimray_app::value_forms::Control;
use glimray_app::value_names::ValueNames;
use glimray_render::{Integrator, RenderSettings};
use std::ops::RangeInclusive;

/// Width of a reset button, and of the buttons that halve and double, with the space before them, in points.
const RESET: f32 = 20.0;
const HALVE_OR_DOUBLE: f32 = 64.0;

/// The title of a command-line value: `side-by-side` becomes `Side by side`.
pub fn title(name: &str) -> String {
    if let Some(integrator) = Integrator::named(name) {
        return integrator.entry().title.into();
    }
    match name {
        // Proper names.
        "srgb" => return "sRGB".into(),
        "agx" => return "AgX".into(),
        "aces" | "uv" => return name.to_uppercase(),
        "moller-trumbore" => return "Möller–Trumbore".into(),
        "blackman-harris" => return "Blackman–Harris".into(),
        _ => {}
    }
    let spaced = name.replace('-', " ");
    let mut letters = spaced.chars();
    match letters.next() {
        Some(first) => first.to_uppercase().chain(letters).collect(),
        None => spaced,
    }
}

/// The row of a setting.
pub fn setting(
    ui: &mut Ui,
    (setting, row): (&Setting, &Row),
    settings: &mut RenderSettings,
    usual: &RenderSettings,
) {
    let mut reset = settings.clone();
    (setting.copy)(usual, &mut reset);
    let is_enabled = setting.applies(settings);
    let of = setting.scope.as_ref().map_or("", |scope| scope.noun);
    line(
        ui,
        (row.label, setting.tip()),
        settings,
        &reset,
        |ui, settings| {
            ui.add_enabled_ui(is_enabled, |ui| control(ui, setting, row, settings))
                .inner
                .on_disabled_hover_text(format!("Only used by {of}"))
        },
    );
}

fn control(ui: &mut Ui, setting: &Setting, row: &Row, settings: &mut RenderSettings) -> Response {
    match (setting.control)() {
        Control::Switch(place) => ui.checkbox(place(settings), ""),
        Control::Count(place, range) => {
            let most = *range.end();
            let has_buttons = setting.name == "samples";
            let beside = if has_buttons { HALVE_OR_DOUBLE } else { 0.0 };
            let width = ui.available_width() - beside;
            let how = (range, row.speed, row.unit);
            let response = wide_number(ui, place(settings), how, width);
            if has_buttons {
                halve_or_double(ui, place(settings), most);
            }
            response
        }
        Control::Real(place, range) => {
            let how = (range, row.speed, row.unit);
            wide_number(ui, place(settings), how, ui.available_width())
        }
        Control::Limit(place, range) => {
            let value = place(settings);
            let mut limit = value.unwrap_or_default();
            let how = (0.0..=*range.end(), row.speed, row.unit);
            let response = wide_number(ui, &mut limit, how, ui.available_width());
            *value = Some(limit).filter(|limit| *limit > 0.0);
            response.on_hover_text("0 is no limit")
        }
        Control::Names(names) => {
            let chosen = (setting.text)(settings).unwrap_or_default();
            let mut name = &*chosen;
            let response = choice_of(ui, setting.name, names.into_iter(), &mut name);
            if name != chosen {
                // All names are those of values.
                let _ = setting.set(settings, name);
            }
            response
        }
        Control::Text => ui.label((setting.text)(settings).unwrap_or_default()),
    }
}

fn halve_or_double(ui: &mut Ui, samples: &mut u32, most: u32) {
    let mut button = |text: &str, tip: &str| ui.button(text).on_hover_text(tip).clicked();
    if button("½", "Halve the target samples") {
        *samples = (*samples / 2).max(1);
    }
    if button("×2", "Double the target samples") {
        *samples = (*samples * 2).min(most);
    }
}

/// A row with a label, a widget, and a reset button while the value differs from `usual`.
pub fn line<T: PartialEq + Clone>(
    ui: &mut Ui,
    (name, tip): (&str, &str),
    value: &mut T,
    usual: &T,
    widget: impl FnOnce(&mut Ui, &mut T) -> Response,
) {
    row(ui, (name, tip), |ui, label| {
        let is_other = value != usual;
        let beside = if is_other { RESET } else { 0.0 };
        let width = (ui.available_width() - beside).max(0.0);
        let size = egui::vec2(width, ui.spacing().interact_size.y);
        let response = ui.allocate_ui(size, |ui| {
            ui.spacing_mut().combo_width = ui.available_width();
            widget(ui, value)
        });
        let response = match label {
            Some(label) => response.inner.labelled_by(label),
            None => response.inner,
        };
        response.on_hover_text(tip);
        if is_other && reset_button(ui, name).clicked() {
            *value = usual.clone();
        }
    });
}

/// A button that resets to the scene's value.
pub fn reset_button(ui: &mut Ui, name: &str) -> Response {
    let button = ui.add(egui::Button::new(RichText::new("↺")).small().frame(false));
    let name = format!("Reset {}", name.to_lowercase());
    let tip = "Reset to the scene's value";
    button.widget_info(|| WidgetInfo::labeled(egui::Role::Button, true, &name));
    button.on_hover_text(tip)
}

/// A choice among the values of a flag.
pub fn choice<T: PartialEq + Clone>(
    ui: &mut Ui,
    id: &str,
    names: &'static ValueNames<T>,
    value: &mut T,
) -> Response {
    // Aliases of the same value are left out.
    let own = (names.all().iter()).filter(|(name, _, known)| names.name(known) == *name);
    let mut name = names.name(value);
    let response = choice_of(ui, id, own.map(|(name, help, _)| (*name, *help)), &mut name);
    if let Some(chosen) = names.value(name).filter(|chosen| chosen != value) {
        *value = chosen;
    }
    response
}

/// A choice among names, each with a description.
fn choice_of<'a>(
    ui: &mut Ui,
    id: &str,
    names: impl Iterator<Item = (&'a str, &'a str)>,
    chosen: &mut &'a str,
) -> Response {
    egui::ComboBox::from_id_salt(id)
        .selected_text(title(chosen))
        .truncate()
        .show_ui(ui, |ui| {
            for (name, help) in names {
                ui.selectable_value(chosen, name, title(name))
                    .on_hover_text(help);
            }
        })
        .response
}

/// A number that can be dragged or typed.
pub fn number<T: egui::emath::Numeric>(
    ui: &mut Ui,
    value: &mut T,
    range: RangeInclusive<T>,
    speed: f64,
    suffix: &str,
) -> Response {
    ui.add(drag(value, range, speed, suffix))
}

/// A number that takes this width.
pub fn wide_number<T: egui::emath::Numeric>(
    ui: &mut Ui,
    value: &mut T,
    (range, speed, suffix): (RangeInclusive<T>, f64, &str),
    width: f32,
) -> Response {
    let size = egui::vec2(width, ui.spacing().interact_size.y);
    ui.add_sized(size, drag(value, range, speed, suffix))
}

fn drag<'a, T: egui::emath::Numeric>(
    value: &'a mut T,
    range: RangeInclusive<T>,
    speed: f64,
    suffix: &str,
) -> egui::DragValue<'a> {
    let decimals = if T::INTEGRAL { 0 } else { 5 };
    egui::DragValue::new(value)
        .range(range)
        .speed(speed)
        .max_decimals(decimals)
        .suffix(suffix)
}
