//! `glimray render SCENE`: renders one picture of a scene file.

use super::cli::RenderArgs;
use super::clock::Clock;
use super::destination::Destination;
use super::error::AppError;
use super::job::{self, Job};
use super::overrides;
use super::picture;
use super::report::Draft;
use std::path::Path;
use std::time::Instant;

pub fn run(arguments: &RenderArgs, started: Instant) -> Result<(), AppError> {
    let stem = arguments.scene.file_stem().unwrap_or("picture".as_ref());
    let destination = Destination::new(&arguments.output, Path::new(stem));
    job::check_report_name(&arguments.log, destination.path(), |_| false)?;
    let name = arguments.scene.display().to_string();
    let mut draft = Draft::new("render", &arguments.log, name, destination.path(), started);
    let outcome = render(arguments, &destination, &mut draft);
    draft.finish(outcome)
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
