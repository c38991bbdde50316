//! glimray's own format (`.toml`): written by hand, and checked down to the last key.
//!
//! [`file`] is the format: its types define the keys, the exporter writes them, and their docs become the JSON
//! Schema. [`values`] checks single values, and [`build`] checks combinations. [`objects`] resolves names and
//! counts objects, then everything is placed, and finally [`animation`] adds the tracks.

mod animation;
mod build;
mod cameras;
pub(crate) mod file;
mod lights;
mod materials;
mod nodes;
mod objects;
mod physical;
mod repeat;
mod set;
pub(crate) mod shapes;
mod textures;
mod transforms;
pub(crate) mod values;

use super::Options;
use super::error::{ImportError, fault};
use super::paths::Files;
use super::source::Source;
use super::suggest;
use glimray_scene::Scene;
use glimray_scene::text;
use schemars::Schema;
use schemars::generate::SchemaSettings;
use schemars::transform::RecursiveTransform;
use serde::Deserialize;
use serde_json::Value;
use set::Override;
use std::ops::Range;
use toml::de::DeTable;

/// Size limit of a native scene in bytes. Large geometry belongs in mesh files.
pub(super) const MAX_BYTES: u64 = 16 << 20;

/// Approximate limit of keys, values and tables in a native scene. The parser takes up to 800 bytes for
/// each.
pub(crate) const MAX_MARKS: usize = 500_000;

/// Limit of the nesting depth of TOML arrays and inline tables, and of the dots in a key. Scenes need no
/// more than a handful.
const MAX_DEPTH: usize = 32;

/// The scene in `source`, with the overrides of `options` applied.
pub(super) fn read(
    source: &Source,
    options: &Options,
    files: &Files,
) -> Result<Scene, ImportError> {
    let text = source.text()?;
    if text.trim().is_empty() {
        let todo = "Check that it was written completely";
        return Err(ImportError::Malformed(fault(
            "bad scene",
            &source.path,
            "the file is empty",
            todo,
        )));
    }
    refuse_excess(source)?;
    let overrides = Override::parse_all(&options.overrides, text.len())?;
    let texts = Texts {
        source,
        overrides: &overrides,
    };
    let mut root = DeTable::parse(text)
        .map_err(|error| texts.explain(&error, "See https://toml.io for the syntax"))?;
    for change in &overrides {
        change.apply(root.get_mut())?;
    }
    let scene = file::SceneFile::deserialize(toml::Deserializer::from(root));
    build::scene(
        scene.map_err(|error| texts.explain(&error, "See `glimray schema` for what is allowed"))?,
        &texts,
        files,
        options,
    )
}

/// The JSON Schema of [`file::SceneFile`].
pub(super) fn schema() -> serde_json::Value {
    let settings = SchemaSettings::draft2020_12();
    let settings = settings.with_transform(RecursiveTransform(without_null));
    settings
        .into_generator()
        .into_root_schema_for::<file::SceneFile>()
        .to_value()
}

/// Removes null from a schema: TOML has none. Descriptions give the defaults.
fn without_null(schema: &mut Schema) {
    schema.remove("default");
    if let Some(Value::Array(types)) = schema.get_mut("type") {
        types.retain(|kind| kind != "null");
        if let [only] = &types[..] {
            let only = only.clone();
            schema.insert("type".to_owned(), only);
        }
    }
    if let Some(Value::Array(kinds)) = schema.get_mut("anyOf") {
        kinds.retain(|kind| kind["type"] != "null");
        if let [Value::Object(only)] = &kinds[..] {
            let only = only.clone();
            schema.remove("anyOf");
            only.into_iter().for_each(|(key, value)| {
                schema.insert(key, value);
            });
        }
    }
}

/// Refuses input that would take the TOML parser too much memory, or that it would refuse without a
/// position.
fn refuse_excess(source: &Source) -> Result<(), ImportError> {
    let (mut depth, mut dots, mut marks) = (0_usize, 0, 0);
    let mut quote = None;
    for (at, &byte) in source.bytes.iter().enumerate() {
        match (quote, byte) {
            // Ends comments and strings. Strings over several lines are not tracked, since no scene needs
            // one with dozens of brackets in it.
            (_, b'\n') => (quote, dots) = (None, 0),
            (Some(open), _) if open == byte && open != b'#' => quote = None,
            (Some(_), _) => continue,
            (None, b'"' | b'\'' | b'#') => quote = Some(byte),
            (None, b'[' | b'{') => depth += 1,
            (None, b']' | b'}') => depth = depth.saturating_sub(1),
            (None, b'.') => dots += 1,
            (None, b'=' | b',') => dots = 0,
            (None, _) => continue,
        }
        marks += 1;
        if depth > MAX_DEPTH || dots > MAX_DEPTH {
            let why = format!("tables are nested more than {MAX_DEPTH} deep");
            return Err(source.malformed(at..at + 1, why, "Look for a missing bracket"));
        }
        if marks > MAX_MARKS {
            let why = "the scene has too many keys and values".to_owned();
            return Err(source.malformed(
                at..at + 1,
                why,
                "Keep geometry in OBJ or PLY files, and use fewer keys",
            ));
        }
    }
    Ok(())
}

/// The texts that a span may lie in: the file, followed by the overrides.
struct Texts<'s> {
    source: &'s Source,
    overrides: &'s [Override],
}

impl Texts<'_> {
    /// An error about `span`; see [`Source::malformed`].
    fn malformed(&self, span: Range<usize>, why: String, todo: &str) -> ImportError {
        match self.overrides.iter().find(|change| change.contains(&span)) {
            Some(change) => change.malformed(span, why, todo),
            None => self.source.malformed(span, why, todo),
        }
    }

    /// An error of the TOML parser or serde, reworded where possible.
    fn explain(&self, error: &toml::de::Error, todo: &str) -> ImportError {
        let message = error.message();
        let (why, todo) = explain_unknown(message)
            .or_else(|| explain_missing(message))
            .unwrap_or_else(|| (shorten(message), todo.to_owned()));
        self.malformed(error.span().unwrap_or(0..0), why, &todo)
    }
}

/// Rewrites serde's "unknown field `a`, expected one of `b`, `c`" with a suggestion.
fn explain_unknown(message: &str) -> Option<(String, String)> {
    let fields = message
        .strip_prefix("unknown field `")
        .map(|rest| ("key", rest));
    let variants = message
        .strip_prefix("unknown variant `")
        .map(|rest| ("value", rest));
    let (kind, rest) = fields.or(variants)?;
    let (word, expected) = rest.rsplit_once("`, expected ")?;
    let known: Vec<&str> = expected.split('`').skip(1).step_by(2).collect();
    let list: Vec<_> = known.iter().map(|name| format!("`{name}`")).collect();
    let why = suggest::unknown(kind, word, known.iter().copied());
    Some((why, format!("Allowed here: {}", list.join(", "))))
}

/// Rewrites serde's "missing field `a`".
fn explain_missing(message: &str) -> Option<(String, String)> {
    let name = message.strip_prefix("missing field `")?.strip_suffix('`')?;
    Some((
        format!("the key `{name}` is missing"),
        format!("Add `{name} = …`"),
    ))
}

/// `message` on one line of limited length: it may quote the file.
fn shorten(message: &str) -> String {
    const LONGEST: usize = 200;
    let line: String = message
        .chars()
        .take(LONGEST)
        .map(|c| if text::is_control(c) { ' ' } else { c })
        .collect();
    let more = if message.chars().nth(LONGEST).is_some() {
        "…"
    } else {
        ""
    };
    format!("{}{more}", line.trim_end_matches('.'))
}
