//! Ctrl-C and SIGTERM.

use crate::support::program::Workspace;
use serde_json::Value;
use std::fs;
use std::io::{BufRead, BufReader};
use std::process::{Command, Stdio};

/// Starts a very long render, sends `signal` once it makes progress, and returns the exit code.
#[cfg(unix)]
fn interrupted(workspace: &Workspace, signal: &str) -> Option<i32> {
    let line = "render a.scene --size 2048x2048 --samples 65536 --progress json -o a.png";
    let mut command = workspace.command(line);
    let mut child = command
        .stderr(Stdio::piped())
        .spawn()
        .expect("glimray runs");
    let mut lines = BufReader::new(child.stderr.take().expect("a pipe")).lines();
    let under_way = lines.any(|line| line.is_ok_and(|line| line.contains("\"progress\"")));
    assert!(under_way, "the render ended early");
    let kill = Command::new("kill")
        .args([signal, &child.id().to_string()])
        .status();
    assert!(kill.expect("kill runs").success());
    let rest: Vec<_> = lines.map_while(Result::ok).collect();
    let last = rest
        .last()
        .and_then(|line| serde_json::from_str::<Value>(line).ok());
    let last = last.expect("JSON");
    assert_eq!(last["error"], "interrupted: no picture was written.");
    child.wait().expect("it ends").code()
}

#[cfg(unix)]
#[test]
fn ctrl_c_exits_130_and_leaves_nothing() {
    let workspace = Workspace::new();
    assert_eq!(interrupted(&workspace, "-INT"), Some(130));
    assert!(workspace.made().is_empty(), "{:?}", workspace.made());
}

#[cfg(unix)]
#[test]
fn sigterm_exits_143_and_leaves_the_old_picture() {
    let workspace = Workspace::new();
    fs::write(workspace.path("a.png"), "old").expect("a file");
    assert_eq!(interrupted(&workspace, "-TERM"), Some(143));
    assert_eq!(fs::read(workspace.path("a.png")).expect("a file"), b"old");
    assert_eq!(workspace.made(), ["a.png"]);
}
