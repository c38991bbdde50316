//! Standard output, standard error and devices.

use crate::support::program::{Run, Workspace};
use crate::support::skip::{Need, skip};
use serde_json::Value;
use std::fs;
use std::path::Path;
use std::process::Stdio;

#[test]
fn a_reader_that_closes_the_pipe_is_not_an_error() {
    let workspace = Workspace::new();
    for line in ["inspect a.scene", "schema", "completions bash", "--help"] {
        let mut command = workspace.command(line);
        command.stdout(Stdio::piped()).stderr(Stdio::piped());
        let mut child = command.spawn().expect("glimray runs");
        drop(child.stdout.take());
        let run = Run::from(child.wait_with_output().expect("it ends")).expect(0);
        assert!(run.stderr.is_empty(), "{line}: {}", run.stderr);
    }
}

#[test]
fn a_closed_standard_error_does_not_change_the_exit_code() {
    let workspace = Workspace::new();
    let mut command = workspace.command("render nothing.scene");
    command.stdout(Stdio::null()).stderr(Stdio::piped());
    let mut child = command.spawn().expect("glimray runs");
    drop(child.stderr.take());
    assert_eq!(child.wait().expect("it ends").code(), Some(3));
}

#[cfg(target_os = "linux")]
#[test]
fn results_that_cannot_be_written_exit_4() {
    let workspace = Workspace::new();
    for line in [
        "inspect a.scene",
        "schema",
        "completions bash",
        "--help",
        "--version",
    ] {
        let full = fs::File::options()
            .write(true)
            .open("/dev/full")
            .expect("a device");
        let mut command = workspace.command(line);
        let run = Run::from(command.stdout(full).output().expect("glimray runs")).expect(4);
        assert_eq!(
            run.stderr,
            "error: cannot write the result (standard output): no space left on device. Redirect it elsewhere.\n",
            "{line}"
        );
    }
}

#[test]
fn standard_output_gets_the_picture_and_nothing_else() {
    let workspace = Workspace::new();
    let run = workspace.run("render a.scene --size 32x24 -o -").expect(0);
    let picture = image::load_from_memory(&run.stdout).expect("a picture");
    assert_eq!((picture.width(), picture.height()), (32, 24));
    assert!(run.stdout.starts_with(b"\x89PNG"));
    let run = workspace
        .run("render a.scene --size 32x24 -o - --format exr --quiet")
        .expect(0);
    assert!(run.stdout.starts_with(&[0x76, 0x2f, 0x31, 0x01]));
    assert!(run.stderr.is_empty(), "{}", run.stderr);
    assert!(workspace.made().is_empty());
}

#[test]
fn a_full_device_exits_4() {
    if !Path::new("/dev/full").exists() {
        return skip(Need::Special, "there is no /dev/full");
    }
    let workspace = Workspace::new();
    let run = workspace
        .run("render a.scene --size 8x8 --quiet -o /dev/full")
        .expect(4);
    run.says("no space left on device");
    let model = include_bytes!("../../encoded/draco.glb");
    std::fs::write(workspace.path("a.glb"), model).expect("a model");
    workspace
        .run("render a.glb --size 8x8 --quiet -o /dev/full")
        .expect(4)
        .says("no space left on device");
}

#[test]
fn progress_is_json_on_request_and_absent_in_a_pipe() {
    let workspace = Workspace::new();
    let run = workspace
        .run("render a.scene --size 64x48 --quiet --progress json")
        .expect(0);
    let lines: Vec<Value> = run
        .stderr
        .lines()
        .map(|line| serde_json::from_str(line).expect("JSON"))
        .collect();
    let last = lines.last().expect("a line");
    assert_eq!(last["progress"], 1.0);
    let run = workspace
        .run("render a.scene --size 64x48 --quiet")
        .expect(0);
    assert_eq!(run.stderr, "");
}
