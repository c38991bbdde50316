//! What README.md says of files and commands holds.

use crate::support::verdict::Verdict;
use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;
use std::process::Command;

fn readme() -> String {
    std::fs::read_to_string("README.md").expect("README.md")
}

/// What stands between `begin` and the next `end`, for each `begin`.
fn between<'a>(text: &'a str, begin: &'a str, end: char) -> impl Iterator<Item = &'a str> {
    let parts = text.split(begin).skip(1);
    parts.filter_map(move |part| Some(part.split_once(end)?.0))
}

#[test]
fn files_that_the_readme_names_are_there() {
    const FOLDERS: [&str; 6] = [
        "assets",
        "benches",
        "examples",
        "shaders",
        "src",
        "tests/suite",
    ];
    let text = readme();
    let links = between(&text, "](", ')').filter(|link| !link.starts_with(['#', 'h']));
    let is_path = |name: &&str| FOLDERS.iter().any(|f| name.starts_with(&format!("{f}/")));
    let quoted = text.split('`').skip(1).step_by(2).filter(is_path);
    let is_exact = |name: &&str| !name.contains(['{', '*', ' ']) && !name.contains("NAME");
    let mut verdict = Verdict::on("README.md");
    for name in links.chain(quoted).filter(is_exact) {
        verdict.that(name, Path::new(name).exists(), || "is not there");
    }
    verdict.close();
}

#[test]
fn the_map_of_the_readme_has_every_shader() {
    let text = readme();
    let (_, map) = text.split_once("\nshaders/types.wesl").expect("the map");
    let (map, _) = map.split_once("\ntests/suite/").expect("the map's end");
    let is_separator = |c: char| c.is_whitespace() || c == ',';
    let words: BTreeSet<_> = map.split(is_separator).collect();
    let mut verdict = Verdict::on("the map of README.md");
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

/// What `glimray help COMMAND` prints, on one line.
fn help(command: &str) -> String {
    let output = Command::new(env!("CARGO_BIN_EXE_glimray"))
        .args(["help", command])
        .output()
        .expect("glimray");
    assert!(output.status.success(), "there is no command `{command}`");
    let text = String::from_utf8(output.stdout).expect("UTF-8");
    text.split_whitespace().collect::<Vec<_>>().join(" ")
}

/// Whether the program's help has the flag, and not only one that begins like it.
fn has_flag(help: &str, flag: &str) -> bool {
    help.split([' ', ',']).any(|word| word == flag)
}

fn is_command_here(name: &str) -> bool {
    cfg!(feature = "viewer") || name != "view"
}

#[test]
fn commands_of_the_readme_have_only_flags_that_there_are() {
    let text = readme();
    let lines = text
        .lines()
        .map(|line| line.trim_start_matches("target/release/"));
    let plain = lines.filter(|line| line.starts_with("glimray "));
    let quoted = text.split('`').skip(1).step_by(2);
    let quoted = quoted.filter(|code| code.starts_with("glimray "));
    let mut helps = BTreeMap::new();
    let mut verdict = Verdict::on("README.md");
    for line in plain.chain(quoted) {
        let line = line.split(['#', '|']).next().expect("a part");
        let mut words = line.split_whitespace().skip(1);
        let Some(command) = words.next().filter(|name| is_command_here(name)) else {
            continue;
        };
        if ["help", "COMMAND", "…"].contains(&command) {
            continue;
        }
        let help = helps.entry(command).or_insert_with(|| help(command));
        for flag in words.filter(|word| word.starts_with("--")) {
            verdict.that(line, has_flag(help, flag), || format!("has no {flag}"));
        }
    }
    assert!(helps.len() >= 10, "{:?}", helps.keys());
    verdict.close();
}

#[test]
fn options_in_the_table_of_the_readme_are_those_of_render_with_their_values() {
    let text = readme();
    let (_, table) = text.split_once("**Options of `render`").expect("the table");
    let (table, _) = table.split_once("\n**Report:**").expect("its end");
    let help = help("render");
    let mut verdict = Verdict::on("the options in README.md");
    // A bar within a cell is escaped.
    for option in table.split('`').skip(1).step_by(2) {
        let (flag, values) = option.split_once(' ').unwrap_or((option, ""));
        verdict.that(option, has_flag(&help, flag), || "there is no such flag");
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
fn exit_codes_of_the_readme_are_those_of_the_help() {
    let text = readme();
    let (_, said) = text.split_once("**Exit codes:** ").expect("exit codes");
    let said = said.split_once(" SIGTERM").expect("the last of them").0;
    let said: Vec<_> = said
        .split('·')
        .map(|code| code.replace(['`', '\n'], " "))
        .collect();
    let said = said
        .iter()
        .map(|code| code.split_whitespace().collect::<Vec<_>>().join(" "));
    let said = said.collect::<Vec<_>>().join(", ").replace(" :", ":");
    let output = Command::new(env!("CARGO_BIN_EXE_glimray"))
        .arg("help")
        .output();
    let help = String::from_utf8(output.expect("glimray").stdout).expect("UTF-8");
    let help = help.split_whitespace().collect::<Vec<_>>().join(" ");
    assert!(
        help.contains(&format!("Exit codes: {said} SIGTERM.")),
        "{said}"
    );
}
