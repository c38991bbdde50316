//! Models in ZIP archives.

use super::{archive, load, scene};
use crate::support::effort;

const MODEL: &[u8] =
    b"mtllib textures/a.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nusemtl a\nf 1/1 2/1 3/1\n";

#[test]
fn a_model_is_read_with_its_files() {
    let files: &[(&str, &[u8])] = &[
        ("__MACOSX/model/._a.obj", b"\0\0"),
        ("model/readme.txt", b"hello"),
        ("model/a.obj", MODEL),
        ("model/textures/a.mtl", b"newmtl a\nmap_Kd red.png\n"),
        ("model/textures/red.png", &super::textures::png()),
    ];
    let scene = scene("a.ZIP", archive(files));
    assert_eq!((scene.triangle_count(), scene.pictures.len()), (1, 1));
    assert_eq!(scene.meshes[0].name, "a");
    assert_eq!(scene.skipped, [""; 0]);
}

#[test]
fn of_several_scenes_the_outermost_is_shown_and_the_others_reported() {
    let triangle: &[u8] = b"v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
    let files: &[(&str, &[u8])] = &[
        ("deep/a.toml", b""),
        ("z.obj", triangle),
        ("b.obj", triangle),
        ("a.stl", b"solid a\nendsolid a\n"),
    ];
    let scene = scene("a.zip", archive(files));
    assert_eq!(scene.meshes[0].name, "b");
    assert_eq!(
        scene.skipped,
        ["only `b.obj` is shown: the archive has 3 more scene(s)"]
    );
}

#[test]
fn archives_without_a_scene_and_damaged_ones_are_refused() {
    let message = |bytes: &[u8]| load("a.zip", bytes).expect_err("refused").to_string();
    let empty = message(&archive(&[("a.txt", b"hello")]));
    assert!(
        empty.ends_with("none of its 1 files is a scene or model. Put a scene or model into it."),
        "{empty}"
    );
    let nested = message(&archive(&[("a.zip", b"PK")]));
    assert!(nested.contains("none of its 1 files"), "{nested}");
    let whole = archive(&[("a.obj", MODEL), ("b.txt", &[7; 3000])]);
    for percent in 0..100 {
        let error = effort::within(2_000.0, || message(&whole[..whole.len() * percent / 100]));
        assert_eq!(error.lines().count(), 1, "{error}");
    }
}

#[test]
fn decompression_bombs_are_refused() {
    // A hundred million spaces, which become a hundred thousand bytes.
    let spaces = vec![b' '; 100 << 20];
    let bytes = archive(&[("a.obj", &spaces)]);
    assert!(bytes.len() < 1 << 20);
    let error = effort::within(10_000.0, || load("a.zip", &bytes).expect_err("refused"));
    assert!(error.is_too_big(), "{error}");
}
