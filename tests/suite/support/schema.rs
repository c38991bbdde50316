//! Checks JSON against JSON Schemas as `glimray schema` prints them: the part of draft 2020-12 that they use. A member
//! of an object that no schema describes is an error too, and so is a keyword that is not checked here.

use serde_json::{Map, Value};
use std::collections::BTreeSet;

/// Violations of `schema` by `value`: a line each, with the place.
pub fn errors(schema: &Value, value: &Value) -> Vec<String> {
    let mut found = Found::default();
    closed(schema, schema, value, "", &mut found.errors);
    found.errors
}

/// The errors at a place, and the members that a schema describes there.
#[derive(Default)]
struct Found {
    errors: Vec<String>,
    described: BTreeSet<String>,
}

/// Checks a place as a whole: every member of an object is described.
fn closed(root: &Value, schema: &Value, value: &Value, at: &str, errors: &mut Vec<String>) {
    let mut found = Found::default();
    check(root, schema, value, at, &mut found);
    for name in value.as_object().into_iter().flat_map(Map::keys) {
        if !found.described.contains(name) {
            found.errors.push(format!("{at}.{name} is not described"));
        }
    }
    errors.append(&mut found.errors);
}

fn check(root: &Value, schema: &Value, value: &Value, at: &str, found: &mut Found) {
    let Some(schema) = schema.as_object() else {
        let is_refused = schema == &Value::Bool(false);
        if is_refused {
            found.errors.push(format!("{at} must not be there"));
        }
        return;
    };
    for (keyword, rule) in schema {
        let mut fail = |why: String| found.errors.push(format!("{at}: {why}"));
        match keyword.as_str() {
            "$schema" | "$defs" | "title" | "description" | "format" | "default" => {}
            "$ref" => {
                let path = rule.as_str().and_then(|path| path.strip_prefix('#'));
                let target = path.and_then(|path| root.pointer(path));
                check(root, target.expect("a definition"), value, at, found);
            }
            "type" => {
                let kinds = rule.as_array().cloned().unwrap_or(vec![rule.clone()]);
                if !kinds.iter().any(|kind| is_of(kind, value)) {
                    fail(format!("{value} is not {rule}"));
                }
            }
            "const" if value != rule => fail(format!("{value} is not {rule}")),
            "enum" if !rule.as_array().expect("a list").contains(value) => {
                fail(format!("{value} is none of {rule}"));
            }
            "const" | "enum" => {}
            "minimum" | "maximum" => {
                let limit = rule.as_f64().expect("a number");
                let is_least = keyword == "minimum";
                let is_beyond = |number: f64| match is_least {
                    true => number < limit,
                    false => number > limit,
                };
                if value.as_f64().is_some_and(is_beyond) {
                    fail(format!("{value} is beyond the {keyword} {rule}"));
                }
            }
            "required" => {
                let members = value.as_object();
                for name in rule.as_array().expect("a list") {
                    let name = name.as_str().expect("a name");
                    if members.is_some_and(|members| !members.contains_key(name)) {
                        fail(format!("{name} is missing"));
                    }
                }
            }
            "properties" => {
                for (name, schema) in rule.as_object().expect("schemas") {
                    found.described.insert(name.clone());
                    if let Some(member) = value.get(name) {
                        let at = format!("{at}.{name}");
                        closed(root, schema, member, &at, &mut found.errors);
                    }
                }
            }
            "items" => {
                for (index, item) in value.as_array().into_iter().flatten().enumerate() {
                    let at = format!("{at}[{index}]");
                    closed(root, rule, item, &at, &mut found.errors);
                }
            }
            "prefixItems" => {
                let items = value.as_array().into_iter().flatten();
                for (index, (item, rule)) in items.zip(rule.as_array().expect("a list")).enumerate()
                {
                    let at = format!("{at}[{index}]");
                    closed(root, rule, item, &at, &mut found.errors);
                }
            }
            "minItems" | "maxItems" => {
                let limit = rule.as_u64().expect("a number") as usize;
                let is_beyond = |length: usize| match keyword == "minItems" {
                    true => length < limit,
                    false => length > limit,
                };
                if value.as_array().is_some_and(|items| is_beyond(items.len())) {
                    fail(format!("its length is beyond the {keyword} {rule}"));
                }
            }
            "allOf" => {
                for schema in rule.as_array().expect("a list") {
                    check(root, schema, value, at, found);
                }
            }
            "anyOf" | "oneOf" => {
                let branches = rule.as_array().expect("a list").iter();
                let branches: Vec<_> = branches
                    .map(|schema| {
                        let mut branch = Found::default();
                        check(root, schema, value, at, &mut branch);
                        branch
                    })
                    .collect();
                let fits = branches.iter().filter(|branch| branch.errors.is_empty());
                let count = fits.clone().count();
                found
                    .described
                    .extend(fits.flat_map(|branch| branch.described.clone()));
                if count == 0 || keyword == "oneOf" && count > 1 {
                    let why = branches.into_iter().flat_map(|branch| branch.errors);
                    let why = why.collect::<Vec<_>>().join("; ");
                    found
                        .errors
                        .push(format!("{at}: {count} of {keyword} fit: {why}"));
                }
            }
            unknown => fail(format!("the keyword {unknown} is not checked")),
        }
    }
}

fn is_of(kind: &Value, value: &Value) -> bool {
    match kind.as_str().expect("the name of a type") {
        "null" => value.is_null(),
        "boolean" => value.is_boolean(),
        "string" => value.is_string(),
        "number" => value.is_number(),
        "integer" => value.is_u64() || value.is_i64(),
        "array" => value.is_array(),
        "object" => value.is_object(),
        other => panic!("the type {other} is not known"),
    }
}
