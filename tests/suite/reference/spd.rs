//! Scenes of the Standard Procedural Database (Haines 1987), if available: in the folder that `GLIMRAY_SPD`
//! names, or next to the repository. Without them tests are skipped.

use crate::support::skip::{Need, skip};
use glimray::import;
use glimray::scene::Scene;
use std::fmt::Display;
use std::path::PathBuf;

fn folder() -> PathBuf {
    let beside = || PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("../shared/data/spd");
    std::env::var_os("GLIMRAY_SPD").map_or_else(beside, PathBuf::from)
}

fn missing(what: impl Display) {
    let why = format!("there is no {what}; set GLIMRAY_SPD to a folder with SPD's scenes");
    skip(Need::Spd, why);
}

/// The scene and the text of its file.
pub fn load(name: &str) -> Option<(Scene, String)> {
    let path = folder().join(name);
    let Ok(text) = std::fs::read_to_string(&path) else {
        missing(path.display());
        return None;
    };
    let scene = import::load(&path).unwrap_or_else(|error| panic!("{error}"));
    Some((scene, text))
}

/// The names of all scenes in Haines' format, in order.
pub fn files() -> Vec<String> {
    let names = std::fs::read_dir(folder()).into_iter().flatten();
    let names = names.map(|entry| entry.expect("an entry").file_name());
    let names = names.map(|name| name.to_string_lossy().into_owned());
    let mut names: Vec<_> = names.filter(|name| name.ends_with(".nff")).collect();
    names.sort();
    if names.is_empty() {
        missing(folder().join("*.nff").display());
    }
    names
}
