//! Inputs that the fuzzer (`examples/fuzz.rs`) found or starts from: each gives a scene or a one-line
//! error.

use super::message_in;
use glimray::import::{self, Options};
use std::path::Path;

#[test]
fn what_the_fuzzer_found_is_read_or_refused_in_one_line() {
    let corpus = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/corpus");
    let mut count = 0;
    for entry in std::fs::read_dir(&corpus).expect("the corpus") {
        let path = entry.expect("an entry").path();
        let name = path
            .file_name()
            .unwrap_or_default()
            .to_string_lossy()
            .into_owned();
        let folder = super::folder(&[]);
        std::fs::copy(&path, folder.path().join(&name)).expect("a copy");
        // Files that are not scenes are named by a scene, as in the fuzzer.
        let scene = match name.rsplit('.').next() {
            Some("toml" | "scene" | "nff" | "obj") => name.clone(),
            Some("mtl") => with(
                &folder,
                "a.obj",
                &format!("mtllib {name}\nusemtl a\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"),
            ),
            Some("ply") => with(
                &folder,
                "a.toml",
                &format!("[[objects]]\nmesh = {{ file = '{name}' }}\n"),
            ),
            _ => with(
                &folder,
                "a.toml",
                &format!("background = {{ picture = '{name}' }}\n"),
            ),
        };
        if import::load(&folder.path().join(&scene)).is_err() {
            let message = message_in(&folder, &scene, &Options::default());
            assert!(message.ends_with('.'), "{name}: {message}");
        }
        count += 1;
    }
    assert!(count > 0, "there is nothing in the corpus");
}

fn with(folder: &tempfile::TempDir, name: &str, text: &str) -> String {
    std::fs::write(folder.path().join(name), text).expect("a scene");
    name.to_owned()
}
