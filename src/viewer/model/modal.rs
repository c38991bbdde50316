//! A movement that a key began: its limit and the number typed so far.

use super::handles::{Handles, Part};
use super::tool::Tool;
use eframe::egui::Key;
use glam::DAffine3;

/// A movement that a key began.
#[derive(Clone, Debug, Default)]
pub struct Modal {
    /// The axis of the limit, and whether that is the plane across it.
    limit: Option<(usize, bool)>,
    /// A number so far.
    typed: String,
    /// Where the thing was put last.
    pub place: Option<DAffine3>,
    /// Whether it ends with the next place.
    pub is_confirmed: bool,
}

impl Modal {
    /// The handle that does the same. Where the thing has no such freedom, that for all directions.
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

    /// The number as far as it was typed.
    pub fn typed(&self) -> &str {
        &self.typed
    }

    pub fn limit(&mut self, axis: usize, is_plane: bool) {
        // The second time it is taken back.
        let limit = Some((axis, is_plane));
        self.limit = if self.limit == limit { None } else { limit };
    }

    pub fn type_key(&mut self, key: Key) {
        match key {
            Key::Minus => match self.typed.strip_prefix('-') {
                Some(rest) => self.typed = rest.to_owned(),
                None => self.typed.insert(0, '-'),
            },
            Key::Period | Key::Comma if !self.typed.contains('.') => self.typed.push('.'),
            Key::Backspace => _ = self.typed.pop(),
            _ => {
                let digits = [
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
                let digit = digits.into_iter().position(|digit| digit == key);
                self.typed.extend(digit.map(|digit| digit.to_string()));
            }
        }
    }
}
