//! GPU failures as a user sees them, injected through `GLIMRAY_FAULT` (see `crates/render/src/gpu/fault.rs`): the same
//! picture after a lost device, or one clear line and an exit code, and never a partial file.

use crate::reference::compare::assert_none;
use glimray::gpu::AdapterReport;
use std::ffi::OsStr;
use std::fs;
use std::path::PathBuf;
use std::process::{Command, Stdio};
use tempfile::TempDir;

const SCENE: &str = "
ambient = [0.1, 0.1, 0.1]
background = [0.2, 0.4, 0.6]
[output]
size = [200, 150]
samples = 3
[camera]
look_from = [0, 1.5, 6]
look_at = [0, 0.5, 0]
fov_y_deg = 45
[[lights]]
point = { position = [3, 5, 4], color = [1, 1, 1], intensity = 0.8 }
[[objects]]
plane = { point = [0, 0, 0], normal = [0, 1, 0] }
[[objects]]
sphere = { center = [0, 1, 0], radius = 1 }
[[objects]]
triangle = { vertices = [[-3, 0, 0], [-1, 0, 1], [-2, 2, 0]] }
";

/// A folder with a scene in it.
struct Workplace(TempDir);

/// The outcome of a run of `glimray render`.
struct Run {
    code: Option<i32>,
    stderr: String,
    picture: Option<Vec<u8>>,
    submissions: u64,
}

impl Workplace {
    fn new() -> Self {
        let folder = tempfile::tempdir().expect("a temporary folder");
        fs::write(folder.path().join("a.toml"), SCENE).expect("a scene");
        Self(folder)
    }

    fn path(&self, name: &str) -> PathBuf {
        self.0.path().join(name)
    }

    /// Renders with an injected fault and more flags, and removes the output.
    fn render<S: AsRef<OsStr>>(&self, fault: &str, flags: impl IntoIterator<Item = S>) -> Run {
        let output = Command::new(env!("CARGO_BIN_EXE_glimray"))
            .args([
                "render", "a.toml", "-o", "a.png", "--quiet", "--report", "a.json",
            ])
            .args(flags)
            .current_dir(self.0.path())
            .env("GLIMRAY_FAULT", fault)
            .stdin(Stdio::null())
            .output()
            .expect("glimray runs");
        let report = fs::read_to_string(self.path("a.json")).unwrap_or_default();
        let report: serde_json::Value = serde_json::from_str(&report).unwrap_or_default();
        let picture = fs::read(self.path("a.png")).ok();
        for name in ["a.png", "a.json"] {
            let _ = fs::remove_file(self.path(name));
        }
        let left = fs::read_dir(self.0.path())
            .expect("a readable folder")
            .count();
        assert_eq!(left, 1, "{fault}: files are left beside the scene");
        Run {
            code: output.status.code(),
            stderr: String::from_utf8(output.stderr).expect("messages are text"),
            picture,
            submissions: report["submissions"]["count"].as_u64().unwrap_or_default(),
        }
    }
}

const NO_FLAGS: [&str; 0] = [];

impl Run {
    /// Describes the error unless the run ended with this code, one line with these words, and no picture.
    fn check_refusal(&self, fault: &str, code: i32, words: &[&str]) -> Result<(), String> {
        let lines: Vec<_> = message_lines(&self.stderr);
        let [line] = lines[..] else {
            return Err(format!("{fault}: not one line but {lines:?}"));
        };
        let says = line.starts_with("error: ") && words.iter().all(|word| line.contains(word));
        let is_fault_of_ours = line.contains("panicked") || line.contains("internal fault");
        if self.code != Some(code) || !says || is_fault_of_ours {
            return Err(format!("{fault}: exit code {:?}, {line}", self.code));
        }
        if self.picture.is_some() {
            return Err(format!("{fault}: there is a picture"));
        }
        Ok(())
    }
}

/// Without messages of Vulkan's loader and Mesa about the machine.
fn message_lines(stderr: &str) -> Vec<&str> {
    stderr
        .lines()
        .filter(|line| !line.contains("XDG_RUNTIME_DIR") && !line.starts_with("MESA"))
        .collect()
}

#[test]
fn a_device_lost_at_any_submission_costs_nothing_but_time() {
    let place = Workplace::new();
    let whole = place.render("", NO_FLAGS);
    assert_eq!(whole.code, Some(0), "{}", whole.stderr);
    assert!(whole.submissions >= 3, "{} submissions", whole.submissions);
    // The first submission clears the film, the second one warms up, the last one develops.
    let last = whole.submissions + 3;
    assert_none((1..=last).map(|at| {
        let run = place.render(&format!("device@{at}"), NO_FLAGS);
        let is_same = run.picture.is_some() && run.picture == whole.picture;
        let says_so = matches!(message_lines(&run.stderr)[..], [line] if line.starts_with("warning: the GPU was lost"));
        (is_same && says_so && run.code == Some(0)).then_some(()).ok_or_else(|| {
            format!("device@{at}: exit code {:?}, same picture {is_same}, {}", run.code, run.stderr)
        })
    }));
}

#[test]
fn a_dispatch_that_is_cut_short_is_noticed_and_done_again() {
    let place = Workplace::new();
    let whole = place.render("", NO_FLAGS);
    assert_none([1, 2, whole.submissions].map(|at| {
        let fault = format!("dispatch@{at}");
        let run = place.render(&fault, NO_FLAGS);
        let is_same = run.picture.is_some() && run.picture == whole.picture;
        let again = run.submissions > at && !message_lines(&run.stderr).is_empty();
        (is_same && again && run.code == Some(0))
            .then_some(())
            .ok_or_else(|| format!("{fault}: same picture {is_same}, {}", run.stderr))
    }));
}

#[test]
fn a_dispatch_that_is_always_cut_short_ends_with_exit_6() {
    let run = Workplace::new().render("dispatch@*", NO_FLAGS);
    assert_none([run.check_refusal("dispatch@*", 6, &["the GPU failed 4 times"])]);
}

#[test]
fn a_device_that_is_lost_every_time_ends_with_exit_6() {
    let run = Workplace::new().render("device@*", NO_FLAGS);
    assert_none([run.check_refusal("device@*", 6, &["the GPU failed 4 times", "--adapter"])]);
}

/// Number of frames that [`animate`] renders.
const FRAMES: usize = 25;

/// Frames of an object that moves, is hidden in the middle and changes its colour, and the messages.
fn animate(fault: &str) -> (Option<i32>, Vec<Vec<u8>>, String) {
    const MOVING: &str = "
[materials]
red = { phong = { diffuse = [0.8, 0.1, 0.1] } }
[[objects]]
name = \"ball\"
sphere = { center = [0, 2, 1], radius = 0.6 }
material = \"red\"
[[animation]]
object = \"ball\"
property = \"translate\"
keys = [[0, [-1, 0, 0]], [1, [1, 0, 0]]]
[[animation]]
object = \"ball\"
property = \"visible\"
keys = [[0, true], [0.4, false], [0.6, true]]
[[animation]]
material = \"red\"
property = \"diffuse\"
keys = [[0, [1, 0, 0]], [1, [0, 1, 0]]]
";
    let folder = tempfile::tempdir().expect("a temporary folder");
    fs::write(folder.path().join("a.toml"), format!("{SCENE}{MOVING}")).expect("a scene");
    let flags = "--fps 24 --shutter 0.5 --size 64x48 --quiet";
    let output = Command::new(env!("CARGO_BIN_EXE_glimray"))
        .args(["animate", "a.toml", "-o", "%d.png"])
        .args(flags.split(' '))
        .current_dir(folder.path())
        .env("GLIMRAY_FAULT", fault)
        .stdin(Stdio::null())
        .output()
        .expect("glimray runs");
    let frame = |i: usize| fs::read(folder.path().join(format!("{i}.png"))).ok();
    let words = String::from_utf8(output.stderr).expect("messages are text");
    (
        output.status.code(),
        (0..FRAMES).map_while(frame).collect(),
        words,
    )
}

#[test]
fn a_device_lost_again_and_again_in_an_animation_costs_nothing_but_time() {
    let (code, expected, words) = animate("");
    assert_eq!((code, expected.len()), (Some(0), FRAMES), "{words}");
    assert!(expected[0] != expected[12] && expected[12] != expected[24]);
    // So far apart that no picture has four, at different points of a frame.
    const APART: usize = 9;
    for first in (1..=APART).step_by(4) {
        let places = (0..FRAMES).map(|i| (first + i * APART).to_string());
        let fault = format!("device@{}", places.collect::<Vec<_>>().join(","));
        let (code, frames, words) = animate(&fault);
        assert_eq!(code, Some(0), "{fault}: {words}");
        assert!(frames == expected, "{fault}: other frames");
        // More in total than one picture may have.
        let losses = words
            .split_once("lost ")
            .and_then(|(_, rest)| rest.split_once(' '));
        let losses: u32 = losses.map_or(0, |(count, _)| count.parse().unwrap_or(0));
        assert!(losses > 3, "{fault}: {words}");
    }
}

#[test]
fn a_failed_allocation_ends_with_exit_7_wherever_it_occurs() {
    let place = Workplace::new();
    let mut at = 0;
    loop {
        at += 1;
        let fault = format!("allocation@{at}");
        let run = place.render(&fault, ["--memory-limit", "512"]);
        if run.code == Some(0) {
            break;
        }
        assert_none([run.check_refusal(&fault, 7, &["out of memory", "smaller scene"])]);
    }
    assert!(at > 8, "only {} allocations were refused", at - 1);
}

#[test]
fn the_memory_limit_is_checked_before_the_first_allocation() {
    let place = Workplace::new();
    let flags = ["--memory-limit", "1", "--size", "4096x4096"];
    let run = place.render("allocation@1", flags);
    assert_none([run.check_refusal("allocation@1", 7, &["memory limit", " 1 MiB allowed"])]);
}

/// Kernels of software adapters are compiled in the time of a wait, on cores that others keep busy.
#[test]
fn a_busy_software_adapter_is_not_taken_for_lost() {
    let patience = |device_type: &str| {
        let adapter = AdapterReport {
            index: 0,
            name: "any".into(),
            backend: "vulkan".into(),
            driver: String::new(),
            device_type: device_type.into(),
            max_buffer_bytes: 1 << 30,
            max_binding_bytes: 1 << 27,
            max_texture_2d: 8192,
            storage_buffers_per_stage: 8,
        };
        adapter.patience().as_secs()
    };
    assert_eq!(patience("cpu"), 3600);
    for kind in ["discrete_gpu", "integrated_gpu", "virtual_gpu", "other"] {
        assert_eq!(patience(kind), 30, "{kind}");
    }
}
