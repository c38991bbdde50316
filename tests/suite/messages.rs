//! Messages of failed runs: the report with its error, JSON lines, and coloured, wrapped text on terminals.

use crate::support::program::Workspace;
#[cfg(target_os = "linux")]
use crate::support::skip::{Need, skip};
use crate::support::verdict::Verdict;
use glimray::bytes;
use glimray::gpu::GpuError;
use glimray_app::error::AppError;
use insta::assert_snapshot;
use serde_json::Value;
use std::process::{Command, Stdio};

/// Names of all fields, such as `outer.inner`. `adapter`, `fetch`, `rays` and `error` count as one field each, because
/// they may be null.
fn fields(report: &Value) -> Vec<String> {
    let mut names = Vec::new();
    for (outer, value) in report.as_object().expect("an object") {
        match value.as_object() {
            Some(inner) if !["adapter", "fetch", "rays", "error"].contains(&outer.as_str()) => {
                names.extend(inner.keys().map(|name| format!("{outer}.{name}")));
            }
            _ => names.push(outer.clone()),
        }
    }
    names.sort();
    names
}

#[test]
fn a_run_that_fails_reports_its_error_and_all_other_fields() {
    let workspace = Workspace::new();
    workspace.write("bad.scene", "1\nsphere\npos: 0 0 x\n");
    let run = workspace
        .run("render a.scene --size 8x8 -o a.png --report -")
        .expect(0);
    assert_eq!(run.report["error"], Value::Null);
    let promised = fields(&run.report);
    let mut verdict = Verdict::on("reports of failures");
    for (line, code, lights, width) in [
        ("render gone.scene", 3, Value::Null, Value::Null),
        ("render bad.scene", 3, Value::Null, Value::Null),
        ("render a.scene --camera nobody", 2, 1.into(), Value::Null),
        (
            "render a.scene --crop 0,0,9,9 --size 8x8",
            2,
            1.into(),
            Value::Null,
        ),
        (
            "render a.scene -o no/where.png --size 8x8",
            4,
            1.into(),
            8.into(),
        ),
        (
            "render a.scene --adapter nothing_like_it --size 8x8",
            5,
            1.into(),
            8.into(),
        ),
        (
            "render a.scene --memory-limit 1 --size 2048x2048",
            7,
            1.into(),
            2048.into(),
        ),
        (
            "demo --memory-limit 1 --size 2048x2048",
            7,
            Value::Null,
            2048.into(),
        ),
    ] {
        let run = workspace.run(&format!("{line} --report -")).expect(code);
        let report = &run.report;
        let said = run.stderr.lines().last().unwrap_or_default();
        let message = report["error"]["message"].as_str().unwrap_or_default();
        verdict.that(line, said == format!("error: {message}"), || {
            said.to_owned()
        });
        verdict.that(line, report["error"]["code"] == code, || report.to_string());
        verdict.that(line, fields(report) == promised, || report.to_string());
        let is_scene_known = line.starts_with("demo") || report["scene"]["lights"] == lights;
        verdict.that(
            line,
            is_scene_known && report["image"]["width"] == width,
            || report.to_string(),
        );
    }
    verdict.close();
    let run = workspace.run("animate a.scene --report -").expect(2);
    assert_eq!(run.report["animation"], Value::Null);
    assert_eq!(run.report["command"], "animate");
    assert_eq!(run.report["error"]["code"], 2);
    // The report also goes to a file, and replaces an older one.
    for code in [5, 3] {
        let line = match code {
            5 => "render a.scene --adapter nothing_like_it --report r.json",
            _ => "render gone.scene --report r.json",
        };
        workspace.run(line).expect(code);
        let report: Value = serde_json::from_slice(&workspace.read("r.json")).expect("JSON");
        assert_eq!(report["error"]["code"], code);
    }
}

#[test]
fn with_progress_in_json_every_line_is_a_json_object() {
    let workspace = Workspace::new();
    // The header announces more objects than there are, which causes a warning.
    let text = String::from_utf8(workspace.read("a.scene")).expect("text");
    workspace.write("warns.scene", text.replacen('2', "9 # skip", 1));
    let mut verdict = Verdict::on("lines");
    for (line, code, key) in [
        ("render warns.scene --size 8x8 --verbose", 0, "warning"),
        ("render a.scene --size 8x8 --verbose", 0, "note"),
        ("render a.scene --size 8x8", 0, "progress"),
        ("render gone.scene", 3, "error"),
        ("render a.scene --samples many", 2, "error"),
        ("render a.scene --bogus", 2, "error"),
        ("render a.scene -o no/where.png", 4, "error"),
        (
            "animate a.scene --frames 0..1 --size 16x16 -o f_%d.png",
            0,
            "note",
        ),
    ] {
        for flag in ["--progress json", "--progress=json"] {
            let run = workspace.run(&format!("{line} {flag}")).expect(code);
            let lines = run.stderr.lines().map(serde_json::from_str::<Value>);
            let lines: Vec<_> = lines.map(|line| line.unwrap_or_default()).collect();
            let is_json = !lines.is_empty() && lines.iter().all(Value::is_object);
            verdict.that(format!("{line} {flag}"), is_json, || run.stderr.clone());
            let has_key = lines.iter().any(|line| !line[key].is_null());
            verdict.that(format!("{line} {flag}"), has_key, || run.stderr.clone());
            let last = lines
                .last()
                .map_or(Value::Null, |line| line["code"].clone());
            let is_code = code == 0 || last == code;
            verdict.that(format!("{line} {flag}"), is_code, || run.stderr.clone());
        }
    }
    verdict.close();
    let run = workspace.run("render a.scene --tone acse --progress json");
    let error: Value = serde_json::from_str(&run.expect(2).stderr).expect("JSON");
    let message = "invalid value 'acse' for '--tone <TONE>' [possible values: none, aces, agx, reinhard, neutral] tip: a \
                   similar value exists: 'aces'";
    assert_eq!(error["error"], message);
}

/// Why tests on a terminal are skipped.
#[cfg(target_os = "linux")]
const NO_SCRIPT: &str = "there is no `script` to create a terminal";

/// The output of a shell command on a terminal with that many columns, with `\n` as line end. `$G` is the
/// program. `None` if there is no `script` to create a terminal.
#[cfg(target_os = "linux")]
fn on_a_terminal(workspace: &Workspace, columns: u32, line: &str) -> Option<String> {
    let mut command = Command::new("script");
    command.args([
        "-qec",
        &format!("stty cols {columns} rows 24; {line}"),
        "/dev/null",
    ]);
    command
        .env("G", workspace.command("").get_program())
        .env("TERM", "xterm");
    command
        .env_remove("NO_COLOR")
        .current_dir(workspace.path("."))
        .stdin(Stdio::null());
    let output = command.output().ok()?;
    Some(String::from_utf8_lossy(&output.stdout).replace("\r\n", "\n"))
}

#[cfg(target_os = "linux")]
#[test]
fn labels_are_coloured_on_a_terminal_only() {
    let workspace = Workspace::new();
    let plain = "error: cannot read the file (gone.scene)";
    let colored = "\u{1b}[1;31merror:\u{1b}[0m cannot read the file (gone.scene)";
    let line = "$G inspect gone.scene";
    let Some(on_terminal) = on_a_terminal(&workspace, 200, line) else {
        return skip(Need::Special, NO_SCRIPT);
    };
    assert!(on_terminal.starts_with(colored), "{on_terminal:?}");
    for line in [
        "NO_COLOR=1 $G inspect gone.scene",
        "TERM=dumb $G inspect gone.scene",
        "$G inspect gone.scene 2>&1 | cat",
    ] {
        let text = on_a_terminal(&workspace, 200, line).expect("a terminal");
        assert!(text.starts_with(plain), "{line}: {text:?}");
    }
    assert!(
        workspace
            .run("inspect gone.scene")
            .stderr
            .starts_with(plain)
    );
}

#[cfg(target_os = "linux")]
#[test]
fn command_line_errors_are_coloured_and_wrapped_on_a_terminal() {
    let workspace = Workspace::new();
    let line = "$G render a.scene --filter lanczos";
    let Some(colored) = on_a_terminal(&workspace, 200, line) else {
        return skip(Need::Special, NO_SCRIPT);
    };
    let label = "\u{1b}[1m\u{1b}[31merror:\u{1b}[0m invalid value";
    assert!(colored.starts_with(label), "{colored:?}");
    let whole = workspace.run(&line["$G ".len()..]).expect(2).stderr;
    let words = |text: &str| {
        text.split_whitespace()
            .map(str::to_owned)
            .collect::<Vec<_>>()
    };
    for columns in [60, 30] {
        let plain = on_a_terminal(&workspace, columns, &format!("NO_COLOR=1 {line}"));
        let plain = plain.expect("a terminal");
        assert_eq!(words(&plain), words(&whole));
        let is_fit = |line: &str| line.chars().count() <= columns as usize;
        assert!(plain.lines().all(is_fit), "{plain}");
        // Colours take no columns.
        let colored = on_a_terminal(&workspace, columns, line).expect("a terminal");
        assert_eq!(
            colored.lines().count(),
            plain.lines().count(),
            "{colored:?}"
        );
    }
}

#[cfg(target_os = "linux")]
#[test]
fn a_terminal_gets_the_faulty_line_with_a_mark() {
    let workspace = Workspace::new();
    workspace.write(
        "bad.toml",
        "ambient = [0, 0, 0]\nbackground = [0, oops, 0]\n",
    );
    let line = "NO_COLOR=1 $G inspect bad.toml";
    let Some(text) = on_a_terminal(&workspace, 200, line) else {
        return skip(Need::Special, NO_SCRIPT);
    };
    let (message, drawing) = text.split_once('\n').expect("lines");
    assert!(
        message.starts_with("error: bad scene (bad.toml:2:18): "),
        "{text}"
    );
    assert_snapshot!(drawing, @r"
2 │ background = [0, oops, 0]
  │                  ^^^^
");
    // Without a terminal there is only the message.
    let run = workspace.run("inspect bad.toml").expect(3);
    assert_eq!(run.stderr.trim_end(), message);
}

#[cfg(target_os = "linux")]
#[test]
fn lines_are_wrapped_between_words_on_a_terminal() {
    let workspace = Workspace::new();
    let line = "$G inspect gone.scene --allow-dir a_folder_that_is_not_there_and_has_a_long_name";
    let whole = workspace.run(&line["$G ".len()..]).expect(3).stderr;
    assert_eq!(whole.lines().count(), 1, "{whole}");
    for columns in [60, 30] {
        let Some(text) = on_a_terminal(&workspace, columns, &format!("NO_COLOR=1 {line}")) else {
            return skip(Need::Special, NO_SCRIPT);
        };
        let lines: Vec<_> = text.trim_end().lines().collect();
        let is_fit = |line: &&str| line.chars().count() <= columns as usize || !line.contains(' ');
        assert!(lines.len() > 1 && lines.iter().all(is_fit), "{text}");
        assert_eq!(lines.join(" "), whole.trim_end());
    }
}

#[test]
fn messages_of_the_program_name_its_flags() {
    let workspace = Workspace::new();
    workspace.write("out.toml", "[[objects]]\nmesh = { file = '../m.obj' }\n");
    workspace.write(
        "good.toml",
        "[[objects]]\nsphere = { center = [0, 0, 0], radius = 1 }\n",
    );
    let mut verdict = Verdict::on("messages");
    for (line, message) in [
        (
            "inspect out.toml",
            "mesh file refused (out.toml:2:17): `../m.obj` points outside the scene folder. Use \
             --allow-dir DIR to permit.",
        ),
        (
            "inspect good.toml --set camera=3",
            "override refused (--set:1:8): invalid type: integer `3`, expected struct CameraTable. See \
             `glimray schema` for what is allowed.",
        ),
        (
            "render a.scene --size 8x8 --adapter nothing_like_it",
            "no such adapter (--adapter nothing_like_it): available are",
        ),
        (
            "render a.scene --size 2048x2048 --memory-limit 1",
            "Use a smaller scene or picture, or raise --memory-limit if memory allows.",
        ),
    ] {
        let run = workspace.run(line);
        verdict.that(line, run.stderr.contains(message), || run.stderr.clone());
    }
    verdict.close();
}

#[test]
fn a_limit_of_the_adapter_is_not_blamed_on_the_memory_limit() {
    let limit = GpuError::Limit {
        name: "one storage buffer binding",
        need: 2 << 30,
        limit: 128 << 20,
        in_bytes: true,
    };
    let refused = GpuError::OutOfMemory {
        what: "film".into(),
    };
    let budget = GpuError::Budget {
        what: "film 5 GiB".into(),
        need: (6 << 30) + (512 << 20),
        limit: 4 << 30,
    };
    let [limit, refused, budget] = [limit, refused, budget].map(AppError::from);
    let says_so = |error: &AppError| error.to_string().contains("--memory-limit");
    assert!(!says_so(&limit) && !says_so(&refused) && says_so(&budget));
    assert!(limit.to_string().contains("an adapter with higher limits"));
    // People read neither 2147483648 nor bytes.
    let sizes = |error: AppError, text: &str| assert!(error.to_string().contains(text), "{error}");
    sizes(
        limit,
        "(one storage buffer binding): 2 GiB needed, 128 MiB allowed.",
    );
    sizes(
        budget,
        "(film 5 GiB): 6.5 GiB needed in all, 4 GiB allowed.",
    );
    let side = GpuError::Limit {
        name: "texels along a texture's side",
        need: 20_000,
        limit: 16_384,
        in_bytes: false,
    };
    sizes(side.into(), "side): 20000 needed, 16384 allowed.");
}

#[test]
fn sizes_are_in_the_largest_unit_that_fits() {
    let mut verdict = Verdict::on("sizes");
    for (number, text) in [
        (0, "0 bytes"),
        (1, "1 byte"),
        (1023, "1023 bytes"),
        (1024, "1 KiB"),
        (12_600, "12.3 KiB"),
        ((1 << 20) - 1, "1 MiB"),
        (1 << 20, "1 MiB"),
        (1_073_741_824, "1 GiB"),
        (3 << 29, "1.5 GiB"),
        (u64::MAX, "16 EiB"),
    ] {
        let found = bytes::size(number);
        verdict.that(number, found == text, || found.clone());
    }
    verdict.close();
    assert_eq!(bytes::sizes([3 << 20, 2 << 20]), ["3 MiB", "2 MiB"]);
    // A size barely above a limit is not printed as equal to it.
    assert_eq!(
        bytes::sizes([(1 << 20) + 1, 1 << 20]),
        ["1048577 bytes", "1048576 bytes"]
    );
}
