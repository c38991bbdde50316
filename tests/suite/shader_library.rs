//! The table in `shaders/lib/README.md` lists every function that is imported elsewhere, with an existing test.

use crate::support::verdict::Verdict;
use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};

/// The shaders in a folder and those below it, with their sources.
pub fn shaders(folder: &str) -> Vec<(PathBuf, String)> {
    let mut open = vec![PathBuf::from(folder)];
    let mut found = Vec::new();
    while let Some(path) = open.pop() {
        if path.is_dir() {
            let entries = fs::read_dir(&path).expect("a folder");
            open.extend(entries.map(|entry| entry.expect("an entry").path()));
        } else if path.extension().is_some_and(|ending| ending == "wesl") {
            let text = fs::read_to_string(&path).expect("a text file");
            found.push((path, text));
        }
    }
    found
}

/// The names that `text` imports from `module`, such as `package::lib::rng`.
fn imported<'t>(text: &'t str, module: &str) -> Vec<&'t str> {
    let mut names = Vec::new();
    for rest in text.split(&format!("import {module}::")).skip(1) {
        let statement = rest.split(';').next().unwrap_or_default();
        let list = statement.trim_start_matches('{').trim_end_matches('}');
        names.extend(
            list.split(',')
                .map(str::trim)
                .filter(|name| !name.is_empty()),
        );
    }
    names
}

/// Whether the module `name` of the suite has that test.
fn has_test(module: &str, test: &str) -> bool {
    let path = format!("tests/suite/{module}.rs");
    let text = fs::read_to_string(path).unwrap_or_default();
    text.contains(&format!("#[test]\nfn {test}()"))
}

#[test]
fn the_readme_of_the_shader_library_has_every_function_with_its_test() {
    let readme = fs::read_to_string("shaders/lib/README.md").expect("a text file");
    let mut verdict = Verdict::on("shaders/lib/README.md");
    let mut listed = BTreeSet::new();
    for row in readme.lines().filter(|line| line.starts_with("| `")) {
        let cells: Vec<_> = row.split('|').map(str::trim).collect();
        let [_, function, what, _, test, _] = cells[..] else {
            panic!("{row}");
        };
        let names: Vec<_> = function.split('`').skip(1).step_by(2).collect();
        let [file, name] = names[..] else {
            panic!("{row}");
        };
        let text = fs::read_to_string(Path::new("shaders/lib").join(file)).unwrap_or_default();
        let is_there = text.contains(&format!("\nfn {name}("));
        verdict.that(row, is_there, || "there is no such function");
        verdict.that(row, !what.is_empty(), || "does not say what it does");
        let test = test.trim_matches('`').split_once("::");
        let has_test = test.is_some_and(|(module, test)| has_test(module, test));
        verdict.that(row, has_test, || "there is no such test");
        let is_new = listed.insert((file.to_owned(), name.to_owned()));
        verdict.that(row, is_new, || "is there twice");
    }
    let all = shaders("shaders");
    for (path, text) in shaders("shaders/lib") {
        let file = path.strip_prefix("shaders/lib").expect("below it");
        let file = file.to_string_lossy().replace('\\', "/");
        let module = format!(
            "package::lib::{}",
            file.trim_end_matches(".wesl").replace('/', "::")
        );
        let begins = text.lines().next().unwrap_or_default();
        verdict.that(&file, begins.starts_with("// "), || "has no header");
        let is_listed = |name: &str| listed.contains(&(file.clone(), name.to_owned()));
        let has_row = listed.iter().any(|(listed, _)| *listed == file);
        verdict.that(&file, has_row, || "is not in the table");
        for name in all.iter().flat_map(|(_, text)| imported(text, &module)) {
            let is_function = text.contains(&format!("\nfn {name}("));
            verdict.that(
                format!("{file} {name}"),
                !is_function || is_listed(name),
                || "is imported, and not in the table",
            );
        }
    }
    assert!(listed.len() > 80, "{} functions", listed.len());
    verdict.close();
}
