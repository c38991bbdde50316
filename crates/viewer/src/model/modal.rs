//! A move, rotation or scale started by a key: its constraint and the number typed.

use super::handles::{Handles, Part};
use super::tool::Tool;
use eframe::egui::{Key, Pos2, Rect};
use glam::DAffine3;

/// The keys of the digits, from 0 to 9.
pub const DIGITS: [Key; 10] = [
    Key::Num0,
    Key::Num1,
    Key::Num2,
    Key::Num3,
    Key::Num4,
    Key::Num5,
    Key::Num6,
    Key::Num7,
    Key::Num8,
    Key::Num9,
];

/// A move, rotation or scale started by a key.
#[derive(Clone, Debug, Default)]
pub struct Modal {
    /// The constrained axis, and whether the constraint is the plane perpendicular to it.
    limit: Option<(usize, bool)>,
    /// The typed number.
    typed: String,
    /// The last transform that was set.
    pub place: Option<DAffine3>,
    /// Whether it ends with the next update.
    pub is_confirmed: bool,
    /// Whether it begins where the pointer enters the picture, not where it is.
    waits_for_picture: bool,
}

impl Modal {
    /// One that begins where the pointer enters the picture: for what is chosen in a menu.
    pub fn in_picture() -> Self {
        Self {
            waits_for_picture: true,
            ..Self::default()
        }
    }

    /// Where it begins with the pointer at this place of the screen; `None` while it waits.
    pub fn begins_at(&self, pointer: Option<Pos2>, picture: Rect) -> Option<Pos2> {
        let waits = self.waits_for_picture && self.typed.is_empty();
        match pointer {
            Some(pointer) if !waits || picture.contains(pointer) => Some(pointer),
            _ if waits => None,
            pointer => Some(pointer.unwrap_or(picture.center())),
        }
    }

    /// The equivalent handle. Without that freedom, the handle for all directions.
    pub fn part(&self, handles: &Handles) -> Part {
        let wanted = match (handles.tool, self.limit) {
            (_, None) => Part::All,
            (Tool::Rotate, Some((axis, _))) => Part::Ring(axis),
            (_, Some((axis, false))) => Part::Axis(axis),
            (_, Some((axis, true))) => Part::Plane(axis),
        };
        match handles.parts.contains(&wanted) {
            true => wanted,
            false => Part::All,
        }
    }

    /// The number that was typed.
    pub fn amount(&self) -> Option<f64> {
        self.typed.parse().ok()
    }

    /// The typed text.
    pub fn typed(&self) -> &str {
        &self.typed
    }

    /// Constrains the edit to an axis (0 to 2 for x to z), or with `is_plane` to the plane perpendicular to
    /// it. The same constraint again removes it.
    pub fn limit(&mut self, axis: usize, is_plane: bool) {
        // Repeating a constraint removes it.
        let limit = Some((axis, is_plane));
        self.limit = if self.limit == limit { None } else { limit };
    }

    /// Types a digit, a decimal point or a minus sign, which toggles the sign. Backspace deletes.
    pub fn type_key(&mut self, key: Key) {
        match key {
            Key::Minus => match self.typed.strip_prefix('-') {
                Some(rest) => self.typed = rest.to_owned(),
                None => self.typed.insert(0, '-'),
            },
            Key::Period | Key::Comma if !self.typed.contains('.') => self.typed.push('.'),
            Key::Backspace => _ = self.typed.pop(),
            _ => {
                let digit = DIGITS.into_iter().position(|digit| digit == key);
                self.typed.extend(digit.map(|digit| digit.to_string()));
            }
        }
    }
}
