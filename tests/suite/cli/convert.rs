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
