//! `glimray merge PART…`: merges films of parts of a picture into one film or into the picture.

use crate::app::error::AppError;
use crate::app::inputs::Inputs;
use crate::cli::args::MergeArgs;
use crate::cli::destination::Destination;
use crate::cli::interrupt::Interrupt;
use crate::cli::job;
use crate::gpu::Gpu;
use crate::render::{Film, FilmError, FilmHeader, Missing};
use crate::scene::OutputDefaults;
use std::fs::File;
use std::io::BufReader;
use std::path::{Path, PathBuf};

/// Largest number of missing parts that are listed.
const MAX_LISTED: usize = 8;

pub fn run(arguments: &MergeArgs) -> Result<(), AppError> {
    let interrupt = Interrupt::install()?;
    let stem = arguments.parts[0].file_stem().unwrap_or("picture".as_ref());
    let destination = Destination::new(&arguments.output, Path::new(stem));
    Inputs::new(&arguments.parts).refuse_overwrite(destination.path(), "picture", "-o")?;
    let mut all: Option<Film> = None;
    for path in &arguments.parts {
        interrupt.check()?;
        let refused = |error| AppError::Film {
            path: path.clone(),
            error,
        };
        let part = read(path).map_err(refused)?;
        all = Some(match all {
            None => part,
            Some(all) => all.merge(&part).map_err(refused)?,
        });
    }
    let Some(film) = all else {
        return Err(AppError::Internal("merge: no parts".into()));
    };
    let missing = film.missing();
    if !missing.is_empty() {
        return Err(AppError::Missing(incomplete(destination.path(), &missing)));
    }
    arguments.layers.check(
        arguments.develop.denoise,
        film.header().integrator,
        destination.path(),
        destination.takes_layers(),
    )?;
    if film.header().has_opacity() && !destination.takes_opacity() {
        return Err(AppError::Usage(job::no_opacity(destination.path())));
    }
    let (width, height) = film.header().size;
    destination.check(width, height)?;
    if destination.is_film() {
        return destination.save_film(&film);
    }
    let FilmHeader {
        integrator, tone, ..
    } = film.header();
    let said = OutputDefaults {
        exposure_ev: tone.exposure_ev,
        auto_exposure: tone.auto_exposure,
        tone: Some(tone.curve),
        transfer: tone.transfer,
        ..OutputDefaults::default()
    };
    let is_linear = destination.is_linear();
    let tone = arguments
        .develop
        .overrides()
        .tone(&said, *integrator, is_linear);
    let gpu = Gpu::new(&arguments.device.choice())?;
    destination.save(&arguments.layers.finish(&film, &gpu, &tone)?)
}

fn read(path: &PathBuf) -> Result<Film, FilmError> {
    Film::read(BufReader::new(File::open(path)?))
}

/// The error message for missing parts.
fn incomplete(path: &Path, missing: &[Missing]) -> String {
    let part = |Missing { region, samples }: &Missing| {
        let [x, y, width, height] = region;
        let (first, last) = (samples.start, samples.end - 1);
        format!("samples {first} to {last} of {width}×{height} pixels at {x},{y}")
    };
    let listed: Vec<_> = missing.iter().take(MAX_LISTED).map(part).collect();
    let more = match missing.len().saturating_sub(MAX_LISTED) {
        0 => String::new(),
        count => format!(", and {count} more parts"),
    };
    format!(
        "cannot complete the picture ({}): missing {}{more}. Add films of these parts.",
        path.display(),
        listed.join(", ")
    )
}
