//! Rows with a label and a value. Every edit becomes a named change of the scene.

use crate::model::objects::EditError;
use crate::ui::panels::icon::{edge, named};
use crate::ui::panels::row::{heading, row};
use crate::ui::theme;
use eframe::egui::{self, DragValue, Ui, UiBuilder, vec2};
use glam::{DVec3, Vec3};
use glimray_scene::{Scene, Target};

/// Width of the letter of an axis.
const AXIS: f32 = 8.0;
/// Tooltip of animated properties.
const DRIVEN: &str = "Animated: edit its keys in the scene file.";

/// A change of the scene.
pub struct Change {
    /// A description, such as "change diffuse of glass".
    pub name: String,
    /// Applies the change.
    pub apply: Box<Apply>,
}

/// A change that can fail.
type Apply = dyn FnOnce(&mut Scene) -> Result<(), EditError>;

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

/// The label and the tooltip of a row.
type Label<'a> = (&'a str, &'a str);

/// The rows of one object.
pub struct Fields<'a> {
    pub ui: &'a mut Ui,
    pub scene: &'a Scene,
    /// The object's label.
    pub subject: String,
    pub changes: &'a mut Vec<Change>,
    /// The animated property that the next row shows.
    driver: Option<Target>,
}

impl<'a> Fields<'a> {
    pub fn new(
        ui: &'a mut Ui,
        scene: &'a Scene,
        subject: String,
        changes: &'a mut Vec<Change>,
    ) -> Self {
        Self {
            ui,
            scene,
            subject,
            changes,
            driver: None,
        }
    }

    /// Disables the next row if a track animates `target`.
    pub fn driven_by(&mut self, target: Target) -> &mut Self {
        self.driver = Some(target);
        self
    }

    /// Disables the next row if a track animates `target`, if there is one.
    pub fn may_be_driven_by(&mut self, target: Option<Target>) -> &mut Self {
        self.driver = target;
        self
    }

    /// Requests a change of one property.
    pub fn change(
        &mut self,
        property: &str,
        apply: impl FnOnce(&mut Scene) -> Result<(), EditError> + 'static,
    ) {
        let property = property.to_lowercase();
        self.changes.push(Change {
            name: format!("change {property} of {}", self.subject),
            apply: Box::new(apply),
        });
    }

    fn set<T: 'static>(
        &mut self,
        property: &str,
        value: Option<T>,
        set: impl FnOnce(&mut Scene, T) + 'static,
    ) {
        if let Some(value) = value {
            self.change(property, move |scene| {
                set(scene, value);
                Ok(())
            });
        }
    }

    /// A row with a label and `content`.
    fn row<R>(
        &mut self,
        (label, tip): Label,
        content: impl FnOnce(&mut Ui, Option<egui::Id>) -> R,
    ) -> R {
        let driver = self.driver.take();
        let mut targets = self.scene.tracks.iter().flat_map(|track| &track.targets);
        let is_driven = driver.is_some_and(|driver| targets.any(|target| *target == driver));
        row(self.ui, (label, tip), |ui, labelled_by| {
            ui.add_enabled_ui(!is_driven, |ui| content(ui, labelled_by))
                .inner
        })
    }

    /// A row with a number.
    pub fn number(
        &mut self,
        label: Label,
        value: f64,
        limits: Limits,
        set: impl FnOnce(&mut Scene, f64) + 'static,
    ) {
        let value = self.row(label, |ui, labelled_by| {
            let width = ui.available_width();
            drag(ui, Name::Label(labelled_by), label.1, value, limits, width)
        });
        self.set(label.0, value, set);
    }

    /// A row with a vector.
    pub fn vector(
        &mut self,
        label: Label,
        value: DVec3,
        limits: Limits,
        set: impl FnOnce(&mut Scene, DVec3) + 'static,
    ) {
        let value = self.vector_value(label, value, limits);
        self.set(label.0, value, set);
    }

    /// A vector row that returns the edited value and requests no change.
    pub fn vector_value(
        &mut self,
        (label, tip): Label,
        value: DVec3,
        limits: Limits,
    ) -> Option<DVec3> {
        self.row((label, tip), |ui, _| {
            ui.spacing_mut().item_spacing.x = 2.0;
            let width = (ui.available_width() - 10.0) / 3.0 - AXIS;
            let colors = theme::axes(ui.visuals());
            let mut changed = None;
            for (axis, name) in ["x", "y", "z"].into_iter().enumerate() {
                let size = vec2(AXIS, ui.spacing().interact_size.y);
                let (rect, _) = ui.allocate_exact_size(size, egui::Sense::hover());
                let font = egui::TextStyle::Small.resolve(ui.style());
                let (center, letter) = (egui::Align2::CENTER_CENTER, name.to_uppercase());
                (ui.painter()).text(rect.center(), center, letter, font, colors[axis]);
                let name = format!("{label} {name}");
                if let Some(now) = drag(ui, Name::Own(&name), tip, value[axis], limits, width) {
                    changed.get_or_insert(value)[axis] = now;
                }
            }
            changed
        })
    }

    /// A linear colour: a button for the hue, and a number for each component, which may exceed 1.
    pub fn color(
        &mut self,
        (label, tip): Label,
        value: Vec3,
        set: impl FnOnce(&mut Scene, Vec3) + 'static,
    ) {
        let tip = format!("{tip}\nLinear red, green and blue (Rec. 709), 0 or more.");
        let tip = tip.as_str();
        let value = self.row((label, tip), |ui, _| {
            ui.spacing_mut().item_spacing.x = 3.0;
            let button = 22.0;
            ui.spacing_mut().interact_size.x = button;
            // egui draws the button's outline in this colour.
            let edge = edge(ui.visuals());
            ui.visuals_mut().widgets.inactive.bg_fill = edge;
            // A colour brighter than white keeps its brightness when its hue changes.
            let scale = value.max_element().max(1.0);
            let mut shown = (value / scale).to_array();
            let mut changed = None;
            let response = ui.color_edit_button_rgb(&mut shown);
            named(&response, &format!("{label} colour"));
            if response.on_hover_text(tip).changed() {
                changed = Some(Vec3::from(shown) * scale);
            }
            let width = (ui.available_width() - 6.0) / 3.0;
            for (part, name) in ["red", "green", "blue"].into_iter().enumerate() {
                let name = format!("{label} {name}");
                let own = f64::from(value[part]);
                if let Some(now) = drag(ui, Name::Own(&name), tip, own, Limits::AMOUNT, width) {
                    changed.get_or_insert(value)[part] = now as f32;
                }
            }
            changed
        });
        self.set(label, value, set);
    }

    /// Whether an option of this object is on; `usual` until the user changes it.
    pub fn option_value(&self, label: &str, usual: bool) -> bool {
        let id = egui::Id::unique((label, &self.subject));
        self.ui.data(|data| data.get_temp(id)).unwrap_or(usual)
    }

    /// A check box for `value`, kept while the window is open without changing the scene. Returns its new
    /// value when it is clicked.
    pub fn option(&mut self, (label, tip): Label, mut value: bool) -> Option<bool> {
        let id = egui::Id::unique((label, &self.subject));
        self.row(("", tip), |ui, _| {
            let response = ui.checkbox(&mut value, label).on_hover_text(tip);
            response.changed().then(|| {
                ui.data_mut(|data| data.insert_temp(id, value));
                value
            })
        })
    }

    /// A row with a check box.
    pub fn toggle(
        &mut self,
        (label, tip): Label,
        mut value: bool,
        set: impl FnOnce(&mut Scene, bool) + 'static,
    ) {
        let value = self.row(("", tip), |ui, _| {
            let response = ui.checkbox(&mut value, label).on_hover_text(tip);
            response.changed().then_some(value)
        });
        self.set(label, value, set);
    }

    /// A row with a choice.
    pub fn choice<T: Copy + PartialEq + 'static>(
        &mut self,
        label: Label,
        value: T,
        options: &[(T, impl AsRef<str>)],
        set: impl FnOnce(&mut Scene, T) + 'static,
    ) {
        let chosen = self.choice_value(label, value, options);
        self.set(label.0, chosen, set);
    }

    /// A choice row that returns the chosen value and requests no change.
    pub fn choice_value<T: Copy + PartialEq>(
        &mut self,
        (label, tip): Label,
        value: T,
        options: &[(T, impl AsRef<str>)],
    ) -> Option<T> {
        let now = options.iter().find(|(option, _)| *option == value);
        let now = now.map_or("Several", |(_, name)| name.as_ref());
        self.row((label, tip), |ui, labelled_by| {
            let mut chosen = None;
            let width = ui.available_width();
            let response = egui::ComboBox::from_id_salt(label)
                .width(width)
                .truncate()
                .selected_text(now)
                .show_ui(ui, |ui| {
                    for (option, name) in options {
                        if ui
                            .selectable_label(*option == value, name.as_ref())
                            .clicked()
                        {
                            chosen = Some(*option);
                        }
                    }
                })
                .response;
            let response = match labelled_by {
                Some(id) => response.labelled_by(id),
                None => response,
            };
            response.on_hover_text(tip);
            chosen.filter(|chosen| *chosen != value)
        })
    }

    /// A heading.
    pub fn heading(&mut self, text: &str) {
        heading(self.ui, text);
    }

    /// A note.
    pub fn note(&mut self, text: &str) {
        self.ui.weak(text);
    }
}

/// Sets the accessible name of a number.
enum Name<'a> {
    Own(&'a str),
    Label(Option<egui::Id>),
}

/// A number that can be dragged or typed; returns the edited value.
fn drag(ui: &mut Ui, name: Name, tip: &str, value: f64, limits: Limits, width: f32) -> Option<f64> {
    let mut now = value;
    let widget = DragValue::new(&mut now)
        .speed(limits.speed_at(value))
        .range(limits.least..=limits.most)
        .clamp_existing_to_range(false)
        .custom_formatter(|value, _| shown(value))
        .custom_parser(parsed)
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
    // Unedited text must not round the number.
    let is_meant = response.dragged() || shown(value) != shown(now);
    let is_possible = now.is_finite() || now == f64::INFINITY && limits.most == f64::INFINITY;
    (response.changed() && is_meant && is_possible).then(|| now.clamp(limits.least, limits.most))
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
pub fn shown(value: f64) -> String {
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
