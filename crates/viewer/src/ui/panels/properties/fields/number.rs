//! Numbers that are dragged or typed.

use super::MIXED;
use crate::ui::panels::icon::named;
use eframe::egui::{self, DragValue, Ui, UiBuilder, vec2};
use std::cell::Cell;

/// Tooltip of animated properties.
const DRIVEN: &str = "Animated: edit its keys in the scene file.";

/// Range and drag speed of a number.
#[derive(Clone, Copy)]
pub struct Limits {
    pub least: f64,
    pub most: f64,
    /// Change per point of a drag, relative to the number, or to 1 if it is small.
    pub speed: f64,
    /// The unit as a suffix.
    pub unit: &'static str,
}

impl Limits {
    /// Any finite coordinate.
    pub const LENGTH: Self = Self {
        least: -1e15,
        most: 1e15,
        speed: 0.01,
        unit: "",
    };
    /// Positive lengths.
    pub const SIZE: Self = Self {
        least: 1e-9,
        ..Self::LENGTH
    };
    /// Positive lengths, and none at all.
    pub const ENDLESS: Self = Self {
        most: f64::INFINITY,
        ..Self::SIZE
    };
    /// 0 or more.
    pub const AMOUNT: Self = Self {
        least: 0.0,
        most: 1e9,
        ..Self::LENGTH
    };
    pub const ANGLE: Self = Self {
        least: -36000.0,
        most: 36000.0,
        speed: 0.5,
        unit: "°",
    };

    /// From 0 to 1.
    pub const UNIT: Self = Self::between(0.0, 1.0);

    pub const fn between(least: f64, most: f64) -> Self {
        Self {
            least,
            most,
            ..Self::LENGTH
        }
    }

    /// Limits with another change per point of a drag.
    pub const fn with_speed(self, speed: f64) -> Self {
        Self { speed, ..self }
    }

    fn speed_at(&self, value: f64) -> f64 {
        match self.unit {
            "°" => self.speed,
            _ => self.speed * value.abs().clamp(0.1, 1e6),
        }
    }
}

/// Sets the accessible name of a number.
pub enum Name<'a> {
    Own(&'a str),
    Label(Option<egui::Id>),
}

/// A number that can be dragged or typed; returns the edited value. One that is `mixed` is not shown, and any that is typed
/// counts.
pub fn drag(
    ui: &mut Ui,
    name: Name,
    tip: &str,
    value: f64,
    mixed: bool,
    limits: Limits,
    width: f32,
) -> Option<f64> {
    let mut now = value;
    let typed = Cell::new(None);
    let widget = DragValue::new(&mut now)
        .speed(limits.speed_at(value))
        .range(limits.least..=limits.most)
        .clamp_existing_to_range(false)
        .custom_formatter(|value, _| match mixed {
            true => MIXED.to_owned(),
            false => shown(value),
        })
        .custom_parser(|text| {
            typed.set(parsed(text));
            typed.get()
        })
        .update_while_editing(false)
        .suffix(limits.unit);
    let size = vec2(width.max(0.0), ui.spacing().interact_size.y);
    let (rect, _) = ui.allocate_exact_size(size, egui::Sense::hover());
    // A long number does not widen its column.
    let layout = egui::Layout::centered_and_justified(egui::Direction::TopDown);
    let mut cell = ui.new_child(UiBuilder::new().max_rect(rect).layout(layout));
    cell.set_clip_rect(rect.intersect(ui.clip_rect()));
    cell.spacing_mut().button_padding.x = 2.0;
    let response = cell.add(widget);
    let response = match name {
        Name::Own(name) => {
            named(&response, name);
            response
        }
        Name::Label(Some(id)) => response.labelled_by(id),
        Name::Label(None) => response,
    };
    let response = response.on_hover_text(tip).on_disabled_hover_text(DRIVEN);
    if let Some(typed) = typed
        .get()
        .filter(|typed| mixed && is_possible(*typed, limits))
    {
        return Some(typed.clamp(limits.least, limits.most));
    }
    // Unedited text must not round the number.
    let is_meant = response.dragged() || shown(value) != shown(now);
    (response.changed() && is_meant && is_possible(now, limits))
        .then(|| now.clamp(limits.least, limits.most))
}

fn is_possible(value: f64, limits: Limits) -> bool {
    value.is_finite() || value == f64::INFINITY && limits.most == f64::INFINITY
}

/// Reads a number as egui does, and "∞" or "none" as infinity.
fn parsed(text: &str) -> Option<f64> {
    let text: String = text.split_whitespace().collect();
    match text.as_str() {
        "∞" | "none" => Some(f64::INFINITY),
        number => number.replace('−', "-").parse().ok(),
    }
}

/// Formats a number with few digits.
fn shown(value: f64) -> String {
    let size = value.abs();
    let text = match size {
        0.0 => return "0".into(),
        _ if value.is_infinite() => return "∞".into(),
        _ if !(1e-3..1e6).contains(&size) => return format!("{value:.2e}"),
        _ if size >= 1000.0 => format!("{value:.1}"),
        _ if size >= 100.0 => format!("{value:.2}"),
        _ => format!("{value:.3}"),
    };
    text.trim_end_matches('0').trim_end_matches('.').to_owned()
}
