//! Who may import whom, and how long a file may grow. What this table does not allow is a design
//! question, not a formality.

mod circles;

use crate::support::verdict::Verdict;
use std::{
    collections::BTreeSet,
    fs,
    path::{Path, PathBuf},
};

/// Modules that each module of `src/` may use; "*" is everything.
const MODULES: &[(&str, &[&str])] = &[
    ("scene", &["threads"]),
    ("clock", &[]),
    ("random", &[]),
    ("text", &[]),
    ("bytes", &[]),
    ("image", &[]),
    ("layout", &[]),
    ("gpu", &["bytes"]),
    ("threads", &[]),
    ("bvh", &["threads"]),
    ("import", &["bytes", "random", "scene", "text", "threads"]),
    ("export", &["scene", "text"]),
    ("pack", &["clock", "scene", "bvh", "layout"]),
    (
        "render",
        &[
            "bytes", "clock", "random", "scene", "threads", "pack", "layout", "gpu", "image",
        ],
    ),
    ("output", &["bytes", "image", "text"]),
    (
        "app",
        &[
            "bytes", "clock", "scene", "image", "gpu", "import", "export", "pack", "render",
            "output", "text",
        ],
    ),
    ("cli", ABOVE_APP),
    ("viewer", ABOVE_APP),
    ("main", &["*"]),
    ("lib", &["*"]),
];

/// Modules that the command line and the window may use: everything but each other.
const ABOVE_APP: &[&str] = &[
    "app", "bvh", "bytes", "clock", "random", "scene", "image", "layout", "gpu", "import",
    "export", "pack", "render", "output", "text",
];

/// Tiers that each tier of `shaders/` may import.
const TIERS: &[(&str, &[&str])] = &[
    ("types", &[]),
    ("lib", &["lib", "types"]),
    ("bindings", &["types"]),
    ("scene", &["lib", "types", "bindings", "scene"]),
    ("kernels", &["lib", "types", "bindings", "scene"]),
];

const MOST_SHADER_LINES: usize = 250;
const MOST_RUST_LINES: usize = 450;
/// The two files that host and shader share are lists, and stay in one piece.
const MOST_LIST_LINES: [(&str, usize); 2] = [("types.wesl", 600), ("layout.rs", 650)];

/// All files below a folder with this extension, and what is in them.
fn files(folder: &str, extension: &str) -> Vec<(PathBuf, String)> {
    let mut open = vec![PathBuf::from(folder)];
    let mut found = Vec::new();
    while let Some(path) = open.pop() {
        if path.is_dir() {
            open.extend(
                fs::read_dir(&path)
                    .expect("a folder")
                    .map(|entry| entry.expect("an entry").path()),
            );
        } else if path.extension().is_some_and(|found| found == extension) {
            let text = fs::read_to_string(&path).expect("a text file");
            found.push((path, text));
        }
    }
    assert!(!found.is_empty(), "no .{extension} files in {folder}");
    found
}

/// The module or tier of a file: the first folder below the root, or the file's own name.
fn part_of(path: &Path) -> String {
    let first = path.iter().nth(1).expect("a file below the root");
    Path::new(first)
        .file_stem()
        .unwrap_or_default()
        .to_string_lossy()
        .into_owned()
}

/// The text without its comments.
fn code(text: &str) -> String {
    text.lines()
        .map(|line| line.split("//").next().unwrap_or_default())
        .collect::<Vec<_>>()
        .join("\n")
}

/// The names that follow `root::` anywhere in the code: `x` in `root::x::y`, and `x` and `y` in
/// `root::{x::{a, b}, y}`.
fn names_after(code: &str, root: &str) -> BTreeSet<String> {
    let is_part = |c: char| c.is_alphanumeric() || c == '_';
    let name = |text: &str| {
        text.trim_start()
            .chars()
            .take_while(|c| is_part(*c))
            .collect::<String>()
    };
    let mut found = BTreeSet::new();
    for (at, _) in code.match_indices(&format!("{root}::")) {
        if code[..at].ends_with(is_part) {
            continue;
        }
        let rest = &code[at + root.len() + 2..];
        match rest.strip_prefix('{') {
            Some(list) => found.extend(list_items(list).into_iter().map(name)),
            None => _ = found.insert(name(rest)),
        }
    }
    found.remove("");
    found
}

/// The items of a list up to its closing brace, lists within them left whole.
fn list_items(list: &str) -> Vec<&str> {
    let (mut depth, mut start, mut items) = (0, 0, Vec::new());
    for (at, c) in list.char_indices() {
        match c {
            '{' => depth += 1,
            '}' if depth > 0 => depth -= 1,
            ',' if depth == 0 => {
                items.push(&list[start..at]);
                start = at + 1;
            }
            '}' => {
                items.push(&list[start..at]);
                break;
            }
            _ => {}
        }
    }
    items
}

fn check_directions(folder: &str, extension: &str, root: &str, table: &[(&str, &[&str])]) {
    let mut verdict = Verdict::on(format!("imports of {folder}"));
    for (path, text) in files(folder, extension) {
        let part = part_of(&path);
        let allowed = table.iter().find(|(name, _)| *name == part);
        verdict.that(path.display(), allowed.is_some(), || {
            format!("the table has no {part}")
        });
        let Some((_, allowed)) = allowed else {
            continue;
        };
        for used in names_after(&code(&text), root) {
            let is_allowed =
                used == part || allowed.contains(&"*") || allowed.contains(&used.as_str());
            verdict.that(path.display(), is_allowed, || {
                format!("{part} may not use {used}")
            });
        }
    }
    verdict.close();
}

#[test]
fn modules_use_only_what_they_may() {
    check_directions("src", "rs", "crate", MODULES);
}

#[test]
fn shaders_import_only_what_they_may() {
    check_directions("shaders", "wesl", "package", TIERS);
}

/// Terms of the program: crates, and words of its command line and its end.
const OF_THE_PROGRAM: &[&str] = &[
    "clap::",
    "clap_complete::",
    "indicatif::",
    "nv_flip::",
    "signal_hook::",
    "terminal_size::",
    "unicode_width::",
    "exit_code",
    "ExitCode",
    "process::exit",
    "print!(",
    "println!(",
];

/// The first `--word` in the code, which can only be in a string.
fn flag(code: &str) -> Option<&str> {
    let is_of_flag = |c: char| c == '-' || c.is_ascii_alphanumeric();
    code.match_indices("--").find_map(|(at, _)| {
        let rest = &code[at..];
        let is_flag = rest[2..].starts_with(|c: char| c.is_ascii_lowercase());
        is_flag.then(|| rest.split(|c| !is_of_flag(c)).next().unwrap_or(rest))
    })
}

/// Other programs use the library too, and have other flags or none.
#[test]
fn only_the_program_knows_flags_exit_codes_and_the_terminal() {
    let mut verdict = Verdict::on("src without the program");
    let of_program = |path: &Path| ["app", "cli", "main", "viewer"].contains(&&*part_of(path));
    for (path, text) in files("src", "rs") {
        if of_program(&path) {
            continue;
        }
        let code = code(&text);
        let word = OF_THE_PROGRAM.iter().find(|word| code.contains(**word));
        verdict.that(path.display(), word.is_none(), || format!("has {word:?}"));
        let flag = flag(&code);
        verdict.that(path.display(), flag.is_none(), || format!("names {flag:?}"));
    }
    verdict.close();
    let found = |text: &str| flag(&code(text)).map(str::to_owned);
    assert_eq!(
        found("f(\"Use --no-bvh, or\")").as_deref(),
        Some("--no-bvh")
    );
    assert_eq!(found("x - -y; f(\"-- a\") // --no-bvh"), None);
}

/// A browser has no files, no threads and another clock.
#[test]
fn only_a_few_files_of_the_library_need_more_than_a_browser_has() {
    const WORDS: &[&str] = &[
        "std::fs",
        "fs::{",
        "std::thread",
        "std::time::Instant",
        "std::time::SystemTime",
        "tempfile",
    ];
    // Of these a browser has the clock, and the one file that asks first.
    const PARTS: &[&str] = &["app", "cli", "main", "viewer", "output", "clock"];
    const FILES: &[&str] = &["src/import/folder.rs", "src/gpu/shader.rs"];
    let mut verdict = Verdict::on("src for browsers");
    for (path, text) in files("src", "rs") {
        let is_allowed = PARTS.contains(&&*part_of(&path));
        if is_allowed || FILES.iter().any(|file| path == Path::new(file)) {
            continue;
        }
        let code = code(&text);
        let word = WORDS.iter().find(|word| code.contains(**word));
        verdict.that(path.display(), word.is_none(), || format!("has {word:?}"));
    }
    verdict.close();
}

/// Kernels are entry points, and nothing imports one; not even another kernel.
#[test]
fn kernels_do_not_import_each_other() {
    let mut verdict = Verdict::on("kernels");
    for (path, text) in files("shaders", "wesl") {
        let imports = names_after(&code(&text), "package");
        verdict.that(
            path.display(),
            !imports.contains("kernels"),
            || "imports a kernel",
        );
    }
    verdict.close();
}

/// No way round the table: a path that climbs to the root of the crate.
#[test]
fn no_module_climbs_to_the_root() {
    let mut verdict = Verdict::on("src");
    for (path, text) in files("src", "rs") {
        let depth = path.iter().count() - 1;
        let code = code(&text);
        let climbs = code.contains(&vec!["super"; depth].join("::")) && !code.contains("mod tests");
        verdict.that(path.display(), !climbs, || "reaches the root by super::");
    }
    verdict.close();
}

/// That is what makes the library testable on its own.
#[test]
fn the_shader_library_names_no_binding_and_keeps_no_state() {
    let mut verdict = Verdict::on("shaders/lib");
    for (path, text) in files("shaders/lib", "wesl") {
        let code = code(&text);
        for word in [
            "@group",
            "@binding",
            "@id",
            "override ",
            "var<private>",
            "var<storage",
            "var<uniform",
            "var<workgroup",
        ] {
            verdict.that(path.display(), !code.contains(word), || {
                format!("contains {word}")
            });
        }
    }
    verdict.close();
}

#[test]
fn files_stay_short() {
    let mut verdict = Verdict::on("lines");
    for (folder, extension, most) in [
        ("shaders", "wesl", MOST_SHADER_LINES),
        ("src", "rs", MOST_RUST_LINES),
    ] {
        for (path, text) in files(folder, extension) {
            let lines = text.lines().count();
            let list = MOST_LIST_LINES
                .iter()
                .find(|(name, _)| path.ends_with(name));
            let most = list.map_or(most, |(_, most)| *most);
            verdict.that(path.display(), lines <= most, || {
                format!("{lines} lines, {most} allowed")
            });
        }
    }
    verdict.close();
}

#[test]
fn paths_are_found_in_every_form() {
    let found = |code: &str| {
        names_after(code, "crate")
            .into_iter()
            .collect::<Vec<_>>()
            .join(" ")
    };
    assert_eq!(found("use crate::scene::Mesh;"), "scene");
    assert_eq!(
        found("use crate::{gpu::{Gpu, GpuError},\n layout, pack::{self}};"),
        "gpu layout pack"
    );
    assert_eq!(
        found("let x = crate::image::Image::default(); my_crate::y"),
        "image"
    );
    assert_eq!(found(&code("/// as [`crate::app`]\nfn f() {}")), "");
}
