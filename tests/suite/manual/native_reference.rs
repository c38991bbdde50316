//! The reference of native scenes, made of the JSON Schema that `glimray schema` prints.

use serde_json::Value;
use std::fmt::Write;
use std::process::Command;

/// A section for each table and each list of words, in the order in which the ones before mention them.
pub fn markdown() -> String {
    let output = Command::new(env!("CARGO_BIN_EXE_glimray"))
        .arg("schema")
        .output()
        .expect("glimray");
    let schema: Value = serde_json::from_slice(&output.stdout).expect("JSON");
    let mut reference = Reference {
        schema: &schema,
        order: Vec::new(),
    };
    let mut text = String::from("## Top level\n\n");
    text.push_str(&reference.keys(&schema));
    let mut next = 0;
    while let Some(name) = reference.order.get(next).cloned() {
        let _ = write!(
            text,
            "\n## {}\n\n{}",
            title(&name),
            reference.section(&name)
        );
        next += 1;
    }
    text
}

struct Reference<'s> {
    schema: &'s Value,
    /// The names of the definitions that have a section.
    order: Vec<String>,
}

/// "area light" for `AreaLightTable`.
fn title(name: &str) -> String {
    if name == "ColorTable" {
        return "textured colour".to_owned();
    }
    let name = name.trim_end_matches("Table").trim_end_matches("Name");
    let mut title = String::new();
    for c in name.chars() {
        if c.is_uppercase() && !title.is_empty() {
            title.push(' ');
        }
        title.extend(c.to_lowercase());
    }
    title
}

fn description(schema: &Value) -> String {
    let text = schema["description"].as_str().unwrap_or_default();
    text.split_whitespace()
        .collect::<Vec<_>>()
        .join(" ")
        .replace('|', "\\|")
}

fn alternatives(schema: &Value) -> Option<&Vec<Value>> {
    schema["anyOf"].as_array().or(schema["oneOf"].as_array())
}

impl Reference<'_> {
    fn section(&mut self, name: &str) -> String {
        let schema = &self.schema["$defs"][name];
        let mut text = description(schema);
        if !text.is_empty() {
            text.push_str("\n\n");
        }
        if schema["properties"].is_object() {
            return text + &self.keys(schema);
        }
        text.push_str("| value | meaning |\n|---|---|\n");
        for word in alternatives(schema).into_iter().flatten() {
            let _ = writeln!(text, "| `{}` | {} |", word["const"], description(word));
        }
        text
    }

    fn keys(&mut self, schema: &Value) -> String {
        let mut text = String::from("| key | value | meaning |\n|---|---|---|\n");
        let required = schema["required"].as_array();
        let required: Vec<_> = required.into_iter().flatten().collect();
        for (key, value) in schema["properties"].as_object().into_iter().flatten() {
            let is_required = required.iter().any(|name| *name == key);
            let mark = if is_required { " (required)" } else { "" };
            let kind = self.kind(value);
            let _ = writeln!(text, "| `{key}`{mark} | {kind} | {} |", description(value));
        }
        text
    }

    /// A value in words, with links to the sections of tables.
    fn kind(&mut self, schema: &Value) -> String {
        if let Some(reference) = schema["$ref"].as_str() {
            let name = reference.rsplit('/').next().unwrap_or_default();
            return self.reference(name);
        }
        if let Some(words) = schema["enum"].as_array() {
            let words: Vec<_> = words.iter().map(|word| format!("`{word}`")).collect();
            return words.join(", ");
        }
        if !schema["const"].is_null() {
            return format!("`{}`", schema["const"]);
        }
        if let Some(kinds) = alternatives(schema) {
            let mut words = Vec::new();
            for kind in kinds.iter().filter(|kind| kind["type"] != "null") {
                let word = self.kind(kind);
                if !words.contains(&word) {
                    words.push(word);
                }
            }
            return words.join(" or ");
        }
        let kind = match &schema["type"] {
            Value::Array(kinds) => kinds.iter().find(|kind| *kind != "null"),
            kind => Some(kind),
        };
        match kind.and_then(Value::as_str) {
            Some("boolean") => "true or false".to_owned(),
            Some("string") => "text".to_owned(),
            Some("number") => format!("number{}", range(schema)),
            Some("integer") => format!("whole number{}", range(schema)),
            Some("array") => self.list(schema),
            Some("object") => {
                let of = self.kind(&schema["additionalProperties"]);
                format!("table of named entries: {of}")
            }
            _ => "any".to_owned(),
        }
    }

    fn reference(&mut self, name: &str) -> String {
        let schema = &self.schema["$defs"][name];
        let is_word = |word: &Value| word["const"].is_string();
        let words = alternatives(schema);
        let is_list = words.is_some_and(|words| !words.is_empty() && words.iter().all(is_word));
        if name == "Color" {
            return "colour".to_owned();
        }
        if !schema["properties"].is_object() && !is_list {
            return self.kind(schema);
        }
        if !self.order.iter().any(|known| known == name) {
            self.order.push(name.to_owned());
        }
        let title = title(name);
        format!("[{title}](#{})", title.replace(' ', "-"))
    }

    fn list(&mut self, schema: &Value) -> String {
        let of = match &schema["items"] {
            Value::Null => "value".to_owned(),
            items => self.kind(items),
        };
        let limit = |key: &str| schema[key].as_u64();
        let of = if of.contains([' ', '×']) && !of.starts_with('[') {
            format!("({of})")
        } else {
            of
        };
        match (limit("minItems"), limit("maxItems")) {
            (Some(least), Some(most)) if least == most => format!("{least} × {of}"),
            (Some(least), Some(most)) => format!("{least} to {most} × {of}"),
            _ => format!("list of {of}"),
        }
    }
}

fn range(schema: &Value) -> String {
    let number = |value: f64| match value {
        std::f64::consts::PI => "π".to_owned(),
        std::f64::consts::FRAC_PI_2 => "π/2".to_owned(),
        _ => value.to_string(),
    };
    let limit = |key: &str| schema[key].as_f64().map(number);
    let least = limit("minimum").map(|least| format!(" ≥ {least}"));
    let least = least.or(limit("exclusiveMinimum").map(|least| format!(" > {least}")));
    let most = limit("maximum").map(|most| format!(" ≤ {most}"));
    let most = most.or(limit("exclusiveMaximum").map(|most| format!(" < {most}")));
    match (least, most) {
        (Some(least), Some(most)) => format!("{least} and{most}"),
        (least, most) => least.or(most).unwrap_or_default(),
    }
}

#[test]
fn values_are_told_with_their_ranges() {
    let rows = [
        (
            r#"{"type": ["number", "null"], "minimum": 0, "maximum": 1}"#,
            "number ≥ 0 and ≤ 1",
        ),
        (
            r#"{"type": "array", "items": {"type": "number"}, "minItems": 3, "maxItems": 3}"#,
            "3 × number",
        ),
        (
            r#"{"anyOf": [{"type": "string"}, {"type": "null"}]}"#,
            "text",
        ),
        (r#"{"enum": ["a", "b"]}"#, "`\"a\"`, `\"b\"`"),
        (
            r#"{"type": "integer", "exclusiveMinimum": 0}"#,
            "whole number > 0",
        ),
    ];
    for (schema, expected) in rows {
        let schema: Value = serde_json::from_str(schema).expect("JSON");
        let mut reference = Reference {
            schema: &schema,
            order: Vec::new(),
        };
        assert_eq!(reference.kind(&schema), expected);
    }
    assert_eq!(title("DiscLightTable"), "disc light");
}
