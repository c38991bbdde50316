//! Bad input for animations: one-line errors, the right exit codes, and no files.

use crate::support::program::Workspace;
use std::fs;

#[test]
fn bad_command_lines_exit_2_and_say_why() {
    let workspace = Workspace::new();
    let video = "-o v.y4m --frames 0..3";
    let animate = |flags: &str| format!("animate a.scene {flags}");
    for (line, why) in [
        (
            animate("-o f_%d.png --frames 5..2"),
            "it is empty: 2 is before 5",
        ),
        (
            animate("-o f_%d.png --frames x..2"),
            "from 0 to 9999999, not `x`",
        ),
        (
            animate("-o f_%d.png --frames -3..2"),
            "from 0 to 9999999, not `-3`",
        ),
        (
            animate("-o f_%d.png --frames 4 --loop"),
            "there are no frames (--frames, --loop)",
        ),
        (
            animate("-o f_%d.png"),
            "nothing moves in the scene (--frames)",
        ),
        (
            animate("-o f_%d.png --frames 3.."),
            "nothing moves in the scene (--frames)",
        ),
        (animate(&format!("{video} --step 0")), "0 is not in 1.."),
        (
            animate(&format!("{video} --fps 0")),
            "from 0.01 to 1000, not `0`",
        ),
        (
            animate(&format!("{video} --fps -24")),
            "from 0.01 to 1000, not `-24`",
        ),
        (
            animate(&format!("{video} --fps NaN")),
            "from 0.01 to 1000, not `NaN`",
        ),
        (
            animate(&format!("{video} --shutter -0.5")),
            "from 0 to 16, not `-0.5`",
        ),
        (
            animate(&format!("{video} --shutter -90deg")),
            "the angle must be a number from 0 to 5760",
        ),
        (
            animate(&format!("{video} --shutter 0.5..0.1")),
            "it closes before it opens",
        ),
        (
            animate(&format!("{video} --shutter inf")),
            "from 0 to 16, not `inf`",
        ),
        (
            animate("--frames 0..3 -o v.avi"),
            "none of the extensions .mp4, .gif, .y4m of a video",
        ),
        (animate("--frames 0..3 -o v"), "none of the extensions"),
        (
            animate("--frames 0..3 -o f.png"),
            "the name has no placeholder for the frame number. Write NAME_%04d.png",
        ),
        (
            animate("--frames 0..3 -o f_%s.png"),
            "`%s` is not a placeholder",
        ),
        (
            animate("--frames 0..3 -o f_%d_%d.png"),
            "more than one placeholder",
        ),
        (
            animate("--frames 0..3 -o f_##_##.png"),
            "more than one placeholder",
        ),
        (
            animate("--frames 0..3 -o f_%99d.png"),
            "is not a placeholder",
        ),
        (
            animate("--frames 0..3 -o x%d/f.png"),
            "the name has no placeholder for the frame number",
        ),
        (
            animate("--frames 0..3 -o f%d.png --frames-dir d"),
            "cannot use --frames-dir",
        ),
        (
            animate("--frames 0..3 -o f%d.png --encode-only"),
            "cannot use --encode-only",
        ),
        (
            animate("--frames 0..3 -o f%d.png --discard-frames"),
            "cannot use --discard-frames",
        ),
        (
            animate("--frames 0..3 -o - --format mp4"),
            "only Y4M can be streamed",
        ),
        (
            animate("--frames 0..3 -o - --format png"),
            "only Y4M can be streamed",
        ),
        (
            animate("--frames 0..3 -o v.y4m --report v.y4m"),
            "the picture goes there",
        ),
        (
            animate("--frames 0..3 -o v.y4m --report ./v.y4m"),
            "the picture goes there",
        ),
        (
            animate("--frames 0..3 -o f_%04d.png --report ./f_0002.png"),
            "the picture goes there",
        ),
        (
            animate("--frames 0..3 -o ./f_%04d.png --report f_journal.png.jsonl"),
            "the picture goes there",
        ),
        (
            animate("--frames 0..3 -o f%d.jpg --size 65536x1"),
            "JPEG supports at most",
        ),
        (
            animate(&format!("{video} --quality 0")),
            "0 is not in 1..=100",
        ),
        (
            "turntable a.scene --seconds 0".into(),
            "from 0.01 to 10000, not `0`",
        ),
        (
            "turntable a.scene --axis 0,0,0".into(),
            "it must be x, y, z or a direction such as 0,1,0, not `0,0,0`",
        ),
        (
            "turntable a.scene --axis up".into(),
            "it must be x, y, z or a direction such as 0,1,0, not `up`",
        ),
        ("turntable a.scene --elevation 90".into(), "from -89 to 89"),
        (
            "turntable a.scene --seconds 10000 --fps 1000".into(),
            "too many frames",
        ),
        (
            "render a.scene --frame 1 --time 1".into(),
            "cannot be used with",
        ),
        (
            "render a.scene --time inf".into(),
            "from -1000000 to 1000000, not `inf`",
        ),
        ("render a.scene --frame -1".into(), "-1"),
    ] {
        let run = workspace.run(&line).expect(2);
        run.says(why);
        assert!(run.stderr.starts_with("error: "), "{line}: {}", run.stderr);
        assert_eq!(run.stderr.matches("error:").count(), 1, "{line}");
        assert!(run.stdout.is_empty(), "{line}");
    }
    assert_eq!(workspace.files(".").len(), 1);
    assert_eq!(
        fs::read_dir(workspace.path(".")).expect("a folder").count(),
        1
    );
}

#[test]
fn places_that_cannot_be_written_exit_4_before_any_rendering() {
    let workspace = Workspace::new();
    workspace.write("file", "not a folder");
    workspace.write("old.y4m", "old");
    for (flags, why) in [
        (
            "-o no/where/f_%d.png",
            "the folder no does not exist. Create it first.",
        ),
        (
            "-o no/v.y4m",
            "the folder no does not exist. Create it first.",
        ),
        ("-o file/f_%d.png", "(file/"),
        ("-o v.y4m --frames-dir file", "(file/"),
        (
            "-o old.y4m --no-clobber",
            "it exists and must not be replaced",
        ),
    ] {
        let run = workspace.animate(&format!("--frames 0..3 {flags}"), 4);
        run.says(why);
        assert_eq!(run.stderr.matches("error:").count(), 1, "{}", run.stderr);
    }
    assert_eq!(workspace.read("old.y4m"), b"old");
    assert_eq!(
        fs::read_dir(workspace.path(".")).expect("a folder").count(),
        3
    );
}

#[test]
fn no_clobber_keeps_foreign_frames_and_resumes_its_own() {
    let workspace = Workspace::new();
    let flags = "--frames 0..3 -o f_%d.png --no-clobber";
    workspace.write("f_2.png", "a stranger's");
    let run = workspace.animate(flags, 4);
    run.says("error: cannot write frame 2 (f_2.png): the file exists, and no known run of this animation");
    assert_eq!(workspace.read("f_2.png"), b"a stranger's");
    assert_eq!(workspace.frames("."), ["f_2.png"]);

    let run = workspace.animate(flags.trim_end_matches("--no-clobber"), 0);
    run.says("re-rendering frame 2: no known run wrote the file");
    fs::remove_file(workspace.path("f_3.png")).expect("removed");
    assert_eq!(workspace.animate(flags, 0).counts(), (1, 3));
}
