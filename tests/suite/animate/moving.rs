//! Frames of animated scenes: their range, which of them are equal, and turntables.

use crate::support::program::{MOVING, Run, Workspace};
use glimray::output::video;
use std::collections::BTreeSet;
use std::fs;

/// The contents of the frame files, in order of their names.
fn pictures(workspace: &Workspace, folder: &str) -> Vec<Vec<u8>> {
    let files = workspace.files(folder);
    let names = workspace.frames(folder);
    names.iter().map(|name| files[name].clone()).collect()
}

fn span(run: &Run) -> [u64; 3] {
    ["first", "last", "frames"].map(|name| run.report["animation"][name].as_u64().expect(name))
}

#[test]
fn an_animation_ends_at_its_last_key_and_all_its_frames_differ() {
    let workspace = Workspace::moving();
    let run = workspace.animate("-o f_%d.png", 0);
    // 0 to 0.25 seconds at 24 frames per second, including both ends.
    assert_eq!(span(&run), [0, 6, 7]);
    let different: BTreeSet<_> = pictures(&workspace, ".").into_iter().collect();
    assert_eq!(different.len(), 7);
    let other_rate = workspace.animate("--fps 8 -o g_%d.png", 0);
    assert_eq!(span(&other_rate), [0, 2, 3]);
    // Frame N is at N / FPS seconds.
    for (slow, fast) in [(0, 0), (1, 3), (2, 6)] {
        let [slow, fast] = [format!("g_{slow}.png"), format!("f_{fast}.png")];
        assert!(
            workspace.read(&slow) == workspace.read(&fast),
            "{slow} and {fast}"
        );
    }
}

#[test]
fn frames_after_the_end_of_the_animation_are_said() {
    let workspace = Workspace::moving();
    let said = "the animation ends at frame 6";
    let run = workspace.animate("--frames 5..8 -o f_%d.png", 0);
    run.says(said);
    assert_eq!(span(&run), [5, 8, 4]);
    for flags in ["--frames 5..6 -o g_%d.png", "--frames 5.. -o h_%d.png"] {
        let run = workspace.animate(flags, 0);
        assert!(!run.stderr.contains(said), "{flags}: {}", run.stderr);
    }
}

#[test]
fn a_loop_drops_the_frame_that_equals_the_first() {
    let workspace = Workspace::moving();
    let there_and_back = "keys = [[0, [-1.5, 0, 0]], [0.125, [0.5, 0.2, 0]], [0.25, [-1.5, 0, 0]]]";
    let keys = MOVING
        .lines()
        .find(|line| line.starts_with("keys"))
        .expect("keys");
    workspace.write("a.toml", MOVING.replace(keys, there_and_back));
    assert_eq!(span(&workspace.animate("-o f_%d.png", 0)), [0, 6, 7]);
    assert!(workspace.read("f_0.png") == workspace.read("f_6.png"));
    assert_eq!(span(&workspace.animate("--loop -o f_%d.png", 0)), [0, 5, 6]);
    workspace.animate("--loop -o f.gif --keep-frames", 0);
    assert_eq!(workspace.frames("f.gif.frames").len(), 6);
}

#[test]
fn ping_pong_tracks_are_extended_to_a_whole_cycle() {
    let workspace = Workspace::moving();
    let to_and_fro = "beyond = \"ping-pong\"\nkeys = [[0, [-1.5, 0, 0]], [0.125, [0.5, 0.2, 0]]]";
    let keys = MOVING
        .lines()
        .find(|line| line.starts_with("keys"))
        .expect("keys");
    workspace.write("a.toml", MOVING.replace(keys, to_and_fro));
    assert_eq!(span(&workspace.animate("-o f_%d.png", 0)), [0, 6, 7]);
    for (out, back) in [(0, 6), (1, 5), (2, 4)] {
        let [out, back] = [out, back].map(|number| workspace.read(&format!("f_{number}.png")));
        assert!(out == back);
    }
    let inspected = workspace.run("inspect a.toml --json").expect(0).report;
    assert_eq!(inspected["animation"]["frames"], 7);
    assert_eq!(inspected["animation"]["duration"], 0.25);
}

#[test]
fn a_frame_is_the_same_alone_in_sequence_and_from_render() {
    let flags = "--samples 4 --shutter 180deg";
    let workspace = Workspace::moving();
    workspace.animate(&format!("{flags} -o f_%d.png"), 0);
    workspace.animate(&format!("{flags} --frames 3 -o alone_%d.png"), 0);
    workspace.animate(
        &format!("{flags} --frames 1..5 --step 2 -o third_%d.png"),
        0,
    );
    let line = format!("render a.toml --size 32x24 {flags}");
    workspace
        .run(&format!("{line} --frame 3 -o one.png"))
        .expect(0);
    workspace
        .run(&format!("{line} --time 0.125 -o at.png"))
        .expect(0);
    let frame = workspace.read("f_3.png");
    for other in ["alone_3.png", "third_3.png", "one.png", "at.png"] {
        assert!(workspace.read(other) == frame, "{other}");
    }
    // Motion blur is visible.
    workspace.animate("--samples 4 --shutter 0 --frames 3 -o sharp_%d.png", 0);
    assert!(workspace.read("sharp_3.png") != frame);
    // The opening time matters: half a frame earlier gives another picture.
    workspace.animate(
        "--samples 4 --shutter -0.25..0.25 --frames 3 -o middle_%d.png",
        0,
    );
    assert!(workspace.read("middle_3.png") != frame);
}

#[test]
fn two_runs_of_a_blurred_animation_are_the_same_byte_for_byte() {
    let run = || {
        let workspace = Workspace::moving();
        workspace.animate("--samples 3 --shutter 270deg -o v.y4m --keep-frames", 0);
        let mut files = workspace.files("v.y4m.frames");
        files.append(&mut workspace.files("."));
        files
    };
    let (first, second) = (run(), run());
    assert_eq!(first.len(), 7 + 3, "frames, their journal, scene and video");
    assert!(first == second);
}

#[test]
fn only_a_deleted_frame_is_rendered_again_and_it_is_the_same() {
    let workspace = Workspace::moving();
    workspace.animate("-o f_%d.png", 0);
    let whole = workspace.files(".");
    fs::remove_file(workspace.path("f_3.png")).expect("removed");
    let run = workspace.animate("-o f_%d.png", 0);
    assert_eq!(run.counts(), (1, 6));
    assert!(workspace.files(".") == whole);
}

#[test]
fn a_changed_key_causes_only_the_affected_frames_to_be_rendered() {
    let workspace = Workspace::moving();
    workspace.animate("-o f_%d.png", 0);
    let before = pictures(&workspace, ".");
    // The change takes effect after 0.125 seconds, which is frame 3.
    workspace.write("a.toml", MOVING.replace("1.5, 0.1, 0", "1.2, 0.3, 0"));
    let run = workspace.animate("-o f_%d.png", 0);
    assert_eq!(run.counts(), (3, 4));
    run.says("re-rendering frames 4..6: moving objects, the camera or the lights have changed");
    let after = pictures(&workspace, ".");
    let is_same: Vec<_> = before.iter().zip(&after).map(|(a, b)| a == b).collect();
    assert_eq!(is_same, [true, true, true, true, false, false, false]);
    // They equal the frames of a fresh run.
    let fresh = Workspace::moving();
    fresh.write("a.toml", workspace.read("a.toml"));
    fresh.animate("-o f_%d.png", 0);
    assert!(pictures(&fresh, ".") == after);
}

#[test]
fn animated_lights_materials_and_scales_make_frames_differ() {
    let track = |table: &str| format!("{MOVING}\n[[animation]]\n{table}\n");
    let scenes = [
        "light = \"lamp\"\nproperty = \"intensity\"\nkeys = [[0, 1], [0.25, 0.4]]",
        "material = \"red\"\nproperty = \"diffuse\"\nkeys = [[0, [0.7, 0.1, 0.1]], [0.25, [0.1, 0.1, 0.9]]]",
        "object = \"ball\"\nproperty = \"scale\"\nkeys = [[0, 1], [0.25, 0.5]]",
    ];
    // Nothing else moves.
    let still = |text: &str| {
        let from = text.find("[[animation]]").expect("an animation");
        let to = from + text[from + 1..].find("[[animation]]").expect("another") + 1;
        let text = format!("{}{}", &text[..from], &text[to..]);
        text.replace("[[lights]]\n", "[[lights]]\nname = \"lamp\"\n")
    };
    for table in scenes {
        let workspace = Workspace::moving();
        workspace.write("a.toml", still(&track(table)));
        let run = workspace.animate("--fps 8 -o f_%d.png", 0);
        assert_eq!(span(&run), [0, 2, 3]);
        let different: BTreeSet<_> = pictures(&workspace, ".").into_iter().collect();
        assert_eq!(different.len(), 3, "{table}");
    }
}

/// Mean squared difference of the 8-bit channels of two pictures.
fn distance(a: &video::Picture8, b: &video::Picture8) -> f64 {
    let pairs = a.pixels.iter().flatten().zip(b.pixels.iter().flatten());
    let squares = pairs.map(|(a, b)| (f64::from(*a) - f64::from(*b)).powi(2));
    squares.sum::<f64>() / (3 * a.pixels.len()) as f64
}

#[test]
fn a_turn_is_seamless_and_keeps_the_model_in_the_picture() {
    // An elongated model away from the origin that looks different from every side.
    let workspace = Workspace::moving();
    workspace.write(
        "model.obj",
        "v 1 0 0\nv 5 0 0.4\nv 3 1.5 0\nv 3 0.2 1\nf 1 2 3\nf 1 4 2\nf 2 4 3\nf 1 3 4\n",
    );
    let frames = 16;
    let flags = format!(
        "--seconds 2 --fps {} --size 48x32 --background 0,0,0",
        frames / 2
    );
    workspace
        .run(&format!("turntable model.obj {flags} -o t_%02d.png"))
        .expect(0);
    let pictures: Vec<_> = (0..frames)
        .map(|i| video::read_frame(&workspace.path(&format!("t_{i:02}.png"))).expect("a frame"))
        .collect();
    assert_eq!(workspace.frames(".").len(), frames);
    for (i, picture) in pictures.iter().enumerate() {
        let lit = |x: usize, y: usize| picture.pixels[y * 48 + x].iter().any(|&c| c > 8);
        let seen = (0..48 * 32).filter(|i| lit(i % 48, i / 48)).count();
        assert!(seen > 40, "frame {i}: only {seen} pixels show the model");
        let at_edge =
            (0..48).any(|x| lit(x, 0) || lit(x, 31)) || (0..32).any(|y| lit(0, y) || lit(47, y));
        assert!(!at_edge, "frame {i}: the model reaches the edge");
    }
    // The step from the last frame to the first is like all others.
    let step = |i: usize| distance(&pictures[i % frames], &pictures[(i + 1) % frames]);
    let inner = (0..frames - 1).map(&step);
    let (least, most) = inner.fold((f64::INFINITY, 0.0_f64), |(a, b), d| (a.min(d), b.max(d)));
    let seam = step(frames - 1);
    assert!(
        least > 0.0 && seam >= 0.8 * least && seam <= 1.2 * most,
        "{seam}, others {least} to {most}"
    );
    let different: BTreeSet<_> = pictures.iter().map(|picture| &picture.pixels).collect();
    assert_eq!(different.len(), frames);
}
