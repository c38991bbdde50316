//! Recipes and the map of the code name items with their files, as in `crates/scene/src/shape.rs: CanonicalShape`, and the
//! files have them.

use super::pages::manual;
use crate::support::verdict::Verdict;
use std::fs;

/// Pages whose quotations are read.
const PAGES: [&str; 2] = ["ARCHITECTURE.md", "docs/src/contributing/"];

/// The file and the items of a quotation of the form `path: item, item`; `None` for other forms.
fn file_and_items(quoted: &str) -> Option<(&str, Vec<&str>)> {
    let (path, items) = quoted.split_once(':')?;
    let is_file = path.contains('/') && !path.contains(char::is_whitespace);
    let is_list = is_file && items.starts_with(char::is_whitespace);
    is_list.then(|| (path, items.split(',').map(str::trim).collect()))
}

/// Whether `item` is a whole word of the file.
fn has(text: &str, item: &str) -> bool {
    text.split(|c: char| !c.is_alphanumeric() && c != '_')
        .any(|word| word == item)
}

#[test]
fn items_are_told_from_other_quotations() {
    let rows = [
        ("src/a.rs: Item", Some(("src/a.rs", vec!["Item"]))),
        (
            "a/b.wesl: one,\n   TWO",
            Some(("a/b.wesl", vec!["one", "TWO"])),
        ),
        ("src/a.rs", None),
        ("module::item", None),
        ("src/a.rs::item", None),
        ("error: src/a.rs: item", None),
    ];
    for (quoted, expected) in rows {
        assert_eq!(file_and_items(quoted), expected, "{quoted}");
    }
    assert!(has("pub fn one(two: u32)", "one"));
    assert!(!has("pub fn one_more(two: u32)", "one"));
}

#[test]
fn items_are_in_their_files() {
    let mut verdict = Verdict::on("items of pages");
    let is_read = |path: &str| PAGES.iter().any(|start| path.starts_with(start));
    for page in manual().into_iter().filter(|page| is_read(&page.path)) {
        for quoted in page.quoted() {
            let Some((path, items)) = file_and_items(&quoted) else {
                continue;
            };
            let text = fs::read_to_string(path);
            for item in items {
                let is_there = text.as_ref().is_ok_and(|text| has(text, item));
                let row = format!("{}: {path}: {item}", page.path);
                verdict.that(row, is_there, || "is not there");
            }
        }
    }
    verdict.close();
}
