//! `glimray render SCENE`: a scene file → a picture.

use super::cli::{RenderArgs, SceneFlags};
use super::clock::Clock;
use super::destination::Destination;
use super::exit::AppError;
use super::inputs::Inputs;
use super::job::{self, Job};
use super::memory;
use super::overrides;
use super::picture;
use super::report::Draft;
use crate::import;
use crate::scene::Scene;
use std::path::Path;
use std::time::Instant;

pub fn run(arguments: &RenderArgs, started: Instant) -> Result<(), AppError> {
    let stem = arguments.scene.file_stem().unwrap_or("picture".as_ref());
    let destination = Destination::new(&arguments.output, Path::new(stem));
    job::check_report_name(&arguments.log, destination.path(), |_| false)?;
    let name = arguments.scene.display().to_string();
    let mut draft = Draft::new("render", &arguments.log, name, destination.path(), started);
    let outcome = render(arguments, &destination, &mut draft);
    draft.close(outcome)
}

fn render(
    arguments: &RenderArgs,
    destination: &Destination,
    draft: &mut Draft,
) -> Result<(), AppError> {
    let mut scene = draft.load(&arguments.scene, &arguments.reading)?;
    overrides::apply(&mut scene, &arguments.camera)?;
    let clock = Clock::new(&scene.output, &arguments.motion);
    let shot = clock.moment(&arguments.moment);
    let job = Job {
        scene,
        picture: &arguments.picture,
        device: &arguments.device,
        log: &arguments.log,
    };
    picture::run(&job, destination, shot, &arguments.part, draft)
}

/// Reads a scene; `--strict` refuses one of which anything had to be skipped. What the scene names is
/// known as far as it was read, whether it could be or not.
pub fn load(path: &Path, flags: &SceneFlags) -> (Result<Scene, AppError>, Inputs) {
    if let Err(error) = memory::check_file(path) {
        return (Err(error), Inputs::new([path]));
    }
    let (scene, files) = import::load_watched(path, &flags.import_options());
    let scene = scene.map_err(AppError::from);
    (
        scene.and_then(|scene| strict(path, flags, scene)),
        Inputs::new(files),
    )
}

fn strict(path: &Path, flags: &SceneFlags, scene: Scene) -> Result<Scene, AppError> {
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
