//! `glimray render SCENE`: a scene file → a picture.

use super::cli::{RenderArgs, SceneFlags};
use super::clock::Clock;
use super::destination::Destination;
use super::exit::AppError;
use super::job::Job;
use super::overrides;
use super::picture;
use crate::import;
use crate::scene::Scene;
use std::path::Path;
use std::time::Instant;

pub fn run(arguments: &RenderArgs, started: Instant) -> Result<(), AppError> {
    let loading = Instant::now();
    let mut scene = load(&arguments.scene, &arguments.reading)?;
    let load_seconds = loading.elapsed().as_secs_f64();
    overrides::apply(&mut scene, &arguments.camera)?;
    let clock = Clock::new(&scene.output, &arguments.motion);
    let shot = clock.moment(&arguments.moment);
    let stem = arguments.scene.file_stem().unwrap_or("picture".as_ref());
    let destination = Destination::new(&arguments.output, Path::new(stem));
    let job = Job {
        command: "render",
        scene_path: arguments.scene.display().to_string(),
        scene,
        background: arguments.camera.background,
        picture: &arguments.picture,
        device: &arguments.device,
        log: &arguments.log,
        started,
        load_seconds,
    };
    picture::run(&job, &destination, shot)
}

/// Reads a scene; `--strict` refuses one of which anything had to be skipped.
pub fn load(path: &Path, flags: &SceneFlags) -> Result<Scene, AppError> {
    let scene = import::load_with(path, &flags.import_options())?;
    match scene.skipped.first() {
        Some(first) if flags.strict => Err(AppError::Refused(format!(
            "refusing the scene ({}): {first}{}. Repair it or leave out --strict.",
            path.display(),
            match scene.skipped.len() - 1 {
                0 => String::new(),
                more => format!(" (and {more} more)"),
            }
        ))),
        _ => Ok(scene),
    }
}
