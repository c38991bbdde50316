//! Rows of settings with a reset button, and titles of command-line values.

use eframe::egui::{self, Response, RichText, Ui, WidgetInfo};
use glimray_app::value_names::ValueNames;
use glimray_render::Integrator;
use std::ops::RangeInclusive;

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

/// A row of a two-column grid: a label, a widget, and a reset button while the value differs from `usual`.
pub fn line<T: PartialEq + Clone>(
    ui: &mut Ui,
    (name, tip): (&str, &str),
    value: &mut T,
    usual: &T,
    widget: impl FnOnce(&mut Ui, &mut T) -> Response,
) {
    let label = ui.label(name).on_hover_text(tip);
    ui.horizontal(|ui| {
        widget(ui, value).labelled_by(label.id).on_hover_text(tip);
        if value != usual && reset_button(ui, name).clicked() {
            *value = usual.clone();
        }
    });
    ui.end_row();
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
    name: &str,
    names: &'static ValueNames<T>,
    value: &mut T,
) -> Response {
    let chosen = title(names.name(value));
    egui::ComboBox::from_id_salt(name)
        .selected_text(chosen)
        .show_ui(ui, |ui| {
            for (own_name, help, known) in names.all() {
                // Aliases of the same value are left out.
                if names.name(known) == *own_name {
                    ui.selectable_value(value, known.clone(), title(own_name))
                        .on_hover_text(*help);
                }
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
    let decimals = if T::INTEGRAL { 0 } else { 5 };
    ui.add(
        egui::DragValue::new(value)
            .range(range)
            .speed(speed)
            .max_decimals(decimals)
            .suffix(suffix),
    )
}
