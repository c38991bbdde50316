//! Scene → picture in a file: what `render` and `demo` share.

use super::destination::Destination;
use super::device;
use super::exit::AppError;
use super::interrupt::Interrupt;
use super::job::{self, Job, Outcome};
use super::legend;
use super::progress::Progress;
use super::report::Draft;
use crate::image::Image;
use crate::render::{Levels, Renderer, Settings};
use std::time::Instant;

/// Renders the picture that is taken while the shutter is open, from `shot.0` to `shot.1` in
/// seconds, and writes it, and the report if one is asked for.
///
/// # Errors
/// Whatever goes wrong on the way; no picture is then left on the disk.
pub fn run(
    job: &Job,
    destination: &Destination,
    shot: (f64, f64),
    draft: &mut Draft,
) -> Result<(), AppError> {
    let interrupt = Interrupt::install()?;
    job.warn_of_skipped();
    let settings = job.settings();
    let size = job::picture_size(&settings)?;
    draft.plan(job.image(destination.path(), &settings, size));
    draft.inputs.spare(destination.path(), "picture", "-o")?;
    destination.check(size.0, size.1)?;
    job.check_report(draft)?;

    let gpu = job.open_gpu(size, draft)?;
    job.announce("", &settings, gpu.adapter());
    let (mut renderer, bvh_seconds) = device::renderer(gpu, &job.scene, shot, settings.clone())?;
    draft.seconds.bvh = bvh_seconds;
    {
        let _deferred = interrupt.defer();
        let image = trace(job, &mut renderer, &settings, destination, &interrupt)?;
        let started = Instant::now();
        destination.save(&image)?;
        draft.seconds.write = started.elapsed().as_secs_f64();
    }
    let stats = renderer.stats();
    draft.seconds.take(stats);
    draft.seconds.total = draft.started.elapsed().as_secs_f64();
    Job::warn_of_losses(stats);
    let path = destination.path();
    job.console().status(format_args!(
        "wrote {} ({:.2} s)",
        path.display(),
        draft.seconds.total
    ));
    job.report(
        &settings,
        Outcome {
            path,
            size,
            pictures: 1,
            adapter: Some(renderer.adapter()),
            stats,
            animation: None,
        },
        draft,
    )
}

fn trace(
    job: &Job,
    renderer: &mut Renderer,
    settings: &Settings,
    destination: &Destination,
    interrupt: &Interrupt,
) -> Result<Image, AppError> {
    let mut progress = Progress::new(job.log);
    while !renderer.is_done() {
        interrupt.check()?;
        renderer.step()?;
        progress.update(renderer.progress());
    }
    let tone = job.tone(settings, destination.is_linear());
    let image = renderer.develop(&tone)?;
    interrupt.check()?;
    if let (Levels::Found, Some(quantity)) = (tone.levels, settings.integrator.quantity())
        && let Some(range) = renderer.range()?
    {
        (job.console()).status(format_args!("{}", legend::sentence(quantity, range)));
    }
    Ok(image)
}
