//! The tables of formats and glTF extensions, from the lists of the importers.

use glimray::import::{GLTF_EXTENSIONS, SCENE_FORMATS, Support};
use std::fmt::Write;

pub fn scenes() -> String {
    let mut text = "| files | format | shown | skipped |\n|---|---|---|---|\n".to_owned();
    for format in SCENE_FORMATS {
        let endings = format.endings.iter().map(|ending| format!("`.{ending}`"));
        let endings = endings.collect::<Vec<_>>().join(" ");
        let skipped = match format.skipped {
            "" => "–",
            parts => parts,
        };
        writeln!(
            text,
            "| {endings} | {} | {} | {skipped} |",
            format.name, format.shown
        )
        .expect("a string takes everything");
    }
    text
}

pub fn extensions() -> String {
    let mut text = "| extensions | |\n|---|---|\n".to_owned();
    for (support, effect) in [
        (Support::Full, "supported"),
        (
            Support::Paths,
            "shown by `--integrator path`, kept by the classical one",
        ),
        (
            Support::Kept,
            "partly: read and kept in the scene, not shown",
        ),
        (
            Support::Irrelevant,
            "skipped, as they say nothing about the picture",
        ),
    ] {
        let names = GLTF_EXTENSIONS
            .iter()
            .filter(|(_, found)| *found == support);
        let names: Vec<_> = names.map(|(name, _)| format!("`{name}`")).collect();
        writeln!(text, "| {} | {effect} |", names.join(" ")).expect("a string takes everything");
    }
    text + "| others | skipped; a model that requires one is refused |\n"
}
