//! The time to the first picture: of a whole process, with and without a shader cache.

use super::figure::Figure;
use super::workloads::course_text;
use crate::args::DeviceFlags;
use glimray_app::error::AppError;
use serde::Serialize;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use std::time::Instant;
use std::{env, fs, process};

/// Settings that keep a driver from reading and writing its cache: Mesa's and NVIDIA's.
const WITHOUT_CACHE: [(&str, &str); 2] = [
    ("MESA_SHADER_CACHE_DISABLE", "true"),
    ("__GL_SHADER_DISK_CACHE", "0"),
];

/// The command lines to measure, before `-o PICTURE`.
const COMMANDS: [(&str, &[&str]); 2] = [
    (
        "first-picture-course",
        &["render", SCENE, "--size", "640x480"],
    ),
    ("first-picture-demo", &["demo"]),
];
const SCENE: &str = "course.scene";

/// Times of a command, in seconds from start to exit.
pub struct FirstPicture {
    name: &'static str,
    arguments: &'static [&'static str],
    folder: Folder,
    device: Vec<String>,
    cold: Vec<f64>,
    warm: Vec<f64>,
}

/// The medians of a command.
#[derive(Debug, Serialize)]
pub struct Row {
    name: &'static str,
    /// Without a shader cache.
    cold_seconds: Figure,
    /// With the cache that an earlier run has filled.
    warm_seconds: Figure,
}

/// The commands whose names pass the filter.
///
/// # Errors
/// The folder for temporary files cannot be written.
pub fn selected(
    is_selected: impl Fn(&str) -> bool,
    device: &DeviceFlags,
) -> Result<Vec<FirstPicture>, AppError> {
    let chosen = COMMANDS.into_iter().filter(|(name, _)| is_selected(name));
    let first_picture = |(name, arguments)| {
        Ok(FirstPicture {
            name,
            arguments,
            folder: Folder::new(name)?,
            device: command_line(device),
            cold: Vec::new(),
            warm: Vec::new(),
        })
    };
    chosen.map(first_picture).collect()
}

impl FirstPicture {
    /// Runs the command once without and once with the cache.
    ///
    /// # Errors
    /// The program cannot be started or fails.
    pub fn run(&mut self) -> Result<(), AppError> {
        if self.warm.is_empty() {
            self.seconds(&[])?;
        }
        self.cold.push(self.seconds(&WITHOUT_CACHE)?);
        self.warm.push(self.seconds(&[])?);
        Ok(())
    }

    fn seconds(&self, variables: &[(&str, &str)]) -> Result<f64, AppError> {
        let fault = |why: String| AppError::Internal(format!("bench: {}: {why}", self.name));
        let program = env::current_exe().map_err(|error| fault(error.to_string()))?;
        let started = Instant::now();
        let output = Command::new(program)
            .args(self.arguments)
            .args(["-o", "picture.png", "--quiet"])
            .args(&self.device)
            .envs(variables.iter().copied())
            .current_dir(&self.folder.0)
            .stdin(Stdio::null())
            .output()
            .map_err(|error| fault(error.to_string()))?;
        let seconds = started.elapsed().as_secs_f64();
        match output.status.success() {
            true => Ok(seconds),
            false => Err(fault(String::from_utf8_lossy(&output.stderr).trim().into())),
        }
    }

    /// The figures of all runs.
    pub fn row(&self) -> Row {
        Row {
            name: self.name,
            cold_seconds: Figure::of(self.cold.iter().copied()),
            warm_seconds: Figure::of(self.warm.iter().copied()),
        }
    }
}

/// The flags that choose the adapter.
fn command_line(device: &DeviceFlags) -> Vec<String> {
    let adapter = device.adapter.clone().map(|adapter| ("--adapter", adapter));
    let backend = device
        .backend
        .map(|backend| ("--backend", backend.name().to_owned()));
    let flags = adapter.into_iter().chain(backend);
    flags
        .flat_map(|(flag, value)| [flag.to_owned(), value])
        .collect()
}

impl Row {
    /// A line for people.
    pub fn text(&self) -> String {
        format!(
            "{:<20} whole process: {:.3} s without a shader cache, {:.3} s with it\n",
            self.name, self.cold_seconds, self.warm_seconds
        )
    }
}

/// A temporary folder with a scene in it.
struct Folder(PathBuf);

impl Folder {
    fn new(name: &str) -> Result<Self, AppError> {
        let folder = env::temp_dir().join(format!("glimray-{name}-{}", process::id()));
        let write = |path: &Path| {
            fs::create_dir_all(path)?;
            fs::write(path.join(SCENE), course_text(1500, 3))
        };
        let folder = Self(folder);
        write(&folder.0).map_err(|error| {
            AppError::Unwritable(format!(
                "cannot write the scene of the benchmark ({}): {error}. Set TMPDIR to another folder.",
                folder.0.display()
            ))
        })?;
        Ok(folder)
    }
}

impl Drop for Folder {
    fn drop(&mut self) {
        // A failure only leaves small files in the folder for temporary files.
        let _ = fs::remove_dir_all(&self.0);
    }
}
