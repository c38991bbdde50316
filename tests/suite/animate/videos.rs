//! Videos, name patterns, and the same frame from other commands.

#[cfg(unix)]
use crate::support::program::Run;
use crate::support::program::Workspace;
use std::fs;

/// Number of frames in a Y4M stream of the tests' frame size.
fn y4m_frames(bytes: &[u8]) -> usize {
    let end = bytes.iter().position(|&b| b == b'\n').expect("a header");
    let header = std::str::from_utf8(&bytes[..end]).expect("text");
    assert!(header.starts_with("YUV4MPEG2 W32 H24 "), "{header}");
    let marks = bytes[end..].windows(7).filter(|part| part == b"\nFRAME\n");
    // The first marker follows the header, the others follow pixels.
    let others = bytes[end..].windows(6).filter(|part| part == b"FRAME\n");
    assert!(marks.count() >= 1);
    others.count()
}

#[test]
fn a_video_with_kept_frames_is_encoded_again_without_rendering() {
    let workspace = Workspace::moving();
    let run = workspace.animate("--frames 0..7 -o v.y4m --keep-frames", 0);
    assert_eq!(run.counts(), (8, 0));
    assert_eq!(workspace.frames("v.y4m.frames").len(), 8);
    let animation = &run.report["animation"];
    assert_eq!(animation["video"], "v.y4m");
    assert_eq!(animation["frame_files"], "v.y4m.frames/frame_%04d.png");
    assert!(
        animation["encode_seconds"]
            .as_f64()
            .is_some_and(|s| s > 0.0)
    );
    let video = workspace.read("v.y4m");
    assert_eq!(y4m_frames(&video), 8);

    fs::remove_file(workspace.path("v.y4m")).expect("removed");
    let again = workspace.animate("--frames 0..7 -o v.y4m --encode-only", 0);
    assert_eq!(again.counts(), (0, 8));
    assert!(again.report["adapter"].is_null());
    assert!(workspace.read("v.y4m") == video);
    // With every other frame, the video has half the frame rate.
    let half = workspace.animate(
        "--frames 0..7 --step 2 -o w.y4m --frames-dir v.y4m.frames",
        0,
    );
    assert_eq!(half.counts(), (0, 4));
    assert_eq!(y4m_frames(&workspace.read("w.y4m")), 4);
    let rate = |bytes: Vec<u8>| {
        let text = String::from_utf8_lossy(&bytes).into_owned();
        let field = text.split_whitespace().find(|field| field.starts_with('F'));
        let (n, d) = field.expect("a rate")[1..]
            .split_once(':')
            .expect("a ratio");
        n.parse::<f64>().expect("a number") / d.parse::<f64>().expect("a number")
    };
    assert_eq!((rate(video), rate(workspace.read("w.y4m"))), (24.0, 12.0));

    fs::remove_file(workspace.path("v.y4m.frames/frame_0002.png")).expect("removed");
    let run = workspace.animate("--frames 0..8 -o v.y4m --encode-only", 3);
    run.says("frame 2: its file is missing; frame 8: not rendered yet");
    workspace.animate("--frames 0..2 -o none.y4m --encode-only", 3);
    assert!(!workspace.path("none.y4m.frames").exists());
}

#[test]
fn frames_are_removed_once_their_video_is_written() {
    let workspace = Workspace::moving();
    let run = workspace.animate("--frames 0..3 -o v.y4m", 0);
    assert_eq!(run.counts(), (4, 0));
    assert!(run.report["animation"]["frame_files"].is_null());
    assert_eq!(workspace.made(), ["v.y4m"]);
}

/// The video is longer than a file may be, and each frame is not.
#[cfg(unix)]
#[test]
fn a_video_that_cannot_be_written_leaves_all_its_frames() {
    let workspace = Workspace::moving();
    let line = "animate a.toml --size 96x72 --samples 1 -o v.y4m --report -";
    let mut shell = std::process::Command::new("sh");
    shell.args(["-c", &format!("ulimit -f 64; exec \"$G\" {line}")]);
    shell.env("G", env!("CARGO_BIN_EXE_glimray"));
    let output = shell.current_dir(workspace.path(".")).output();
    let run = Run::from(output.expect("a shell")).expect(4);
    run.says("All 7 frames are kept in v.y4m.frames; the same command resumes with encoding.");
    assert!(!workspace.path("v.y4m").exists());
    assert_eq!(
        workspace.files("v.y4m.frames").len(),
        8,
        "frames and journal"
    );
    assert_eq!(workspace.run(line).expect(0).counts(), (0, 7));
    assert_eq!(workspace.made(), ["v.y4m"]);
}

#[test]
fn frames_of_other_ranges_outlive_a_video() {
    let workspace = Workspace::moving();
    workspace.animate("--frames 0..3 -o v.y4m --keep-frames", 0);
    workspace.animate("--frames 0..1 -o v.y4m", 0);
    assert_eq!(
        workspace.frames("v.y4m.frames"),
        ["frame_0002.png", "frame_0003.png"]
    );
    assert_eq!(
        workspace.animate("--frames 2..3 -o v.y4m", 0).counts(),
        (0, 2)
    );
    assert!(!workspace.path("v.y4m.frames").exists());
}

#[test]
fn discard_frames_keeps_other_files_in_the_folder() {
    let workspace = Workspace::moving();
    fs::create_dir(workspace.path("d")).expect("a folder");
    workspace.write("d/mine.txt", "mine");
    let flags = "--frames 0..2 -o v.y4m --frames-dir d --discard-frames";
    let run = workspace.animate(flags, 0);
    assert!(run.report["animation"]["frame_files"].is_null());
    let left: Vec<_> = workspace.files("d").into_keys().collect();
    assert_eq!(left, ["mine.txt"]);
}

#[test]
fn a_stream_is_only_the_video_and_leaves_no_file() {
    let workspace = Workspace::moving();
    let line = "animate a.toml --size 32x24 --frames 0..3 --quiet -o - --format y4m";
    let run = workspace.run(line).expect(0);
    assert_eq!(y4m_frames(&run.stdout), 4);
    assert_eq!(run.stderr, "");
    assert_eq!(workspace.files(".").len(), 1);
    // With a folder for the frames, the same stream can be written again.
    let kept = workspace.run(&format!("{line} --frames-dir d")).expect(0);
    assert!(kept.stdout == run.stdout);
    assert_eq!(workspace.frames("d").len(), 4);
    let again = workspace.run(&format!("{line} --frames-dir d --verbose").replace("--quiet", ""));
    assert!(again.expect(0).stdout == run.stdout);
}

#[test]
fn loop_leaves_out_the_last_frame() {
    let workspace = Workspace::moving();
    for (range, numbers) in [
        ("--frames 0..4 --loop", vec![0, 1, 2, 3]),
        ("--frames 0..4 --loop --step 2", vec![0, 2]),
        ("--frames 1..4 --step 2", vec![1, 3]),
        ("--frames 2", vec![2]),
        ("--frames ..1", vec![0, 1]),
    ] {
        fs::create_dir(workspace.path("f")).expect("a folder");
        let run = workspace.animate(&format!("{range} -o f/####.png"), 0);
        let expected: Vec<_> = numbers.iter().map(|n| format!("{n:04}.png")).collect();
        assert_eq!(workspace.frames("f"), expected, "{range}");
        let animation = &run.report["animation"];
        assert_eq!(animation["first"], numbers[0]);
        assert_eq!(animation["last"], *numbers.last().expect("a number"));
        fs::remove_dir_all(workspace.path("f")).expect("removed");
    }
}

#[test]
fn frame_names_follow_the_pattern() {
    let workspace = Workspace::moving();
    for (pattern, name, journal) in [
        ("a%%b_%03d.png", "a%b_007.png", "a%b_journal.png.jsonl"),
        ("take#2_%d.jpg", "take#2_7.jpg", "take#2_journal.jpg.jsonl"),
        ("%5d.exr", "00007.exr", "journal.exr.jsonl"),
        ("100%%_##.hdr", "100%_07.hdr", "100%_journal.hdr.jsonl"),
        // Only the last folder is created.
        ("new/x%d.png", "new/x7.png", "new/xjournal.png.jsonl"),
    ] {
        workspace.animate(&format!("--frames 7 -o {pattern}"), 0);
        assert!(workspace.path(name).is_file(), "{pattern}");
        assert!(workspace.path(journal).is_file(), "{pattern}");
    }
}

#[test]
fn frames_with_another_number_of_digits_are_different_files() {
    let workspace = Workspace::moving();
    workspace.animate("--frames 8..10 -o f_%d.png", 0);
    let run = workspace.animate("--frames 8..10 -o f_%02d.png", 0);
    // Frame 10 has two digits in both patterns.
    assert_eq!(run.counts(), (2, 1));
    assert_eq!(
        workspace.frames("."),
        ["f_08.png", "f_09.png", "f_10.png", "f_8.png", "f_9.png"]
    );
}

#[test]
fn render_makes_the_same_frame_as_animate() {
    let workspace = Workspace::moving();
    let flags = "--size 32x24 --samples 3 --fps 10 --shutter 180deg";
    workspace
        .run(&format!("animate a.toml {flags} --frames 3..5 -o f_%d.png"))
        .expect(0);
    for (when, name) in [("--frame 4", "f_4.png"), ("--time 0.5", "f_5.png")] {
        workspace
            .run(&format!("render a.toml {flags} {when} -o one.png"))
            .expect(0);
        assert!(workspace.read("one.png") == workspace.read(name), "{when}");
    }
}

#[test]
fn a_turntable_is_a_loop_of_whole_frames() {
    let workspace = Workspace::moving();
    let flags = "--seconds 0.26 --fps 20 --size 32x24 --report -";
    let run = workspace
        .run(&format!("turntable a.toml {flags} -o t.y4m"))
        .expect(0);
    // 5.2 frames are rounded to 5, numbered from 0.
    assert_eq!(run.counts(), (5, 0));
    assert_eq!(run.report["animation"]["last"], 4);
    assert_eq!(run.report["command"], "turntable");
    assert_eq!(run.report["image"]["samples"], 4);
    assert_eq!(y4m_frames(&workspace.read("t.y4m")), 5);
}
