//! The scenes that the manual prints load, and look as good as its pictures.

use super::pages::{Page, manual};
use crate::support::verdict::Verdict;
use glimray::import;
use glimray::scene::Scene;
use std::fs;

/// The files that scenes of the manual name.
const FILES: [&str; 3] = ["lighthouse.obj", "lighthouse.mtl", "tile.png"];

fn load(name: &str, text: &str) -> Result<Scene, String> {
    let folder = tempfile::tempdir().expect("a temporary folder");
    for file in FILES {
        let from = format!("assets/scenes/{file}");
        fs::copy(from, folder.path().join(file)).expect("a copy");
    }
    let path = folder.path().join(name);
    fs::write(&path, text).expect("a file");
    import::load(&path).map_err(|error| error.to_string())
}

/// The scenes with their pages, and the languages of their blocks.
fn scenes() -> Vec<(Page, String, String)> {
    let mut found = Vec::new();
    for page in manual() {
        let blocks = page.blocks().into_iter();
        let blocks = blocks.filter(|block| ["toml", "scene"].contains(&block.language));
        let texts: Vec<_> = blocks
            .map(|block| (block.language.to_owned(), block.text.to_owned()))
            .collect();
        for (language, text) in texts {
            found.push((Page::read(&page.path), language, text));
        }
    }
    found
}

#[test]
fn scenes_of_the_manual_load_without_a_word() {
    let mut verdict = Verdict::on("scenes of the manual");
    for (page, language, text) in scenes() {
        let name = format!("{}:\n{text}", page.path);
        match load(&format!("a.{language}"), &text) {
            Ok(scene) => verdict.that(name, scene.skipped.is_empty(), || {
                format!("{:?}", scene.skipped)
            }),
            Err(error) => verdict.that(name, false, || error),
        }
    }
    verdict.close();
}

#[test]
fn complete_scenes_of_the_manual_are_lit_and_sampled_well() {
    let mut verdict = Verdict::on("complete scenes of the manual");
    for (page, language, text) in scenes() {
        let is_complete = text.contains("[camera]") && text.contains("[[objects]]");
        if language != "toml" || !is_complete {
            continue;
        }
        let scene = load("a.toml", &text).unwrap_or_else(|error| panic!("{error}\n{text}"));
        let name = format!("{}:\n{text}", page.path);
        verdict.that(&name, !scene.is_unlit(), || "has no light");
        let samples = scene.output.samples;
        verdict.that(&name, samples >= 16, || format!("has {samples} samples"));
    }
    verdict.close();
}
