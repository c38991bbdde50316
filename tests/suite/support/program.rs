//! Runs the program in a temporary folder with a scene.

use glimray::image::Image;
use glimray::output;
use serde_json::Value;
use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Output, Stdio};
use tempfile::TempDir;

/// A red sphere and a light, in the course format.
pub const SCENE: &str = "2
amb: 0.1 0.1 0.1
sphere
pos: 0 0 -3
rad: 1
dif: 0.7 0.1 0.1
spe: 0.2 0.2 0.2
shi: 20
light
pos: 2 2 1
col: 1 1 1
";

/// A red sphere that crosses the picture in a quarter of a second along a bent path, so that at 24 frames per
/// second all frames differ.
pub const MOVING: &str = r#"
ambient = [0.1, 0.1, 0.1]

[camera]
look_from = [0, 0, 6]
look_at = [0, 0, 0]
fov_y_deg = 45

[[lights]]
point = { position = [2, 2, 4], intensity = 1, attenuation = "none" }

[materials]
red = { phong = { diffuse = [0.7, 0.1, 0.1], specular = [0.2, 0.2, 0.2], shininess = 20 } }

[[objects]]
name = "ball"
sphere = { center = [0, 0, 0], radius = 1 }
material = "red"

[[animation]]
object = "ball"
property = "translate"
keys = [[0, [-1.5, 0, 0]], [0.125, [0.5, 0, 0]], [0.25, [1.5, 0.1, 0]]]
"#;

/// File names with their contents.
pub type Files = BTreeMap<String, Vec<u8>>;

/// A temporary folder with a scene in it.
pub struct Workspace {
    folder: TempDir,
    scene: &'static str,
}

/// The result of a run of the program.
#[derive(Debug)]
pub struct Run {
    pub code: Option<i32>,
    pub stdout: Vec<u8>,
    pub stderr: String,
    /// JSON on standard output, such as a report; null if there is none.
    pub report: Value,
}

impl Workspace {
    /// With a static scene, `a.scene`.
    pub fn new() -> Self {
        Self::with("a.scene", SCENE)
    }

    /// With an animated scene of seven frames, `a.toml`.
    pub fn moving() -> Self {
        Self::with("a.toml", MOVING)
    }

    fn with(scene: &'static str, text: &str) -> Self {
        let folder = tempfile::tempdir().expect("a temporary folder");
        let workspace = Self { folder, scene };
        workspace.write(scene, text);
        workspace
    }

    pub fn path(&self, name: &str) -> PathBuf {
        self.folder.path().join(name)
    }

    pub fn write(&self, name: &str, bytes: impl AsRef<[u8]>) {
        fs::write(self.path(name), bytes).expect("a file");
    }

    pub fn read(&self, name: &str) -> Vec<u8> {
        fs::read(self.path(name)).expect(name)
    }

    pub fn command(&self, line: &str) -> Command {
        let mut command = Command::new(env!("CARGO_BIN_EXE_glimray"));
        command.current_dir(self.folder.path());
        command.args(line.split_whitespace()).stdin(Stdio::null());
        // With a display, the program would open its window.
        for name in ["DISPLAY", "WAYLAND_DISPLAY", "WAYLAND_SOCKET"] {
            command.env_remove(name);
        }
        command
    }

    pub fn run(&self, line: &str) -> Run {
        Run::from(self.command(line).output().expect("glimray runs"))
    }

    /// Saves a PNG or OpenEXR picture.
    pub fn picture(&self, name: &str, width: u32, pixels: &[[f32; 3]]) {
        let image = Image {
            width,
            height: pixels.len() as u32 / width,
            pixels: pixels.iter().map(|&[r, g, b]| [r, g, b, 1.0]).collect(),
        };
        output::save(self.path(name), &image).expect("saved");
    }

    /// Runs `animate` on the scene with small pictures, a report and more flags. It must exit with `code`.
    #[track_caller]
    pub fn animate(&self, flags: &str, code: i32) -> Run {
        let scene = self.scene;
        let line = format!("animate {scene} --size 32x24 --report - {flags}");
        self.run(&line).expect(code)
    }

    pub fn start(&self, line: &str) -> Child {
        let mut command = self.command(line);
        command.stdout(Stdio::null()).stderr(Stdio::piped());
        command.spawn().expect("glimray runs")
    }

    /// All files in a folder, including hidden ones.
    pub fn files(&self, folder: &str) -> Files {
        read_folder(&self.path(folder))
    }

    /// The names of all entries of a folder, including hidden files, folders and pipes.
    pub fn names(&self, folder: &str) -> Vec<String> {
        let entries = fs::read_dir(self.path(folder)).expect("a folder");
        let names = entries.map(|entry| entry.expect("an entry").file_name());
        let mut names: Vec<_> = names
            .map(|name| name.to_string_lossy().into_owned())
            .collect();
        names.sort();
        names
    }

    /// The names of all entries beside the scene, including hidden files.
    pub fn made(&self) -> Vec<String> {
        let mut names = self.names(".");
        names.retain(|name| name != self.scene);
        names
    }

    /// The names of frames in a folder.
    pub fn frames(&self, folder: &str) -> Vec<String> {
        let names = self.files(folder).into_keys();
        names
            .filter(|name| name.ends_with(".png") && !name.starts_with('.'))
            .collect()
    }
}

impl From<Output> for Run {
    fn from(output: Output) -> Self {
        Self {
            code: output.status.code(),
            report: serde_json::from_slice(&output.stdout).unwrap_or_default(),
            stdout: output.stdout,
            stderr: String::from_utf8(output.stderr).expect("messages are text"),
        }
    }
}

impl Run {
    pub fn text(&self) -> &str {
        std::str::from_utf8(&self.stdout).expect("text on standard output")
    }

    pub fn json(&self) -> Value {
        serde_json::from_slice(&self.stdout).expect("JSON on standard output")
    }

    /// Fails unless the run exited with `code`.
    #[track_caller]
    pub fn expect(self, code: i32) -> Self {
        assert_eq!(self.code, Some(code), "{}", self.stderr);
        self
    }

    /// Numbers of frames that were rendered and reused.
    pub fn counts(&self) -> (u64, u64) {
        let number = |name: &str| self.report["animation"][name].as_u64().expect(name);
        (number("rendered"), number("reused"))
    }

    #[track_caller]
    pub fn says(&self, words: &str) {
        assert!(self.stderr.contains(words), "{words}: {}", self.stderr);
    }
}

pub fn read_folder(folder: &Path) -> Files {
    let Ok(entries) = fs::read_dir(folder) else {
        return Files::new();
    };
    entries
        .map(|entry| entry.expect("an entry"))
        // Another process may remove files meanwhile.
        .filter(|entry| entry.path().is_file())
        .map(|entry| {
            let bytes = fs::read(entry.path()).unwrap_or_default();
            (entry.file_name().to_string_lossy().into_owned(), bytes)
        })
        .collect()
}
