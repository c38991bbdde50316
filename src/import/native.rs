//! glimray's own format (`.toml`): written by hand, checked to the last key.
//!
//! [`file`] is the format: its types are what a scene may say, and their docs become the JSON
//! Schema. [`values`] checks single values, [`build`] what only shows when several are put together:
//! [`objects`] knows who is who and how many there will be, then everything is placed, and at last
//! [`animation`] moves it.

mod animation;
mod build;
mod cameras;
mod file;
mod lights;
mod materials;
mod nodes;
mod objects;
mod repeat;
mod set;
mod shapes;
mod textures;
mod transforms;
mod values;

use super::Options;
use super::error::{ImportError, fault};
use super::paths::Files;
use super::source::Source;
use super::suggest;
use crate::scene::Scene;
use serde::Deserialize;
use set::Override;
use std::ops::Range;
use toml::de::DeTable;

/// The longest native scene that is read. Geometry of any size belongs into mesh files.
pub(super) const MAX_BYTES: u64 = 16 << 20;

/// How many keys, values and tables a native scene may have, about. The parser takes up to 800
/// bytes for each.
const MAX_MARKS: usize = 500_000;

/// How deep values may nest in TOML arrays and inline tables, and how many dots a key may have.
/// No scene needs more than a handful.
const MAX_DEPTH: usize = 32;

/// The scene in `source`, changed by the overrides of `options`.
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
    )
}

/// The JSON Schema of [`file::SceneFile`].
pub(super) fn schema() -> serde_json::Value {
    schemars::schema_for!(file::SceneFile).to_value()
}

/// Refuses what would take the TOML parser too much memory, or what it would refuse without saying
/// where.
fn refuse_excess(source: &Source) -> Result<(), ImportError> {
    let (mut depth, mut dots, mut marks) = (0_usize, 0, 0);
    let mut quote = None;
    for (at, &byte) in source.bytes.iter().enumerate() {
        match (quote, byte) {
            // Ends comments, and strings: those over several lines are not followed, since no scene
            // has use for one with dozens of brackets in it.
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
            let why = "a native scene cannot have so many keys and values".to_owned();
            return Err(source.malformed(
                at..at + 1,
                why,
                "Keep geometry in OBJ files, and let fewer keys move it",
            ));
        }
    }
    Ok(())
}

/// The texts that a span may lie in: the file, and behind it the overrides.
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

    /// An error of the TOML parser or of serde, in our words where we have better ones.
    fn explain(&self, error: &toml::de::Error, todo: &str) -> ImportError {
        let message = error.message();
        let (why, todo) = explain_unknown(message)
            .or_else(|| explain_missing(message))
            .unwrap_or_else(|| (shorten(message), todo.to_owned()));
        self.malformed(error.span().unwrap_or(0..0), why, &todo)
    }
}

/// Serde's "unknown field `a`, expected one of `b`, `c`" with a suggestion instead.
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
    Some((why, format!("Known here: {}", list.join(", "))))
}

/// Serde's "missing field `a`".
fn explain_missing(message: &str) -> Option<(String, String)> {
    let name = message.strip_prefix("missing field `")?.strip_suffix('`')?;
    Some((
        format!("the key `{name}` is missing"),
        format!("Add `{name} = …`"),
    ))
}

/// `message` on one line of bearable length: it may quote the file.
fn shorten(message: &str) -> String {
    const LONGEST: usize = 200;
    let line: String = message
        .chars()
        .take(LONGEST)
        .map(|c| if c.is_control() { ' ' } else { c })
        .collect();
    let more = if message.chars().nth(LONGEST).is_some() {
        "…"
    } else {
        ""
    };
    format!("{}{more}", line.trim_end_matches('.'))
}
