//! Tests that need optional parts of a machine: they are skipped with a visible message, unless
//! `GLIMRAY_REQUIRE` requires them.

use std::fmt::Display;
use std::io::Write;

/// Optional requirements of tests, and their names in `GLIMRAY_REQUIRE`: `GLIMRAY_REQUIRE=gl,xvfb`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Need {
    /// The database of advisories on crates. No test needs it: `make deny` does.
    Advisories,
    /// `cargo-deny`. No test needs it: `make deny` does.
    Deny,
    /// Built examples, which `cargo test` without `--test` builds.
    Examples,
    /// The programs of FFmpeg, `ffmpeg` and `ffprobe`.
    Ffmpeg,
    /// A Git checkout of the project.
    Git,
    /// An adapter of the OpenGL backend of wgpu.
    Gl,
    /// A driver that limits the loop iterations of a shader, as lavapipe does.
    LoopLimit,
    /// Third-party models in `../shared/data`.
    Models,
    /// Private mounts.
    Mounts,
    /// Python with the packages of its tests. No test needs it: `make python-test` does.
    Python,
    /// Named pipes, `/dev/full`, `/proc`, and `script`, which creates terminals.
    Special,
    /// The scenes of the Standard Procedural Database.
    Spd,
    /// The spelling checker `typos`. No test needs it: `make typos` does.
    Typos,
    /// A compiler for WebAssembly. No test needs it: `make wasm` does.
    Wasm,
    /// An X server without a screen, and xdotool to move its mouse.
    Xvfb,
}

impl Need {
    const ALL: [Self; 15] = [
        Self::Advisories,
        Self::Deny,
        Self::Examples,
        Self::Ffmpeg,
        Self::Git,
        Self::Gl,
        Self::LoopLimit,
        Self::Models,
        Self::Mounts,
        Self::Python,
        Self::Special,
        Self::Spd,
        Self::Typos,
        Self::Wasm,
        Self::Xvfb,
    ];

    fn name(self) -> &'static str {
        match self {
            Self::Advisories => "advisories",
            Self::Deny => "deny",
            Self::Examples => "examples",
            Self::Ffmpeg => "ffmpeg",
            Self::Git => "git",
            Self::Gl => "gl",
            Self::LoopLimit => "loop-limit",
            Self::Models => "models",
            Self::Mounts => "mounts",
            Self::Python => "python",
            Self::Special => "special",
            Self::Spd => "spd",
            Self::Typos => "typos",
            Self::Wasm => "wasm",
            Self::Xvfb => "xvfb",
        }
    }
}

/// Called by a test that returns early because a requirement is missing. Panics if it is required; otherwise
/// writes a line that the test harness does not capture.
#[track_caller]
pub fn skip(need: Need, why: impl Display) {
    let required = std::env::var("GLIMRAY_REQUIRE").unwrap_or_default();
    match judge(&required, need, why) {
        // `eprintln!` is captured if a test passes.
        Ok(line) => _ = writeln!(std::io::stderr(), "{line}"),
        Err(error) => panic!("{error}"),
    }
}

/// The line that a skipped test writes, or why it may not be skipped.
fn judge(required: &str, need: Need, why: impl Display) -> Result<String, String> {
    let mut is_required = false;
    for name in required.split(',').filter(|name| !name.is_empty()) {
        let known = Need::ALL.iter().find(|need| need.name() == name);
        let known = known.ok_or_else(|| {
            let names = Need::ALL.map(Need::name).join(", ");
            format!("GLIMRAY_REQUIRE names `{name}`, which is none of {names}")
        })?;
        is_required |= *known == need;
    }
    let (name, thread) = (need.name(), std::thread::current());
    let test = thread.name().unwrap_or("a test");
    match is_required {
        true => Err(format!("{why}, but GLIMRAY_REQUIRE has `{name}`")),
        false => Ok(format!("skipped: {test}: {why} ({name})")),
    }
}

#[test]
fn what_is_required_is_not_skipped() {
    let gone = |required| judge(required, Need::Gl, "there is no OpenGL adapter");
    for required in ["gl", "xvfb,gl", "gl,ffmpeg"] {
        let error = gone(required).expect_err(required);
        assert_eq!(
            error,
            "there is no OpenGL adapter, but GLIMRAY_REQUIRE has `gl`"
        );
    }
    for required in ["", "xvfb", "xvfb,ffmpeg"] {
        let line = gone(required).expect(required);
        assert!(line.starts_with("skipped: "), "{line}");
        assert!(line.ends_with("there is no OpenGL adapter (gl)"), "{line}");
    }
}

#[test]
fn a_misspelt_requirement_fails() {
    for required in ["gk", "xvfb,gk", "GL", "gl ,xvfb"] {
        let error = judge(required, Need::Gl, "").expect_err(required);
        assert!(error.starts_with("GLIMRAY_REQUIRE names `"), "{error}");
    }
}

/// A test that prints its own message would bypass the requirement.
#[test]
fn tests_are_skipped_here_and_nowhere_else() {
    let mut open = vec![std::path::PathBuf::from("tests/suite")];
    let mut read = 0;
    while let Some(path) = open.pop() {
        if path.is_dir() {
            let entries = std::fs::read_dir(&path).expect("a folder");
            open.extend(entries.map(|entry| entry.expect("an entry").path()));
        } else if !path.ends_with("support/skip.rs") {
            let text = std::fs::read_to_string(&path).unwrap_or_default();
            assert!(!text.contains("\"skipped:"), "{}", path.display());
            read += 1;
        }
    }
    assert!(read > 100, "{read} files");
}
