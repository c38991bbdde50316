//! Links lead somewhere: on GitHub, and in the built book.

use super::pages::{Page, book, manual};
use crate::support::verdict::Verdict;
use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};

/// `make docs` builds the pages as deep in the site as they are in the repository, and copies the folders that
/// they link to beside them. So a link works in both places.
const PAGES: &str = "docs/src";
const BUILT: &str = "docs/book";

fn is_elsewhere(target: &str) -> bool {
    target.starts_with("https://") || target.starts_with("http://")
}

#[test]
fn every_link_of_the_manual_leads_somewhere() {
    let mut verdict = Verdict::on("links of the manual");
    for page in manual() {
        for target in page.links().into_iter().filter(|link| !is_elsewhere(link)) {
            let row = format!("{}: {target}", page.path);
            let (file, anchor) = target.split_once('#').unwrap_or((&target, ""));
            let path = page.resolve(file);
            verdict.that(&row, file.is_empty() || path.exists(), || "is not there");
            if anchor.is_empty() {
                continue;
            }
            let anchors = match file {
                "" => page.anchors(),
                _ if path.exists() => Page::read(&path.to_string_lossy()).anchors(),
                _ => continue,
            };
            let is_there = anchors.iter().any(|heading| heading == anchor);
            verdict.that(&row, is_there, || format!("the headings are {anchors:?}"));
        }
    }
    verdict.close();
}

#[test]
fn every_page_of_the_book_is_in_its_summary_once() {
    let summary = Page::read("docs/src/SUMMARY.md");
    let listed = summary.links();
    let unique: BTreeSet<_> = listed.iter().cloned().collect();
    assert_eq!(unique.len(), listed.len(), "{listed:?}");
    let pages = book().into_iter();
    let pages = pages.map(|page| page.path[PAGES.len() + 1..].to_owned());
    let pages: BTreeSet<_> = pages.filter(|path| path != "SUMMARY.md").collect();
    assert_eq!(unique, pages);
}

#[test]
fn links_of_the_book_work_in_the_built_book_too() {
    let makefile = fs::read_to_string("Makefile").expect("Makefile");
    let lists = makefile
        .lines()
        .filter_map(|line| line.strip_prefix("LINKED := "));
    let copied: Vec<_> = lists.flat_map(str::split_whitespace).collect();
    assert!(makefile.contains(&format!("$(SITE)/{BUILT}")));
    let depth = |path: &str| path.split('/').count();
    assert_eq!(depth(PAGES), depth(BUILT));

    let mut verdict = Verdict::on("links that leave the book");
    let root = fs::canonicalize(".").expect("the repository");
    let inside = root.join(PAGES);
    for page in book() {
        for target in page.links().into_iter().filter(|link| !is_elsewhere(link)) {
            let file = target.split('#').next().unwrap_or_default();
            let Ok(path) = fs::canonicalize(page.resolve(file)) else {
                continue;
            };
            if file.is_empty() || path.starts_with(&inside) {
                continue;
            }
            let row = format!("{}: {target}", page.path);
            let path = path.strip_prefix(&root).expect("in the repository");
            let is_copied = copied.iter().any(|folder| path.starts_with(folder));
            verdict.that(
                &row,
                is_copied,
                || "is not copied into the site: see LINKED in the Makefile",
            );
            // mdBook takes every link to Markdown for a page of its own.
            let is_page = path.extension().is_some_and(|ending| ending == "md");
            verdict.that(&row, !is_page, || "would lead to .html: link to the folder");
        }
    }
    verdict.close();
}

#[test]
fn files_and_tests_that_the_manual_names_are_there() {
    const FOLDERS: [&str; 9] = [
        "assets/",
        "benches/",
        "crates/",
        "examples/",
        "fuzz/",
        "packaging/",
        "shaders/",
        "src/",
        "tests/",
    ];
    let is_pattern = |name: &str| name.contains(['{', '*', ' ', '%']) || name.contains("NAME");
    let mut verdict = Verdict::on("files named in the manual");
    for page in manual() {
        for name in page.quoted() {
            let is_path = FOLDERS.iter().any(|folder| name.starts_with(folder));
            if is_path && !is_pattern(&name) {
                let row = format!("{}: {name}", page.path);
                verdict.that(row, Path::new(&name).exists(), || "is not there");
            }
            let Some((module, test)) = name.rsplit_once("::") else {
                continue;
            };
            let file = format!("tests/suite/{}.rs", module.replace("::", "/"));
            if let Ok(text) = fs::read_to_string(file)
                && test.contains('_')
            {
                let is_test = text.contains(&format!("#[test]\nfn {test}()"));
                let row = format!("{}: {name}", page.path);
                verdict.that(row, is_test, || "there is no such test");
            }
        }
    }
    verdict.close();
}

/// Whether `name` may be of a function, a type or a constant.
fn is_identifier(name: &str) -> bool {
    let is_part = |c: char| c.is_ascii_alphanumeric() || c == '_';
    let is_word = name.chars().all(is_part) && name.starts_with(|c: char| c.is_ascii_alphabetic());
    let is_placeholder = name.chars().all(|c| c.is_ascii_uppercase());
    is_word && !is_placeholder && name.contains(|c: char| c == '_' || c.is_ascii_uppercase())
}

#[test]
fn names_in_internals_and_recipes_are_in_the_code() {
    let mut code = String::new();
    let mut open = ["crates", "src", "shaders", "tests/suite"]
        .map(PathBuf::from)
        .to_vec();
    while let Some(path) = open.pop() {
        if path.is_dir() {
            let entries = fs::read_dir(&path).expect("a folder");
            open.extend(entries.map(|entry| entry.expect("an entry").path()));
        } else {
            code.push_str(&fs::read_to_string(&path).unwrap_or_default());
        }
    }
    let words: BTreeSet<_> = code
        .split(|c: char| !c.is_ascii_alphanumeric() && c != '_')
        .collect();
    let mut verdict = Verdict::on("names in internals and recipes");
    for page in book() {
        if !["/internals/", "/contributing/"]
            .iter()
            .any(|part| page.path.contains(part))
        {
            continue;
        }
        for quoted in page.quoted() {
            let name = quoted.trim_end_matches(['!', '(', ')']);
            let name = name.rsplit("::").next().unwrap_or_default();
            if is_identifier(name) && !name.contains("NAME") {
                let row = format!("{}: {quoted}", page.path);
                verdict.that(row, words.contains(name), || "is nowhere in the code");
            }
        }
    }
    verdict.close();
}
