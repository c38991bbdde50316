//! Products of the repository: the package, the hand-in, the manual pages; and what the files for
//! building them say of each other.

// The hand-in is made by `make`, and releases by scripts.
#[cfg(unix)]
mod hand_in;
#[cfg(unix)]
mod release;

use crate::support::program::Workspace;
use crate::support::verdict::Verdict;
use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::{Component, Path, PathBuf};
use std::process::{Command, Output};

fn read(path: impl AsRef<Path>) -> String {
    let path = path.as_ref();
    fs::read_to_string(path).unwrap_or_else(|error| panic!("{}: {error}", path.display()))
}

fn manifest() -> toml::Table {
    read("Cargo.toml").parse().expect("TOML")
}

/// Files that tell people and machines what to run.
fn instructions() -> Vec<PathBuf> {
    let names = ["README.md", "CONTRIBUTING.md", "Dockerfile"];
    let mut found: Vec<_> = names.map(PathBuf::from).into();
    let mut open = vec![PathBuf::from("docs"), PathBuf::from(".github")];
    while let Some(path) = open.pop() {
        if path.is_dir() {
            let entries = fs::read_dir(&path).expect("a folder");
            open.extend(entries.map(|entry| entry.expect("an entry").path()));
        } else if path.extension().is_some_and(|e| e == "md" || e == "yml") {
            found.push(path);
        }
    }
    found
}

/// The code in `path`: the whole file, but in pages the blocks and quotations, each on lines of its own.
fn code(path: &Path) -> String {
    let text = read(path);
    if path.extension().is_none_or(|extension| extension != "md") {
        return text;
    }
    let parts = text.split("```").enumerate();
    let parts = parts.map(|(index, part)| match index % 2 {
        0 => part
            .split('`')
            .skip(1)
            .step_by(2)
            .collect::<Vec<_>>()
            .join("\n"),
        _ => part.to_owned(),
    });
    parts.collect::<Vec<_>>().join("\n")
}

/// The words after each `program` that stands where a command begins.
fn commands<'a>(code: &'a str, program: &str) -> Vec<Vec<&'a str>> {
    let starts = code.match_indices(program).filter(|(at, _)| {
        let line = code[..*at].rsplit('\n').next().unwrap_or_default();
        let line = line.trim_start_matches([' ', '\t', '-']).trim_end();
        ["", "run:", "command:", "RUN"].contains(&line) || line.ends_with("&&")
    });
    let ends = ['\n', '#', ';', '|', '&'];
    let rest = starts.map(|(at, _)| code[at + program.len()..].split(ends).next());
    rest.map(|words| words.unwrap_or_default().split_whitespace().collect())
        .collect()
}

#[test]
fn commands_are_found_where_they_stand() {
    let text = "    make b NAME=x  # c\n      - run: make d && make e\nRUN make f; we make g.\n";
    let found: Vec<_> = commands(text, "make ").concat();
    assert_eq!(found, ["b", "NAME=x", "d", "e", "f"]);
}

#[test]
fn every_make_target_that_is_named_is_in_the_makefile() {
    let makefile = read("Makefile");
    let (_, phony) = makefile.split_once(".PHONY:").expect("the targets");
    let targets: BTreeSet<_> = (phony.lines().next().expect("a line"))
        .split_whitespace()
        .collect();
    let mut verdict = Verdict::on("targets");
    for target in &targets {
        let has_recipe = makefile.contains(&format!("\n{target}:"));
        verdict.that(target, has_recipe, || "has no recipe");
    }
    for path in instructions() {
        for words in commands(&code(&path), "make ") {
            let target = words.first().copied().unwrap_or_default();
            let name = format!("{}: make {target}", path.display());
            verdict.that(name, targets.contains(target), || "there is no such target");
        }
    }
    verdict.close();
}

#[test]
fn every_profile_and_feature_that_is_named_is_in_the_manifest() {
    let manifest = manifest();
    let features = manifest["features"].as_table().expect("features");
    let profiles = manifest["profile"].as_table().expect("profiles");
    let mut verdict = Verdict::on("cargo's arguments");
    for path in instructions() {
        for words in commands(&code(&path), "cargo ") {
            let name = |word| format!("{}: {word}", path.display());
            for pair in words.windows(2) {
                match pair {
                    ["--profile", profile] => {
                        let is_there = profiles.contains_key(*profile);
                        verdict.that(name(*profile), is_there, || "there is no such profile");
                    }
                    ["--features", list] if !list.contains('"') => {
                        for feature in list.split(',') {
                            let is_there = features.contains_key(feature);
                            verdict.that(name(feature), is_there, || "there is no such feature");
                        }
                    }
                    _ => (),
                }
            }
        }
    }
    verdict.close();
}

/// `feature` with all features that it switches on.
fn implied(features: &toml::Table, feature: &str) -> BTreeSet<String> {
    let list = features[feature].as_array().expect("a list");
    let names = list.iter().filter_map(toml::Value::as_str);
    let names = names.filter(|name| features.contains_key(*name));
    let mut found: BTreeSet<_> = names.flat_map(|name| implied(features, name)).collect();
    found.insert(feature.to_owned());
    found
}

#[test]
fn each_feature_is_compiled_without_each_other_one() {
    let manifest = manifest();
    let features = manifest["features"].as_table().expect("features");
    let makefile = read("Makefile");
    let (_, list) = makefile.split_once("\nFEATURE_SETS := ").expect("sets");
    let sets = list.lines().next().expect("a line").split(' ');
    let sets = sets.map(|set| set.split(',').flat_map(|name| implied(features, name)));
    let sets: Vec<BTreeSet<_>> = sets.map(Iterator::collect).collect();
    let mut verdict = Verdict::on("features");
    // `link` is a feature of the build script alone.
    let names = || (features.keys()).filter(|name| !["default", "link"].contains(&name.as_str()));
    for one in names() {
        for other in names().filter(|other| !implied(features, one).contains(*other)) {
            let is_apart = |set: &BTreeSet<String>| set.contains(one) && !set.contains(other);
            verdict.that(
                format!("{one} without {other}"),
                sets.iter().any(is_apart),
                || "is in no set of the Makefile's FEATURE_SETS",
            );
        }
    }
    verdict.close();
}

#[test]
fn the_container_has_every_usual_feature_but_the_window_and_opengl() {
    let manifest = manifest();
    let features = manifest["features"].as_table().expect("features");
    let dockerfile = read("Dockerfile");
    let builds = commands(&dockerfile, "cargo ");
    let lists = builds.iter().flat_map(|words| words.windows(2));
    let lists: Vec<_> = lists.filter(|pair| pair[0] == "--features").collect();
    let [[_, list]] = lists[..] else {
        panic!("one list of features: {builds:?}");
    };
    assert!(
        builds
            .iter()
            .any(|words| words.contains(&"--no-default-features"))
    );
    let found: BTreeSet<_> = (list.split(','))
        .flat_map(|name| implied(features, name))
        .collect();
    let mut usual = implied(features, "default");
    for absent in ["default", "gl", "viewer"] {
        assert!(usual.remove(absent), "{absent}");
    }
    assert_eq!(found, usual);
}

/// Rust is named by the same version everywhere.
#[test]
fn containers_and_workflows_use_the_rust_of_the_manifest() {
    let manifest = manifest();
    let version = manifest["workspace"]["package"]["rust-version"]
        .as_str()
        .expect("text");
    for (path, begin) in [
        ("Dockerfile", "FROM rust:"),
        (".github/workflows/ci.yml", "rustup toolchain install "),
        (".github/workflows/ci.yml", "rustup default "),
        (".github/workflows/release.yml", "rustup toolchain install "),
        (".github/workflows/release.yml", "rustup default "),
    ] {
        let text = read(path);
        let found: Vec<_> = text.split(begin).skip(1).collect();
        assert!(!found.is_empty(), "{path}: {begin}");
        for rest in found {
            let is_end = |c: char| c.is_whitespace() || c == '-';
            assert_eq!(rest.split(is_end).next(), Some(version), "{path}: {begin}");
        }
    }
}

/// Tests and CI have a profile of their own.
#[test]
fn what_users_install_is_optimised_as_a_whole() {
    let manifest = manifest();
    let release = manifest["profile"]["release"].as_table().expect("a table");
    let is_full = |profile: &toml::Table| {
        let level = profile.get("opt-level").and_then(toml::Value::as_integer);
        level.is_none_or(|level| level == 3)
    };
    assert!(is_full(release), "{release}");
    if let Some(packages) = release.get("package").and_then(toml::Value::as_table) {
        for (name, profile) in packages {
            let profile = profile.as_table().expect("a table");
            assert!(is_full(profile), "{name}: {profile}");
        }
    }
    assert_eq!(release["lto"].as_str(), Some("fat"));
    assert_eq!(release["strip"].as_bool(), Some(true));
}

/// Tests run with the checks that the installed program has: the profiles differ only in how much they optimise.
#[test]
fn the_profile_of_tests_has_the_checks_of_the_program() {
    let manifest = manifest();
    let profile = &manifest["profile"]["ci"];
    for check in ["debug-assertions", "overflow-checks"] {
        assert_eq!(profile[check].as_bool(), Some(false), "{check}");
    }
}

#[test]
fn the_changelog_has_the_version_of_the_manifest() {
    let manifest = manifest();
    let version = manifest["workspace"]["package"]["version"]
        .as_str()
        .expect("text");
    let changelog = read("CHANGELOG.md");
    let newest = changelog.lines().find_map(|line| line.strip_prefix("## "));
    let newest = newest.and_then(|line| line.split(' ').next());
    assert_eq!(newest, Some(version));
}

/// The commands that the help of `command` lists; that of the program for none.
fn commands_below(workspace: &Workspace, command: &str) -> Vec<String> {
    let help = workspace.run(&format!("{command} --help")).expect(0);
    let Some((_, list)) = help.text().split_once("Commands:\n") else {
        return Vec::new();
    };
    let (list, _) = list.split_once("\n\n").expect("their end");
    // The description of a command stands in the same line or below, farther in.
    let commands = list.lines().filter(|line| !line.starts_with("   "));
    let commands = commands.filter_map(|line| line.split_whitespace().next());
    let commands = commands.filter(|name| *name != "help");
    commands
        .map(|name| format!("{command} {name}").trim().to_owned())
        .collect()
}

#[test]
fn every_command_has_a_manual_page_with_its_flags() {
    let workspace = Workspace::new();
    fs::create_dir(workspace.path("man")).expect("a folder");
    let run = workspace.run("man man").expect(0);
    let mut commands = commands_below(&workspace, "");
    assert!(commands.len() >= 14, "{commands:?}");
    let steps: Vec<_> = (commands.iter())
        .flat_map(|command| commands_below(&workspace, command))
        .collect();
    assert!(steps.contains(&"farm plan".to_owned()), "{steps:?}");
    commands.extend(steps);
    assert!(commands.contains(&"render".to_owned()), "{commands:?}");
    let names = run.text();
    assert_eq!(names.lines().count(), commands.len() + 1, "{names}");
    let page = |name: &str| String::from_utf8(workspace.read(name)).expect("text");
    assert!(page("man/glimray.1").contains(".TH glimray 1"));
    for command in &commands {
        let name = command.replace(' ', "-");
        let text = page(&format!("man/glimray-{name}.1"));
        let is_titled = text
            .replace("\\-", "-")
            .contains(&format!(".TH glimray-{name} 1"));
        assert!(is_titled, "{text}");
    }
    for (name, flags) in [
        ("render", ["samples", "max\\-depth", "look\\-from"]),
        ("farm-plan", ["parts", "minutes", "simulate"]),
        ("farm-run", ["all", "jobs", "attempts"]),
    ] {
        let text = page(&format!("man/glimray-{name}.1"));
        for flag in flags {
            assert!(text.contains(&format!("\\-\\-{flag}")), "{name}: {flag}");
        }
    }
    workspace.run("man gone").expect(4);
}

/// Links to files in a text in Markdown, as it writes them, without places in pages.
fn links(text: &str) -> Vec<&str> {
    let parts = text.split("](").skip(1);
    let links = parts.filter_map(|part| Some(part.split_once(')')?.0));
    links
        .filter(|link| !link.contains("://"))
        .map(|link| link.split('#').next().unwrap_or_default())
        .filter(|link| !link.is_empty())
        .collect()
}

/// `link` in the file `from`, as a path from the root; `None` if it leads out.
fn target(from: &Path, link: &str) -> Option<String> {
    let mut parts: Vec<_> = from.parent()?.iter().collect();
    for part in Path::new(link).components() {
        match part {
            Component::Normal(name) => parts.push(name),
            Component::ParentDir => _ = parts.pop()?,
            _ => (),
        }
    }
    let path: PathBuf = parts.iter().collect();
    Some(path.to_str()?.replace('\\', "/"))
}

/// Whether there is this file among `files`, or one below this folder.
fn has<'a>(files: impl IntoIterator<Item = &'a String>, path: &str) -> bool {
    let folder = format!("{}/", path.trim_end_matches('/'));
    let is_it = |file: &&String| *file == path || file.starts_with(&folder);
    files.into_iter().any(|file| is_it(&file))
}

/// Each link of the pages among `files` leads to one of them.
fn check_links(verdict: &mut Verdict, files: &BTreeMap<String, Vec<u8>>) {
    for (name, bytes) in files.iter().filter(|(name, _)| name.ends_with(".md")) {
        let text = String::from_utf8_lossy(bytes);
        for link in links(&text) {
            let target = target(Path::new(name), link);
            let is_there = target.is_some_and(|target| has(files.keys(), &target));
            verdict.that(format!("{name}: {link}"), is_there, || "is not there");
        }
    }
}

fn cargo(arguments: &[&str]) -> Output {
    let cargo = std::env::var_os("CARGO").unwrap_or("cargo".into());
    let output = Command::new(cargo).args(arguments).output().expect("cargo");
    let told = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success(), "{told}");
    output
}

#[test]
fn links_of_pages_lead_to_files_and_pictures_of_the_gallery_are_on_pages() {
    let mut names: Vec<String> = [
        "README.md",
        "ARCHITECTURE.md",
        "CHANGELOG.md",
        "CONTRIBUTING.md",
        "SECURITY.md",
        "Cargo.toml",
        "Makefile",
    ]
    .map(str::to_owned)
    .to_vec();
    for folder in [
        "assets",
        "benches",
        "crates",
        "docs",
        "examples",
        "packaging",
        "shaders",
        "src",
        "tests",
    ] {
        names.extend(all_files(Path::new(folder)));
    }
    names.extend(
        [
            ".github/workflows/ci.yml",
            ".github/workflows/release.yml",
            "Dockerfile",
            "LICENSE-APACHE",
            "LICENSE-MIT",
            "deny.toml",
            "typos.toml",
        ]
        .map(str::to_owned),
    );
    let read = |name: &String| match name.ends_with(".md") {
        true => fs::read(name).expect(name),
        false => Vec::new(),
    };
    let files: BTreeMap<_, _> = names
        .iter()
        .map(|name| (name.clone(), read(name)))
        .collect();
    let mut verdict = Verdict::on("pages");
    let pages: String = files
        .values()
        .map(|bytes| String::from_utf8_lossy(bytes))
        .collect();
    for picture in files
        .keys()
        .filter(|name| name.starts_with("assets/gallery/"))
    {
        verdict.that(picture, pages.contains(&**picture), || "is on no page");
    }
    check_links(&mut verdict, &files);
    verdict.close();
}

/// Bytes that the package may have before it is compressed: twice what source, shaders and scenes need.
const MOST_PACKED: u64 = 12 << 20;

/// Names of the files in a package.
fn packed(package: &str) -> Vec<String> {
    let list = [
        "package",
        "--list",
        "--allow-dirty",
        "--offline",
        "--package",
        package,
    ];
    let list = String::from_utf8(cargo(&list).stdout).expect("UTF-8");
    list.replace('\\', "/").lines().map(str::to_owned).collect()
}

#[test]
fn the_package_has_what_is_built_and_shown_and_nothing_else() {
    const PARTS: [&str; 3] = ["assets/scenes/", "examples/", "src/"];
    const FILES: [&str; 8] = [
        ".cargo_vcs_info.json",
        "CHANGELOG.md",
        "Cargo.lock",
        "Cargo.toml",
        "Cargo.toml.orig",
        "LICENSE-APACHE",
        "LICENSE-MIT",
        "README.md",
    ];
    let names = packed("glimray");
    let mut verdict = Verdict::on("the package");
    for name in &names {
        let is_known = FILES.contains(&&**name) || PARTS.iter().any(|part| name.starts_with(part));
        verdict.that(name, is_known, || "has no business there");
    }
    let files = names.iter().filter_map(|name| fs::metadata(name).ok());
    let size: u64 = files.map(|file| file.len()).sum();
    verdict.that("size", size < MOST_PACKED, || format!("{size} bytes"));
    verdict.close();
}

/// Folders of published packages, and the folders there that the compiler reads.
const PUBLISHED: [(&str, &str, &[&str]); 9] = [
    ("glimray", "", &["src", "examples", "assets/scenes"]),
    ("glimray-app", "crates/app/", &["src"]),
    ("glimray-cli", "crates/cli/", &["src"]),
    ("glimray-io", "crates/io/", &["src"]),
    ("glimray-render", "crates/render/", &["src"]),
    ("glimray-scene", "crates/scene/", &["src"]),
    ("glimray-shader-test", "crates/shader-test/", &["src"]),
    (
        "glimray-shaders",
        "shaders/",
        &["src", "kernels", "lib", "linked", "scene", "types"],
    ),
    ("glimray-viewer", "crates/viewer/", &["src"]),
];

#[test]
fn every_package_that_is_published_says_what_it_is() {
    let mut verdict = Verdict::on("packages");
    let mut members: Vec<_> = fs::read_dir("crates").expect("a folder").collect();
    members.extend(fs::read_dir(".").expect("a folder"));
    let mut published = BTreeSet::new();
    for folder in members
        .into_iter()
        .map(|entry| entry.expect("an entry").path())
    {
        let Ok(text) = fs::read_to_string(folder.join("Cargo.toml")) else {
            continue;
        };
        let manifest: toml::Table = text.parse().expect("TOML");
        let package = &manifest["package"];
        // The package of the fuzzers needs a nightly compiler, and is no member.
        let is_private = package.get("publish").and_then(toml::Value::as_bool) == Some(false);
        if !is_private {
            published.insert(package["name"].as_str().expect("text").to_owned());
        }
    }
    published.insert("glimray".to_owned());
    let known = PUBLISHED.map(|(package, ..)| package.to_owned());
    verdict.that("published", published == known.into(), || {
        format!("{published:?}")
    });
    for (package, root, _) in PUBLISHED {
        let manifest: toml::Table = read(format!("{root}Cargo.toml")).parse().expect("TOML");
        for key in ["description", "keywords", "categories", "license"] {
            let has = manifest["package"].get(key).is_some();
            verdict.that(format!("{package}: {key}"), has, || "is missing");
        }
        let names = packed(package);
        for file in ["README.md", "LICENSE-APACHE", "LICENSE-MIT"] {
            let is_there = names.iter().any(|name| name == file);
            verdict.that(format!("{package}: {file}"), is_there, || "is missing");
        }
    }
    verdict.close();
}

#[test]
fn packages_have_all_that_the_compiler_reads() {
    let mut verdict = Verdict::on("packages");
    for (package, root, folders) in PUBLISHED {
        let names = packed(package);
        for folder in folders {
            for name in all_files(Path::new(&format!("{root}{folder}"))) {
                let name = name.strip_prefix(root).expect("the root");
                // Models are left out.
                let is_there = name.ends_with(".glb") || names.iter().any(|known| known == name);
                verdict.that(format!("{package}: {name}"), is_there, || "is missing");
            }
        }
        for name in names.iter().filter(|name| name.ends_with(".rs")) {
            let text = fs::read_to_string(format!("{root}{name}")).expect("a source");
            for embedded in text.split("include_").skip(1) {
                let call = embedded.split(';').next().unwrap_or_default();
                let path = call.split('"').find(|part| part.contains("../"));
                let climbs = path.is_some_and(|path| target(Path::new(name), path).is_none());
                verdict.that(
                    format!("{package}: {name}"),
                    !climbs,
                    || "reads a file outside",
                );
            }
        }
    }
    verdict.close();
}

/// The files below a folder, by their paths with `/`.
fn all_files(folder: &Path) -> Vec<String> {
    let mut found = Vec::new();
    for entry in fs::read_dir(folder).expect("a folder") {
        let path = entry.expect("an entry").path();
        match path.is_dir() {
            true => found.extend(all_files(&path)),
            false => found.push(path.to_str().expect("UTF-8").replace('\\', "/")),
        }
    }
    found
}
