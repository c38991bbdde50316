//! Settings from a file that people may have changed: what can be read is taken.

use crate::app::words::TONES;
use crate::viewer::model::bindings::{Bindings, Preset};
use crate::viewer::model::preferences::{Preferences, SavedCamera, Theme};
use serde::de::DeserializeOwned;
use std::collections::BTreeMap;
use std::path::PathBuf;
use toml::{Table, Value};

/// What the file says, and what of it could not be read: a few words each, no full stop.
pub(super) fn read(bytes: &[u8]) -> (Preferences, Vec<String>) {
    let mut preferences = Preferences::default();
    let mut notes = Vec::new();
    match str::from_utf8(bytes) {
        Ok(text) => match text.parse::<Table>() {
            Ok(table) => fill(&mut preferences, table, &mut notes),
            Err(error) => notes.push(place(text, &error)),
        },
        Err(_) => notes.push("it is not UTF-8 text".to_owned()),
    }
    (preferences, notes)
}

/// A mistake of spelling, in one line.
fn place(text: &str, error: &toml::de::Error) -> String {
    let start = error.span().map_or(0, |span| span.start).min(text.len());
    let line = text.as_bytes()[..start].iter().filter(|b| **b == b'\n');
    let why = error.message().lines().next().unwrap_or("invalid TOML");
    format!("line {}: {why}", line.count() + 1)
}

fn fill(preferences: &mut Preferences, mut table: Table, notes: &mut Vec<String>) {
    let it = preferences;
    if let Some(name) = take::<String>(&mut table, "theme", notes) {
        match Theme::ALL.into_iter().find(|theme| theme.name() == name) {
            Some(theme) => it.theme = theme,
            None => notes.push(format!("unknown theme `{name}`")),
        }
    }
    if let Some(scale) = take::<f32>(&mut table, "ui_scale", notes) {
        match (0.5..=4.0).contains(&scale) {
            true => it.ui_scale = scale,
            false => notes.push(format!("`ui_scale` must be 0.5 to 4, not {scale}")),
        }
    }
    if let Some(seen) = take(&mut table, "hint_seen", notes) {
        it.hint_seen = seen;
    }
    if let Some(samples) = take::<i64>(&mut table, "samples", notes) {
        match u32::try_from(samples) {
            Ok(count @ 1..=65_536) => it.samples = Some(count),
            _ => notes.push(format!("`samples` must be 1 to 65536, not {samples}")),
        }
    }
    if let Some(word) = take::<String>(&mut table, "tone", notes) {
        it.tone = TONES.value(&word);
        if it.tone.is_none() {
            notes.push(format!("unknown tone curve `{word}`"));
        }
    }
    if let Some(size) = take::<[f32; 2]>(&mut table, "window", notes) {
        match size.iter().all(|side| (50.0..=100_000.0).contains(side)) {
            true => it.window = Some(size),
            false => notes.push("`window` is not a valid size".to_owned()),
        }
    }
    if let Some(position) = take::<[f32; 2]>(&mut table, "window_position", notes) {
        match position.iter().all(|at| at.abs() <= 100_000.0) {
            true => it.window_position = Some(position),
            false => notes.push("`window_position` is not a valid position".to_owned()),
        }
    }
    if let Some(maximized) = take(&mut table, "maximized", notes) {
        it.maximized = maximized;
    }
    if let Some(text) = take::<String>(&mut table, "layout", notes) {
        match serde_json::from_str(&text) {
            Ok(layout) => it.layout = layout,
            Err(_) => notes.push("`layout` is not JSON".to_owned()),
        }
    }
    if let Some(paths) = take::<Vec<PathBuf>>(&mut table, "recent", notes) {
        for path in paths {
            if !it.recent.contains(&path)
                && it.recent.len() < crate::viewer::model::preferences::MAX_RECENT
            {
                it.recent.push(path);
            }
        }
    }
    if let Some(bindings) = take::<Table>(&mut table, "bindings", notes) {
        it.bindings = read_bindings(bindings, notes);
    }
    if let Some(cameras) = take::<Table>(&mut table, "cameras", notes) {
        for (scene, list) in cameras {
            read_cameras(it, scene, list, notes);
        }
    }
    unknown(&table, notes);
}

fn read_bindings(mut table: Table, notes: &mut Vec<String>) -> Bindings {
    let name = take::<String>(&mut table, "preset", notes);
    let preset = name.map_or(Preset::default(), |name| {
        Preset::from_name(&name).unwrap_or_else(|| {
            notes.push(format!("unknown preset `{name}`"));
            Preset::default()
        })
    });
    let mut changed = take::<Table>(&mut table, "changed", notes).unwrap_or_default();
    let names: Vec<_> = changed.keys().cloned().collect();
    let lists = names.into_iter().filter_map(|name| {
        let triggers = take::<Vec<String>>(&mut changed, &name, notes)?;
        Some((name, triggers))
    });
    let lists: BTreeMap<_, _> = lists.collect();
    unknown(&table, notes);
    Bindings::from_changes(preset, &lists, notes)
}

fn read_cameras(it: &mut Preferences, scene: String, list: Value, notes: &mut Vec<String>) {
    let Value::Array(list) = list else {
        notes.push(format!("the cameras of `{scene}` are not a list"));
        return;
    };
    let mut cameras = Vec::new();
    for camera in list {
        match SavedCamera::from_toml(camera) {
            Ok(camera) => cameras.push(camera),
            Err(why) => notes.push(format!("a camera of `{scene}`: {why}")),
        }
    }
    if !cameras.is_empty() {
        it.cameras.insert(scene.into(), cameras);
    }
}

/// Takes a value out of the table, if it is there and of the right kind.
fn take<T: DeserializeOwned>(table: &mut Table, name: &str, notes: &mut Vec<String>) -> Option<T> {
    let value = table.remove(name)?;
    match value.try_into() {
        Ok(value) => Some(value),
        Err(error) => {
            let why = error.message().lines().next().unwrap_or("invalid TOML");
            notes.push(format!("`{name}`: {why}"));
            None
        }
    }
}

fn unknown(rest: &Table, notes: &mut Vec<String>) {
    for name in rest.keys() {
        notes.push(format!("unknown setting `{name}`"));
    }
}
