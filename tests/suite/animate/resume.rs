//! Resumable runs.

use crate::support::PATIENCE;
use crate::support::program::{MOVING, Workspace};
use crate::support::random::Random;
use std::fs;
use std::io::{BufRead, BufReader, Read};
use std::process::Command;
use std::thread::sleep;
use std::time::{Duration, Instant};

/// Waits until a folder has `count` frames.
fn wait_for(workspace: &Workspace, folder: &str, count: usize) {
    let start = Instant::now();
    while workspace.frames(folder).len() < count {
        assert!(start.elapsed() < PATIENCE, "no frames");
        sleep(Duration::from_millis(2));
    }
}

#[test]
fn killed_runs_leave_whole_frames_and_the_final_result_is_the_same() {
    let workspace = Workspace::moving();
    for folder in ["whole", "killed"] {
        fs::create_dir(workspace.path(folder)).expect("a folder");
    }
    let flags = "--size 96x72 --samples 2 --frames 0..23";
    let line = |folder| format!("animate a.toml {flags} -o {folder}/f_%04d.png");
    workspace.run(&line("whole")).expect(0);
    let whole = workspace.files("whole");
    assert_eq!(whole.len(), 25, "24 frames and their journal");

    let mut random = Random::new(17);
    for kill in 0..5 {
        let mut run = workspace.start(&line("killed"));
        wait_for(&workspace, "killed", 1 + kill * 4 + random.below(4));
        sleep(Duration::from_micros(random.below(40_000) as u64));
        run.kill().expect("killed");
        run.wait().expect("it ends");
        for (name, bytes) in workspace.files("killed") {
            let is_frame = name.starts_with("f_0");
            assert!(!is_frame || whole[&name] == bytes, "{name} is not whole");
        }
    }
    let there = workspace.frames("killed").len() as u64;
    let last = workspace
        .run(&format!("{} --report -", line("killed")))
        .expect(0);
    let (rendered, reused) = last.counts();
    assert_eq!(rendered + reused, 24);
    // Each killed run may leave one whole frame that the journal does not know.
    assert!(reused + 5 >= there && rendered < 24, "{reused} of {there}");
    assert!(workspace.files("killed") == whole);
}

#[test]
fn only_a_deleted_truncated_or_modified_frame_is_rendered_again() {
    let workspace = Workspace::moving();
    let flags = "--frames 0..5 -o f_%d.png";
    assert_eq!(workspace.animate(flags, 0).counts(), (6, 0));
    let whole = workspace.files(".");
    assert_eq!(workspace.animate(flags, 0).counts(), (0, 6));

    fs::remove_file(workspace.path("f_3.png")).expect("removed");
    let run = workspace.animate(flags, 0);
    assert_eq!(run.counts(), (1, 5));
    run.says("5 of 6 frames are already done");
    run.says("re-rendering frame 3: its file is missing");

    let bytes = workspace.read("f_4.png");
    workspace.write("f_4.png", &bytes[..bytes.len() / 2]);
    let run = workspace.animate(flags, 0);
    assert_eq!(run.counts(), (1, 5));
    run.says("re-rendering frame 4: its file has been modified");

    // One bit differs in a file of equal length.
    let mut bytes = workspace.read("f_0.png");
    *bytes.last_mut().expect("bytes") ^= 1;
    workspace.write("f_0.png", bytes);
    assert_eq!(workspace.animate(flags, 0).counts(), (1, 5));
    assert!(workspace.files(".") == whole);
}

#[test]
fn a_change_is_named_and_all_dependent_frames_are_rendered_again() {
    let workspace = Workspace::moving();
    let flags = "--frames 0..3 -o f_%d.png";
    workspace.animate(flags, 0);
    let redone = |more: &str, why: &str| {
        let run = workspace.animate(&format!("{flags} {more}"), 0);
        assert_eq!(run.counts(), (4, 0), "{more}");
        run.says(&format!("re-rendering frames 0..3: {why}"));
        let redone = &run.report["animation"]["redone"];
        assert_eq!(redone[0]["why"], why);
        assert_eq!(redone[0]["frames"], serde_json::json!([0, 1, 2, 3]));
    };
    redone("--samples 2", "the settings have changed");
    redone("--samples 2 --exposure 1", "the settings have changed");
    redone(
        "--samples 2 --exposure 1 --fov-y 40",
        "moving objects, the camera or the lights have changed",
    );
    workspace.write("a.toml", MOVING.replace("radius = 1", "radius = 2"));
    redone(
        "--samples 2 --exposure 1 --fov-y 40",
        "the scene has changed",
    );
    let journal = String::from_utf8(workspace.read("f_journal.png.jsonl")).expect("text");
    let version = concat!("glimray ", env!("CARGO_PKG_VERSION"));
    let older = journal.replace(version, "glimray 0.0.1");
    assert_ne!(older, journal);
    workspace.write("f_journal.png.jsonl", older);
    redone(
        "--samples 2 --exposure 1 --fov-y 40",
        "another adapter, driver or glimray version rendered it",
    );
    // Flags that do not affect the picture do not matter.
    let more = "--samples 2 --exposure 1 --fov-y 40 --count-rays --memory-limit 512 --quality 5";
    assert_eq!(
        workspace.animate(&format!("{flags} {more}"), 0).counts(),
        (0, 4)
    );
    // Another range of the same pattern reuses existing frames and renders new ones.
    let other = flags.replace("0..3", "2..5") + " " + more;
    assert_eq!(workspace.animate(&other, 0).counts(), (2, 2));
}

#[test]
fn an_unreadable_journal_only_causes_frames_to_be_rendered_again() {
    let workspace = Workspace::moving();
    let flags = "--frames 0..2 -o f_%d.png";
    workspace.animate(flags, 0);
    let whole = workspace.files(".");
    let journal = "f_journal.png.jsonl";
    for (text, rendered) in [
        // A killed run may leave an incomplete last line.
        (whole[journal][..whole[journal].len() - 20].to_vec(), 1),
        (b"{\"glimray_journal\":999}\n".to_vec(), 3),
        (b"\xff\0 no journal".to_vec(), 3),
        (Vec::new(), 3),
    ] {
        workspace.write(journal, &text);
        let run = workspace.animate(flags, 0);
        assert_eq!(run.counts(), (rendered, 3 - rendered), "{}", run.stderr);
        assert!(workspace.files(".") == whole);
    }
}

#[cfg(target_os = "linux")]
#[test]
fn a_full_disk_at_frame_17_keeps_sixteen_frames_and_the_same_command_resumes() {
    let workspace = Workspace::moving();
    fs::create_dir(workspace.path("f")).expect("a folder");
    let flags = "--frames 1..24 -o f/f_%02d.png";
    // A full device in place of the frame.
    std::os::unix::fs::symlink("/dev/full", workspace.path("f/f_17.png")).expect("a link");
    let run = workspace.animate(flags, 4);
    let lines: Vec<_> = run.stderr.lines().collect();
    assert_eq!(
        lines.last().copied(),
        Some(
            "error: cannot write the file (f/f_17.png): no space left on device. Free some space or \
             choose another disk. The error occurred at frame 17; 16 of 24 frames are kept; the same \
             command resumes from there."
        )
    );
    fs::remove_file(workspace.path("f/f_17.png")).expect("removed");
    assert_eq!(workspace.frames("f").len(), 16);
    assert_eq!(workspace.animate(flags, 0).counts(), (8, 16));
    assert_eq!(workspace.files("f").len(), 25);
}

#[cfg(unix)]
#[test]
fn a_second_run_in_a_folder_is_refused_and_ctrl_c_keeps_the_first_ones_frames() {
    let workspace = Workspace::moving();
    fs::create_dir(workspace.path("f")).expect("a folder");
    let line = "animate a.toml --size 32x24 --frames 0..99999 -o f/f_%d.png";
    let mut first = workspace.start(line);
    wait_for(&workspace, "f", 3);
    let second = workspace.animate("--frames 0..3 -o f/other_%d.png", 4);
    second.says("error: cannot write frames (folder f): another run is writing there.");
    assert!(
        workspace
            .files("f")
            .keys()
            .all(|name| !name.starts_with("other"))
    );

    let id = first.id().to_string();
    let kill = Command::new("kill").args(["-INT", &id]).status();
    assert!(kill.expect("kill runs").success());
    let mut text = String::new();
    let mut stderr = BufReader::new(first.stderr.take().expect("a pipe"));
    stderr.read_to_string(&mut text).expect("text");
    assert_eq!(first.wait().expect("it ends").code(), Some(130));
    let frames = workspace.frames("f").len();
    let last = text.lines().last().expect("a line");
    assert_eq!(
        last,
        format!(
            "error: interrupted: {frames} of 100000 frames are kept; the same command resumes from there."
        )
    );
    // Frames and the journal, but no lock and no partial files.
    assert_eq!(workspace.files("f").len(), frames + 1);
    let again = format!("--frames 0..{} -o f/f_%d.png", frames - 1);
    assert_eq!(workspace.animate(&again, 0).counts(), (0, frames as u64));
}

#[test]
fn progress_in_json_has_frame_counts_and_the_time_left() {
    let workspace = Workspace::moving();
    let line = "animate a.toml --size 128x96 --samples 8 --frames 0..9 --quiet --progress json -o f_%d.png";
    let mut run = workspace.start(line);
    let stderr = BufReader::new(run.stderr.take().expect("a pipe"));
    let lines: Vec<serde_json::Value> = stderr
        .lines()
        .map(|line| serde_json::from_str(&line.expect("text")).expect("JSON"))
        .collect();
    assert!(run.wait().expect("it ends").success());
    let last = lines.last().expect("a line");
    assert_eq!(
        (&last["progress"], &last["frames"]),
        (&1.0.into(), &10.into())
    );
    assert_eq!(
        (&last["frame"], &last["frames_done"]),
        (&9.into(), &9.into())
    );
    assert_eq!(last["seconds_left"], 0.0);
    assert!(
        last["frames_per_second"]
            .as_f64()
            .is_some_and(|rate| rate > 0.0)
    );
}
