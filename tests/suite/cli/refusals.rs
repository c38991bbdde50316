//! Exit codes and messages for bad command lines, scenes and outputs.

use crate::support::program::{SCENE, Workspace};
use std::fs;

#[test]
fn bad_command_lines_exit_2_and_say_why() {
    let workspace = Workspace::new();
    for (flags, why) in [
        (
            "--size 0x0",
            "width and height must be a number from 1 to 1000000, not `0`",
        ),
        ("--size -1x5", "not `-1`"),
        ("--size 640", "WIDTHxHEIGHT"),
        ("--size 1e9x1", "not `1e9`"),
        ("--size 2000000x1", "not `2000000`"),
        ("--samples 0", "0 is not in 1..=65536"),
        ("--samples -3", "-3 is not in"),
        ("--samples many", "invalid digit"),
        ("--look-from nan,0,0", "not `nan`"),
        ("--look-at 1,2", "X,Y,Z: 3 numbers, not 2"),
        ("--look-at 1,2,3,4", "not 4"),
        ("--look-from 1e999,0,0", "not `1e999`"),
        ("--look-from 0,0,-1", "both are the same point"),
        ("--up 0,0,0", "it has zero length"),
        ("--up 0,0,5", "it is parallel to the viewing direction"),
        (
            "--background -1,0,0",
            "every channel must be a number from 0",
        ),
        ("--fov-y 180", "from 0.001 to 179.9"),
        ("--fov-y NaN", "from 0.001 to 179.9"),
        ("--exposure inf", "from -64 to 64"),
        ("--exposure autoo", "`auto`"),
        ("--exposure auto+99", "from -64 to 64"),
        ("--clamp-indirect 0", "from 0.000001 to 1000000"),
        ("--seed -1", "-1"),
        ("--crop 0,0,0,5", "it is empty"),
        ("--crop 0,0,641,5", "outside of 640×480 pixels"),
        ("--camera nobody", "no such camera"),
        ("--quality 0", "0 is not in 1..=100"),
        ("--quality 101", "101 is not in 1..=100"),
        ("--memory-limit 0", "0 is not in"),
        ("--set novalue", "KEY=VALUE"),
        ("--tone acse", "a similar value exists: 'aces'"),
        (
            "--backend opengl",
            "[possible values: vulkan, metal, dx12, gl]",
        ),
        (
            "--integrator rays",
            "[possible values: whitted, path, lecture, normals, depth, ids, uv, heat, samples]",
        ),
        (
            "--filter lanczos",
            "[possible values: box, tent, gaussian, blackman-harris, mitchell]",
        ),
        ("--filter-radius 0", "it must be a number from 0.01 to 16"),
        ("--filter-radius NaN", "it must be a number from 0.01 to 16"),
        (
            "--light-samples 0",
            "it must be a number from 0.001 to 1000",
        ),
        (
            "--light-samples -1",
            "it must be a number from 0.001 to 1000",
        ),
        (
            "--antialias some",
            "[possible values: none, stratified, adaptive]",
        ),
        ("--noise 0", "it must be a number from 0.000001 to 1"),
        ("--max-depth 1001", "1001 is not in 0..=1000"),
        ("--max-depth -1", "invalid value '-1'"),
        ("--offset near", "it must be bound or fixed:DISTANCE"),
        ("--offset fixed:", "a finite number above 0, not ``"),
        ("--offset fixed:0", "a finite number above 0, not `0`"),
        (
            "--offset fixed:-1e-4",
            "a finite number above 0, not `-1e-4`",
        ),
        ("--offset fixed:inf", "a finite number above 0, not `inf`"),
        ("--offset fixed:NaN", "a finite number above 0, not `NaN`"),
        ("--min-throughput 2", "it must be a number from 0 to 1"),
        (
            "--format bmp",
            "[possible values: png, jpeg, jpg, exr, hdr]",
        ),
        ("--quiet --verbose", "cannot be used with"),
        ("--bogus", "unexpected argument '--bogus'"),
        (
            "-o picture.bmp",
            "cannot determine the image format (picture.bmp)",
        ),
        ("-o picture", "cannot determine the image format (picture)"),
        (
            "-o a.jpg --size 65536x1",
            "JPEG supports at most 65535×65535",
        ),
        ("-o a.png --report a.png", "the picture goes there"),
    ] {
        let run = workspace.run(&format!("render a.scene {flags}")).expect(2);
        assert!(run.stderr.contains(why), "{flags}: {}", run.stderr);
        assert!(run.stderr.starts_with("error: "), "{flags}: {}", run.stderr);
        assert_eq!(
            run.stderr.matches("error:").count(),
            1,
            "{flags}: {}",
            run.stderr
        );
        assert!(run.stdout.is_empty(), "{flags}");
    }
    assert!(workspace.made().is_empty());
}

#[test]
fn refused_scenes_exit_3_with_one_line() {
    let workspace = Workspace::new();
    fs::write(
        workspace.path("skips.scene"),
        SCENE.replacen('2', "9 # skip", 1),
    )
    .expect("a scene");
    for line in [
        "render nothing.scene",
        "inspect nothing.scene",
        "render skips.scene --strict",
    ] {
        let run = workspace.run(line).expect(3);
        assert!(run.stderr.starts_with("error: "), "{}", run.stderr);
        assert_eq!(run.stderr.trim_end().lines().count(), 1, "{}", run.stderr);
    }
    let run = workspace.run("inspect skips.scene --strict").expect(3);
    let start = "error: refusing the scene (skips.scene): ";
    let end = "Repair it or omit --strict.\n";
    assert!(
        run.stderr.starts_with(start) && run.stderr.ends_with(end),
        "{}",
        run.stderr
    );
}

#[test]
fn outputs_that_cannot_be_written_exit_4_before_any_rendering() {
    let workspace = Workspace::new();
    fs::write(workspace.path("old.png"), "old").expect("a file");
    let run = |flags: &str| {
        workspace
            .run(&format!("render a.scene {flags}"))
            .expect(4)
            .stderr
    };
    insta::assert_snapshot!(run("-o no/a.png"), @"error: cannot write the file (no/a.png): the folder no does not exist. Create it first.");
    insta::assert_snapshot!(run("-o ."), @"error: cannot write the file (.): it is a folder. Add a file name.");
    insta::assert_snapshot!(run("-o old.png --no-clobber"), @"error: cannot write the file (old.png): it exists and must not be replaced. Choose another name.");
    insta::assert_snapshot!(run("--report no/a.json"), @"error: cannot write the file (no/a.json): the folder no does not exist. Create it first.");
    assert_eq!(fs::read(workspace.path("old.png")).expect("a file"), b"old");
    assert_eq!(workspace.made(), ["old.png"]);
}

/// Flags may be given for several pictures, so those that change nothing are no errors.
#[test]
fn flags_without_effect_get_a_line() {
    let workspace = Workspace::new();
    for (flags, why) in [
        (
            "--integrator whitted --clamp-indirect 1",
            "--clamp-indirect has no effect (--integrator whitted)",
        ),
        (
            "--integrator normals --bsdf spec",
            "--bsdf has no effect (--integrator normals)",
        ),
        (
            "--transparent-shadows",
            "--transparent-shadows has no effect (--integrator whitted)",
        ),
        (
            "--noise 0.1 --samples 4",
            "--noise has no effect (--antialias stratified)",
        ),
        ("--bare", "--bare has no effect (a.scene)"),
        ("--no-lights", "--no-lights has no effect (a.scene)"),
        ("--no-background", "--no-background has no effect (a.scene)"),
        ("--no-ground", "--no-ground has no effect (a.scene)"),
    ] {
        let run = workspace.run(&format!(
            "render a.scene --size 8x8 --quiet {flags} -o a.png"
        ));
        let run = run.expect(0);
        run.says(why);
        assert_eq!(run.stderr.lines().count(), 1, "{}", run.stderr);
    }
    for flags in [
        "--integrator path --clamp-indirect 1 --bsdf spec --transparent-shadows",
        "--antialias adaptive --samples 4 --noise 0.1",
    ] {
        let run = workspace.run(&format!(
            "render a.scene --size 8x8 --quiet {flags} -o a.png"
        ));
        assert_eq!(run.expect(0).stderr, "");
    }
    workspace.write("m.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    let run = workspace.run("render m.obj --size 8x8 --quiet --no-ground -o a.png");
    assert_eq!(run.expect(0).stderr, "");
}

#[test]
fn only_models_get_a_ground() {
    let workspace = Workspace::new();
    for command in [
        "render",
        "explain --pixel 1,1",
        "inspect",
        "convert",
        "turntable",
    ] {
        for ground in ["surface", "shadow"] {
            let run = workspace.run(&format!("{command} a.scene --ground {ground}"));
            run.expect(2).says("only models get one");
        }
    }
}
