//! `glimray render SCENE`: renders one picture of a scene file.

use crate::args::RenderArgs;
use crate::destination::Destination;
use crate::device::Opening;
use crate::idle_flags;
use crate::job;
use crate::job::Job;
use crate::picture;
use crate::report::Draft;
use glimray_app::clock::Clock;
use glimray_app::error::AppError;
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
    idle_flags::check(&arguments.reading, &arguments.scene)?;
    let opening = Opening::start(&arguments.device);
    let (job, shutter) = job(arguments, draft)?;
    picture::run(&job, opening, destination, shutter, &arguments.part, draft)
}

/// The scene with the options of the command line, and when the shutter opens and closes, in seconds.
///
/// # Errors
/// The scene is refused, or flags do not fit it.
pub fn job<'a>(
    arguments: &'a RenderArgs,
    draft: &mut Draft,
) -> Result<(Job<'a>, (f64, f64)), AppError> {
    let options = (arguments.camera).import_options(&arguments.reading, &arguments.picture);
    let mut scene = draft.load(&arguments.scene, &options, arguments.reading.strict)?;
    arguments
        .camera
        .overrides(&arguments.reading)
        .apply(&mut scene)?;
    let clock = Clock::new(&scene.output, &arguments.motion.overrides());
    let shutter = clock.moment(&arguments.moment.moment());
    let job = Job {
        scene,
        picture: &arguments.picture,
        device: &arguments.device,
        log: &arguments.log,
        layers: &arguments.layers,
    };
    Ok((job, shutter))
}
