//! The text of a scene file: a section for each list and each table of its names, one key per line, and tables inside
//! others in braces.

use glimray_scene::text;
use std::fmt::Write;
use toml::{Table, Value};

/// Longer lists of lists or tables have one of them per line.
const MOST_IN_A_LINE: usize = 2;

/// The text of `file`.
pub(super) fn text(file: &Table) -> String {
    let mut out = "# A glimray scene: right-handed, +Y up, linear colours. `glimray schema` lists all keys.\n".to_owned();
    let (sections, plain): (Vec<_>, Vec<_>) =
        file.iter().partition(|(key, value)| is_section(key, value));
    if !plain.is_empty() {
        out.push('\n');
        lines(&mut out, plain);
    }
    for (key, value) in sections {
        let mut tables = Vec::new();
        match value {
            Value::Array(list) => {
                let list = list.iter().filter_map(Value::as_table);
                tables.extend(list.map(|table| (format!("[[{key}]]"), table)));
            }
            Value::Table(named) if named.values().all(Value::is_table) => {
                let named = named
                    .iter()
                    .filter_map(|(name, it)| Some((name, it.as_table()?)));
                tables.extend(named.map(|(name, it)| (format!("[{key}.{}]", quoted(name)), it)));
            }
            Value::Table(table) => {
                let _ = writeln!(out, "\n[{key}]");
                lines(&mut out, table);
            }
            _ => {}
        }
        for (index, (head, table)) in tables.into_iter().enumerate() {
            let _ = match index {
                0 => writeln!(out, "\n# {}{}\n{head}", key[..1].to_uppercase(), &key[1..]),
                _ => writeln!(out, "\n{head}"),
            };
            lines(&mut out, table);
        }
    }
    out
}

/// Whether a key of a file has lines of its own.
fn is_section(key: &str, value: &Value) -> bool {
    match value {
        Value::Array(list) => list.iter().all(Value::is_table),
        value => value.is_table() && key != "background",
    }
}

fn lines<'t>(out: &mut String, table: impl IntoIterator<Item = (&'t String, &'t Value)>) {
    for (key, value) in table {
        let _ = match value {
            Value::Array(items) if items.len() > MOST_IN_A_LINE && is_nested(items) => {
                let items = items.iter().map(|item| format!("    {},\n", inline(item)));
                writeln!(out, "{key} = [\n{}]", items.collect::<String>())
            }
            value => writeln!(out, "{key} = {}", inline(value)),
        };
    }
}

fn is_nested(items: &[Value]) -> bool {
    items.iter().all(|item| item.is_array() || item.is_table())
}

/// A value on a line.
fn inline(value: &Value) -> String {
    let listed = |items: Vec<String>| items.join(", ");
    match value {
        Value::String(text) => string(text),
        // Fewer digits than TOML's own, which have no exponent.
        Value::Float(number) => format!("{number:?}"),
        Value::Array(items) => format!("[{}]", listed(items.iter().map(inline).collect())),
        Value::Table(table) if table.is_empty() => "{}".to_owned(),
        Value::Table(table) => {
            let entries = table.iter();
            let entries =
                entries.map(|(key, value)| format!("{} = {}", quoted(key), inline(value)));
            format!("{{ {} }}", listed(entries.collect()))
        }
        other => other.to_string(),
    }
}

/// A string, without control characters.
fn string(text: &str) -> String {
    let mut quoted = String::from("\"");
    for c in text.chars() {
        match c {
            '"' | '\\' => quoted.extend(['\\', c]),
            c if text::is_control(c) => {
                let _ = write!(quoted, "\\U{:08x}", u32::from(c));
            }
            c => quoted.push(c),
        }
    }
    quoted.push('"');
    quoted
}

/// A key, in quotes if it needs them.
fn quoted(key: &str) -> String {
    let is_bare = |c: char| c.is_ascii_alphanumeric() || c == '_' || c == '-';
    match !key.is_empty() && key.chars().all(is_bare) {
        true => key.to_owned(),
        false => string(key),
    }
}
