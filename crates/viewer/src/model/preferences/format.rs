//! The settings file. Users may edit it, so every invalid value falls back to its default alone.

use crate::model::bindings::{Bindings, Preset};
use crate::model::preferences::{MAX_RECENT, Preferences, SavedCamera};
use serde::de::DeserializeOwned;
use serde::{Deserialize, Serialize, Serializer};
use std::collections::BTreeMap;
use std::path::PathBuf;
use toml::{Table, Value};

/// The bindings in the file.
#[derive(Default, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
struct BindingsEntry {
    preset: Preset,
    changed: Table,
}

/// The text of the file.
pub(super) fn write(preferences: &Preferences) -> String {
    // Every field has a form in TOML: no paths without text, no maps with other keys.
    let settings = toml::to_string(preferences).unwrap_or_default();
    format!(
        "# Settings of `glimray view`, which rewrites this file when a setting changes.\n\n{settings}"
    )
}

/// The settings in a file, and a note for each value that is not valid: a clause without a full stop.
pub(super) fn read(bytes: &[u8]) -> (Preferences, Vec<String>) {
    let mut notes = Vec::new();
    let table = match str::from_utf8(bytes).map(|text| (text, text.parse::<Table>())) {
        Ok((_, Ok(table))) => table,
        Ok((text, Err(error))) => {
            notes.push(syntax_error(text, &error));
            Table::new()
        }
        Err(_) => {
            notes.push("it is not UTF-8 text".to_owned());
            Table::new()
        }
    };
    (from_table(table, &mut notes), notes)
}

/// An error of the syntax, in one line.
fn syntax_error(text: &str, error: &toml::de::Error) -> String {
    let start = error.span().map_or(0, |span| span.start).min(text.len());
    let line = text.as_bytes()[..start].iter().filter(|b| **b == b'\n');
    format!("line {}: {}", line.count() + 1, reason(error))
}

fn reason(error: &toml::de::Error) -> String {
    let why = error.message().lines().next().unwrap_or("invalid TOML");
    // The names of all settings are too long for a message.
    match why.starts_with("unknown field") {
        true => why.split(", expected").next().unwrap_or(why).to_owned(),
        false => why.to_owned(),
    }
}

fn from_table(mut table: Table, notes: &mut Vec<String>) -> Preferences {
    let overlays = sub_table(&mut table, "overlays", notes);
    let bindings = sub_table(&mut table, "bindings", notes);
    let cameras = sub_table(&mut table, "cameras", notes);
    let mut preferences = by_key(table, check, notes);
    preferences.overlays = by_key(overlays, |_| Ok(()), notes);
    let bindings: BindingsEntry = by_key(bindings, |_| Ok(()), notes);
    let changed = by_key(bindings.changed, |_| Ok(()), notes);
    preferences.bindings = Bindings::from_changes(bindings.preset, &changed, notes);
    let cameras: BTreeMap<PathBuf, Vec<Value>> = by_key(cameras, |_| Ok(()), notes);
    for (scene, list) in cameras {
        let list: Vec<_> = (list.into_iter())
            .filter_map(|camera| match camera.try_into::<SavedCamera>() {
                Ok(camera) => Some(camera),
                Err(error) => {
                    let why = reason(&error);
                    notes.push(format!("a camera of `{}`: {why}", scene.display()));
                    None
                }
            })
            .collect();
        if !list.is_empty() {
            preferences.cameras.insert(scene, list);
        }
    }
    let mut recent = Vec::new();
    for path in std::mem::take(&mut preferences.recent) {
        if !recent.contains(&path) && recent.len() < MAX_RECENT {
            recent.push(path);
        }
    }
    preferences.recent = recent;
    preferences
}

fn sub_table(table: &mut Table, name: &str, notes: &mut Vec<String>) -> Table {
    match table.remove(name) {
        None => Table::new(),
        Some(Value::Table(table)) => table,
        Some(_) => {
            notes.push(format!("`{name}`: must be a table"));
            Table::new()
        }
    }
}

/// Deserializes a table with those of its keys that are known and have valid values.
fn by_key<T: DeserializeOwned + Default>(
    table: Table,
    check: fn(&T) -> Result<(), &'static str>,
    notes: &mut Vec<String>,
) -> T {
    let mut valid = Table::new();
    let mut result = T::default();
    for (key, value) in table {
        valid.insert(key.clone(), value);
        let read: Result<T, String> = valid.clone().try_into().map_err(|error| reason(&error));
        match read.and_then(|read| check(&read).map(|()| read).map_err(str::to_owned)) {
            Ok(read) => result = read,
            Err(why) => {
                valid.remove(&key);
                notes.push(format!("`{key}`: {why}"));
            }
        }
    }
    result
}

/// Checks the ranges of numbers.
fn check(it: &Preferences) -> Result<(), &'static str> {
    let is_side = |side: &f32| (50.0..=100_000.0).contains(side);
    let is_place = |at: &f32| at.abs() <= 100_000.0;
    if !(0.5..=4.0).contains(&it.ui_scale) {
        return Err("must be 0.5 to 4");
    }
    if it
        .samples
        .is_some_and(|count| !(1..=65_536).contains(&count))
    {
        return Err("must be 1 to 65536");
    }
    if it.window.is_some_and(|size| !size.iter().all(is_side)) {
        return Err("is not a valid size");
    }
    if (it.window_position).is_some_and(|position| !position.iter().all(is_place)) {
        return Err("is not a valid position");
    }
    Ok(())
}

/// Bindings as their preset and changes.
pub(super) fn bindings<S: Serializer>(bindings: &Bindings, to: S) -> Result<S::Ok, S::Error> {
    let changed = bindings.changes().into_iter();
    let entry = BindingsEntry {
        preset: bindings.preset(),
        changed: changed.map(|(name, keys)| (name, keys.into())).collect(),
    };
    entry.serialize(to)
}

/// Paths. Those that are not Unicode have no form in the file and are left out.
pub(super) fn paths<S: Serializer>(paths: &[PathBuf], to: S) -> Result<S::Ok, S::Error> {
    to.collect_seq(paths.iter().filter_map(|path| path.to_str()))
}

/// Bookmarks by the path of their scene, as for [`paths`].
pub(super) fn cameras<S: Serializer>(
    cameras: &BTreeMap<PathBuf, Vec<SavedCamera>>,
    to: S,
) -> Result<S::Ok, S::Error> {
    let texts = cameras.iter();
    to.collect_map(texts.filter_map(|(path, cameras)| Some((path.to_str()?, cameras))))
}

/// A tone curve by its name on the command line.
pub(super) mod tone {
    use glimray_app::value_names::TONES;
    use glimray_scene::ToneCurve;
    use serde::de::Error;
    use serde::{Deserialize, Deserializer, Serialize, Serializer};

    pub fn serialize<S: Serializer>(tone: &Option<ToneCurve>, to: S) -> Result<S::Ok, S::Error> {
        tone.map(|tone| TONES.name(&tone)).serialize(to)
    }

    pub fn deserialize<'de, D: Deserializer<'de>>(from: D) -> Result<Option<ToneCurve>, D::Error> {
        let word = String::deserialize(from)?;
        match TONES.value(&word) {
            Some(tone) => Ok(Some(tone)),
            None => Err(D::Error::custom(format!("unknown tone curve `{word}`"))),
        }
    }
}

/// JSON as text: TOML has no null.
pub(super) mod json {
    use serde::de::Error;
    use serde::{Deserialize, Deserializer, Serialize, Serializer};
    use serde_json::Value;

    pub fn serialize<S: Serializer>(value: &Value, to: S) -> Result<S::Ok, S::Error> {
        value.to_string().serialize(to)
    }

    pub fn deserialize<'de, D: Deserializer<'de>>(from: D) -> Result<Value, D::Error> {
        let text = String::deserialize(from)?;
        serde_json::from_str(&text).map_err(|_| D::Error::custom("is not JSON"))
    }
}
