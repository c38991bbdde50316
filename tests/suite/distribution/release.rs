//! The parts of a release: names of archives, notices of crates, entries for desktops, and the workflow.

use super::{cargo, manifest, read};
use crate::support::verdict::Verdict;
use glimray_notices::{licenses, packages, sbom};
use std::collections::BTreeSet;
use std::process::{Command, Output};

/// Targets for which the workflow makes archives.
const TARGETS: [&str; 5] = [
    "aarch64-apple-darwin",
    "aarch64-unknown-linux-gnu",
    "x86_64-apple-darwin",
    "x86_64-pc-windows-msvc",
    "x86_64-unknown-linux-gnu",
];

fn script(name: &str, arguments: &[&str]) -> Output {
    let run = Command::new(format!("packaging/{name}"))
        .args(arguments)
        .output();
    run.expect("a script")
}

fn version() -> String {
    let manifest = manifest();
    let version = manifest["workspace"]["package"]["version"].as_str();
    version.expect("text").to_owned()
}

#[test]
fn binstall_knows_the_names_of_the_archives() {
    let manifest = manifest();
    let binstall = manifest["package"]["metadata"]["binstall"]
        .as_table()
        .expect("a table");
    for target in TARGETS {
        let own = binstall["overrides"]
            .get(target)
            .and_then(toml::Value::as_table);
        let value = |key: &str| {
            let value = own.and_then(|own| own.get(key)).unwrap_or(&binstall[key]);
            let value = value
                .as_str()
                .expect("text")
                .replace("{ version }", &version());
            value.replace("{ target }", target)
        };
        let name = script("dist.sh", &["--archive", target]).stdout;
        let name = String::from_utf8(name).expect("text").trim().to_owned();
        let address = format!("{{ repo }}/releases/download/v{}/{name}", version());
        assert_eq!(value("pkg-url"), address);
        let ending = match &*value("pkg-fmt") {
            "tgz" => ".tar.gz",
            "zip" => ".zip",
            other => panic!("{other}"),
        };
        let folder = name.strip_suffix(ending).expect(ending);
        assert_eq!(
            value("bin-dir"),
            format!("{folder}/{{ bin }}{{ binary-ext }}")
        );
    }
}

#[test]
fn crates_of_the_workspace_need_each_other_in_its_version() {
    let manifest = manifest();
    let dependencies = manifest["workspace"]["dependencies"]
        .as_table()
        .expect("a table");
    let own = dependencies
        .iter()
        .filter(|(name, _)| name.starts_with("glimray-"));
    let versions = own.filter_map(|(name, table)| Some((name, table.get("version")?.as_str()?)));
    let others: Vec<_> = versions.filter(|(_, found)| *found != version()).collect();
    assert!(others.is_empty(), "{others:?}");
}

#[test]
fn a_tag_names_the_version_of_the_manifest() {
    let run = script("check-tag.sh", &["v999.0.0"]);
    assert_eq!(run.status.code(), Some(1));
    let told = String::from_utf8(run.stderr).expect("text");
    let expected = format!(
        "error: the tag is v999.0.0, and Cargo.toml names the version {0}. Tag v{0}, or set the version.\n",
        version()
    );
    assert_eq!(told, expected);
}

#[test]
fn workflows_pin_actions_by_commit() {
    let mut verdict = Verdict::on("actions");
    for name in ["ci.yml", "release.yml"] {
        let text = read(format!(".github/workflows/{name}"));
        for action in text.split("uses: ").skip(1) {
            let action = action.lines().next().unwrap_or_default();
            let (_, rest) = action.split_once('@').unwrap_or_default();
            let (commit, version) = rest.split_once(" # v").unwrap_or_default();
            let is_commit = commit.len() == 40 && commit.bytes().all(|b| b.is_ascii_hexdigit());
            let is_pinned = is_commit && !version.is_empty();
            verdict.that(format!("{name}: {action}"), is_pinned, || "is not pinned");
        }
    }
    verdict.close();
}

#[test]
fn desktops_are_told_of_the_same_models() {
    let list = |file: &str| {
        let text = read(format!("assets/desktop/{file}"));
        let line = text.lines().find_map(|line| line.strip_prefix("MimeType="));
        let types = line
            .expect("types")
            .split(';')
            .filter(|part| !part.is_empty());
        types.map(str::to_owned).collect::<BTreeSet<_>>()
    };
    let opened = list("glimray.desktop");
    assert_eq!(opened.len(), 5, "{opened:?}");
    assert_eq!(list("glimray.thumbnailer"), opened);
    let about = read("assets/desktop/glimray.metainfo.xml");
    let provided = about.split("<mediatype>").skip(1);
    let provided = provided.filter_map(|rest| rest.split('<').next().map(str::to_owned));
    assert_eq!(provided.collect::<BTreeSet<_>>(), opened);
}

#[test]
fn every_crate_in_the_program_is_in_its_notices() {
    let about = Command::new("rustc")
        .args(["--version", "--verbose"])
        .output();
    let about = String::from_utf8(about.expect("rustc").stdout).expect("text");
    let target = about
        .lines()
        .find_map(|line| line.strip_prefix("host: "))
        .expect("a target");
    let found = packages(target).expect("packages");
    let licenses = licenses(&found).expect("licences");
    let bill = sbom(&found).expect("a bill of materials");
    let again = packages(target).expect("packages");
    assert!(
        sbom(&again).is_ok_and(|again| again == bill),
        "a second run differs"
    );
    let bill: serde_json::Value = serde_json::from_str(&bill).expect("JSON");
    let components = bill["components"].as_array().expect("components");

    let list = [
        "tree",
        "--locked",
        "--package",
        "glimray",
        "--edges",
        "normal,no-proc-macro",
    ];
    let format = [
        "--prefix",
        "none",
        "--no-dedupe",
        "--format",
        "{p}",
        "--target",
        target,
    ];
    let tree = String::from_utf8(cargo(&[&list[..], &format].concat()).stdout).expect("text");
    let lock: toml::Table = read("Cargo.lock").parse().expect("TOML");
    let locked = lock["package"].as_array().expect("packages");
    let crates: BTreeSet<_> = tree.lines().filter(|line| !line.is_empty()).collect();
    assert!(crates.len() > 200, "{}", crates.len());
    let mut verdict = Verdict::on("crates");
    for line in crates {
        let mut words = line.split(' ');
        let name = words.next().expect("a name");
        let version = words
            .next()
            .and_then(|word| word.strip_prefix('v'))
            .expect("a version");
        if name == "glimray" {
            continue;
        }
        let component = components
            .iter()
            .find(|it| it["name"] == name && it["version"] == version);
        verdict.that(
            line,
            component.is_some(),
            || "is not in the bill of materials",
        );
        let entry = locked.iter().find(|package| {
            package["name"].as_str() == Some(name) && package["version"].as_str() == Some(version)
        });
        // Crates of this workspace have no checksum, and the licences of the program.
        let Some(sum) = entry.expect("a locked crate").get("checksum") else {
            continue;
        };
        let stated = component.map(|it| it["hashes"][0]["content"].as_str());
        verdict.that(
            line,
            stated == Some(sum.as_str()),
            || "has another checksum",
        );
        let (rows, texts) = licenses.split_once("\n====").expect("texts");
        let is_listed = rows.contains(&format!("\n{name} {version}: "));
        verdict.that(line, is_listed, || "is not in the list of licences");
        let holders = texts.split("\n====").filter_map(|text| text.lines().nth(1));
        let is_covered = holders
            .flat_map(|line| line.split(", "))
            .any(|it| it == format!("{name} {version}"));
        verdict.that(line, is_covered, || "has no text");
    }
    // Works in crates: fonts of the window, and C++.
    for holder in [
        "Canonical Ltd.",
        "SIL OPEN FONT LICENSE",
        "Bitstream, Inc.",
        "Lucide Contributors",
        "NVIDIA CORPORATION",
        "Cisco Systems",
    ] {
        verdict.that(holder, licenses.contains(holder), || "is not named");
    }
    verdict.close();
}
