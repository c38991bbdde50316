//! Modules beside each other form no circle, and the window's tiers import downwards only: a reader of a
//! module need not read its users first.

use super::{code, package_of, rust_files};
use crate::support::verdict::Verdict;
use std::{
    collections::{BTreeMap, BTreeSet},
    iter,
    path::{Path, PathBuf},
};

/// A module by its package and the names that lead to it from its root.
type Name = Vec<String>;

/// The module in a source; the root of the package for `lib.rs` and `main.rs`.
fn module_of(path: &Path) -> Name {
    let (package, below) = package_of(path);
    let below = below.with_extension("");
    let names = below.iter().map(|name| name.to_string_lossy().into_owned());
    let is_root = below == Path::new("lib") || below == Path::new("main");
    let names = names.take(if is_root { 0 } else { usize::MAX });
    iter::once(package).chain(names).collect()
}

/// Every path in the code that begins with `crate`, `super`, `self` or a module below, lists taken apart.
fn paths_in(code: &str) -> Vec<Vec<&str>> {
    let mut found = Vec::new();
    let statements = code.split(';').map(str::trim);
    for statement in statements {
        let is_use = |at: usize| {
            !statement[..at].ends_with(|c: char| c.is_alphanumeric() || c == '_' || c == ':')
        };
        let uses = statement.match_indices("use ");
        if let Some((at, _)) = uses.filter(|(at, _)| is_use(*at)).last() {
            take_apart(&statement[at + 4..], &[], &mut found);
        }
        for root in ["crate::", "super::", "self::"] {
            let starts = statement.match_indices(root).map(|(at, _)| at);
            for at in starts.filter(|&at| is_use(at)) {
                let is_path = |c: char| c.is_alphanumeric() || c == '_' || c == ':';
                let rest = &statement[at..];
                let length = rest.find(|c| !is_path(c)).unwrap_or(rest.len());
                found.push(
                    rest[..length]
                        .split("::")
                        .filter(|name| !name.is_empty())
                        .collect(),
                );
            }
        }
    }
    found
}

/// `a::{b, c::{d, e}}` into `a::b`, `a::c::d` and `a::c::e`.
fn take_apart<'a>(tree: &'a str, before: &[&'a str], found: &mut Vec<Vec<&'a str>>) {
    let (path, list) = match tree.split_once('{') {
        Some((path, list)) => (path, Some(list)),
        None => (tree, None),
    };
    let names = path.split("::").map(str::trim);
    let names = names.map(|name| name.split(" as ").next().unwrap_or(name));
    let mut whole = before.to_vec();
    whole.extend(names.filter(|name| !name.is_empty()));
    match list {
        None => found.push(whole),
        Some(list) => {
            for item in super::list_items(list) {
                take_apart(item.trim(), &whole, found);
            }
        }
    }
}

/// The module that a path in `here` leads to: the longest beginning of it that is one.
fn target(path: &[&str], here: &Name, modules: &BTreeSet<Name>) -> Option<Name> {
    let climbs = path.iter().take_while(|name| **name == "super").count();
    let start: &[String] = match path.first() {
        Some(&"crate") => &here[..1],
        Some(&"super") => here.get(..here.len().checked_sub(climbs)?)?,
        _ => here,
    };
    let rest = path.iter().skip(climbs.max(match path.first() {
        Some(&"crate" | &"self") => 1,
        _ => 0,
    }));
    let whole: Name = (start.iter().cloned())
        .chain(rest.map(|name| (*name).to_owned()))
        .collect();
    // Another crate's name follows no root and is no module below this one.
    let is_rooted = matches!(path.first(), Some(&"crate" | &"super" | &"self"));
    let least = if is_rooted { 1 } else { here.len() + 1 };
    (least..=whole.len())
        .rev()
        .map(|length| whole[..length].to_vec())
        .find(|name| modules.contains(name))
}

/// For each folder who uses whom of the modules in it, with all that is below them.
fn uses(files: &[(PathBuf, String)]) -> BTreeMap<String, BTreeMap<String, BTreeSet<String>>> {
    let modules: BTreeSet<Name> = files.iter().map(|(path, _)| module_of(path)).collect();
    let mut uses: BTreeMap<_, BTreeMap<_, BTreeSet<_>>> = BTreeMap::new();
    for (path, text) in files {
        let here = module_of(path);
        let code = code(text);
        for path in paths_in(&code) {
            let Some(there) = target(&path, &here, &modules) else {
                continue;
            };
            let shared = here.iter().zip(&there).take_while(|(a, b)| a == b).count();
            if let (Some(user), Some(used)) = (here.get(shared), there.get(shared)) {
                let folder = uses.entry(here[..shared].join("/")).or_default();
                folder.entry(user.clone()).or_default().insert(used.clone());
            }
        }
    }
    uses
}

/// Whether uses lead from one module to another.
fn leads(uses: &BTreeMap<String, BTreeSet<String>>, from: &str, to: &str) -> bool {
    let (mut open, mut seen) = (vec![from], BTreeSet::new());
    while let Some(module) = open.pop() {
        for used in uses.get(module).into_iter().flatten() {
            if used == to {
                return true;
            }
            if seen.insert(used.as_str()) {
                open.push(used);
            }
        }
    }
    false
}

#[test]
fn modules_beside_each_other_form_no_circle() {
    let mut verdict = Verdict::on("circles");
    for (folder, uses) in uses(&rust_files()) {
        for (user, used) in &uses {
            for used in used {
                let is_circle = leads(&uses, used, user);
                verdict.that(format!("{folder}/{user}"), !is_circle, || {
                    format!("uses {used}, which uses it in turn")
                });
            }
        }
    }
    verdict.close();
}

/// The tiers of the window, each of which may use those after it. The bench stands beside the window.
const WINDOW_TIERS: [&str; 7] = [
    "window", "bench", "ui", "actions", "state", "model", "worker",
];

/// Imports in `crates/viewer/src` that do not lead down the tiers.
fn upward_imports(files: &[(PathBuf, String)]) -> Vec<(String, String)> {
    let tier = |name: &str| WINDOW_TIERS.iter().position(|tier| *tier == name);
    let uses = uses(files).remove("viewer").unwrap_or_default();
    let pairs = uses.into_iter().flat_map(|(user, used)| {
        let pairs = used.into_iter().map(move |used| (user.clone(), used));
        pairs.collect::<Vec<_>>()
    });
    let is_upward = |user: &str, used: &str| user != used && tier(user) >= tier(used);
    pairs.filter(|(user, used)| is_upward(user, used)).collect()
}

#[test]
fn the_windows_tiers_import_downwards_only() {
    let mut files = rust_files();
    assert_eq!(upward_imports(&files), []);
    let folders: BTreeSet<_> = (files.iter())
        .filter_map(|(path, _)| path.strip_prefix("crates/viewer/src").ok())
        .filter_map(|path| path.with_extension("").iter().next().map(|n| n.to_owned()))
        .filter(|name| name != "lib")
        .collect();
    let tiers: BTreeSet<_> = WINDOW_TIERS.iter().map(|tier| (*tier).into()).collect();
    assert_eq!(folders, tiers, "a folder that is no tier");
    // The test sees an import that leads up.
    let model = files
        .iter_mut()
        .find(|(path, _)| path.ends_with("viewer/src/model/document.rs"));
    let (_, text) = model.expect("a file of the model");
    text.push_str("use crate::ui::panels;");
    assert_eq!(upward_imports(&files), [("model".into(), "ui".into())]);
}

#[test]
fn paths_are_followed_to_their_modules() {
    let modules: BTreeSet<Name> = ["x", "x/a", "x/a/b", "x/a/b/c", "x/d"]
        .map(|name| name.split('/').map(str::to_owned).collect())
        .into();
    let here: Name = ["x", "a", "b"].map(str::to_owned).into();
    let found = |code: &str| {
        let targets = paths_in(code).into_iter();
        let targets = targets.filter_map(|path| target(&path, &here, &modules));
        targets
            .map(|name| name.join("/"))
            .collect::<Vec<_>>()
            .join(" ")
    };
    assert_eq!(found("use crate::d::Thing;"), "x/d x/d");
    assert_eq!(found("use super::super::d::{self, Thing};"), "x/d x/d x/d");
    assert_eq!(found("use c::{One, Two};"), "x/a/b/c x/a/b/c");
    assert_eq!(found("fn f() { super::b::g() }"), "x/a/b");
    assert_eq!(found("use std::fmt;"), "");
}
