//! `--checkpoint`: a run that is killed, interrupted or short of disk space goes on with the same command and ends with
//! the bytes of an undisturbed one.

use crate::support::program::{Run, Workspace};
use crate::support::random::Random;
use crate::support::verdict::Verdict;
use serde_json::Value;
use std::io::{BufRead, BufReader};
use std::process::{Child, Command, Stdio};
use std::thread::sleep;
use std::time::Duration;

/// A second or two of work each, and the output.
const WORK: [(&str, &str); 5] = [
    ("--size 160x120 --samples 700", "png"),
    ("--size 96x72 --samples 900 --integrator path", "exr"),
    (
        "--size 96x72 --samples 4096 --antialias adaptive --noise 0.0005 --integrator path",
        "png",
    ),
    (
        "--size 200x150 --crop 20,30,180,140 --samples 1024 --sample-offset 256 --sample-count 704",
        "film",
    ),
    (
        "--size 64x48 --samples 256 --integrator path --denoise --layers beauty,depth,normal",
        "exr",
    ),
];

/// The undisturbed output of a command.
fn undisturbed(workspace: &Workspace, flags: &str, ending: &str) -> Vec<u8> {
    let name = format!("undisturbed.{ending}");
    let run = workspace.run(&format!("render a.scene {flags} -o {name} --report -"));
    assert_eq!(run.expect(0).report["resumed"], Value::Null);
    workspace.read(&name)
}

fn send(child: &Child, signal: &str) {
    let id = child.id().to_string();
    // The process may have ended meanwhile.
    let mut kill = Command::new("kill");
    let _ = kill.args([signal, &id]).stderr(Stdio::null()).status();
}

/// Starts a run and sends the signal after a while.
fn signalled(workspace: &Workspace, line: &str, signal: &str, after: Duration) -> Run {
    let child = workspace.start(line);
    sleep(after);
    send(&child, signal);
    Run::from(child.wait_with_output().expect("it ends"))
}

#[test]
fn runs_killed_at_random_end_with_the_bytes_of_an_undisturbed_one() {
    let mut random = Random::new(17);
    let mut verdict = Verdict::on("killed runs");
    let mut resumed = 0;
    for (flags, ending) in WORK {
        let workspace = Workspace::new();
        let expected = undisturbed(&workspace, flags, ending);
        for round in 0..2 {
            let line =
                format!("render a.scene {flags} -o a.{ending} --checkpoint a.ckpt --every 0.05s");
            let mut kills = 0;
            let run = loop {
                // Later runs get longer, so that it ends.
                let after = random.between(0.2, 0.6) + 0.2 * f64::from(kills);
                let run = signalled(&workspace, &line, "-KILL", Duration::from_secs_f64(after));
                resumed += usize::from(run.stderr.contains("resuming from a.ckpt: "));
                if run.code.is_some() {
                    break run;
                }
                kills += 1;
            };
            let name = format!("{flags}, round {round}");
            let is_same = run.code == Some(0) && workspace.read(&format!("a.{ending}")) == expected;
            verdict.that(&name, is_same, || format!("{kills} kills, {run:?}"));
            std::fs::remove_file(workspace.path(&format!("a.{ending}"))).expect("a picture");
            let names = [String::from("a.scene"), format!("undisturbed.{ending}")];
            let left = workspace.names(".");
            verdict.that(format!("{name}: files"), left == names, || {
                format!("{left:?}")
            });
        }
    }
    verdict.close();
    assert!(resumed >= 5, "only {resumed} runs went on");
}

/// The shares of the work that a run reports, with their times in seconds, until it is at `share`; then it is sent the
/// signal. Also the rest of its messages.
fn until(child: &mut Child, share: f64, signal: &str) -> (Vec<(f64, f64)>, String) {
    let mut reported = Vec::new();
    let mut rest = String::new();
    for line in BufReader::new(child.stderr.take().expect("a pipe")).lines() {
        let line = line.expect("text");
        let value: Value = serde_json::from_str(&line).expect("JSON");
        match (value["seconds"].as_f64(), value["progress"].as_f64()) {
            (Some(seconds), Some(done)) => reported.push((seconds, done)),
            _ => rest += &line,
        }
        if reported.last().is_some_and(|(_, done)| *done >= share) && rest.len() < 1 << 16 {
            send(child, signal);
        }
    }
    (reported, rest)
}

#[test]
fn a_killed_run_loses_at_most_an_interval() {
    let workspace = Workspace::new();
    let line = "render a.scene --size 320x240 --samples 65536 -o a.png --checkpoint a.ckpt --every 0.3 --progress json";
    let mut child = workspace.start(line);
    let (reported, _) = until(&mut child, 0.02, "-KILL");
    child.wait().expect("it ends");
    let (last, done) = *reported.last().expect("progress");
    // An interval, a submission, and the writing of two checkpoints on a busy machine.
    let before = reported
        .iter()
        .rev()
        .find(|(seconds, _)| *seconds < last - 1.5);
    let least = before.map_or(0.0, |(_, done)| *done);
    assert!(
        least > 0.0 && workspace.path("a.ckpt").exists(),
        "{reported:?}"
    );
    let mut child = workspace.start(line);
    let (_, notes) = until(&mut child, 0.0, "-TERM");
    assert_eq!(child.wait().expect("it ends").code(), Some(143), "{notes}");
    let other = line.replace("65536", "3").replace("--progress json", "");
    workspace
        .run(&other)
        .expect(0)
        .says("it differs in the settings");
    let percent = notes.split("resuming from a.ckpt: ").nth(1).expect(&notes);
    let percent: f64 = percent
        .split(' ')
        .next()
        .expect("a number")
        .parse()
        .expect("a number");
    assert!(
        percent + 1.0 > 100.0 * least,
        "{percent} % of {done}, at least {least}"
    );
}

#[test]
fn a_run_that_is_terminated_says_how_to_go_on_and_counts_everything() {
    let workspace = Workspace::new();
    let flags = "--size 160x120 --samples 2000 --count-rays --report a.json";
    workspace
        .run(&format!("render a.scene {flags} -o whole.png -q"))
        .expect(0);
    let report = || -> Value { serde_json::from_slice(&workspace.read("a.json")).expect("JSON") };
    let whole = report();
    let line = format!("render a.scene {flags} -o a.png --checkpoint a.ckpt");
    for (signal, code) in [("-TERM", 143), ("-INT", 130)] {
        let mut child = workspace.start(&format!("{line} --progress json"));
        let (_, rest) = until(&mut child, if code == 143 { 0.1 } else { 0.3 }, signal);
        assert_eq!(child.wait().expect("it ends").code(), Some(code), "{rest}");
        assert!(
            rest.contains("\"error\":\"interrupted: ")
                && rest.contains(" % done is kept (a.ckpt). Repeat the command to go on."),
            "{rest}"
        );
        assert_eq!(report()["error"]["code"], code);
        assert!(!workspace.path("a.png").exists());
    }
    let kept = report()["resumed"].as_f64().expect("a share");
    assert!((0.1..0.9).contains(&kept), "{kept}");
    workspace
        .run(&line)
        .expect(0)
        .says("resuming from a.ckpt: ");
    assert!(workspace.read("a.png") == workspace.read("whole.png"));
    assert_eq!(workspace.made(), ["a.json", "a.png", "whole.png"]);
    let resumed = report();
    assert!(resumed["resumed"].as_f64().expect("a share") > kept);
    for field in ["rays", "nonfinite_samples", "cut_off_trees"] {
        assert_eq!(resumed[field], whole[field], "{field}");
    }
    assert_eq!(
        resumed["image"]["mean_samples"],
        whole["image"]["mean_samples"]
    );
    assert!(resumed["submissions"]["count"].as_u64() < whole["submissions"]["count"].as_u64());
}

#[test]
fn what_is_no_checkpoint_of_the_picture_is_set_aside() {
    let workspace = Workspace::new();
    let line = "render a.scene --size 32x24 --samples 2 -o a.png --checkpoint a.ckpt";
    // The picture cannot be written, so the checkpoint stays.
    let failing = |flags: &str| {
        let line = line.replace("a.png", "/dev/full --format png");
        let run = workspace.run(&format!("{line} {flags}")).expect(4);
        run.says("100 % done is kept (a.ckpt)");
        workspace.read("a.ckpt")
    };
    let good = failing("");
    std::fs::remove_file(workspace.path("a.ckpt")).expect("removed");
    let other = failing("--seed 7 --crop 0,0,20,20");
    let damaged = [&good[..good.len() / 2], b"?", &good[good.len() / 2 + 1..]].concat();
    let mut verdict = Verdict::on("files set aside");
    for (number, (bytes, why)) in [
        (&other[..], "it differs in the settings, region."),
        (&damaged[..], "the checkpoint is damaged: "),
        (
            &good[..good.len() - 9],
            "the checkpoint is cut short: it ends after ",
        ),
        (b"my notes", "the file is not a checkpoint."),
        (b"", "the file is not a checkpoint."),
    ]
    .into_iter()
    .enumerate()
    {
        workspace.write("a.ckpt", bytes);
        let run = workspace.run(line).expect(0);
        let aside = format!("a.ckpt.old-{}", number + 1);
        let says = [
            "warning: cannot go on from the checkpoint (a.ckpt): ",
            why,
            &aside,
        ];
        let says = says.iter().all(|words| run.stderr.contains(words));
        verdict.that(why, says, || run.stderr.clone());
        let is_kept = workspace.read(&aside) == bytes && !workspace.path("a.ckpt").exists();
        verdict.that(&aside, is_kept, || format!("{:?}", workspace.made()));
    }
    verdict.close();
}

#[test]
fn a_picture_that_cannot_be_written_costs_no_second_render() {
    let workspace = Workspace::new();
    let line = "render a.scene --size 64x48 --samples 100 --checkpoint a.ckpt --report -";
    let expected = workspace
        .run("render a.scene --size 64x48 --samples 100 -o whole.png")
        .expect(0);
    assert!(!expected.stderr.contains("resuming"));
    let run = workspace
        .run(&format!("{line} -o /dev/full --format png"))
        .expect(4);
    run.says("100 % done is kept (a.ckpt). Repeat the command to go on.");
    let run = workspace.run(&format!("{line} -o a.png")).expect(0);
    run.says("resuming from a.ckpt: 100 % done");
    assert_eq!(run.report["resumed"], 1.0);
    assert_eq!(run.report["submissions"]["count"], 0);
    assert!(workspace.read("a.png") == workspace.read("whole.png"));
    assert_eq!(workspace.made(), ["a.png", "whole.png"]);
}

#[test]
fn a_checkpoint_that_does_not_fit_on_the_disk_is_one_warning() {
    let workspace = Workspace::new();
    let program = workspace.command("").get_program().to_owned();
    let line = "ulimit -f 16; exec \"$G\" render a.scene --size 64x48 --samples 4000 -q -o a.png --checkpoint a.ckpt --every 0.01";
    let mut shell = Command::new("sh");
    shell
        .args(["-c", line])
        .env("G", program)
        .current_dir(workspace.path("."));
    let run = Run::from(shell.output().expect("a shell")).expect(0);
    assert_eq!(run.stderr.matches("warning: ").count(), 1, "{}", run.stderr);
    run.says("cannot write the file (a.ckpt): file too large");
    run.says("Rendering goes on, and the checkpoint is tried again every 0.01 s.");
    assert_eq!(workspace.made(), ["a.png"]);
}

#[test]
fn a_failing_device_keeps_the_checkpoint() {
    let workspace = Workspace::new();
    let flags = "--size 160x120 --samples 300";
    let expected = undisturbed(&workspace, flags, "png");
    let line = format!("render a.scene {flags} -o a.png --checkpoint a.ckpt");
    for faults in ["device@6,7,8,9", "dispatch@5,6,7,8"] {
        let mut command = workspace.command(&line);
        let run = Run::from(
            command
                .env("GLIMRAY_FAULT", faults)
                .output()
                .expect("glimray runs"),
        );
        let run = run.expect(6);
        run.says(" % done is kept (a.ckpt). Repeat the command to go on.");
        workspace
            .run(&line)
            .expect(0)
            .says("resuming from a.ckpt: ");
        assert!(workspace.read("a.png") == expected, "{faults}");
    }
}

#[test]
fn a_second_run_on_a_checkpoint_is_refused_and_a_killed_one_blocks_nobody() {
    let workspace = Workspace::new();
    let flags = "--size 160x120 --samples 4000 --checkpoint a.ckpt --every 0.05s";
    let mut first = workspace.start(&format!("render a.scene {flags} -o a.png"));
    while !workspace.path("a.ckpt").exists() {
        let ended = first.try_wait().expect("a process");
        assert!(ended.is_none(), "it ended without a checkpoint: {ended:?}");
        sleep(Duration::from_millis(20));
    }
    let before = workspace.read("a.ckpt.lock");
    for seed in ["", "--seed 5"] {
        let second = workspace.run(&format!("render a.scene {flags} {seed} -o b.png"));
        assert_eq!(
            second.expect(4).stderr,
            "error: cannot keep a checkpoint (a.ckpt): another run is writing there. Wait until it ends, or name \
             another file with --checkpoint.\n",
            "{seed}"
        );
    }
    assert_eq!(before, b"");
    send(&first, "-KILL");
    first.wait().expect("it ends");
    // The lock is left, and locked by nobody.
    let mut names = workspace.names(".");
    names.retain(|name| !name.starts_with(".a.ckpt.part-"));
    assert_eq!(names, ["a.ckpt", "a.ckpt.lock", "a.scene"]);
    let line = format!("render a.scene {flags} -o a.png");
    let mut third = workspace.start(&line);
    let mut said = BufReader::new(third.stderr.take().expect("a pipe")).lines();
    let resumed = said.any(|line| line.expect("text").starts_with("resuming from a.ckpt: "));
    assert!(resumed, "the third run does not go on from the checkpoint");
    send(&third, "-INT");
    said.for_each(drop);
    assert_eq!(third.wait().expect("it ends").code(), Some(130));
    let mut names = workspace.names(".");
    names.retain(|name| !name.starts_with(".a.ckpt.part-"));
    assert_eq!(names, ["a.ckpt", "a.scene"]);

    // A file that happens to have the name of the lock.
    workspace.write("a.ckpt.lock", "something else");
    let refused = workspace.run(&line).expect(4);
    refused.says("error: cannot lock the checkpoint (a.ckpt.lock): the file is not a lock.");
    assert_eq!(workspace.read("a.ckpt.lock"), b"something else");
}

#[test]
fn a_checkpoint_in_an_impossible_place_is_refused_before_rendering() {
    let workspace = Workspace::new();
    std::fs::create_dir(workspace.path("folder")).expect("a folder");
    std::os::unix::fs::symlink("a.scene", workspace.path("link")).expect("a link");
    let mut verdict = Verdict::on("refused checkpoints");
    for (flags, code, words) in [
        ("--checkpoint -", 2, "it is read again. Name a file."),
        (
            "--checkpoint a.png",
            2,
            "the picture goes there. Choose another name.",
        ),
        (
            "--checkpoint a.json",
            2,
            "the report goes there. Choose another name.",
        ),
        (
            "--checkpoint a.scene",
            2,
            "this run reads that file. Choose another name.",
        ),
        (
            "--checkpoint link",
            2,
            "this run reads that file. Choose another name.",
        ),
        (
            "--checkpoint /dev/null",
            2,
            "it is a pipe or a device. Name a file.",
        ),
        ("--checkpoint folder", 4, "it is a folder. Add a file name."),
        (
            "--checkpoint gone/a.ckpt",
            4,
            "the folder gone does not exist. Create it first.",
        ),
        (
            "--checkpoint a.ckpt --every 0",
            2,
            "it must be a number from 0.01 to 1000000",
        ),
        ("--every 5", 2, "--checkpoint <FILE>"),
    ] {
        let line = format!("render a.scene --size 8x8 -o a.png --report a.json {flags}");
        let run = workspace.run(&line);
        let is_refused = run.code == Some(code) && run.stderr.contains(words);
        verdict.that(flags, is_refused, || {
            format!("{:?}: {}", run.code, run.stderr)
        });
        assert!(!workspace.path("a.png").exists(), "{flags}");
    }
    verdict.close();
}
