//! A run never overwrites its inputs, whatever output path is given: the same name, another path to it, a
//! symbolic or hard link, or a name that the program chooses.

use crate::support::program::{MOVING, Run, Workspace};
use crate::support::verdict::Verdict;
use glimray::image::Image;
use glimray::output;
use std::fs;

/// A sphere with a picture texture named `TEXTURE`.
const TEXTURED: &str = r#"
[camera]
look_from = [0, 0, 5]
look_at = [0, 0, 0]

[[lights]]
point = { position = [2, 3, 4], intensity = 30 }

[[objects]]
sphere = { center = [0, 0, 0], radius = 1 }
material = { phong = { diffuse = { picture = "TEXTURE" } } }
"#;

const MODEL: &str =
    "mtllib model.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nusemtl paint\nf 1/1 2/1 3/1\n";
const LIBRARY: &str = "newmtl paint\nKd 1 1 1\nmap_Kd model.png\n";

fn picture(workspace: &Workspace, name: &str) {
    let image = Image {
        width: 2,
        height: 2,
        pixels: vec![[1.0, 0.5, 0.0, 1.0]; 4],
    };
    output::save(workspace.path(name), &image).expect("a picture");
}

/// Scenes whose textures have the names of output files.
fn workspace() -> Workspace {
    let workspace = Workspace::new();
    for folder in ["kept", "locked"] {
        fs::create_dir(workspace.path(folder)).expect("a folder");
    }
    for (scene, texture) in [
        ("floor.toml", "floor.png"),
        ("numbered.toml", "numbered_1.png"),
        ("kept.toml", "kept/frame_0001.png"),
        ("lock.toml", "locked/.glimray.lock"),
        ("journal.toml", "f_journal.png.jsonl"),
    ] {
        workspace.write(scene, TEXTURED.replace("TEXTURE", texture));
        picture(&workspace, "texture.png");
        fs::rename(workspace.path("texture.png"), workspace.path(texture)).expect("renamed");
    }
    workspace.write("model.obj", MODEL);
    workspace.write("model.mtl", LIBRARY);
    for name in ["one.png", "two.png"] {
        picture(&workspace, name);
    }
    workspace
}

fn is_refusal(run: &Run) -> bool {
    let (start, words) = (
        "error: cannot write the ",
        ": this run reads that file. Name another one with -",
    );
    let last = run.stderr.lines().last().unwrap_or_default();
    run.code == Some(4) && last.starts_with(start) && last.contains(words)
}

#[test]
fn no_command_writes_a_file_that_it_reads() {
    let workspace = workspace();
    let files = || [".", "kept", "locked"].map(|folder| workspace.files(folder));
    let before = files();
    let mut verdict = Verdict::on("inputs");
    for line in [
        "render floor.toml",
        "render floor.toml -o floor.png",
        "render floor.toml -o kept/../floor.png",
        "render floor.toml -o floor.toml --format png",
        "render floor.toml -o new.png --report floor.toml",
        "render floor.toml -o new.png --report ./floor.png",
        "render a.scene -o a.scene --format exr",
        "render model.obj -o model.mtl --format png",
        // The texture is missing and skipped, but the next run would read it.
        "render model.obj",
        "animate floor.toml --frames 0..2 -o floor.png --format y4m",
        "animate floor.toml --frames 0..2 -o new_%d.png --report floor.png",
        "animate numbered.toml --frames 0..2 -o numbered_%d.png",
        "animate journal.toml --frames 0..2 -o f_%d.png",
        "animate kept.toml --frames 0..2 -o new.y4m --frames-dir kept",
        "animate lock.toml --frames 0..2 -o new.y4m --frames-dir locked",
        "turntable floor.toml -o floor.png --format y4m",
        "explain floor.toml --pixel 1,1 --obj floor.toml",
        "explain floor.toml --pixel 1,1 --obj floor.png",
        "compare one.png two.png --diff one.png",
        "compare one.png two.png --diff ./two.png",
        "convert floor.toml -o floor.toml",
    ] {
        let run = workspace.run(line);
        verdict.that(line, is_refusal(&run), || {
            format!("{:?}: {}", run.code, run.stderr)
        });
        let is_kept = files() == before;
        verdict.that(line, is_kept, || "a file has changed");
    }
    verdict.close();
    insta::assert_snapshot!(workspace.run("render floor.toml").stderr, @"error: cannot write the picture (floor.png): this run reads that file. Name another one with -o.");
}

#[cfg(unix)]
#[test]
fn links_to_an_input_are_refused_too() {
    let workspace = workspace();
    std::os::unix::fs::symlink("floor.png", workspace.path("soft.png")).expect("a link");
    std::os::unix::fs::symlink(workspace.path("."), workspace.path("round")).expect("a link");
    fs::hard_link(workspace.path("floor.png"), workspace.path("hard.png")).expect("a link");
    let before = workspace.files(".");
    let mut verdict = Verdict::on("links");
    for name in ["soft.png", "hard.png", "round/floor.png"] {
        for flags in [format!("-o {name}"), format!("-o new.png --report {name}")] {
            let run = workspace.run(&format!("render floor.toml {flags}"));
            verdict.that(&flags, is_refusal(&run), || {
                format!("{:?}: {}", run.code, run.stderr)
            });
        }
    }
    verdict.that(
        "files",
        workspace.files(".") == before,
        || "a file has changed",
    );
    verdict.close();
}

#[test]
fn the_report_of_an_unreadable_scene_replaces_only_a_report() {
    let workspace = workspace();
    // The texture is named after the syntax error.
    workspace.write(
        "floor.toml",
        format!("nonsense\n{}", TEXTURED.replace("TEXTURE", "floor.png")),
    );
    let before = workspace.files(".");
    workspace
        .run("render floor.toml -o new.png --report floor.png")
        .expect(3);
    assert!(workspace.files(".") == before);
    for _ in 0..2 {
        workspace
            .run("render floor.toml -o new.png --report r.json")
            .expect(3);
        let report: serde_json::Value =
            serde_json::from_slice(&workspace.read("r.json")).expect("JSON");
        assert_eq!(report["error"]["code"], 3);
    }
}

#[cfg(unix)]
#[test]
fn a_frame_that_is_a_link_is_not_written_through() {
    let workspace = Workspace::moving();
    let line =
        "animate a.toml -o k.y4m --size 32x18 --samples 1 --frames 0..2 --keep-frames --quiet";
    workspace.run(line).expect(0);
    workspace.write("outside.txt", "precious");
    for name in ["frame_0001.png", "frame_journal.png.jsonl", ".glimray.lock"] {
        let path = workspace.path("k.y4m.frames").join(name);
        let kept = fs::read(&path).ok();
        let _ = fs::remove_file(&path);
        std::os::unix::fs::symlink("../outside.txt", &path).expect("a link");
        let run = workspace.run(line).expect(4);
        run.says("it is a symbolic link. Remove the link");
        assert_eq!(workspace.read("outside.txt"), b"precious", "{name}");
        assert!(path.is_symlink(), "{name}");
        fs::remove_file(&path).expect("removed");
        if let Some(kept) = kept {
            fs::write(&path, kept).expect("put back");
        }
    }
    // A finished frame that was moved and linked is only read, so it is accepted.
    let frames = workspace.path("k.y4m.frames");
    for name in ["frame_0000.png", "frame_0001.png"] {
        fs::rename(frames.join(name), workspace.path(name)).expect("moved");
        std::os::unix::fs::symlink(format!("../{name}"), frames.join(name)).expect("a link");
    }
    workspace.run(line).expect(0);
    assert!(frames.join("frame_0001.png").is_symlink());
}

#[cfg(target_os = "linux")]
#[test]
fn a_video_into_a_device_or_a_pipe_has_no_frames_beside_it() {
    let workspace = Workspace::moving();
    let line = |flags: &str| format!("animate a.toml --size 16x16 --frames 0..1 --quiet {flags}");
    workspace
        .run(&line("-o /dev/full"))
        .expect(4)
        .says("error: cannot write the file (/dev/full): no space left on device.");
    workspace.run(&line("-o /dev/null")).expect(0);
    workspace
        .run(&line("-o /dev/null --format mp4"))
        .expect(2)
        .says("Name one with --frames-dir");
    for device in ["/dev/full", "/dev/null"] {
        let folder = format!("{device}.frames");
        assert!(!fs::exists(&folder).expect("known"), "{folder} was made");
    }
    // A pipe gets the same bytes as a file.
    let pipe = workspace.path("pipe");
    let made = std::process::Command::new("mkfifo").arg(&pipe).status();
    assert!(made.expect("mkfifo runs").success());
    let reader = std::thread::spawn(move || fs::read(pipe).expect("a video"));
    workspace.run(&line("-o pipe")).expect(0);
    workspace.run(&line("-o file.y4m")).expect(0);
    assert!(reader.join().expect("read") == workspace.read("file.y4m"));
    assert!(!workspace.path("pipe.frames").exists());
}

#[test]
fn a_frame_of_a_video_is_not_replaced_by_the_video() {
    let workspace = Workspace::new();
    workspace.write("b.toml", MOVING);
    let line = "animate b.toml --frames 0..2 -o d/frame_0001.png --format y4m --frames-dir d";
    workspace
        .run(line)
        .expect(2)
        .says("one of its frames has that name");
}

#[cfg(feature = "viewer")]
#[test]
fn a_recording_replaces_only_a_recording() {
    let workspace = workspace();
    let before = workspace.files(".");
    for flags in [
        "floor.toml --record floor.toml",
        "floor.toml --record floor.png",
        "model.obj --record model.mtl",
    ] {
        let run = workspace.run(&format!("view {flags}")).expect(4);
        run.says("that file is no recording, and would be lost. Name another one with --record.");
    }
    workspace.write("r.jsonl", "{\"time\":0.0,\"size\":[640.0,480.0]}\n");
    let run = workspace
        .run("view floor.toml --replay r.jsonl --record r.jsonl")
        .expect(4);
    run.says("error: cannot write the recording (r.jsonl): this run reads that file.");
    fs::remove_file(workspace.path("r.jsonl")).expect("removed");
    assert!(workspace.files(".") == before);
}

#[test]
fn git_ignores_the_picture_of_make_demo() {
    let read = |name: &str| fs::read_to_string(name).expect(name);
    let demo = read("Makefile");
    let recipe = demo
        .split("\ndemo:")
        .nth(1)
        .expect("a recipe")
        .lines()
        .find(|line| line.contains(" demo -o "));
    let name = recipe
        .and_then(|line| line.split("-o ").nth(1))
        .expect("a name");
    let path = format!("/{}", name.trim());
    assert!(
        read(".gitignore").lines().any(|line| line == path),
        "{path}"
    );
}
