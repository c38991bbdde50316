//! The fuzz targets: each reads arbitrary bytes as one kind of file and panics if glimray does something
//! wrong. The package in `fuzz/` runs them; the test suite replays what they start from and what they found.
//!
//! A file must be read or refused. A refusal is one line. A scene that was read keeps the invariants of
//! `Scene`, has a frame at any time, and if it is small, it can be packed, and exporting it, reading the
//! export and exporting that gives the same text. Each target tells whether the file was read.

mod invariants;
pub mod poses;

use glimray::export;
use glimray::import::{self, Memory, Options};
use glimray::pack;
use glimray::render::Film;
use glimray::scene::Scene;
use xxhash_rust::xxh3::xxh3_128;

/// A kind of file, and the function that reads one and returns whether it was accepted.
pub type Target = (&'static str, fn(&[u8]) -> bool);

/// All targets.
pub const TARGETS: &[Target] = &[
    ("native", native),
    ("course", course),
    ("nff", nff),
    ("obj", obj),
    ("mtl", mtl),
    ("ply", ply),
    ("mesh_ply", mesh_ply),
    ("stl", stl),
    ("gltf", gltf),
    ("glb", glb),
    ("zip", zip),
    ("poses", poses),
    ("picture", picture),
    ("film", film),
];

/// Scenes with more triangles and objects than this are not packed: that would take too long.
const MOST_PACKED: usize = 2000;

/// Scenes with more of everything than this are not exported.
const MOST_EXPORTED: usize = 200;

/// A texture of 2 × 2 texels in PNG.
const PNG: &[u8] = include_bytes!("seeds/picture/rgba.png");

/// Two triangles.
const SQUARE: &[u8] =
    b"mtllib a.mtl\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\n\
    usemtl a\nf 1/1 2/2 3/3\nusemtl b\nf 1/1 3/3 4/4\n";

/// A native scene.
pub fn native(bytes: &[u8]) -> bool {
    let scene = scene("a.toml", bytes);
    scene.iter().for_each(survives_export);
    scene.is_some()
}

/// A scene of the course.
pub fn course(bytes: &[u8]) -> bool {
    scene("a.scene", bytes).is_some()
}

/// A scene in NFF.
pub fn nff(bytes: &[u8]) -> bool {
    scene("a.nff", bytes).is_some()
}

/// An OBJ model.
pub fn obj(bytes: &[u8]) -> bool {
    scene("a.obj", bytes).is_some()
}

/// The materials of an OBJ model.
pub fn mtl(bytes: &[u8]) -> bool {
    let files = [("a.obj", SQUARE), ("a.mtl", bytes), ("a.png", PNG)];
    read(&files, "a.obj").is_some_and(|scene| scene.materials.iter().any(|it| it.name == "a"))
}

/// A PLY model.
pub fn ply(bytes: &[u8]) -> bool {
    scene("a.ply", bytes).is_some()
}

/// A PLY mesh of a native scene.
pub fn mesh_ply(bytes: &[u8]) -> bool {
    let named: &[u8] = b"[[objects]]\nmesh = { file = 'b.ply' }\n";
    read(&[("a.toml", named), ("b.ply", bytes)], "a.toml").is_some()
}

/// An STL model.
pub fn stl(bytes: &[u8]) -> bool {
    scene("a.stl", bytes).is_some()
}

/// A glTF model in JSON.
pub fn gltf(bytes: &[u8]) -> bool {
    scene("a.gltf", bytes).is_some()
}

/// A binary glTF model.
pub fn glb(bytes: &[u8]) -> bool {
    scene("a.glb", bytes).is_some()
}

/// An archive of a model.
pub fn zip(bytes: &[u8]) -> bool {
    scene("a.zip", bytes).is_some()
}

/// Deforming meshes: two moments, and the buffer of a model with a skin, morph targets and a clip.
pub fn poses(bytes: &[u8]) -> bool {
    let Some((moments, buffer)) = bytes.split_first_chunk::<16>() else {
        return false;
    };
    let moment = |at: usize| {
        let bytes = moments[at..].first_chunk().copied().unwrap_or_default();
        let seconds = f64::from_le_bytes(bytes);
        if seconds.is_finite() {
            seconds.clamp(-1e9, 1e9)
        } else {
            0.0
        }
    };
    let (open, length) = (moment(0), moment(8).abs().min(10.0));
    let scene = match poses::model(buffer) {
        Ok(scene) => scene,
        Err(error) => return refused(&error),
    };
    let broken = invariants::broken(&scene);
    let broken = broken.or_else(|| poses::broken(&scene, open));
    if let Some(why) = broken.or_else(|| poses::broken(&scene, open + length)) {
        panic!("the scene has an invalid part: {why}");
    }
    let packed = match pack::scene(&scene) {
        Ok(packed) => packed,
        Err(error) => {
            refused(&error);
            return true;
        }
    };
    // Trees are built, refitted and blurred.
    let mut before = None;
    for frames in [
        vec![scene.frame(open)],
        scene.motion_samples(open, open + length),
    ] {
        match packed.view_from(before.as_ref(), &frames) {
            Ok(view) => before = Some(view),
            Err(error) => _ = refused(&error),
        }
    }
    true
}

/// An image.
pub fn picture(bytes: &[u8]) -> bool {
    let named: &[u8] = b"textures.t = { picture = 'a.png' }\n";
    read(&[("a.toml", named), ("a.png", bytes)], "a.toml").is_some()
}

/// A film file. Its checksum is put right, which no mutation would.
pub fn film(bytes: &[u8]) -> bool {
    let mut bytes = bytes.to_vec();
    if let Some((content, digest)) = bytes.split_last_chunk_mut::<16>() {
        *digest = xxh3_128(content).to_le_bytes();
    }
    match Film::read(&bytes[..]) {
        Err(error) => refused(&error),
        Ok(film) => {
            let mut again = Vec::new();
            film.write(&mut again).expect("memory takes everything");
            assert!(again == bytes, "a film is not written as it was read");
            let has_parts = film.parts().next().is_some();
            assert!(
                film.merge(&film).is_err() == has_parts,
                "samples were merged with themselves"
            );
            true
        }
    }
}

/// The scene in `bytes`, a file called `name`, beside which there are a picture, materials and a mesh.
fn scene(name: &str, bytes: &[u8]) -> Option<Scene> {
    let mtl: &[u8] = b"newmtl a\nKd 1 0 0\nnewmtl b\nmap_Kd a.png\n";
    let files = [
        ("a.mtl", mtl),
        ("a.png", PNG),
        ("b.obj", SQUARE),
        ("a.bin", &[0; 256]),
        (name, bytes),
    ];
    read(&files, name)
}

/// Reads the scene `name` among `files` and examines the result.
fn read(files: &[(&str, &[u8])], name: &str) -> Option<Scene> {
    let files = Memory::from_iter(files.iter().copied());
    let scene = match import::load_from(&files, name, &Options::default()) {
        Ok(scene) => scene,
        Err(error) => {
            refused(&error);
            return None;
        }
    };
    for note in &scene.skipped {
        is_one_line(note);
    }
    if let Some(why) = invariants::broken(&scene) {
        panic!("the scene has an invalid part: {why}");
    }
    scene.frame(0.0);
    let frame = scene.frame(0.7);
    if scene.triangle_count() + scene.instances.len() + scene.shapes.len() < MOST_PACKED {
        match pack::scene(&scene) {
            Err(error) => _ = refused(&error),
            Ok(packed) => {
                if let Err(error) = packed.frame(&frame) {
                    refused(&error);
                }
            }
        }
    }
    Some(scene)
}

/// Checks that the export of `scene` is read, and exported again to the same text.
fn survives_export(scene: &Scene) {
    let count = scene.triangle_count()
        + scene.instances.len()
        + scene.shapes.len()
        + scene.materials.len()
        + scene.nodes.len();
    if count > MOST_EXPORTED {
        return;
    }
    let Ok(first) = export::native(scene, "a", &|_, _| false) else {
        return;
    };
    let mut files = Memory::from_iter([("a.toml", first.text.as_bytes())]);
    for file in &first.files {
        files.insert(&file.name, file.bytes.as_slice());
    }
    let again = import::load_from(&files, "a.toml", &Options::default());
    let again = again.unwrap_or_else(|error| panic!("{error}\n{}", first.text));
    let second = export::native(&again, "a", &|_, _| false).expect("a second export");
    assert!(
        first.text == second.text,
        "the export is not stable:\n{}\n{}",
        first.text,
        second.text
    );
}

/// Checks the message of a refusal, which accepts nothing.
fn refused(error: &impl std::fmt::Display) -> bool {
    is_one_line(&error.to_string());
    false
}

fn is_one_line(message: &str) {
    assert!(!message.is_empty(), "a message is empty");
    // Marks, separators, embeddings, overrides and isolates of Unicode's bidirectional algorithm.
    let acts = |c: char| {
        c.is_control()
            || matches!(c, '\u{200b}'..='\u{200f}' | '\u{2028}'..='\u{202e}' | '\u{2066}'..='\u{2069}')
    };
    assert!(
        !message.contains(acts),
        "a message has several lines, or acts on a terminal: {message:?}"
    );
}
