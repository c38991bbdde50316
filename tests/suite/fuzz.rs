//! The fuzz targets on what they start from and on what they found: seeds, corpora and regressions.

#[path = "../fuzz/harness.rs"]
mod targets;

use glimray::import::{Archive, Resolver};
use std::fs;
use std::panic::catch_unwind;
use std::path::Path;
use std::time::{Duration, Instant};

/// Time for one file, which is small. The fuzzer has the same limit.
const MOST_TIME: Duration = Duration::from_secs(10);

fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}

/// Names and contents of the files that the target starts from, or that once failed.
fn inputs(target: &str) -> Vec<(String, Vec<u8>)> {
    let mut inputs = Vec::new();
    for folder in ["seeds", "regressions"] {
        let Ok(entries) = fs::read_dir(root().join("tests/fuzz").join(folder).join(target)) else {
            continue;
        };
        for entry in entries {
            let path = entry.expect("an entry").path();
            inputs.push((path.display().to_string(), fs::read(&path).expect("a file")));
        }
    }
    let (folder, endings): (&str, &[&str]) = match target {
        "native" => ("assets/scenes", &["toml"]),
        "course" => ("assets/scenes", &["scene"]),
        "nff" => ("assets/scenes", &["nff"]),
        "glb" => ("tests/encoded", &["glb"]),
        "picture" => ("tests/encoded", &["ktx2", "webp"]),
        _ => ("tests/encoded", &[]),
    };
    for entry in fs::read_dir(root().join(folder)).expect("a folder") {
        let path = entry.expect("an entry").path();
        let ending = path.extension().unwrap_or_default();
        if endings.iter().any(|known| ending == *known) {
            inputs.push((path.display().to_string(), fs::read(&path).expect("a file")));
        }
    }
    let corpus = root().join("tests/fuzz/corpus").join(target);
    let corpus = corpus.with_extension("zip");
    if let Ok(bytes) = fs::read(&corpus) {
        let corpus = Archive::new(bytes).expect("an archive");
        for name in corpus.names() {
            let bytes = corpus.read(name, u64::MAX).expect("a file");
            inputs.push((format!("{target}.zip, {}", name.display()), bytes));
        }
    }
    inputs
}

#[test]
fn what_the_fuzzer_found_is_read_or_refused_in_one_line() {
    for (target, run) in targets::TARGETS {
        let inputs = inputs(target);
        assert!(!inputs.is_empty(), "{target} has nothing to start from");
        for (name, bytes) in inputs {
            let started = Instant::now();
            let outcome = catch_unwind(|| run(&bytes));
            assert!(outcome.is_ok(), "{target} fails with {name}");
            let took = started.elapsed();
            assert!(took < MOST_TIME, "{target} takes {took:?} with {name}");
        }
    }
}

/// What is refused at once would tell nothing of poses.
#[test]
fn the_poses_that_the_fuzzer_starts_from_are_of_deforming_meshes() {
    let seeds = fs::read_dir(root().join("tests/fuzz/seeds/poses")).expect("a folder");
    for seed in seeds {
        let path = seed.expect("an entry").path();
        let bytes = fs::read(&path).expect("a file");
        let scene = targets::poses::model(&bytes[16..]).expect("a model");
        // One of them is far larger than f32 can light.
        let mut notes = scene.skipped.iter();
        let is_sized = notes.all(|note| note.starts_with("the scene measures"));
        assert!(is_sized, "{}: {:?}", path.display(), scene.skipped);
        assert_eq!(scene.deformations.len(), 1, "{}", path.display());
        assert_eq!(scene.tracks.len(), 10, "{}", path.display());
        assert!(scene.frame(0.7) != scene.frame(0.0), "{}", path.display());
    }
}

#[test]
fn every_target_is_built() {
    let folder = root().join("fuzz");
    if !folder.is_dir() {
        // A package holds no other packages.
        return;
    }
    let manifest = fs::read_to_string(folder.join("Cargo.toml")).expect("the manifest");
    for (target, _) in targets::TARGETS {
        let program = format!("name = \"{target}\"\npath = \"targets/{target}.rs\"\n");
        assert!(manifest.contains(&program), "{target} is not in Cargo.toml");
        let path = folder.join("targets").join(target).with_extension("rs");
        let text = fs::read_to_string(&path).expect("a target");
        let call = format!("glimray_fuzz::{target}(bytes)");
        assert!(text.contains(&call), "{} calls another", path.display());
    }
    let count = manifest.matches("[[bin]]").count();
    assert_eq!(count, targets::TARGETS.len(), "programs without a target");
}
