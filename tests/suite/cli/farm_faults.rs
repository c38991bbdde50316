//! Farms on machines that fail: signals, full disks, no adapter, different adapters.

use crate::support::program::{Run, Workspace};
use glimray::render::Film;
use serde_json::Value;
use std::process::Command;
use std::thread::sleep;
use std::time::{Duration, Instant};
use xxhash_rust::xxh3::xxh3_128;

fn status(workspace: &Workspace, folder: &str) -> Value {
    workspace
        .run(&format!("farm status {folder} --json"))
        .expect(0)
        .json()
}

/// The command in a shell, after a limit was set.
fn limited(workspace: &Workspace, limit: &str, line: &str) -> Run {
    let program = workspace.command("").get_program().to_owned();
    let mut shell = Command::new("sh");
    shell
        .args(["-c", &format!("{limit}; exec \"$G\" {line}")])
        .env("G", program)
        .current_dir(workspace.path("."));
    Run::from(shell.output().expect("a shell"))
}

/// Gives a film another adapter, and the hash that belongs to it.
fn forge_adapter(workspace: &Workspace, film: &str) {
    let bytes = workspace.read(film);
    let (body, _) = bytes.split_at(bytes.len() - size_of::<u128>());
    let header = Film::read(&bytes[..]).expect("a film").header().clone();
    let name = header.adapters.first().expect("an adapter");
    let at = body
        .windows(name.len())
        .position(|words| words == name.as_bytes())
        .expect("the adapter in the film");
    let mut forged = body.to_vec();
    forged[at] = b'X';
    forged.extend(xxh3_128(&forged).to_le_bytes());
    workspace.write(film, forged);
}

/// One of the names in the warning begins with the forged letter.
#[track_caller]
fn warns_of_forged_adapter(run: &Run) {
    let warning = "warning: the parts are of different adapters (";
    let (_, adapters) = run.stderr.split_once(warning).expect("a warning");
    assert!(
        adapters.starts_with('X') || adapters.contains(", X"),
        "{adapters}"
    );
}

#[test]
fn a_signal_stops_all_processes_and_loses_no_checkpoint() {
    let workspace = Workspace::new();
    let flags = "--size 160x120 --samples 2048 --integrator path";
    let begun = Instant::now();
    workspace
        .run(&format!("render a.scene {flags} --quiet -o one.film"))
        .expect(0);
    // The parts together take as long, on a busy machine too.
    let third = begun.elapsed() / 3;
    for (signal, code) in [("-TERM", 143), ("-INT", 130)] {
        workspace
            .run(&format!(
                "farm plan a.scene {flags} --parts 2 --dir farm -o all.film"
            ))
            .expect(0);
        // To the first process only, as batch engines do.
        let child = workspace.start("farm run farm --all --jobs 2 --quiet");
        let begun = Instant::now();
        while status(&workspace, "farm")["running"] != 2 {
            assert!(begun.elapsed() < Duration::from_secs(60), "nothing runs");
            sleep(Duration::from_millis(20));
        }
        sleep(third);
        let id = child.id().to_string();
        let kill = Command::new("kill").args([signal, &id]).status();
        assert!(kill.expect("kill runs").success());
        let run = Run::from(child.wait_with_output().expect("it ends"));
        assert_eq!(run.code, Some(code), "{}", run.stderr);
        assert_eq!(workspace.names("farm/leases"), [""; 0]);
        let state = status(&workspace, "farm");
        assert_eq!((&state["done"], &state["failed"]), (&0.into(), &0.into()));
        assert_eq!(
            workspace.names("farm/parts"),
            ["00000.checkpoint", "00001.checkpoint"]
        );
        workspace.run("farm run farm --all --quiet").expect(0);
        workspace.run("farm merge farm --quiet").expect(0);
        assert!(workspace.read("all.film") == workspace.read("one.film"));
        std::fs::remove_dir_all(workspace.path("farm")).expect("removed");
    }
}

#[test]
fn a_full_disk_fails_the_part_and_leaves_no_piece_of_it() {
    let workspace = Workspace::new();
    let flags = "--size 64x48 --samples 128";
    workspace
        .run(&format!("render a.scene {flags} --quiet -o one.png"))
        .expect(0);
    workspace
        .run(&format!("farm plan a.scene {flags} --parts 2 -o all.png"))
        .expect(0);
    // 16 blocks of 512 bytes are less than a film of 49 kB.
    let line = "farm run all.png.farm --all --attempts 1 --quiet";
    let run = limited(&workspace, "ulimit -f 16", line).expect(4);
    run.says("file too large");
    assert_eq!(workspace.names("all.png.farm/parts"), [""; 0]);
    let state = status(&workspace, "all.png.farm");
    assert_eq!((&state["done"], &state["failed"]), (&0.into(), &2.into()));
    workspace.run(line).expect(0);
    // Nor is a picture written in part, and the films stay.
    let merge = "farm merge all.png.farm --quiet";
    limited(&workspace, "ulimit -f 1", merge)
        .expect(4)
        .says("file too large");
    assert!(!workspace.path("all.png").exists());
    workspace.run(merge).expect(0);
    assert!(workspace.read("all.png") == workspace.read("one.png"));

    let plan = format!("farm plan a.scene {flags} --parts 2 --dir small -o all.png");
    limited(&workspace, "ulimit -f 0", &plan).expect(4);
    workspace.run("farm run small --all").expect(3);
}

#[cfg(target_os = "linux")]
#[test]
fn a_machine_without_an_adapter_fails_no_part() {
    let workspace = Workspace::new();
    workspace
        .run("farm plan a.scene --size 24x18 --samples 128 --parts 2 --backend vulkan -o all.png")
        .expect(0);
    let mut command = workspace.command("farm run all.png.farm --all --attempts 3");
    for name in ["VK_DRIVER_FILES", "VK_ICD_FILENAMES"] {
        command.env(name, "/nonexistent.json");
    }
    let run = Run::from(command.output().expect("glimray runs")).expect(5);
    run.says("no usable GPU (tried Vulkan)");
    assert_eq!(run.stderr.matches("part ").count(), 1, "{}", run.stderr);
    let state = status(&workspace, "all.png.farm");
    assert_eq!(
        (&state["failed"], &state["waiting"]),
        (&0.into(), &2.into())
    );
}

#[test]
fn parts_of_different_adapters_are_named() {
    let workspace = Workspace::moving();
    workspace
        .run("farm plan a.toml --size 24x18 --samples 128 --frame 1 --parts 2 -o still.png")
        .expect(0);
    workspace
        .run("farm run still.png.farm --all --quiet")
        .expect(0);
    forge_adapter(&workspace, "still.png.farm/parts/00001.film");
    let run = workspace
        .run("farm merge still.png.farm --same-adapter")
        .expect(3);
    run.says("the parts are of different adapters");
    assert!(!workspace.path("still.png").exists());
    let run = workspace.run("farm merge still.png.farm").expect(0);
    warns_of_forged_adapter(&run);

    // Within a frame of an animation they are refused, unless they are asked for.
    workspace
        .run("farm plan a.toml --size 24x18 --samples 128 --frames 1..2 --parts 4 -o f_%d.png --dir film")
        .expect(0);
    workspace.run("farm run film --all --quiet").expect(0);
    forge_adapter(&workspace, "film/parts/00003.film");
    let run = workspace.run("farm merge film").expect(3);
    run.says("the parts are of different adapters");
    let run = workspace.run("farm merge film --mix-adapters").expect(0);
    warns_of_forged_adapter(&run);
    // Frames that are whole may come from different adapters, but not in silence.
    workspace
        .run("farm plan a.toml --size 24x18 --samples 2 --frames 1..2 --parts 2 -o w_%d.png --dir whole")
        .expect(0);
    workspace.run("farm run whole --all --quiet").expect(0);
    let done = "whole/done/00001.json";
    let mut mark: Value = serde_json::from_slice(&workspace.read(done)).expect("JSON");
    mark["adapter"] = "another one".into();
    workspace.write(done, mark.to_string());
    workspace
        .run("farm merge whole --same-adapter")
        .expect(3)
        .says("another one");
    workspace
        .run("farm merge whole")
        .expect(0)
        .says("warning: the frames are of different adapters (another one, ");
    assert!(workspace.path("w_2.png").exists());
    workspace
        .run("farm merge film --mix-adapters --same-adapter")
        .expect(2);
}

#[test]
fn a_lease_lasts_as_long_as_it_says() {
    let workspace = Workspace::new();
    workspace
        .run("farm plan a.scene --size 24x18 --samples 128 --parts 1 -o all.png")
        .expect(0);
    let lease = |text: &str| workspace.write("all.png.farm/leases/00000.0", text);
    let running = || status(&workspace, "all.png.farm")["running"].clone();
    lease("");
    let old = std::fs::File::options()
        .write(true)
        .open(workspace.path("all.png.farm/leases/00000.0"))
        .expect("a lease");
    let age = |seconds: i64| {
        let now = std::time::SystemTime::now();
        let time = match u64::try_from(seconds) {
            Ok(seconds) => now - Duration::from_secs(seconds),
            Err(_) => now + Duration::from_secs(seconds.unsigned_abs()),
        };
        old.set_modified(time).expect("a time");
    };
    for (text, seconds, expected) in [
        ("elsewhere 1 3600\n", 3000, 1),
        ("elsewhere 1 3600\n", 3700, 0),
        ("elsewhere 1 2\n", 5, 0),
        // Not said, or nonsense: 60 seconds.
        ("elsewhere 1\n", 50, 1),
        ("elsewhere 1\n", 70, 0),
        ("elsewhere 1 1e300\n", 70, 0),
        // A clock that was far ahead.
        ("elsewhere 1 60\n", -50, 1),
        ("elsewhere 1 60\n", -1_000_000, 0),
        ("elsewhere 1 NaN\n", 70, 0),
        ("", 50, 1),
    ] {
        lease(text);
        age(seconds);
        assert_eq!(running(), expected, "{text:?} after {seconds} s");
    }
    // A process says how long its own lease lasts.
    lease("elsewhere 1 1\n");
    age(5);
    let flags = "--size 160x120 --samples 8192 --integrator path";
    workspace
        .run(&format!(
            "farm plan a.scene {flags} --parts 1 --dir long -o long.png"
        ))
        .expect(0);
    let mut child = workspace.start("farm run long 0 --lease 7 --quiet");
    let begun = Instant::now();
    while workspace.names("long/leases").is_empty() {
        assert!(begun.elapsed() < Duration::from_secs(60), "no lease");
        sleep(Duration::from_millis(20));
    }
    sleep(Duration::from_millis(200));
    let text = String::from_utf8(workspace.read("long/leases/00000.0")).expect("text");
    let words: Vec<_> = text.split_whitespace().collect();
    assert_eq!(words[1..3], [&child.id().to_string(), "7"]);
    child.kill().expect("killed");
    child.wait().expect("it ends");
}
