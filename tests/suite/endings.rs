//! Runs that cannot continue: signals during a blocked write, and limits on files and memory. They end soon,
//! with the promised exit code, and leave no partial file.

#![cfg(target_os = "linux")]

use crate::support::program::{Run, Workspace};
use crate::support::verdict::Verdict;
use std::fs;
use std::io::{BufRead, BufReader};
use std::path::PathBuf;
use std::process::{Child, Command, Stdio};
use std::thread::sleep;
use std::time::{Duration, Instant};

/// A run that takes longer is taken to hang.
const PATIENCE: Duration = Duration::from_secs(60);

fn signal(child: &Child, name: &str) {
    let id = child.id().to_string();
    let kill = Command::new("kill").args([name, &id]).status();
    assert!(kill.expect("kill runs").success());
}

/// The exit code. A run that hangs is killed and has none.
fn end_of(child: &mut Child) -> Option<i32> {
    let start = Instant::now();
    while start.elapsed() < PATIENCE {
        if let Some(status) = child.try_wait().expect("a process") {
            return status.code();
        }
        sleep(Duration::from_millis(5));
    }
    child.kill().expect("killed");
    child.wait().expect("it ends");
    None
}

/// All entries of the folder except the `known` ones.
fn left(workspace: &Workspace, known: &[&str]) -> Vec<String> {
    let names = workspace.names(".").into_iter();
    names
        .filter(|name| !known.contains(&name.as_str()))
        .collect()
}

/// Runs a shell command in which `$G` is the program.
fn shell(workspace: &Workspace, line: &str) -> Run {
    let mut command = workspace.command("");
    let program = command.get_program().to_owned();
    command = Command::new("sh");
    command.args(["-c", line]).env("G", program);
    command
        .current_dir(workspace.path("."))
        .stdin(Stdio::null());
    let output = command.output().expect("a shell");
    Run {
        code: output.status.code(),
        report: serde_json::Value::Null,
        stdout: output.stdout,
        stderr: String::from_utf8_lossy(&output.stderr).into_owned(),
    }
}

#[test]
fn one_signal_ends_a_run_that_is_stuck_in_its_output() {
    let workspace = Workspace::new();
    let mut verdict = Verdict::on("stuck outputs");
    for (output, name, code) in [
        // Nobody opens the other end.
        ("-o pipe --format png", "-TERM", 143),
        ("-o pipe --format png", "-INT", 130),
        // Nobody reads from the pipe, and the picture is larger than its buffer.
        ("-o - --format exr", "-TERM", 143),
    ] {
        let _ = fs::remove_file(workspace.path("pipe"));
        let pipe = Command::new("mkfifo").arg(workspace.path("pipe")).status();
        assert!(pipe.expect("mkfifo runs").success());
        let line = format!("render a.scene --size 256x256 --progress json {output}");
        let mut command = workspace.command(&line);
        command.stdout(Stdio::piped()).stderr(Stdio::piped());
        let mut child = command.spawn().expect("glimray runs");
        let mut lines = BufReader::new(child.stderr.take().expect("a pipe")).lines();
        let is_traced = lines.any(|line| line.is_ok_and(|line| line.contains("\"progress\":1.0")));
        assert!(is_traced, "{line} ended early");
        signal(&child, name);
        let found = end_of(&mut child);
        verdict.that(format!("{line} {name}"), found == Some(code), || {
            format!("{found:?}")
        });
    }
    verdict.close();
    assert_eq!(left(&workspace, &["a.scene", "pipe"]), Vec::<String>::new());
}

/// The temporary file that is being written, once it is not empty.
fn part(workspace: &Workspace) -> Option<PathBuf> {
    let names = workspace.names(".");
    let name = names.into_iter().find(|name| name.contains(".part-"))?;
    let path = workspace.path(&name);
    let has_begun = fs::metadata(&path).is_ok_and(|part| part.len() > 0);
    has_begun.then_some(path)
}

#[test]
fn a_second_signal_in_the_midst_of_a_write_leaves_no_part_of_the_file() {
    let workspace = Workspace::moving();
    let line = "animate a.toml --size 1024x768 --samples 1 --frames 0..7 --quiet -o v.y4m";
    workspace.run(&format!("{line} --keep-frames")).expect(0);
    for _ in 0..20 {
        let mut child = workspace.start(&format!("{line} --encode-only"));
        while part(&workspace).is_none() && child.try_wait().expect("a process").is_none() {
            sleep(Duration::from_millis(1));
        }
        // Both signals arrive while the process is stopped, and it handles them when it continues.
        let id = child.id().to_string();
        // The process may have ended meanwhile.
        let send = |name: &str| {
            let mut kill = Command::new("kill");
            let _ = kill
                .args([name, id.as_str()])
                .stderr(Stdio::null())
                .status();
        };
        send("-STOP");
        let is_writing = part(&workspace).is_some();
        for name in ["-INT", "-TERM", "-CONT"] {
            send(name);
        }
        let code = end_of(&mut child);
        assert_eq!(
            workspace.names("."),
            ["a.toml", "v.y4m", "v.y4m.frames"],
            "{code:?}"
        );
        // The file may have been completed before the program ended.
        if is_writing && code != Some(0) {
            assert!(code == Some(130) || code == Some(143), "{code:?}");
            return;
        }
    }
    panic!("no write was interrupted");
}

#[test]
fn a_limit_on_file_sizes_is_an_error_and_leaves_nothing() {
    let workspace = Workspace::new();
    let run = shell(
        &workspace,
        "ulimit -f 1; exec $G render a.scene --size 200x200 -q -o a.exr",
    );
    let run = run.expect(4);
    run.says("error: cannot write the file (a.exr): file too large. Raise the file size limit");
    assert_eq!(left(&workspace, &["a.scene"]), Vec::<String>::new());
}

#[test]
fn a_standard_output_that_is_closed_is_an_error() {
    let workspace = Workspace::new();
    for line in [
        "$G render a.scene --size 8x8 -q -o - >&-",
        "$G render a.scene --size 8x8 -q -o a.png --report - >&-",
        "$G animate a.scene --frames 0..1 --size 16x16 -q -o - >&-",
    ] {
        let run = shell(&workspace, line).expect(4);
        run.says("(standard output): it is closed. Redirect it to a file or a program.");
    }
    // The result is discarded on purpose.
    shell(
        &workspace,
        "$G render a.scene --size 8x8 -q -o - >/dev/null",
    )
    .expect(0);
    assert_eq!(left(&workspace, &["a.scene"]), Vec::<String>::new());
}

/// A height field of 2 · `side`² triangles as OBJ.
fn terrain(side: usize) -> String {
    let mut text = String::new();
    for y in 0..=side {
        for x in 0..=side {
            text += &format!("v {x}.000 {}.500 {y}.000\n", (x * 7919 + y * 104_729) % 97);
        }
    }
    for y in 0..side {
        for x in 0..side {
            let a = y * (side + 1) + x + 1;
            let b = a + side + 1;
            text += &format!("f {a} {} {}\nf {a} {} {b}\n", a + 1, b + 1, b + 1);
        }
    }
    text
}

#[test]
fn what_does_not_fit_into_a_memory_limit_exits_7() {
    let workspace = Workspace::new();
    workspace.write("big.obj", terrain(500));
    let bytes = workspace.read("big.obj").len() as u64;
    assert!(bytes > 15 << 20, "{bytes}");
    workspace.write("names.toml", "[[objects]]\nmesh = { file = \"big.obj\" }\n");
    let mut verdict = Verdict::on("memory limits");
    for (limit, line, words) in [
        (
            120_000,
            "inspect big.obj",
            "error: too big for the memory (big.obj): reading it takes",
        ),
        (
            500_000,
            "render a.scene -o a.png",
            "error: too big for the memory (a.scene): rendering it takes",
        ),
        (
            500_000,
            "render big.obj -o a.png",
            "error: too big for the memory",
        ),
        (
            500_000,
            "animate a.scene --frames 0..1 -o f_%d.png",
            "error: too big for the memory",
        ),
        // The size of this file is not known beforehand.
        (68_000, "inspect names.toml", "do not fit into memory"),
        // The memory it needs is not known either; the message is Rust's own.
        (88_000, "inspect names.toml", "memory allocation of"),
    ] {
        let run = shell(&workspace, &format!("ulimit -v {limit}; exec $G {line}"));
        let says_so = run.code == Some(7) && run.stderr.contains(words);
        verdict.that(format!("{limit} {line}"), says_so, || {
            format!("{:?}: {}", run.code, run.stderr)
        });
    }
    verdict.close();
    assert_eq!(
        left(&workspace, &["a.scene", "big.obj", "names.toml"]),
        Vec::<String>::new()
    );
    // A sufficient limit does not matter.
    shell(
        &workspace,
        "ulimit -v 8000000; exec $G render a.scene --size 8x8 -q -o a.png",
    )
    .expect(0);
}
