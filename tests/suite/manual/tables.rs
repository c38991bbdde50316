//! Tables and lists of the manual have everything, and nothing that is not there.

use super::commands::help_text;
use super::pages::Page;
use crate::support::verdict::Verdict;
use glimray::import::SCENE_ENDINGS;
use std::collections::BTreeSet;
use std::path::Path;

#[test]
fn the_map_of_the_code_has_every_shader() {
    let page = Page::read("docs/src/internals/code-map.md");
    let is_separator = |c: char| c.is_whitespace() || ",`.".contains(c);
    let words: BTreeSet<_> = page.text.split(is_separator).collect();
    let mut verdict = Verdict::on(&page.path);
    for folder in ["lib", "scene", "kernels"] {
        for entry in std::fs::read_dir(Path::new("shaders").join(folder)).expect("a folder") {
            let path = entry.expect("an entry").path();
            if path.extension().is_some_and(|ending| ending != "wesl") {
                continue;
            }
            let stem = path.file_stem().expect("a name").to_string_lossy();
            let name = match path.is_dir() {
                true => format!("{stem}/"),
                false => stem.into_owned(),
            };
            verdict.that(path.display(), words.contains(&*name), || "is missing");
        }
    }
    verdict.close();
}

#[test]
fn every_scene_is_in_the_table_of_scenes() {
    let page = Page::read("assets/scenes/README.md");
    let mut verdict = Verdict::on(&page.path);
    for entry in std::fs::read_dir("assets/scenes").expect("a folder") {
        let name = entry.expect("an entry").file_name();
        let name = name.to_string_lossy();
        if SCENE_ENDINGS
            .iter()
            .any(|ending| name.ends_with(&format!(".{ending}")))
        {
            let row = format!("| `{name}` |");
            verdict.that(&name, page.text.contains(&row), || "is missing");
        }
    }
    verdict.close();
}

#[test]
fn options_in_the_table_are_those_of_render_with_their_values() {
    let page = Page::read("docs/src/guide/command-line.md");
    let (_, table) = page
        .text
        .split_once("\n## Options of render\n")
        .expect("the section");
    let table = table.split("\n## ").next().expect("a part");
    let help = help_text("render").expect("a command");
    let help = help.split_whitespace().collect::<Vec<_>>().join(" ");
    let mut verdict = Verdict::on("the table of options");
    let rows = table.lines().filter(|line| line.starts_with('|'));
    for option in rows.flat_map(|row| row.split('`').skip(1).step_by(2)) {
        let (flag, values) = option.split_once(' ').unwrap_or((option, ""));
        let is_flag = help.split([' ', ',']).any(|word| word == flag);
        verdict.that(option, is_flag, || "there is no such flag");
        // A bar within a cell is escaped.
        let values: Vec<_> = values.split("\\|").collect();
        if values.len() < 2 || values[0] == "INDEX" {
            continue;
        }
        let (_, own) = help.split_once(&format!("{flag} <")).unwrap_or_default();
        let own = own.split(" --").next().expect("a part");
        for value in values {
            let is_there = own.contains(&format!("- {value}:"));
            verdict.that(option, is_there, || format!("has no value {value}"));
        }
    }
    verdict.close();
}

#[test]
fn exit_codes_are_those_of_the_help() {
    let page = Page::read("docs/src/guide/report.md");
    let rows = page.text.lines().filter_map(|line| {
        let cells: Vec<_> = line.split('|').map(str::trim).collect();
        let [_, code, meaning, _, _] = cells[..] else {
            return None;
        };
        code.parse::<u8>()
            .ok()
            .map(|code| (code, meaning.replace('`', "")))
    });
    let rows: Vec<_> = rows
        .map(|(code, meaning)| format!("{code} {meaning}"))
        .collect();
    assert_eq!(rows.len(), 11, "{rows:?}");
    let help = help_text("").expect("the help");
    let help = help.split_whitespace().collect::<Vec<_>>().join(" ");
    for row in &rows {
        assert!(help.contains(row), "{row}");
    }
}
