//! `farm`: parts of a picture or film, rendered by processes that may be killed at any time, merge to the bytes of one run.

use crate::support::program::{Run, SCENE, Workspace};
use crate::support::random::Random;
use crate::support::verdict::Verdict;
use serde_json::{Value, json};
use std::fs;
use std::io::Write;
use std::os::unix::ffi::OsStrExt;
use std::process::Command;
use std::thread::sleep;
use std::time::Duration;

const STILL: &str = "--size 96x72 --samples 320 --integrator path";

fn manifest(workspace: &Workspace, folder: &str) -> Value {
    let text = workspace.read(&format!("{folder}/manifest.json"));
    serde_json::from_slice(&text).expect("a manifest")
}

fn status(workspace: &Workspace, folder: &str) -> Value {
    let run = workspace.run(&format!("farm status {folder} --json"));
    serde_json::from_str(run.expect(0).text()).expect("a status")
}

/// The rectangle and the samples of a part.
fn extent(part: &Value, whole: [u64; 3]) -> ([u64; 4], [u64; 2]) {
    let numbers = |value: &Value| -> Vec<u64> {
        let list = value.as_array().expect("a list").iter();
        list.map(|number| number.as_u64().expect("a number"))
            .collect()
    };
    let [width, height, samples] = whole;
    let crop = match &part["crop"] {
        Value::Null => [0, 0, width, height],
        crop => numbers(crop).try_into().expect("four"),
    };
    let samples = match &part["samples"] {
        Value::Null => [0, samples],
        range => numbers(range).try_into().expect("two"),
    };
    (crop, samples)
}

#[test]
fn a_still_in_parts_merges_to_the_bytes_of_one_run() {
    let workspace = Workspace::new();
    workspace
        .run(&format!("render a.scene {STILL} --quiet -o one.png"))
        .expect(0);
    workspace
        .run(&format!("farm plan a.scene {STILL} --parts 7 -o all.png"))
        .expect(0);
    // Another machine has the folder only.
    fs::rename(workspace.path("a.scene"), workspace.path("gone.scene")).expect("renamed");
    let parts = manifest(&workspace, "all.png.farm")["parts"]
        .as_array()
        .expect("parts")
        .clone();
    assert!(parts.len() >= 7, "{}", parts.len());
    // Each sample of each pixel is in one part.
    let mut covered = 0;
    for part in &parts {
        let ([x0, y0, x1, y1], [start, end]) = extent(part, [96, 72, 320]);
        assert!(x0 < x1 && y0 < y1 && start < end && start % 64 == 0);
        covered += (x1 - x0) * (y1 - y0) * (end - start);
    }
    assert_eq!(covered, 96 * 72 * 320);

    let run = workspace.run("farm merge all.png.farm").expect(8);
    assert_eq!(run.text().lines().count(), parts.len(), "{}", run.text());
    assert!(run.text().starts_with("glimray farm run all.png.farm 0\n"));
    workspace
        .run("farm run all.png.farm --all --jobs 2 --quiet")
        .expect(0);
    let state = status(&workspace, "all.png.farm");
    assert_eq!(state["done"], parts.len());
    assert_eq!(
        (&state["running"], &state["failed"]),
        (&0.into(), &0.into())
    );
    workspace.run("farm merge all.png.farm").expect(0);
    assert!(workspace.read("all.png") == workspace.read("one.png"));
    assert_eq!(workspace.names("all.png.farm/leases"), [""; 0]);
}

#[test]
fn a_film_in_parts_merges_to_the_bytes_of_one_run() {
    let workspace = Workspace::moving();
    let flags = "--size 32x24 --samples 128 --shutter 180deg";
    workspace
        .run(&format!("animate a.toml {flags} --quiet -o one_%02d.png"))
        .expect(0);
    // Ranges of frames, and frames that are cut themselves.
    for parts in [3, 14] {
        let name = format!("all{parts}_%02d.png");
        workspace
            .run(&format!(
                "farm plan a.toml {flags} --parts {parts} --dir f{parts} -o {name}"
            ))
            .expect(0);
        workspace
            .run(&format!("farm run f{parts} --all --quiet"))
            .expect(0);
        workspace.run(&format!("farm merge f{parts}")).expect(0);
        for frame in 0..7 {
            let one = workspace.read(&format!("one_{frame:02}.png"));
            let all = workspace.read(&format!("all{parts}_{frame:02}.png"));
            assert!(one == all, "frame {frame} of {parts} parts");
        }
    }
}

#[test]
fn processes_killed_at_random_lose_nothing_that_is_done() {
    let workspace = Workspace::new();
    let flags = "--size 120x90 --samples 640 --integrator path";
    workspace
        .run(&format!("render a.scene {flags} --quiet -o one.film"))
        .expect(0);
    workspace
        .run(&format!("farm plan a.scene {flags} --parts 10 -o all.film"))
        .expect(0);
    let mut random = Random::new(5);
    for _ in 0..6 {
        let child = workspace.start("farm run all.film.farm --all --quiet");
        sleep(Duration::from_millis(300 + random.below(900) as u64));
        let id = child.id().to_string();
        let _ = Command::new("kill").args(["-KILL", &id]).status();
        child.wait_with_output().expect("it ends");
        // A killed run may leave an unfinished file beside the marks.
        let mut done = workspace.names("all.film.farm/done");
        done.retain(|name| !name.contains(".part-"));
        assert_eq!(status(&workspace, "all.film.farm")["done"], done.len());
    }
    // The process that held a part is dead: nobody waits for its lease.
    workspace
        .run("farm run all.film.farm --all --quiet --lease 3600")
        .expect(0);
    workspace.run("farm merge all.film.farm").expect(0);
    assert!(workspace.read("all.film") == workspace.read("one.film"));
}

#[test]
fn what_is_damaged_foreign_or_missing_is_named() {
    let workspace = Workspace::new();
    let flags = "--size 24x18 --samples 128";
    workspace
        .run(&format!("farm plan a.scene {flags} --parts 2 -o all.png"))
        .expect(0);
    workspace
        .run("farm run all.png.farm --all --quiet")
        .expect(0);
    // A damaged part is set aside and rendered again.
    let film = "all.png.farm/parts/00001.film";
    let whole = workspace.read(film);
    workspace.write(film, &whole[..whole.len() / 2]);
    let run = workspace.run("farm run all.png.farm 1").expect(0);
    assert!(run.stderr.contains("cut short"), "{}", run.stderr);
    assert!(workspace.read(film) == whole);
    assert!(workspace.path(&format!("{film}.old-1")).exists());
    // A finished part is skipped.
    let run = workspace.run("farm run all.png.farm 1").expect(0);
    assert!(!run.stderr.contains("part 1 of"), "{}", run.stderr);

    workspace.run("farm run all.png.farm 2").expect(2);
    workspace
        .run("farm merge all.png.farm -o all.exr")
        .expect(2);
    workspace
        .run(&format!("farm plan a.scene {flags} --parts 2 -o all.png"))
        .expect(4);
    workspace.run("farm status nowhere").expect(3);
    workspace.write("all.png.farm/scene.zip", "other");
    let run = workspace.run("farm run all.png.farm --all").expect(3);
    assert!(
        run.stderr.contains("not the one that was planned"),
        "{}",
        run.stderr
    );
    let text = workspace.read("all.png.farm/manifest.json");
    let text = String::from_utf8(text).expect("text");
    let other = text.replace("\"glimray\": \"", "\"glimray\": \"9.");
    workspace.write("all.png.farm/manifest.json", other);
    let run = workspace.run("farm run all.png.farm --all").expect(3);
    assert!(run.stderr.contains("same version"), "{}", run.stderr);
}

#[test]
fn results_of_another_farm_are_noticed() {
    let workspace = Workspace::moving();
    for seed in [0, 5] {
        let flags = format!("a.toml --size 24x18 --samples 128 --seed {seed}");
        workspace
            .run(&format!(
                "farm plan {flags} --parts 2 --dir p{seed} -o p{seed}.png"
            ))
            .expect(0);
        workspace
            .run(&format!(
                "farm plan {flags} --frames 0..3 --parts 2 --dir f{seed} -o f{seed}_%d.png"
            ))
            .expect(0);
        for farm in ["p", "f"] {
            workspace
                .run(&format!("farm run {farm}{seed} --all --quiet"))
                .expect(0);
        }
    }
    let film = "p0/parts/00001.film";
    let own = workspace.read(film);
    workspace.write(film, workspace.read("p5/parts/00001.film"));
    workspace
        .run("farm merge p0")
        .expect(3)
        .says("part 1 cannot be used, p0/parts/00001.film is of another picture.");
    workspace
        .run("farm run p0 --all")
        .expect(0)
        .says("part 1 is rendered again: p0/parts/00001.film is of another picture.");
    assert!(workspace.read(film) == own);

    // Frames: of another farm, of another number, cut short, and gone.
    let frame = "f0/parts/00000/frame_00000.png";
    let own = workspace.read(frame);
    for (bytes, why) in [
        (
            workspace.read("f5/parts/00000/frame_00000.png"),
            "is not what was rendered",
        ),
        (
            workspace.read("f0/parts/00001/frame_00002.png"),
            "is not what was rendered",
        ),
        (own[..own.len() / 2].to_vec(), "is not what was rendered"),
    ] {
        workspace.write(frame, bytes);
        workspace.run("farm merge f0").expect(3).says(why);
        workspace.run("farm run f0 0").expect(0).says(why);
        assert!(workspace.read(frame) == own);
    }
    fs::remove_file(workspace.path(frame)).expect("removed");
    assert_eq!(status(&workspace, "f0")["done"], 1);
    let run = workspace.run("farm merge f0").expect(8);
    assert_eq!(run.text(), "glimray farm run f0 0\n");
    workspace.run("farm merge f0 --partial").expect(2);
    fs::remove_file(workspace.path(film)).expect("removed");
    let run = workspace.run("farm merge p0").expect(8);
    assert_eq!(run.text(), "glimray farm run p0 1\n");
    let run = workspace.run("farm merge p0 --partial").expect(0);
    run.says("the picture is incomplete");
    fs::remove_file(workspace.path("p0/parts/00000.film")).expect("removed");
    workspace.run("farm merge p0 --partial").expect(8);
}

#[test]
fn what_could_not_be_merged_is_not_planned() {
    let workspace = Workspace::moving();
    fs::create_dir(workspace.path("folder.png")).expect("a folder");
    let mut verdict = Verdict::on("plans");
    for (flags, code, words) in [
        (
            "-o o.jpg --background transparent --integrator path",
            2,
            "opacity",
        ),
        (
            "-o o.mp4 --background transparent --integrator path",
            2,
            "opacity",
        ),
        ("-o o.png --layers albedo", 2, ".exr"),
        ("-o o.mp4 --layers albedo", 2, ".exr"),
        ("-o o.gif --fps 1000", 2, "frames per second"),
        ("-o f_%d.film", 2, "frames cannot be films"),
        ("-o o.mp4 --frame 3", 2, "--frame and --time"),
        ("-o o.mp4 --time 0.1", 2, "--frame and --time"),
        (
            "-o o.png --report r.json",
            2,
            "each part writes its own report",
        ),
        ("-o folder.png", 2, "it is a folder"),
        ("-o gone/o.png --dir farm", 4, "does not exist"),
        ("-o o.txt", 2, "the name is none of a picture"),
    ] {
        let run = workspace.run(&format!("farm plan a.toml --size 16x12 --parts 2 {flags}"));
        let is_refused = run.code == Some(code) && run.stderr.contains(words);
        verdict.that(flags, is_refused, || {
            format!("{:?}: {}", run.code, run.stderr)
        });
    }
    verdict.close();
    assert_eq!(workspace.made(), ["folder.png"]);
    let name = std::ffi::OsStr::from_bytes(b"bad\xff.png");
    let mut command = workspace.command("farm plan a.toml --size 16x12 --parts 2 -o");
    Run::from(command.arg(name).output().expect("glimray runs"))
        .expect(2)
        .says("not valid Unicode");
    // Names that begin with a dash are names.
    let line = "farm plan a.toml --size 16x12 --samples 128 --parts 2 -o=-o.png";
    workspace
        .run(line)
        .expect(0)
        .says("glimray farm run ./-o.png.farm");
    workspace
        .run("farm run --all --quiet -- -o.png.farm")
        .expect(0);
    workspace.run("farm merge -- -o.png.farm").expect(0);
    assert!(workspace.path("-o.png").exists());
}

/// A changed manifest that makes sense would render another picture, which only the films' fingerprints would show.
#[test]
fn a_manifest_with_one_other_character_is_refused_by_every_step() {
    let workspace = Workspace::new();
    workspace
        .run("farm plan a.scene --size 16x12 --samples 128 --parts 2 --dir still -o o.png")
        .expect(0);
    workspace.run("farm status still").expect(0);
    let good = workspace.read("still/manifest.json");
    let mut verdict = Verdict::on("changed characters");
    let places = (0..good.len()).filter(|&at| good[at].is_ascii_digit());
    for at in places.step_by(3).chain([good.len() - 1]) {
        let mut changed = good.clone();
        changed[at] = if good[at] == b'1' { b'2' } else { b'1' };
        workspace.write("still/manifest.json", &changed);
        for step in [
            "run still --all --attempts 1",
            "merge still",
            "status still",
        ] {
            let run = workspace.run(&format!("farm {step}"));
            let is_refused = run.code == Some(3) && run.stderr.lines().count() == 1;
            verdict.that(format!("{step}, byte {at}"), is_refused, || {
                format!("{:?}: {}", run.code, run.stderr)
            });
        }
    }
    verdict.close();
    let said = String::from_utf8(good.clone()).expect("text");
    let said = said.replace("\"samples\": 128", "\"samples\": 192");
    workspace.write("still/manifest.json", said);
    workspace
        .run("farm run still --all")
        .expect(3)
        .says("its manifest was changed after it was planned. Copy it again, or plan it again with other flags.");
    workspace.write("still/manifest.json", good);
    workspace.run("farm run still --all --quiet").expect(0);
}

#[test]
fn manifests_that_were_changed_are_refused() {
    let workspace = Workspace::moving();
    workspace
        .run("farm plan a.toml --size 16x12 --samples 2 --frames 0..3 --parts 2 --dir film -o f_%d.png")
        .expect(0);
    workspace
        .run("farm plan a.toml --size 16x12 --samples 128 --parts 2 --dir still -o o.png")
        .expect(0);
    let mut verdict = Verdict::on("manifests");
    let mut check = |farm: &str, pointer: &str, value: Value| {
        let good = workspace.read(&format!("{farm}/manifest.json"));
        let mut changed: Value = serde_json::from_slice(&good).expect("a manifest");
        *changed.pointer_mut(pointer).expect(pointer) = value.clone();
        workspace.write(&format!("{farm}/manifest.json"), changed.to_string());
        for step in ["run", "merge", "status"] {
            let flag = if step == "run" {
                "--all --attempts 1"
            } else {
                ""
            };
            let run = workspace.run(&format!("farm {step} {farm} {flag}"));
            let lines = run.stderr.lines().filter(|line| !line.starts_with("part "));
            let is_line = lines.count() == 1;
            let is_refused = run.code == Some(3) && is_line;
            verdict.that(format!("{step} {pointer} {value}"), is_refused, || {
                format!("{:?}: {}", run.code, run.stderr)
            });
        }
        workspace.write(&format!("{farm}/manifest.json"), good);
    };
    for (pointer, value) in [
        ("/frames/step", json!(0)),
        ("/frames/count", json!(u32::MAX)),
        ("/frames/count", json!(7)),
        ("/frames/count", json!(0)),
        ("/frames/first", json!(u32::MAX)),
        ("/parts/0/frames", json!([1, 1])),
        ("/parts/0/frames", json!([77, 78])),
        ("/parts/0/frames", json!([1, 0])),
        ("/parts/1/frames", Value::Null),
        ("/parts", json!([])),
        ("/scene/file", json!("/dev/zero")),
        ("/scene/file", json!("../scene.zip")),
        ("/quality", json!(0)),
        ("/size", json!([0, 12])),
        ("/flags", json!(["--help"])),
        ("/flags", json!(["--bogus=1"])),
    ] {
        check("film", pointer, value);
    }
    for (pointer, value) in [
        ("/parts/0/crop", json!([0, 0, 0, 5])),
        ("/parts/0/crop", json!([0, 0, 4_000_000_000_u32, 5])),
        ("/parts/0/samples", json!([64, 64])),
        ("/parts/0/samples", json!([0, 4096])),
    ] {
        check("still", pointer, value);
    }
    verdict.close();
}

#[test]
fn a_part_that_fails_is_counted_with_its_error() {
    let workspace = Workspace::new();
    workspace
        .run("farm plan a.scene --size 24x18 --samples 128 --parts 2 -o all.png")
        .expect(0);
    // A folder where the film should be.
    fs::create_dir(workspace.path("all.png.farm/parts/00000.film")).expect("a folder");
    workspace
        .run("farm run all.png.farm --all --attempts 2 --quiet")
        .expect(4);
    let state = status(&workspace, "all.png.farm");
    assert_eq!((&state["done"], &state["failed"]), (&1.into(), &1.into()));
    assert_eq!(state["failures"][0]["attempts"], 2);
    fs::remove_dir(workspace.path("all.png.farm/parts/00000.film")).expect("removed");
    workspace
        .run("farm run all.png.farm --all --quiet")
        .expect(0);
    assert_eq!(status(&workspace, "all.png.farm")["done"], 2);
}

#[test]
fn a_lease_of_another_machine_expires() {
    let workspace = Workspace::new();
    workspace
        .run("farm plan a.scene --size 24x18 --samples 128 --parts 1 -o all.png")
        .expect(0);
    workspace.write("all.png.farm/leases/00000.0", "elsewhere 1 3\n");
    assert_eq!(status(&workspace, "all.png.farm")["running"], 1);
    let run = workspace.run("farm run all.png.farm 0").expect(0);
    assert!(
        run.stderr.contains("elsewhere, process 1"),
        "{}",
        run.stderr
    );
    assert_eq!(status(&workspace, "all.png.farm")["done"], 1);
}

#[test]
fn the_scripts_for_slurm_have_the_tasks_and_the_options() {
    let workspace = Workspace::new();
    workspace
        .run("farm plan a.scene --size 24x18 --samples 320 --parts 5 -o all.png")
        .expect(0);
    let run = workspace
        .run(
            "farm submit all.png.farm --engine slurm --dry-run --tasks 2 --partition gpu \
             --gres gpu:1 --time 10:00 --option account=film",
        )
        .expect(0);
    let odd = "a 100%#'\"\\ b";
    fs::rename(workspace.path("all.png.farm"), workspace.path(odd)).expect("renamed");
    let mut command = workspace.command("farm submit --engine slurm --dry-run");
    let output = command.arg(odd).output().expect("glimray runs");
    let script = String::from_utf8(output.stdout).expect("text");
    let escaped = r#"/a 100%%#'\"\\ b/logs/part-%a.log""#;
    let is_log = |line: &str| line.starts_with("#SBATCH --output=\"") && line.ends_with(escaped);
    assert!(script.lines().any(is_log), "{script}");
    fs::rename(workspace.path(odd), workspace.path("all.png.farm")).expect("renamed");
    let mut command = workspace.command("farm submit all.png.farm --engine slurm --dry-run");
    let output = command.args(["--time", "1\n#"]).output();
    Run::from(output.expect("glimray runs")).expect(2);
    for line in [
        "#SBATCH --array=0-1",
        "#SBATCH --partition=gpu",
        "#SBATCH --gres=gpu:1",
        "#SBATCH --time=10:00",
        "#SBATCH --account=film",
        "#SBATCH --requeue",
    ] {
        assert!(run.text().lines().any(|found| found == line), "{line}");
    }
    assert!(run.text().contains("--slice=\"$SLURM_ARRAY_TASK_ID/2\""));
    // A shell can read both.
    workspace.write("jobs.sh", run.text());
    let mut checked = Command::new("sh");
    checked.arg("-n").arg(workspace.path("jobs.sh"));
    assert!(checked.status().expect("a shell").success());
}

#[test]
fn a_part_of_a_picture_is_cut_and_merged_as_such() {
    let workspace = Workspace::moving();
    let flags = "--size 60x40 --samples 128 --crop 11,7,47,30";
    for ending in ["png", "exr", "film"] {
        workspace
            .run(&format!("render a.toml {flags} --quiet -o one.{ending}"))
            .expect(0);
        workspace
            .run(&format!(
                "farm plan a.toml {flags} --parts 4 -o all.{ending}"
            ))
            .expect(0);
        let folder = format!("all.{ending}.farm");
        workspace
            .run(&format!("farm run {folder} --all --quiet"))
            .expect(0);
        workspace.run(&format!("farm merge {folder}")).expect(0);
        let read = |stem: &str| workspace.read(&format!("{stem}.{ending}"));
        assert!(read("all") == read("one"), "{ending}");
    }
    let range = "--frames 2..3";
    workspace
        .run(&format!(
            "animate a.toml {flags} {range} --quiet -o one_%d.exr"
        ))
        .expect(0);
    for parts in [1, 4] {
        workspace
            .run(&format!(
                "farm plan a.toml {flags} {range} --parts {parts} --dir f{parts} -o f{parts}_%d.exr"
            ))
            .expect(0);
        workspace
            .run(&format!("farm run f{parts} --all --quiet"))
            .expect(0);
        workspace.run(&format!("farm merge f{parts}")).expect(0);
        for frame in 2..4 {
            let one = workspace.read(&format!("one_{frame}.exr"));
            let all = workspace.read(&format!("f{parts}_{frame}.exr"));
            assert!(one == all, "frame {frame} of {parts} parts");
        }
    }
}

#[test]
fn a_video_has_the_bytes_of_one_run() {
    let workspace = Workspace::moving();
    let flags = "--size 32x24 --samples 70 --loop --fps 12";
    for ending in ["mp4", "gif", "y4m"] {
        workspace
            .run(&format!("animate a.toml {flags} --quiet -o one.{ending}"))
            .expect(0);
        for parts in [2, 9] {
            workspace
                .run(&format!(
                    "farm plan a.toml {flags} --parts {parts} --dir {ending}{parts} -o all.{ending}"
                ))
                .expect(0);
            workspace
                .run(&format!("farm run {ending}{parts} --all --quiet"))
                .expect(0);
            workspace
                .run(&format!("farm merge {ending}{parts}"))
                .expect(0);
            let read = |stem: &str| workspace.read(&format!("{stem}.{ending}"));
            assert!(read("all") == read("one"), "{ending} of {parts} parts");
        }
    }
}

#[test]
fn parts_need_no_source_tree() {
    let workspace = Workspace::new();
    // A scene that names a picture beside its folder, and light from another folder.
    for folder in ["scenes", "shared", "sky"] {
        fs::create_dir(workspace.path(folder)).expect("a folder");
    }
    let pixels: Vec<[f32; 3]> = (0..32)
        .map(|index| [0.1 * (index % 8) as f32, 0.5, 1.0 / (1 + index) as f32])
        .collect();
    workspace.picture("shared/map.png", 8, &pixels);
    workspace.picture("sky/day.exr", 8, &pixels);
    workspace.write(
        "scenes/a.toml",
        r#"
[camera]
look_from = [0, 0, 6]
look_at = [0, 0, 0]
fov_y_deg = 45

[textures]
map = { picture = { file = "../shared/map.png" } }

[materials]
painted = { phong = { diffuse = { texture = "map" } } }

[[objects]]
sphere = { center = [0, 0, 0], radius = 1.5 }
material = "painted"
"#,
    );
    let flags = "scenes/a.toml --allow-dir shared --environment sky/day.exr --environment-rotation 30 --size 40x30 \
                 --samples 128 --integrator path";
    workspace
        .run(&format!("render {flags} --quiet -o one.exr"))
        .expect(0);
    workspace
        .run(&format!("farm plan {flags} --parts 3 -o all.exr"))
        .expect(0);
    for folder in ["scenes", "shared", "sky"] {
        fs::remove_dir_all(workspace.path(folder)).expect("removed");
    }
    // The folder may lie elsewhere on another machine.
    fs::rename(workspace.path("all.exr.farm"), workspace.path("moved")).expect("renamed");
    workspace.run("farm run moved --all --quiet").expect(0);
    workspace.run("farm merge moved").expect(0);
    assert!(workspace.read("all.exr") == workspace.read("one.exr"));
}

#[test]
fn archives_and_hidden_folders_can_be_planned() {
    let workspace = Workspace::new();
    let mut archive = zip::ZipWriter::new(std::io::Cursor::new(Vec::new()));
    let options = zip::write::SimpleFileOptions::default();
    archive
        .start_file("inner/a.scene", options)
        .expect("a file");
    archive.write_all(SCENE.as_bytes()).expect("written");
    let archive = archive.finish().expect("an archive").into_inner();
    workspace.write("packed.zip", archive);
    fs::create_dir(workspace.path(".hidden")).expect("a folder");
    workspace.write(".hidden/a.scene", SCENE);
    for scene in ["packed.zip", ".hidden/a.scene"] {
        let flags = format!("{scene} --size 24x18 --samples 128");
        workspace
            .run(&format!("render {flags} --quiet -o one.png"))
            .expect(0);
        workspace
            .run(&format!(
                "farm plan {flags} --parts 2 --dir farm -o all.png"
            ))
            .expect(0);
        workspace.run("farm run farm --all --quiet").expect(0);
        workspace.run("farm merge farm").expect(0);
        assert!(
            workspace.read("all.png") == workspace.read("one.png"),
            "{scene}"
        );
        fs::remove_dir_all(workspace.path("farm")).expect("removed");
    }
}

#[test]
fn parts_are_as_long_as_was_asked_for() {
    let workspace = Workspace::new();
    let flags = "--size 320x240 --samples 16384 --integrator path";
    workspace
        .run(&format!(
            "farm plan a.scene {flags} --minutes 0.1 -o all.exr"
        ))
        .expect(0);
    let manifest = manifest(&workspace, "all.exr.farm");
    let measured = |name: &str| manifest["measured"][name].as_f64().expect(name);
    let (start, work) = (measured("start_seconds"), measured("render_seconds"));
    let parts = manifest["parts"].as_array().expect("parts");
    let seconds = |part: &Value| part["seconds"].as_f64().expect("seconds");
    let sum: f64 = parts.iter().map(seconds).sum();
    assert!((sum / work - 1.0).abs() < 1e-9, "{sum} of {work}");
    // Not one part fewer than needed, and at most a quarter more.
    let needed = work / (6.0 - start).max(1.0);
    let count = parts.len() as f64;
    assert!(
        count >= needed && count < 1.25 * needed + 2.0,
        "{count}, {needed}"
    );
    let longest = parts.iter().map(seconds).fold(0.0, f64::max);
    // Rows of uneven cost cannot be cut evenly to the last second.
    assert!(start + longest < 1.25 * 6.0, "{longest}");
}

#[test]
fn a_simulation_predicts_the_sizes_of_films_with_layers() {
    let workspace = Workspace::new();
    let flags = "--size 512x384 --samples 64 --layers beauty,albedo,depth";
    let run = workspace
        .run(&format!(
            "farm plan a.scene {flags} --simulate 4 -o all.exr"
        ))
        .expect(0);
    assert_eq!(workspace.made(), [""; 0]);
    let row = run.text().lines().find(|line| line.starts_with("| 4 |"));
    let cells = row.expect("a row").split('|').map(str::trim);
    let cells: Vec<f64> = cells.filter_map(|cell| cell.parse().ok()).collect();
    let [
        _,
        parts,
        _,
        all,
        efficiency,
        part_mb,
        read_mb,
        merge,
        memory_mb,
    ] = cells[..]
    else {
        panic!("{row:?}");
    };
    assert!(
        efficiency > 0.1 && efficiency <= 1.0 && all > 0.0,
        "{row:?}"
    );

    workspace
        .run(&format!(
            "farm plan a.scene {flags} --parts {parts} -o all.exr"
        ))
        .expect(0);
    workspace
        .run("farm run all.exr.farm --all --quiet")
        .expect(0);
    let films = workspace.files("all.exr.farm/parts").into_values();
    let megabytes: Vec<f64> = films.map(|film| film.len() as f64 / 1e6).collect();
    let (sum, largest) = (
        megabytes.iter().sum::<f64>(),
        megabytes.iter().copied().fold(0.0, f64::max),
    );
    assert!((read_mb - sum).abs() < 1.0, "{read_mb} of {sum}");
    // The costs of rows are measured again, so bands differ a little.
    assert!(
        (part_mb / largest - 1.0).abs() < 0.5,
        "{part_mb}, {largest}"
    );
    assert!(memory_mb >= sum && merge < 60.0, "{row:?}");
}
