//! Which files a scene may read.

use super::{folder, message_in, without_folder};
use glam::Vec3;
use glimray::import::{self, Options};
use insta::assert_snapshot;
use std::path::Path;

const TRIANGLE: &[u8] = b"v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";

/// A native scene that refers to `file`, a name without quotes.
fn naming(file: &str) -> String {
    format!(
        "[[objects]]\nmesh = {{ file = {} }}\n",
        serde_json::json!(file)
    )
}

#[test]
fn names_outside_the_folder_are_refused() {
    let names = [
        "../m.obj",
        "a/../../m.obj",
        "..\\m.obj",
        "/etc/passwd",
        "/proc/self/mem",
        "/dev/zero",
        "C:\\m.obj",
        "c:m.obj",
        "\\\\host\\share\\m.obj",
        "file:///etc/passwd",
        "http://example.org/m.obj",
        "%2e%2e/m.obj",
        "%FF.obj",
        "a\0b.obj",
        "",
        " ",
        ".",
        "gone.obj",
        "folder",
        "folder/deep.obj/x.obj",
    ];
    let message = |name: &&str| {
        let scene = naming(name);
        let folder = folder(&[("a.toml", scene.as_bytes()), ("folder/deep.obj", TRIANGLE)]);
        message_in(&folder, "a.toml", &Options::default())
    };
    let lines: Vec<_> = names.iter().map(message).collect();
    assert_snapshot!(lines.join("\n"), @r"
mesh file refused (a.toml:2:17): `../m.obj` points outside the scene folder. Name a file in it, or permit the other folder.
mesh file refused (a.toml:2:17): `a/../../m.obj` points outside the scene folder. Name a file in it, or permit the other folder.
mesh file refused (a.toml:2:17): `..\m.obj` points outside the scene folder. Name a file in it, or permit the other folder.
mesh file refused (a.toml:2:17): `/etc/passwd` points outside the scene folder. Name a file in it, or permit the other folder.
mesh file refused (a.toml:2:17): `/proc/self/mem` points outside the scene folder. Name a file in it, or permit the other folder.
mesh file refused (a.toml:2:17): `/dev/zero` points outside the scene folder. Name a file in it, or permit the other folder.
mesh file refused (a.toml:2:17): `C:\m.obj` points outside the scene folder. Name a file in it, or permit the other folder.
mesh file refused (a.toml:2:17): `c:m.obj` points outside the scene folder. Name a file in it, or permit the other folder.
mesh file refused (a.toml:2:17): `\\host\share\m.obj` points outside the scene folder. Name a file in it, or permit the other folder.
mesh file refused (a.toml:2:17): `file:///etc/passwd` points outside the scene folder. Name a file in it, or permit the other folder.
mesh file refused (a.toml:2:17): `http://example.org/m.obj` points outside the scene folder. Name a file in it, or permit the other folder.
mesh file refused (a.toml:2:17): `%2e%2e/m.obj` does not exist. Check the name and the folder.
mesh file refused (a.toml:2:17): `%FF.obj` does not exist. Check the name and the folder.
mesh file refused (a.toml:2:17): `a\0b.obj` is not a file name. Name a plain file in the scene folder.
mesh file refused (a.toml:2:17): `` is not a file name. Name a plain file in the scene folder.
mesh file refused (a.toml:2:17): ` ` is not a file name. Name a plain file in the scene folder.
mesh file refused (a.toml:2:17): `.` is not a plain file. Name a plain file in the scene folder.
mesh file refused (a.toml:2:17): `gone.obj` does not exist. Check the name and the folder.
mesh file refused (a.toml:2:17): `folder` is not a plain file. Name a plain file in the scene folder.
mesh file refused (a.toml:2:17): `folder/deep.obj/x.obj`: part of the path is not a folder. Name a plain file in the scene folder.
");

    let long = "../".repeat(300_000);
    assert_snapshot!(message(&long.as_str()), @"mesh file refused (a.toml:2:17): `../../../../../../../../../../..…` is not a file name. Name a plain file in the scene folder.");
}

#[test]
fn material_files_are_confined_too_but_do_not_refuse_the_model() {
    let names = [
        "../a.mtl",
        "/etc/passwd",
        "C:\\a.mtl",
        "http://example.org/a.mtl",
        ".",
    ];
    for name in names {
        let model = format!("mtllib {name}\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl a\nf 1 2 3\n");
        let files = [
            ("s/a.obj", model.as_bytes()),
            ("a.mtl", b"newmtl a\nKd 1 0 0"),
        ];
        let folder = folder(&files);
        let scene = import::load(&folder.path().join("s/a.obj")).expect("a model");
        assert_ne!(scene.materials[0].classical().diffuse, Vec3::X, "{name}");
        let (first, second) = (&scene.skipped[0], &scene.skipped[1]);
        let quoted = format!("the material file `{name}` ");
        assert!(first.starts_with(&quoted), "{name}: {first}");
        assert!(second.contains("`a` is not defined"), "{name}: {second}");
    }
}

#[test]
fn permitted_folders_are_accessible() {
    let elsewhere = folder(&[("m.obj", TRIANGLE)]);
    let dir = elsewhere.path().canonicalize().expect("a folder");
    let absolute = naming(&dir.join("m.obj").display().to_string());
    let scene = folder(&[("a.toml", absolute.as_bytes())]);
    let refused = message_in(&scene, "a.toml", &Options::default());
    assert!(refused.ends_with(
        "points outside the scene folder. Name a file in it, or permit the other folder."
    ));
    let options = Options {
        allow_dirs: vec![dir],
        ..Options::default()
    };
    let loaded = import::load_with(&scene.path().join("a.toml"), &options).expect("a scene");
    assert_eq!(loaded.triangle_count(), 1);

    let options = Options {
        allow_dirs: vec!["no/such/folder".into()],
        ..Options::default()
    };
    assert_snapshot!(message_in(&scene, "a.toml", &options), @"cannot use the permitted folder (no/such/folder): no such file or folder. Check that the folder exists.");
}

#[cfg(unix)]
#[test]
fn links_out_and_pipes_are_refused() {
    let elsewhere = folder(&[("m.obj", TRIANGLE)]);
    let scene = folder(&[
        ("a.toml", naming("link.obj").as_bytes()),
        ("b.toml", naming("pipe.obj").as_bytes()),
        ("c.toml", naming("inside.obj").as_bytes()),
        ("m.obj", TRIANGLE),
    ]);
    let at = |name: &str| scene.path().join(name);
    std::os::unix::fs::symlink(elsewhere.path().join("m.obj"), at("link.obj")).expect("a link");
    std::os::unix::fs::symlink(at("m.obj"), at("inside.obj")).expect("a link");
    let made = std::process::Command::new("mkfifo")
        .arg(at("pipe.obj"))
        .status();
    assert!(made.expect("mkfifo runs").success());
    let message = |name| message_in(&scene, name, &Options::default());
    assert_snapshot!(message("a.toml"), @"mesh file refused (a.toml:2:17): `link.obj` points outside the scene folder. Name a file in it, or permit the other folder.");
    assert_snapshot!(message("b.toml"), @"mesh file refused (b.toml:2:17): `pipe.obj` is not a plain file. Name a plain file in the scene folder.");
    assert_snapshot!(message("c.toml"), @"no error");
    assert_snapshot!(message("pipe.obj"), @"cannot read the file (pipe.obj): it is not a plain file. Name a file.");
}

#[test]
fn files_that_are_no_scenes_have_their_messages() {
    let folder = folder(&[
        ("a.fbx", b"{}"),
        ("plain", b"0"),
        ("odd.\u{7}\n", b"0"),
        ("d.toml/x", b""),
    ]);
    let names = [
        "a.fbx",
        "plain",
        "odd.\u{7}\n",
        "d.toml",
        "gone.toml",
        "gone.scene",
        "gone/a.obj",
    ];
    let lines: Vec<_> = names
        .iter()
        .map(|name| message_in(&folder, name, &Options::default()))
        .collect();
    assert_snapshot!(lines.join("\n"), @r"
unknown scene format (a.fbx): the extension `.fbx` is not supported. Use a .toml, .scene, .nff, .obj, .gltf, .glb, .ply, .stl or .zip file; convert other models to one of these.
unknown scene format (plain): the name has no extension. Use a .toml, .scene, .nff, .obj, .gltf, .glb, .ply, .stl or .zip file; convert other models to one of these.
unknown scene format (odd.��): the extension `.\u{7}\n` is not supported. Use a .toml, .scene, .nff, .obj, .gltf, .glb, .ply, .stl or .zip file; convert other models to one of these.
cannot read the file (d.toml): it is a folder. Name a file.
cannot read the file (gone.toml): no such file or folder. Check the path and its permissions.
cannot read the file (gone.scene): no such file or folder. Check the path and its permissions.
cannot read the file (gone/a.obj): no such file or folder. Check the path and its permissions.
");
}

#[test]
fn extensions_may_be_upper_case() {
    let folder = folder(&[
        ("A.SCENE", b"0 amb: 0 0 0"),
        ("B.Obj", TRIANGLE),
        ("C.TOML", b"#"),
    ]);
    for name in ["A.SCENE", "B.Obj", "C.TOML"] {
        import::load(&folder.path().join(name)).expect(name);
    }
}

#[test]
fn a_scene_in_the_current_folder_needs_no_path() {
    let error = import::load(Path::new("gone.toml")).expect_err("there is none");
    assert_snapshot!(without_folder(&error, Path::new(".")), @"cannot read the file (gone.toml): no such file or folder. Check the path and its permissions.");
}
