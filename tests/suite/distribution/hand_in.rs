//! The files that `make hand-in` packs.

use super::{check_links, has};
use crate::support::skip::{Need, skip};
use crate::support::verdict::Verdict;
use std::collections::BTreeMap;
use std::fs;
use std::io::{Cursor, Read};
use std::path::Path;
use std::process::Command;
use zip::ZipArchive;

/// The files of the hand-in, by their names below its only folder; `None` where there is no checkout.
fn hand_in() -> Option<BTreeMap<String, Vec<u8>>> {
    let folder = tempfile::tempdir().expect("a folder");
    if !Path::new(".git").exists() {
        skip(Need::Git, "this is no checkout of Git");
        return None;
    }
    let output = Command::new("make")
        .args(["--no-print-directory", "hand-in", "NAME=Ada-1"])
        .arg(format!("HAND_IN_FOLDER={}", folder.path().display()))
        .env_remove("MAKEFLAGS")
        .output()
        .expect("make");
    let told = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success(), "{told}");
    let bytes = fs::read(folder.path().join("Exercise4-Ada-1.zip")).expect("an archive");
    let mut archive = ZipArchive::new(Cursor::new(bytes)).expect("an archive");
    let mut files = BTreeMap::new();
    for index in 0..archive.len() {
        let mut file = archive.by_index(index).expect("a file");
        let name = file.name().expect("a name").into_owned();
        let below = name.strip_prefix("Exercise4-Ada-1/").expect("the folder");
        if file.is_file() {
            let mut bytes = Vec::new();
            file.read_to_end(&mut bytes).expect("bytes");
            files.insert(below.to_owned(), bytes);
        }
    }
    Some(files)
}

#[test]
fn the_hand_in_needs_nothing_from_outside() {
    let Some(files) = hand_in() else {
        return;
    };
    let mut verdict = Verdict::on("the hand-in");
    for name in files.keys() {
        let is_left_out = [".git/", ".ci/", "target/"]
            .iter()
            .any(|part| name.starts_with(part));
        verdict.that(name, !is_left_out, || "should not be there");
    }
    // The bytes equal those here, whatever Git does with ends of lines.
    for (name, bytes) in files.iter().filter(|(name, _)| Path::new(name).exists()) {
        verdict.that(
            name,
            fs::read(name).ok().as_ref() == Some(bytes),
            || "differs",
        );
    }
    let text = |name: &str| String::from_utf8(files[name].clone()).expect("text");
    let manifest: toml::Table = text("Cargo.toml").parse().expect("TOML");
    let package = &manifest["package"];
    let named = [
        package["readme"].as_str(),
        manifest["lib"]["path"].as_str(),
        manifest["bin"][0]["path"].as_str(),
        manifest["test"][0]["path"].as_str(),
        Some("Cargo.lock"),
    ];
    for name in named {
        let name = name.expect("a path");
        verdict.that(name, files.contains_key(name), || "is not there");
    }
    verdict.that(
        "Cargo.toml",
        !text("Cargo.toml").contains("path = \"."),
        || "needs a folder outside",
    );
    // Files that are compiled in are named from the root.
    for (name, bytes) in files.iter().filter(|(name, _)| name.starts_with("crates/")) {
        let code = String::from_utf8_lossy(bytes);
        for embedded in code.split("\"/../../assets/").skip(1) {
            let path = format!("assets/{}", embedded.split('"').next().expect("a path"));
            verdict.that(name, files.contains_key(&path), || format!("needs {path}"));
        }
    }
    check_links(&mut verdict, &files);
    let index = text("index.html");
    let of = |attribute: &'static str| index.split(attribute).skip(1);
    let linked = of("href=\"").chain(of("src=\""));
    let linked = linked.filter_map(|rest| rest.split(['"', '#']).next());
    for link in linked {
        let is_there = has(files.keys(), link);
        verdict.that(format!("index.html: {link}"), is_there, || "is not there");
    }
    verdict.close();
}

#[test]
fn the_hand_in_has_what_the_exercise_asks_for() {
    let Some(files) = hand_in() else {
        return;
    };
    let readme = String::from_utf8_lossy(&files["README.md"]).to_lowercase();
    for heading in ["level 1", "level 2", "level 3", "problems met"] {
        assert!(readme.contains(heading), "the readme has no {heading}");
    }
    let frames = files.iter().filter(|(name, _)| name.starts_with("frames/"));
    let frames: Vec<_> = frames.collect();
    assert!(frames.len() >= 4, "{} frames", frames.len());
    for (name, bytes) in frames {
        let format = ::image::guess_format(bytes).expect("a picture");
        assert_eq!(format, ::image::ImageFormat::Jpeg, "{name}");
    }
    let index = String::from_utf8_lossy(&files["index.html"]);
    let readme = String::from_utf8_lossy(&files["README.md"]);
    let titles = readme.split("### Level ").skip(1);
    let levels = titles.filter_map(|title| title.lines().next());
    for level in levels {
        assert!(index.contains(&format!(">Level {level}<")), "{level}");
    }
    let (_, extras) = readme.split_once("| extra | idea |").expect("the extras");
    let (extras, _) = extras.split_once("\n\n").expect("their end");
    for extra in extras.lines().filter(|line| line.contains("theory/")) {
        let page = extra.split(['(', ')']).nth(1).expect("a page");
        assert!(
            index.contains(&format!("<h2><a href=\"{page}\">")),
            "{page}"
        );
    }
    for needless in ["shaders/linked/", "tests/golden/", "tests/fuzz/corpus/"] {
        let is_part = |name: &&String| name.starts_with(needless);
        assert_eq!(files.keys().find(is_part), None);
    }
    assert_eq!(&files["carousel.mp4"][4..8], b"ftyp", "it is no MP4");
}

#[test]
fn the_hand_in_wants_a_name_in_one_line() {
    let output = Command::new("make")
        .args(["--no-print-directory", "hand-in"])
        .env_remove("MAKEFLAGS")
        .env_remove("NAME")
        .output()
        .expect("make");
    assert_eq!(output.status.code(), Some(2));
    let told = String::from_utf8(output.stderr).expect("text");
    assert_eq!(told.lines().count(), 1, "{told}");
    assert!(told.contains("Use `make hand-in NAME=YourName`"), "{told}");
}
