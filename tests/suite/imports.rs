//! Who may import whom. A row that the tables do not allow is a question of design, not a formality.

mod circles;

use crate::support::verdict::Verdict;
use std::{
    collections::BTreeSet,
    fs,
    path::{Path, PathBuf},
};

/// Packages that each package may use.
const PACKAGES: &[(&str, &[&str])] = &[
    ("scene", &[]),
    ("shaders", &[]),
    ("link", &[]),
    ("notices", &[]),
    ("shader-test", &[]),
    ("io", &["scene"]),
    ("render", &["scene", "shaders"]),
    ("app", &["io", "render", "scene"]),
    ("cli", &["app", "io", "render", "scene"]),
    ("viewer", &["app", "io", "render", "scene"]),
    ("python", &["app", "cli", "io", "render", "scene"]),
    ("", &["cli", "io", "render", "scene", "viewer"]),
];

/// Packages, their modules, and the modules that these may use; "*" is everything. A package that is named for a module is
/// that module, but for the others here.
const MODULES: &[(&str, &str, &[&str])] = &[
    ("scene", "scene", &["threads"]),
    ("scene", "clock", &[]),
    ("scene", "random", &[]),
    ("scene", "text", &[]),
    ("scene", "bytes", &[]),
    ("scene", "image", &[]),
    ("shaders", "shaders", &[]),
    ("link", "link", &[]),
    ("notices", "notices", &[]),
    ("shader-test", "shader-test", &[]),
    ("render", "layout", &[]),
    ("render", "gpu", &["bytes", "clock", "shaders"]),
    ("scene", "threads", &[]),
    ("render", "bvh", &["threads"]),
    (
        "io",
        "import",
        &["bytes", "random", "scene", "text", "threads"],
    ),
    ("io", "export", &["import", "scene", "text"]),
    ("render", "pack", &["clock", "scene", "bvh", "layout"]),
    (
        "render",
        "render",
        &[
            "bytes", "clock", "random", "scene", "threads", "pack", "layout", "gpu", "image",
        ],
    ),
    ("io", "output", &["bytes", "image", "text"]),
    ("io", "io", &[]),
    (
        "app",
        "app",
        &[
            "bytes", "clock", "scene", "image", "gpu", "import", "export", "pack", "render",
            "output", "text",
        ],
    ),
    ("cli", "cli", ABOVE_APP),
    ("viewer", "viewer", ABOVE_APP),
    ("python", "python", &["*"]),
    ("", "main", &["*"]),
    ("", "lib", &["*"]),
    ("", "picture", &["*"]),
];

/// Modules that the command line and the window may use: everything but each other.
const ABOVE_APP: &[&str] = &[
    "app", "bvh", "bytes", "clock", "random", "scene", "image", "layout", "gpu", "import",
    "export", "pack", "render", "output", "text", "threads",
];

/// Tiers that each tier of `shaders/` may import.
const TIERS: &[(&str, &[&str])] = &[
    ("types", &[]),
    ("lib", &["lib", "types"]),
    ("bindings", &["types"]),
    ("scene", &["lib", "types", "bindings", "scene"]),
    ("kernels", &["lib", "types", "bindings", "scene"]),
];

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

/// All sources in Rust of the library and the program.
fn rust_files() -> Vec<(PathBuf, String)> {
    let folders = ["crates", "shaders/src", "src"].into_iter();
    let is_source = |path: &Path| path.iter().any(|name| name == "src");
    let files = folders.flat_map(|folder| files(folder, "rs"));
    files.filter(|(path, _)| is_source(path)).collect()
}

/// The package of a source, and its path below `src/` there. The root has no name.
fn package_of(path: &Path) -> (String, PathBuf) {
    let names: Vec<_> = path.iter().map(|name| name.to_string_lossy()).collect();
    let at = (names.iter().position(|name| name == "src")).expect("a source is below src");
    let package = at.checked_sub(1).map_or("", |before| &*names[before]);
    (
        package.to_owned(),
        names[at + 1..].iter().map(|name| &**name).collect(),
    )
}

/// The module of a name in a package: the one of this name, else the one that the package is named for.
fn module_named(package: &str, name: &str) -> String {
    let is_module = (MODULES.iter()).any(|(known, module, _)| (*known, *module) == (package, name));
    if is_module { name } else { package }.to_owned()
}

/// The module of a source.
fn module_of(path: &Path) -> String {
    let (package, below) = package_of(path);
    let first = Path::new(below.iter().next().expect("a file"));
    let first = first.file_stem().unwrap_or_default().to_string_lossy();
    match (&*package, &*first) {
        (package, "lib") if !package.is_empty() => package.to_owned(),
        (package, first) => module_named(package, first),
    }
}

/// The tier of a shader: the first folder, or the file's own name.
fn tier_of(path: &Path) -> String {
    let first = path.iter().nth(1).expect("a file below the root");
    let stem = Path::new(first).file_stem().unwrap_or_default();
    stem.to_string_lossy().into_owned()
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

/// Checks who uses whom: rows are a file, its part, and the parts that it uses.
fn check_directions(
    subject: &str,
    rows: impl Iterator<Item = (PathBuf, String, BTreeSet<String>)>,
    table: &[(&str, &[&str])],
) {
    let mut verdict = Verdict::on(format!("imports of {subject}"));
    for (path, part, uses) in rows {
        let allowed = table.iter().find(|(name, _)| *name == part);
        verdict.that(path.display(), allowed.is_some(), || {
            format!("the table has no {part}")
        });
        let Some((_, allowed)) = allowed else {
            continue;
        };
        for used in uses {
            let is_allowed =
                used == part || allowed.contains(&"*") || allowed.contains(&used.as_str());
            verdict.that(path.display(), is_allowed, || {
                format!("{part} may not use {used}")
            });
        }
    }
    verdict.close();
}

/// Cargo refuses other uses.
#[test]
fn packages_use_only_what_they_may() {
    let mut verdict = Verdict::on("packages");
    for (package, allowed) in PACKAGES {
        let folder = match *package {
            "" => String::new(),
            "shaders" => "shaders/".to_owned(),
            package => format!("crates/{package}/"),
        };
        let manifest = fs::read_to_string(folder + "Cargo.toml").expect("a manifest");
        let manifest: toml::Table = manifest.parse().expect("TOML");
        let used = manifest["dependencies"].as_table().expect("a table");
        let used: Vec<_> = used
            .keys()
            .filter_map(|name| name.strip_prefix("glimray-"))
            .collect();
        verdict.that(package, used == *allowed, || format!("{used:?}"));
    }
    let folders = fs::read_dir("crates").expect("a folder");
    for name in folders.map(|entry| entry.expect("an entry").file_name()) {
        let name = name.to_string_lossy();
        let is_known = PACKAGES.iter().any(|(package, _)| *package == name);
        verdict.that(&name, is_known, || "is not in the table");
    }
    verdict.close();
}

#[test]
fn modules_use_only_what_they_may() {
    let rows = rust_files().into_iter().map(|(path, text)| {
        let code = code(&text);
        let own = package_of(&path).0;
        let mut uses = BTreeSet::new();
        for (package, _) in PACKAGES {
            let (root, package) = match *package {
                "" => ("crate".to_owned(), own.as_str()),
                package => (format!("glimray_{}", package.replace('-', "_")), package),
            };
            let names = names_after(&code, &root).into_iter();
            uses.extend(names.map(|name| module_named(package, &name)));
        }
        let part = module_of(&path);
        (path, part, uses)
    });
    let table: Vec<_> = MODULES
        .iter()
        .map(|(_, name, allowed)| (*name, *allowed))
        .collect();
    check_directions("sources", rows, &table);
}

#[test]
fn shaders_import_only_what_they_may() {
    let rows = files("shaders", "wesl").into_iter().map(|(path, text)| {
        let part = tier_of(&path);
        (path, part, names_after(&code(&text), "package"))
    });
    check_directions("shaders", rows, TIERS);
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
    let mut verdict = Verdict::on("sources without the program");
    let of_program = |path: &Path| {
        ["app", "cli", "link", "main", "notices", "python", "viewer"].contains(&&*module_of(path))
    };
    for (path, text) in rust_files() {
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
        "thread::",
        "std::time::Instant",
        "std::time::SystemTime",
        "tempfile",
    ];
    // A browser has the clock of these, and the files that ask first.
    const PARTS: &[&str] = &[
        "app", "cli", "link", "main", "notices", "python", "viewer", "output", "clock",
    ];
    const FILES: &[&str] = &[
        "crates/io/src/import/folder.rs",
        "crates/render/src/gpu/blocking.rs",
        "crates/render/src/gpu/early.rs",
        // No thread of a browser waits there.
        "crates/render/src/gpu/gate.rs",
        "crates/render/src/gpu/shader.rs",
        "crates/scene/src/threads.rs",
        "shaders/src/files.rs",
    ];
    check_words("sources for browsers", WORDS, PARTS, FILES);
}

/// Checks that only these modules and files have any of these words in their code.
#[track_caller]
fn check_words(name: &str, words: &[&str], modules: &[&str], files: &[&str]) {
    let mut verdict = Verdict::on(name);
    for (path, text) in rust_files() {
        let is_allowed = modules.contains(&&*module_of(&path));
        if is_allowed || files.iter().any(|file| path == Path::new(file)) {
            continue;
        }
        let code = code(&text);
        let word = words.iter().find(|word| code.contains(**word));
        verdict.that(path.display(), word.is_none(), || format!("has {word:?}"));
    }
    verdict.close();
}

/// A browser has one thread, which may not wait for the device.
#[test]
fn only_a_few_files_of_the_library_wait_for_the_device() {
    const WORDS: &[&str] = &[
        "PollType::Wait",
        "PollType::wait",
        "block_on",
        "Condvar",
        "wait(",
    ];
    const FILES: &[&str] = &[
        "crates/render/src/blocking.rs",
        "crates/render/src/gpu/blocking.rs",
        // This waits for the thread of a window, not for the device.
        "crates/render/src/gpu/gate.rs",
        // A browser does without it.
        "crates/render/src/gpu/lanes.rs",
        "src/picture.rs",
    ];
    const PROGRAM: &[&str] = &[
        "app",
        "cli",
        "link",
        "main",
        "python",
        "shader-test",
        "viewer",
    ];
    check_words("sources of the library", WORDS, PROGRAM, FILES);
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
    let mut verdict = Verdict::on("sources");
    for (path, text) in rust_files() {
        let (package, below) = package_of(&path);
        // The rest of a package may.
        if package == module_of(&path) {
            continue;
        }
        let depth = below.iter().count();
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
