//! Values of materials and lights outside the ranges of their specifications: what is used instead, with a note.

use crate::import::notes::Notes;
use crate::import::source::quote;
use glam::{DVec3, Vec3};

/// The kind of the notes.
const WHAT: &str = "values out of range";

/// Most of any amount, so that products stay finite.
pub(super) const MOST: f64 = 1e12;

/// Reads the values of one material or light.
pub(super) struct Checked<'n> {
    notes: &'n mut Notes,
    /// Whose values they are, for messages.
    owner: String,
}

impl<'n> Checked<'n> {
    /// Reader of the values of the part of the file at `place` with this name.
    pub fn new(notes: &'n mut Notes, place: &str, name: Option<&str>) -> Self {
        let owner = match name {
            Some(name) if !name.is_empty() => format!("{place} {}", quote(name.as_bytes())),
            _ => place.to_owned(),
        };
        Self { notes, owner }
    }

    /// A number in `least`..=`most`.
    pub fn number(
        &mut self,
        key: &str,
        value: Option<f64>,
        default: f64,
        [least, most]: [f64; 2],
    ) -> f64 {
        self.numbers(key, [value.unwrap_or(default)], [least, most])[0]
    }

    /// A number in 0..=1.
    pub fn unit(&mut self, key: &str, value: Option<f64>, default: f64) -> f32 {
        self.number(key, value, default, [0.0, 1.0]) as f32
    }

    /// A number in `least`..=[`MOST`].
    pub fn amount(&mut self, key: &str, value: Option<f64>, default: f64, least: f64) -> f32 {
        self.number(key, value, default, [least, MOST]) as f32
    }

    /// A colour in 0..=1.
    pub fn unit_color(&mut self, key: &str, value: Option<[f64; 3]>, default: Vec3) -> Vec3 {
        let Some(value) = value else { return default };
        DVec3::from(self.numbers(key, value, [0.0, 1.0])).as_vec3()
    }

    /// Numbers of one property in `least`..=`most`.
    pub fn numbers<const N: usize>(
        &mut self,
        key: &str,
        values: [f64; N],
        [least, most]: [f64; 2],
    ) -> [f64; N] {
        let used = values.map(|value| value.clamp(least, most));
        // Programs write numbers that are rounded to f32.
        let is_off = |value: f64, used: f64| (value - used).abs() > 1e-6 * used.abs().max(1.0);
        let mut off = values.iter().zip(&used);
        if off.any(|(value, used)| is_off(*value, *used)) {
            let rule = if values.iter().all(|value| *value >= least) {
                format!("at most {} is allowed", shown(most))
            } else if values.iter().all(|value| *value <= most) {
                format!("at least {} is allowed", shown(least))
            } else {
                format!("only {} to {} is allowed", shown(least), shown(most))
            };
            self.repaired(key, &values, &rule, &list(&used));
        }
        used
    }

    /// Notes that the property `key` breaks a rule, and what is used instead.
    pub fn repaired(&mut self, key: &str, values: &[f64], rule: &str, used: &str) {
        let owner = &self.owner;
        self.notes.add(WHAT, || {
            format!(
                "{owner}: {key} is {}, but {rule}: {used} is used",
                list(values)
            )
        });
    }
}

/// One number, or several in brackets.
fn list(values: &[f64]) -> String {
    let shown: Vec<String> = values.iter().map(|value| shown(*value)).collect();
    match &shown[..] {
        [one] => one.clone(),
        several => format!("[{}]", several.join(", ")),
    }
}

/// A number with at most four decimals.
fn shown(value: f64) -> String {
    match value.abs() {
        0.0 | 1e-3..1e9 => ((value * 1e4).round() / 1e4).to_string(),
        _ => format!("{value:e}"),
    }
}
