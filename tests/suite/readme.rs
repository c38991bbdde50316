//! README.md stays short, and says where everything is.

use std::path::Path;

fn readme() -> String {
    std::fs::read_to_string("README.md").expect("README.md")
}

#[test]
fn the_readme_is_short() {
    let lines = readme().lines().count();
    assert!(
        lines <= 260,
        "{lines} lines: what is long belongs into docs/"
    );
}

#[test]
fn the_readme_shows_no_source_of_formulas() {
    // crates.io renders no LaTeX.
    let text = readme();
    for mark in ["$$", "\\frac", "\\cdot"] {
        assert!(!text.contains(mark), "{mark}");
    }
}

#[test]
fn the_contents_of_the_readme_are_its_sections() {
    let text = readme();
    let sections: Vec<_> = text
        .lines()
        .filter_map(|line| line.strip_prefix("## "))
        .collect();
    let (contents, _) = text.split_once("\n## ").expect("a section");
    for section in &sections {
        let is_listed = contents.contains(&format!("[{section}](#"));
        assert!(is_listed, "{section} is not in the contents");
    }
    assert!(sections.len() >= 8, "{sections:?}");
}

#[test]
fn the_map_of_the_readme_has_the_top_folders() {
    let text = readme();
    let (_, map) = text.split_once("\n## Map\n").expect("the map");
    let folders = [
        "assets",
        "benches",
        "crates",
        "docs",
        "examples",
        "packaging",
        "shaders",
        "src",
        "tests",
    ];
    for folder in folders {
        assert!(Path::new(folder).is_dir(), "{folder}");
        let row = format!("({folder}/)");
        assert!(map.contains(&row), "{folder} is not in the map");
    }
}

#[test]
fn the_scene_of_the_readme_is_the_one_of_its_picture() {
    let text = readme();
    let (_, scene) = text.split_once("```toml\n").expect("a scene");
    let (scene, _) = scene.split_once("```").expect("its end");
    let file = std::fs::read_to_string("assets/scenes/still_life.toml").expect("the file");
    assert!(text.contains("glimray render assets/scenes/still_life.toml"));
    assert_eq!(scene, file);
}
