//! Who renders and merges what on a farm: slices, attempts, frames merged by those who rendered them, kills at any time.

use crate::support::program::{Run, Workspace};
use crate::support::random::Random;
use serde_json::Value;
use std::fs;
use std::process::Command;
use std::thread::sleep;
use std::time::{Duration, Instant};

/// Seven frames, each cut into two films.
const CUT: &str = "--size 32x24 --samples 128 --shutter 180deg --parts 14";

fn status(workspace: &Workspace, folder: &str) -> Value {
    let run = workspace.run(&format!("farm status {folder} --json"));
    run.expect(0).json()
}

/// Compares the frames of `animate` with those of a farm, `one_N.png` and `all_N.png`.
#[track_caller]
fn assert_same_frames(workspace: &Workspace) {
    for frame in 0..7 {
        let one = workspace.read(&format!("one_{frame}.png"));
        let all = workspace.read(&format!("all_{frame}.png"));
        assert!(one == all, "frame {frame}");
    }
}

#[test]
fn a_slice_is_every_nth_part() {
    let workspace = Workspace::new();
    workspace
        .run("farm plan a.scene --size 24x18 --samples 448 --parts 7 --dir farm -o all.png")
        .expect(0);
    workspace.run("farm run farm --slice 1/3 --quiet").expect(0);
    assert_eq!(workspace.names("farm/done"), ["00001.json", "00004.json"]);
    // More tasks than parts: some have nothing to do.
    workspace.run("farm run farm --slice 8/9 --quiet").expect(0);
    workspace.run("farm run farm --slice 0/3 --quiet").expect(0);
    let done = workspace.names("farm/done").len();
    assert_eq!(done, 5);
    for wrong in ["3/3", "1", "0/0", "-1/3"] {
        workspace
            .run(&format!("farm run farm --slice={wrong}"))
            .expect(2);
    }
}

#[test]
fn all_processes_of_a_run_share_its_attempts() {
    let workspace = Workspace::new();
    workspace
        .run("farm plan a.scene --size 24x18 --samples 128 --parts 2 --dir farm -o all.png")
        .expect(0);
    // A folder where the film should be.
    let film = workspace.path("farm/parts/00000.film");
    fs::create_dir(&film).expect("a folder");
    for runs in 1..=2 {
        workspace
            .run("farm run farm --all --jobs 3 --attempts 2 --quiet")
            .expect(4);
        let state = status(&workspace, "farm");
        assert_eq!((&state["done"], &state["failed"]), (&1.into(), &1.into()));
        assert_eq!(state["failures"][0]["attempts"], 2 * runs);
    }
}

#[test]
fn whoever_finishes_a_frame_merges_it() {
    let workspace = Workspace::moving();
    workspace
        .run("animate a.toml --size 32x24 --samples 128 --shutter 180deg --quiet -o one_%d.png")
        .expect(0);
    workspace
        .run(&format!("farm plan a.toml {CUT} --dir farm -o all_%d.png"))
        .expect(0);
    workspace.run("farm run farm 0 --quiet").expect(0);
    assert_eq!(workspace.names("farm/frames"), [""; 0]);
    workspace
        .run("farm run farm --all --jobs 2 --quiet")
        .expect(0);
    let frames = workspace.frames("farm/frames");
    let expected: Vec<_> = (0..7).map(|n| format!("frame_{n:05}.png")).collect();
    assert_eq!(frames, expected);
    // They are used: with another picture and its mark in the place of a frame, that picture is merged.
    let merge = || workspace.run("farm merge farm --quiet").expect(0);
    merge();
    assert_same_frames(&workspace);
    let (frame, mark) = (
        "farm/frames/frame_00003.png",
        "farm/frames/frame_00003.json",
    );
    let own = (workspace.read(frame), workspace.read(mark));
    let other = workspace.read("farm/frames/frame_00004.png");
    let of_other: Value =
        serde_json::from_slice(&workspace.read("farm/frames/frame_00004.json")).expect("JSON");
    let mut forged: Value = serde_json::from_slice(&own.1).expect("JSON");
    forged["picture"] = of_other["picture"].clone();
    workspace.write(frame, &other);
    workspace.write(mark, forged.to_string());
    merge();
    assert!(workspace.read("all_3.png") == other);
    // They are merged again if they are damaged, gone, or of other films.
    workspace.write(mark, &own.1);
    merge();
    assert_same_frames(&workspace);
    fs::remove_file(workspace.path(frame)).expect("removed");
    merge();
    assert_same_frames(&workspace);
    workspace.write(frame, &other);
    forged["films"][1] = "0".into();
    workspace.write(mark, forged.to_string());
    merge();
    assert_same_frames(&workspace);
    assert!(workspace.read(mark) == own.1);
}

#[test]
fn an_animation_killed_at_random_loses_nothing() {
    let workspace = Workspace::moving();
    workspace
        .run("animate a.toml --size 32x24 --samples 128 --shutter 180deg --quiet -o one_%d.png")
        .expect(0);
    let whole = "--size 32x24 --samples 128 --shutter 180deg --parts 3";
    for (index, flags) in [CUT, whole].into_iter().enumerate() {
        workspace
            .run(&format!(
                "farm plan a.toml {flags} --dir farm -o all_%d.png"
            ))
            .expect(0);
        let mut random = Random::new(7 + index as u64);
        let kill = |line: &str, milliseconds: usize| {
            let child = workspace.start(line);
            sleep(Duration::from_millis(milliseconds as u64));
            let id = child.id().to_string();
            let _ = Command::new("kill").args(["-KILL", &id]).status();
            child.wait_with_output().expect("it ends");
        };
        for _ in 0..8 {
            kill("farm run farm --all --quiet", 100 + random.below(500));
        }
        workspace.run("farm run farm --all --quiet").expect(0);
        for _ in 0..4 {
            // Frames that are there are written whole or not at all.
            kill("farm merge farm --quiet", 20 + random.below(200));
        }
        workspace.run("farm merge farm --quiet").expect(0);
        assert_same_frames(&workspace);
        fs::remove_dir_all(workspace.path("farm")).expect("removed");
    }
}

#[test]
fn status_follows_until_all_is_done() {
    let workspace = Workspace::new();
    workspace
        .run("farm plan a.scene --size 64x48 --samples 1024 --integrator path --parts 4 --dir farm -o all.png")
        .expect(0);
    let mut follower = workspace.command("farm status farm --follow");
    let follower = follower
        .stdout(std::process::Stdio::piped())
        .stderr(std::process::Stdio::piped())
        .spawn()
        .expect("glimray runs");
    let begun = Instant::now();
    workspace.run("farm run farm --all --quiet").expect(0);
    let run = Run::from(follower.wait_with_output().expect("it ends")).expect(0);
    assert!(begun.elapsed() < Duration::from_secs(120));
    assert_eq!(
        run.text(),
        "4 of 4 parts done, 0 running, 0 failed, 0 waiting\nnext: glimray farm merge farm\n"
    );
    // A signal ends it where nobody renders.
    fs::remove_file(workspace.path("farm/done/00002.json")).expect("removed");
    let follower = workspace.start("farm status farm --follow");
    sleep(Duration::from_millis(400));
    let id = follower.id().to_string();
    let kill = Command::new("kill").args(["-TERM", &id]).status();
    assert!(kill.expect("kill runs").success());
    Run::from(follower.wait_with_output().expect("it ends")).expect(143);
}

#[test]
fn scenes_and_files_behind_symbolic_links_are_packed() {
    use std::os::unix::fs::symlink;
    let workspace = Workspace::new();
    fs::create_dir_all(workspace.path("real/scenes/deep")).expect("folders");
    let quad = "v -1 -1 -3\nv 1 -1 -3\nv 0 1 -3\nf 1 2 3\n";
    workspace.write("real/quad.obj", quad);
    let scene = "[[objects]]\nmesh = { file = \"../quad.obj\" }\n[[objects]]\nmesh = { file = \"other.obj\" }\n";
    workspace.write("real/scenes/a.toml", scene);
    workspace.write("real/other.obj", quad.replace("-3", "-4"));
    symlink("../other.obj", workspace.path("real/scenes/other.obj")).expect("a link");
    symlink("real/scenes", workspace.path("link")).expect("a link");
    symlink("real/scenes/deep", workspace.path("down")).expect("a link");
    // `down/..` is `real/scenes`, and not the workspace.
    for path in ["real/scenes/a.toml", "link/a.toml", "down/../a.toml"] {
        let flags = format!("{path} --allow-dir real --size 24x18 --samples 128 --quiet");
        workspace
            .run(&format!("render {flags} -o one.png"))
            .expect(0);
        workspace
            .run(&format!(
                "farm plan {flags} --parts 2 --dir farm -o all.png"
            ))
            .expect(0);
        fs::rename(workspace.path("real"), workspace.path("gone")).expect("renamed");
        workspace.run("farm run farm --all --quiet").expect(0);
        workspace.run("farm merge farm --quiet").expect(0);
        assert!(
            workspace.read("all.png") == workspace.read("one.png"),
            "{path}"
        );
        fs::rename(workspace.path("gone"), workspace.path("real")).expect("renamed");
        fs::remove_dir_all(workspace.path("farm")).expect("removed");
    }
}
