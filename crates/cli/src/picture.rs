//! Renders a scene to a picture file, for `render` and `demo`.

use crate::args::PartFlags;
use crate::checkpoint::CheckpointFile;
use crate::destination::Destination;
use crate::device::{self, Opening};
use crate::interrupt::Interrupt;
use crate::job::Job;
use crate::layers::Finished;
use crate::progress::Progress;
use crate::report::Draft;
use glimray_app::error::AppError;
use glimray_app::legend;
use glimray_app::overrides::picture_size;
use glimray_render::{FilmError, Levels, RenderSettings, Renderer, SAMPLE_BLOCK, Tone};
use std::ops::Range;
use std::time::Instant;

/// Renders the picture exposed from `shutter.0` to `shutter.1`, in seconds, on the adapter that is being opened, and writes
/// it, and the report if one was requested.
///
/// # Errors
/// Any error of rendering and writing; no picture is then left on disk.
pub fn run(
    job: &Job,
    opening: Opening,
    destination: &Destination,
    shutter: (f64, f64),
    part: &PartFlags,
    draft: &mut Draft,
) -> Result<(), AppError> {
    let interrupt = Interrupt::install()?;
    job.warn_of_skipped()?;
    let settings = job.settings();
    let settings = RenderSettings {
        sample_range: range(part, destination, &settings)?,
        ..settings
    };
    job.check_format(
        &settings,
        destination.path(),
        destination.takes_layers(),
        destination.takes_opacity(),
    )?;
    let size = picture_size(&settings)?;
    draft.set_image(job.image(destination.path(), &settings, size));
    draft
        .inputs
        .refuse_overwrite(destination.path(), "picture", "-o")?;
    destination.check(size.0, size.1)?;
    job.check_report(draft)?;
    let mut checkpoint = CheckpointFile::new(&part.checkpoint, destination.path(), draft)?;

    let tone = job.tone(&settings, destination.is_linear());
    let tone = (!destination.is_film()).then_some(tone);
    let mut renderer = prepared(job, opening, shutter, &settings, tone, draft)?;
    if let Some(checkpoint) = &mut checkpoint {
        draft.resumed = checkpoint.resume(&mut renderer, job.console())?;
    }
    {
        let _deferred = interrupt.defer();
        let outcome = trace(job, &mut renderer, &interrupt, checkpoint.as_mut()).and_then(|()| {
            write(
                job,
                &mut renderer,
                &settings,
                destination,
                &interrupt,
                draft,
            )
        });
        match (outcome, checkpoint) {
            (Ok(()), Some(checkpoint)) => checkpoint.remove(),
            (Err(error), Some(mut checkpoint)) => {
                return Err(checkpoint.keep(&mut renderer, &interrupt, error));
            }
            (outcome, None) => outcome?,
        }
    }
    let pixels = u64::from(size.0) * u64::from(size.1);
    let made = (destination.path(), size, pixels);
    job.conclude(&settings, made, &renderer, None, draft)
}

/// The renderer of a scene while the shutter is open, from `shutter.0` to `shutter.1` in seconds. The scene is packed while
/// the adapter is being opened; `tone` is compiled beside the kernels.
///
/// # Errors
/// The scene takes too much memory or cannot be packed, or the adapter cannot be opened or cannot render it.
pub fn prepared(
    job: &Job,
    opening: Opening,
    shutter: (f64, f64),
    settings: &RenderSettings,
    tone: Option<Tone>,
    draft: &mut Draft,
) -> Result<Renderer, AppError> {
    let size = picture_size(settings)?;
    job.check_memory(size, draft)?;
    let policy = job.policy();
    let (gpu, packed) = job.pack(opening, shutter, "", (settings, &policy), draft)?;
    let renderer = device::prepared(gpu, packed, settings.clone(), policy, tone)?;
    draft.fetch = Some(device::fetch_report(&renderer)?);
    Ok(renderer)
}

/// The sample range that the flags select; `None` for all samples.
fn range(
    part: &PartFlags,
    destination: &Destination,
    settings: &RenderSettings,
) -> Result<Option<Range<u32>>, AppError> {
    let (start, total) = (part.sample_offset.unwrap_or(0), settings.samples);
    if part.sample_offset.is_none() && part.sample_count.is_none() {
        return Ok(None);
    }
    let refused = |why: String| Err(AppError::Usage(format!("cannot render a part {why}")));
    if !destination.is_film() {
        return refused(format!(
            "({}): only a film can store part of the samples. Choose a name that ends in .film.",
            destination.path().display()
        ));
    }
    if start >= total {
        return refused(format!(
            "(--sample-offset {start}): the picture has samples 0 to {}. Choose a smaller offset.",
            total - 1
        ));
    }
    let count = part.sample_count.unwrap_or(total - start);
    let end = start.saturating_add(count).min(total);
    if !start.is_multiple_of(SAMPLE_BLOCK) {
        return refused(format!(
            "(--sample-offset {start}): parts must start at a multiple of {SAMPLE_BLOCK}. Choose one."
        ));
    }
    if !end.is_multiple_of(SAMPLE_BLOCK) && end < total {
        return refused(format!(
            "(--sample-count {count}): parts must end at a multiple of {SAMPLE_BLOCK} or at the last sample. \
             Choose another count."
        ));
    }
    if settings.is_adaptive() {
        return refused(format!("(--antialias adaptive): {}", FilmError::Adaptive));
    }
    Ok(Some(start..end))
}

/// Renders all samples.
///
/// # Errors
/// The device fails, or the work was interrupted.
pub fn trace(
    job: &Job,
    renderer: &mut Renderer,
    interrupt: &Interrupt,
    mut checkpoint: Option<&mut CheckpointFile>,
) -> Result<(), AppError> {
    let mut progress = Progress::new(job.log);
    while !renderer.is_done() {
        interrupt.check()?;
        renderer.step()?;
        progress.update(renderer.progress());
        if let Some(checkpoint) = &mut checkpoint {
            checkpoint.save_if_due(renderer, interrupt);
        }
    }
    Ok(())
}

/// Writes the finished picture.
fn write(
    job: &Job,
    renderer: &mut Renderer,
    settings: &RenderSettings,
    destination: &Destination,
    interrupt: &Interrupt,
    draft: &mut Draft,
) -> Result<(), AppError> {
    draft.catcher_light = renderer.catcher_light()?;
    let started = if destination.is_film() {
        let mut film = renderer.film()?;
        film.set_tone(job.tone(settings, false));
        let started = Instant::now();
        destination.save_film(&film)?;
        started
    } else {
        let tone = job.tone(settings, destination.is_linear());
        let takes_layers = destination.takes_layers();
        let picture = develop(job, renderer, settings, &tone, takes_layers)?;
        interrupt.check()?;
        draft.seconds.denoise = picture.denoise_seconds();
        let started = Instant::now();
        destination.save(&picture)?;
        started
    };
    draft.seconds.write = started.elapsed().as_secs_f64();
    Ok(())
}

/// The finished picture. Warns if it is black, and tells the range of a quantity that it shows.
///
/// # Errors
/// The device fails.
pub fn develop(
    job: &Job,
    renderer: &mut Renderer,
    settings: &RenderSettings,
    tone: &Tone,
    takes_layers: bool,
) -> Result<Finished, AppError> {
    let image = job.finish(renderer, tone, takes_layers)?;
    if job.is_black(&image.image, tone, settings) {
        job.warn_of_darkness(tone, settings);
    }
    if let (Levels::Found, Some(quantity)) = (tone.levels, settings.integrator.quantity())
        && let Some(range) = renderer.range()?
    {
        (job.console()).status(format_args!("{}", legend::sentence(quantity, range)));
    }
    Ok(image)
}
