//! TOML text: numbers in the fewest digits that preserve all bits.

use glam::{DAffine3, DQuat, DVec3, Vec3};
use glimray_scene::text;
use std::fmt::Write;

/// A scene file being written.
pub(super) struct Text {
    out: String,
    /// Whether a section has just started.
    is_fresh: bool,
}

impl Text {
    pub fn new() -> Self {
        let out = "# A glimray scene: right-handed, +Y up, linear colours. `glimray schema` lists all keys.\n";
        Self {
            out: out.to_owned(),
            is_fresh: false,
        }
    }

    pub fn finish(self) -> String {
        self.out
    }

    /// Starts a section with a comment.
    pub fn section(&mut self, comment: &str) {
        let _ = writeln!(self.out, "\n# {comment}");
        self.is_fresh = true;
    }

    /// Adds an empty line, unless a section has just started.
    pub fn gap(&mut self) {
        if !std::mem::take(&mut self.is_fresh) {
            self.out.push('\n');
        }
    }

    /// The head of a table, such as `[a.b]`, or of a list element.
    pub fn head(&mut self, head: &str) {
        let _ = writeln!(self.out, "{head}");
    }

    /// One line per entry.
    pub fn lines(&mut self, table: &Table) {
        for (key, value) in &table.entries {
            let _ = writeln!(self.out, "{key} = {value}");
        }
    }
}

/// The entries of a table, in order.
#[derive(Default)]
pub(super) struct Table {
    entries: Vec<(&'static str, String)>,
}

impl Table {
    pub fn put(&mut self, key: &'static str, value: impl Into<String>) {
        self.entries.push((key, value.into()));
    }

    pub fn put_if(&mut self, differs: bool, key: &'static str, value: impl Into<String>) {
        if differs {
            self.put(key, value);
        }
    }

    pub fn is_empty(&self) -> bool {
        self.entries.is_empty()
    }

    /// The table as an inline value.
    pub fn inline(&self) -> String {
        if self.is_empty() {
            return "{}".to_owned();
        }
        let entries: Vec<_> = (self.entries.iter())
            .map(|(key, value)| format!("{key} = {value}"))
            .collect();
        format!("{{ {} }}", entries.join(", "))
    }
}

pub(super) fn number(value: f64) -> String {
    let text = format!("{value:?}");
    match text.strip_suffix(".0") {
        // Zero has a sign, integers do not.
        Some(whole) if value != 0.0 || value.is_sign_positive() => whole.to_owned(),
        _ => text,
    }
}

pub(super) fn number32(value: f32) -> String {
    let text = format!("{value:?}");
    // The importer parses f64 and rounds to f32: the shortest f32 digits may round to a neighbour.
    if text
        .parse::<f64>()
        .is_ok_and(|read| (read as f32).to_bits() == value.to_bits())
    {
        return match text.strip_suffix(".0") {
            Some(whole) if value != 0.0 || value.is_sign_positive() => whole.to_owned(),
            _ => text,
        };
    }
    number(f64::from(value))
}

pub(super) fn list(items: impl IntoIterator<Item = String>) -> String {
    let items: Vec<_> = items.into_iter().collect();
    format!("[{}]", items.join(", "))
}

pub(super) fn vector(value: DVec3) -> String {
    list(value.to_array().map(number))
}

pub(super) fn quaternion(value: DQuat) -> String {
    list(value.to_array().map(number))
}

pub(super) fn matrix(value: DAffine3) -> String {
    let axes = value.matrix3;
    let columns = [axes.x_axis, axes.y_axis, axes.z_axis, value.translation];
    list(columns.map(vector))
}

/// A colour: as "#rrggbb" if that is exact and shorter.
pub(super) fn color(value: Vec3) -> String {
    let numbers = list(value.to_array().map(number32));
    let code = |channel: f32| {
        let is_it = |code: &u8| {
            let linear = glimray_scene::linear_from_srgb(f64::from(*code) / 255.0) as f32;
            linear.to_bits() == channel.to_bits()
        };
        (0..=u8::MAX).find(is_it)
    };
    if numbers.len() <= 18 {
        return numbers;
    }
    match value.to_array().map(code) {
        [Some(r), Some(g), Some(b)] => format!("\"#{r:02x}{g:02x}{b:02x}\""),
        _ => numbers,
    }
}

/// A number, or one per axis.
pub(super) fn scale(value: DVec3) -> String {
    let [x, y, z] = value.to_array().map(f64::to_bits);
    if x == y && y == z {
        number(value.x)
    } else {
        vector(value)
    }
}

pub(super) fn string(text: &str) -> String {
    let mut quoted = String::from("\"");
    for c in text.chars() {
        match c {
            '"' | '\\' => quoted.extend(['\\', c]),
            c if text::is_control(c) => {
                let _ = match u32::from(c) {
                    code @ ..=0xffff => write!(quoted, "\\u{code:04x}"),
                    code => write!(quoted, "\\U{code:08x}"),
                };
            }
            c => quoted.push(c),
        }
    }
    quoted.push('"');
    quoted
}

pub(super) fn key(text: &str) -> String {
    let is_bare = |c: char| c.is_ascii_alphanumeric() || c == '_' || c == '-';
    if !text.is_empty() && text.chars().all(is_bare) {
        text.to_owned()
    } else {
        string(text)
    }
}
