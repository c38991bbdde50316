//! `farm`: parts of a picture or film, rendered by processes that may be killed at any time, merge to the bytes of one run.

use crate::support::program::Workspace;
use crate::support::random::Random;
use serde_json::Value;
use std::fs;
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
        let done = workspace.names("all.film.farm/done").len();
        assert_eq!(status(&workspace, "all.film.farm")["done"], done);
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
    // What is done is skipped.
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
    workspace.write("all.png.farm/leases/00000.0", "elsewhere 1\n");
    assert_eq!(status(&workspace, "all.png.farm")["running"], 1);
    let run = workspace.run("farm run all.png.farm 0 --lease 1").expect(0);
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
