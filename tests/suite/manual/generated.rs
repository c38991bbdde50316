//! Generated parts of pages are current: they stand between two comments, and `UPDATE=1` writes them.

use super::pages::Page;
use super::{formats, native_reference};
use glimray::import::{SCENE_ENDINGS, SCENE_FORMATS};
use std::fs;

const BEGIN: &str = "<!-- generated: UPDATE=1 cargo test --profile ci --test suite manual -->\n";
const END: &str = "<!-- end of what is generated -->";

fn check(path: &str, expected: &str) {
    let page = Page::read(path);
    let (before, rest) = page.text.split_once(BEGIN).expect("where it begins");
    let (found, after) = rest.split_once(END).expect("where it ends");
    let expected = format!("\n{}\n\n", expected.trim_end());
    if std::env::var_os("UPDATE").is_some() {
        let updated = format!("{before}{BEGIN}{expected}{END}{after}");
        fs::write(path, updated).expect("the page written");
        return;
    }
    assert!(
        found == expected,
        "{path} is stale. Run\n  UPDATE=1 cargo test --profile ci --test suite manual"
    );
}

#[cfg(feature = "viewer")]
#[test]
fn the_table_of_shortcuts_is_current() {
    let table = glimray_viewer::model::bindings::markdown_table();
    check("docs/src/guide/shortcuts.md", &table);
}

#[test]
fn the_tables_of_formats_are_current() {
    check("README.md", &formats::scenes());
    check("docs/src/guide/models.md", &formats::extensions());
}

#[test]
fn the_table_of_formats_has_every_ending_that_is_read() {
    let listed = SCENE_FORMATS.iter().flat_map(|format| format.endings);
    let listed: Vec<_> = listed.copied().collect();
    assert_eq!(listed, SCENE_ENDINGS);
    let expected = [
        "toml", "scene", "nff", "obj", "gltf", "glb", "ply", "stl", "zip",
    ];
    assert_eq!(listed, expected);
}

#[test]
fn the_reference_of_native_scenes_is_current() {
    let reference = native_reference::markdown();
    check("docs/src/guide/native-reference.md", &reference);
}
