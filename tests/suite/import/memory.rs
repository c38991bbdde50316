//! Memory that files take while they are read, and the number of notes about them.

use super::{folder, load, scene};
use glimray::import::{self, ImportError};
use std::fmt::Write;

const NFF: &str = "v\nfrom 0 0 9\nat 0 0 0\nup 0 1 0\nangle 40\nhither 0.1\nresolution 8 8\n\
                   l 1 2 3\nf 1 1 1 1 0 1 0 1\n";

const TRIANGLE: &str = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";

/// The output of `glimray inspect` for a file with a limited address space: the size that a small file
/// needs, and `bytes` more.
#[cfg(target_os = "linux")]
fn inspect_within(folder: &tempfile::TempDir, name: &str, bytes: u64) -> std::process::Output {
    use std::process::Command;
    // Code, libraries and thread stacks.
    const PROGRAM: u64 = 400 << 20;
    let limit = (PROGRAM + bytes) >> 10;
    let program = env!("CARGO_BIN_EXE_glimray");
    Command::new("sh")
        .args(["-c", &format!("ulimit -v {limit} && exec \"$@\"")])
        .args(["sh", program, "inspect", name])
        .current_dir(folder.path())
        .output()
        .expect("a shell")
}

#[test]
#[cfg(target_os = "linux")]
fn a_library_of_materials_takes_at_most_eight_times_its_size() {
    let library: String = (0..2_000_000).map(|i| format!("newmtl m{i}\n")).collect();
    let model = format!("mtllib a.mtl\n{TRIANGLE}usemtl m1999999\nf 1 2 3\n");
    let folder = folder(&[("a.obj", model.as_bytes()), ("a.mtl", library.as_bytes())]);
    let run = inspect_within(&folder, "a.obj", 8 * library.len() as u64);
    let error = String::from_utf8_lossy(&run.stderr);
    assert_eq!(run.status.code(), Some(0), "{error}");
    let text = String::from_utf8_lossy(&run.stdout);
    assert!(text.contains("materials  2\n  0  `m1999999`"), "{text}");
}

#[test]
#[cfg(target_os = "linux")]
fn a_model_takes_at_most_eight_times_its_size() {
    const SIDE: usize = 500;
    let mut text = String::new();
    for i in 0..SIDE * SIDE {
        let (x, y) = (i % SIDE, i / SIDE);
        let height = ((7 * x + 13 * y) % 31) as f64 / 9.0;
        let _ = writeln!(text, "v {x}.25 {y}.5 {height:.6}");
    }
    for i in (0..SIDE * (SIDE - 1)).filter(|i| i % SIDE < SIDE - 1) {
        let [a, b, c, d] = [i + 1, i + 2, i + 1 + SIDE, i + 2 + SIDE];
        let _ = writeln!(text, "f {a} {b} {c}\nf {b} {d} {c}");
    }
    for smoothing in ["", "s 1\n"] {
        let text = format!("{smoothing}{text}");
        let folder = folder(&[("a.obj", text.as_bytes())]);
        let run = inspect_within(&folder, "a.obj", 8 * text.len() as u64);
        let error = String::from_utf8_lossy(&run.stderr);
        assert_eq!(run.status.code(), Some(0), "{error}");
    }
}

/// A file whose contents need far more memory than its size.
fn too_big(name: &str, contents: &[u8]) -> ImportError {
    match load(name, contents) {
        Ok(_) => panic!("{name} of {} bytes was read", contents.len()),
        Err(error) => {
            assert!(error.is_too_big(), "{error}");
            assert!(error.to_string().contains("MiB of memory"), "{error}");
            error
        }
    }
}

#[test]
fn files_that_need_more_than_eight_times_their_size_are_refused_while_they_are_read() {
    let error = too_big(
        "a.obj",
        format!("{TRIANGLE}{}", "f 1 2 3\n".repeat(1 << 20)).as_bytes(),
    );
    let line = error.fault().position.expect("a place").line;
    assert!((100_000..1 << 20).contains(&line), "{error}");
    let spheres = format!("{NFF}{}", "s 0 0 0 1\n".repeat(1 << 21));
    assert!(
        too_big("a.nff", spheres.as_bytes())
            .fault()
            .position
            .is_some()
    );
    let lights = format!("{NFF}{}", "l 1 1 1\n".repeat(1 << 21));
    too_big("a.nff", lights.as_bytes());
    let fills: String = (0..1_000_000)
        .map(|i| format!("f 1 1 1 1 0 {i} 0 1\n"))
        .collect();
    too_big("a.nff", format!("{NFF}{fills}").as_bytes());
}

#[test]
fn vertices_of_three_bytes_are_refused_by_their_number() {
    const COUNT: usize = 6 << 20;
    let mut file = format!(
        "ply\nformat binary_little_endian 1.0\nelement vertex {COUNT}\nproperty char x\n\
         property char y\nproperty char z\nelement face 0\n\
         property list uchar int vertex_indices\nend_header\n"
    )
    .into_bytes();
    file.resize(file.len() + 3 * COUNT, 1);
    for object in [
        "mesh = { file = 'a.ply' }",
        "sphere = { center = [0, 0, 0], radius = 1 }\nrepeat = { points = { file = 'a.ply' } }",
    ] {
        let text = format!("[[objects]]\n{object}");
        let folder = folder(&[("a.toml", text.as_bytes()), ("a.ply", &file)]);
        let error = import::load(&folder.path().join("a.toml")).expect_err("refused");
        assert!(error.is_too_big(), "{error}");
    }
}

#[test]
fn of_many_undefined_materials_the_first_few_are_named() {
    let faces: String = (0..100_000)
        .map(|i| format!("usemtl m{i}\nf 1 2 3\n"))
        .collect();
    let scene = scene("a.obj", format!("{TRIANGLE}{faces}"));
    // Materials of the faces, and the ground's.
    assert_eq!(scene.materials.len(), 100_000 + 1);
    let [named @ .., last] = &scene.skipped[..] else {
        panic!("nothing was said");
    };
    assert_eq!(named.len(), 8);
    assert!(named[0].contains("`m0` is not defined"), "{}", named[0]);
    assert_eq!(last, "and 99992 more undefined materials");
}

#[test]
fn of_many_missing_files_the_first_few_are_named() {
    let libraries: String = (0..20_000).map(|i| format!("mtllib l{i}.mtl\n")).collect();
    let pictures: String = (0..300)
        .map(|i| format!("newmtl m{i}\nmap_Kd p{i}.png\n"))
        .collect();
    let faces: String = (0..300)
        .map(|i| format!("usemtl m{i}\nf 1 2 3\n"))
        .collect();
    let model = format!("mtllib a.mtl\n{libraries}{TRIANGLE}{faces}");
    let folder = folder(&[("a.obj", model.as_bytes()), ("a.mtl", pictures.as_bytes())]);
    let scene = import::load(&folder.path().join("a.obj")).expect("a scene");
    let summed: Vec<_> = (scene.skipped.iter())
        .filter(|note| note.starts_with("and "))
        .collect();
    assert_eq!(
        summed,
        [
            "and 19992 more missing material files",
            "and 292 more skipped textures",
        ]
    );
}

#[test]
fn notes_of_many_meshes_are_summed_up() {
    let objects: String = (0..40)
        .map(|i| format!("[[objects]]\nmesh = {{ file = 'm{i}.obj' }}\n"))
        .collect();
    let folder = folder(&[("a.toml", objects.as_bytes())]);
    for i in 0..40 {
        let model = format!("{TRIANGLE}usemtl gone\nf 1 2 3\nl 1 2\n");
        std::fs::write(folder.path().join(format!("m{i}.obj")), model).expect("a model");
    }
    let scene = import::load(&folder.path().join("a.toml")).expect("a scene");
    assert!(
        scene.skipped[0].starts_with("`m0.obj`: "),
        "{}",
        scene.skipped[0]
    );
    assert!(
        scene
            .skipped
            .contains(&"and 32 more undefined materials".to_owned())
    );
    assert_eq!(scene.skipped.len(), 18);
}
