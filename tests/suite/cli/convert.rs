//! `convert`.

use crate::support::program::Workspace;
use std::fs;
use std::path::Path;

#[test]
fn a_converted_scene_renders_the_same_picture_and_existing_files_are_kept() {
    let workspace = Workspace::new();
    let scenes = Path::new(env!("CARGO_MANIFEST_DIR")).join("assets/scenes");
    for name in [
        "lighthouse.obj",
        "neutral.nff",
        "spheres_and_triangles.scene",
    ] {
        let from = scenes.join(name);
        let run = workspace
            .run(&format!("convert {} -o new.toml", from.display()))
            .expect(0);
        let files: Vec<_> = run
            .text()
            .lines()
            .map(|line| workspace.path(line))
            .collect();
        assert!(!files.is_empty(), "no files are named");
        assert!(files.iter().all(|file| file.is_file()), "{files:?}");
        let flags = "--size 40x30 --samples 1 --quiet";
        workspace
            .run(&format!("render {} {flags} -o a.exr", from.display()))
            .expect(0);
        workspace
            .run(&format!("render new.toml {flags} -o b.exr"))
            .expect(0);
        let read = |name: &str| fs::read(workspace.path(name)).expect("a picture");
        assert!(read("a.exr") == read("b.exr"), "{name} renders differently");
    }
    // Converting again reuses the same files. Other files of the same name are kept.
    let model = scenes.join("lighthouse.obj");
    let convert = format!("convert {} -o ship.toml", model.display());
    workspace.run(&convert).expect(0);
    let files = || fs::read_dir(workspace.path(".")).expect("a folder").count();
    let before = files();
    workspace.run(&convert).expect(0);
    assert_eq!(files(), before);
    fs::write(workspace.path("ship-lighthouse.ply"), "mine").expect("written");
    workspace.run(&convert).expect(0);
    assert_eq!(
        fs::read(workspace.path("ship-lighthouse.ply")).expect("there"),
        b"mine"
    );
    assert_eq!(files(), before + 1);
    workspace.run(&format!("{convert} --no-clobber")).expect(4);
    workspace.run("convert ship.toml -o ./ship.toml").expect(4);
    workspace.run("convert ship.toml -o ship.obj").expect(2);
    workspace.run("convert gone.toml").expect(3);
    fs::copy(&model, workspace.path("my.model.obj")).expect("a copy");
    fs::write(workspace.path("my.toml"), "mine").expect("written");
    let run = workspace.run("convert my.model.obj").expect(0);
    let last = run.text().lines().last().map(str::to_owned);
    assert_eq!(last.as_deref(), Some("my.model.toml"));
    assert_eq!(fs::read(workspace.path("my.toml")).expect("there"), b"mine");
}

/// A glTF triangle below nodes with these transforms, whose clip has `keys` keys.
fn moving_triangle(workspace: &Workspace, nodes: &str, keys: usize) {
    let times = (0..keys).map(|key| key as f32 / 30.0);
    let places = (0..keys).flat_map(|key| [(key % 7) as f32, (key % 5) as f32, 0.0]);
    let corners = [0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0];
    let numbers = corners.into_iter().chain(times).chain(places);
    let bytes: Vec<u8> = numbers.flat_map(f32::to_le_bytes).collect();
    workspace.write("a.bin", &bytes);
    let (first, length) = (36 + 4 * keys, bytes.len());
    let last = keys as f32 / 30.0;
    workspace.write(
        "a.gltf",
        format!(
            r#"{{"asset": {{"version": "2.0"}}, "buffers": [{{"byteLength": {length}, "uri": "a.bin"}}],
            "bufferViews": [{{"buffer": 0, "byteLength": 36}}, {{"buffer": 0, "byteOffset": 36, "byteLength": {}}},
            {{"buffer": 0, "byteOffset": {first}, "byteLength": {}}}],
            "accessors": [{{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3", "min": [0, 0, 0], "max": [1, 1, 0]}},
            {{"bufferView": 1, "componentType": 5126, "count": {keys}, "type": "SCALAR", "min": [0], "max": [{last}]}},
            {{"bufferView": 2, "componentType": 5126, "count": {keys}, "type": "VEC3"}}],
            "meshes": [{{"primitives": [{{"attributes": {{"POSITION": 0}}}}]}}],
            "nodes": [{nodes}], "scenes": [{{"nodes": [0]}}],
            "animations": [{{"channels": [{{"sampler": 0, "target": {{"node": 0, "path": "translation"}}}}],
            "samplers": [{{"input": 1, "output": 2}}]}}]}}"#,
            4 * keys,
            12 * keys,
        ),
    );
}

#[test]
fn an_animation_that_is_too_long_for_a_scene_file_is_refused_with_what_helps() {
    let workspace = Workspace::new();
    moving_triangle(&workspace, r#"{"mesh": 0}"#, 100_000);
    let run = workspace.run("convert a.gltf -o b.toml").expect(3);
    run.says("The keys of its animation are most of them: render the model as it is.");
    assert!(!workspace.path("b.toml").exists());
    workspace
        .run("render a.gltf --size 8x6 --samples 1 --quiet -o a.png")
        .expect(0);
}

/// Written scenes can be read again, and rendered scenes can be written.
#[test]
fn nodes_that_are_scaled_very_unevenly_are_converted() {
    let workspace = Workspace::new();
    let nodes = r#"{"scale": [0.01, 0.01, 1e6], "children": [1]}, {"rotation": [0.2, 0.4, 0.4, 0.8], "mesh": 0}"#;
    moving_triangle(&workspace, nodes, 3);
    workspace.run("convert a.gltf -o b.toml").expect(0);
    workspace
        .run("render b.toml --size 8x6 --samples 1 --quiet -o b.png")
        .expect(0);
}
