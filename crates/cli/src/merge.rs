//! `glimray merge PART…`: merges films of parts of a picture into one film or into the picture.
//!
//! The outlines of all parts are read first: parts that do not belong together are refused before any sums are read. Then
//! the sums of one part after the other are added, so that memory depends on the picture and not on the number of parts.

use crate::args::MergeArgs;
use crate::destination::Destination;
use crate::interrupt::Interrupt;
use crate::job;
use glimray_app::console;
use glimray_app::error::AppError;
use glimray_app::inputs::Inputs;
use glimray_app::overrides::picture_size;
use glimray_render::gpu::Gpu;
use glimray_render::{Film, FilmError, FilmHeader, FilmOutline, Missing, RenderSettings};
use glimray_scene::OutputDefaults;
use std::fs::File;
use std::io::BufReader;
use std::path::{Path, PathBuf};

/// Largest number of missing parts that the error message lists; the commands for them are complete.
const MAX_LISTED: usize = 8;

pub fn run(arguments: &MergeArgs) -> Result<(), AppError> {
    let interrupt = Interrupt::install()?;
    let stem = arguments.parts[0].file_stem().unwrap_or("picture".as_ref());
    let destination = Destination::new(&arguments.output, Path::new(stem));
    Inputs::new(&arguments.parts).refuse_overwrite(destination.path(), "picture", "-o")?;
    let outlines = outlines(&arguments.parts, &interrupt)?;
    let whole = whole(&arguments.parts, &outlines)?;
    check_adapters(whole.header(), destination.path(), arguments.same_adapter)?;
    let missing = whole.missing_of(region(arguments.crop, whole.header().size)?);
    if !missing.is_empty() && !arguments.partial {
        // A damaged header can look like that of other samples.
        for path in &arguments.parts {
            interrupt.check()?;
            read(path)?;
        }
        if !destination.is_stdout() {
            console::print(&commands(whole.header(), &missing))?;
        }
        return Err(AppError::Missing(format!(
            "{}. Add films of these parts, or write what is there with --partial.",
            incomplete(destination.path(), &missing)
        )));
    }
    arguments.layers.check(
        arguments.develop.denoise() == Some(true),
        whole.header().integrator,
        destination.path(),
        destination.takes_layers(),
    )?;
    if whole.header().has_opacity() && !destination.takes_opacity() {
        return Err(AppError::Usage(job::no_opacity(destination.path())));
    }
    let (width, height) = whole.header().size;
    destination.check(width, height)?;
    let film = sum(&arguments.parts, &outlines, whole, &interrupt)?;
    if !missing.is_empty() {
        let why = incomplete(destination.path(), &missing);
        console::warning(format_args!("{why}."));
    }
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
        integrator: (*integrator).into(),
        denoise: tone.denoise,
        ..OutputDefaults::default()
    };
    let is_linear = destination.is_linear();
    let tone = arguments
        .develop
        .overrides()
        .tone(&said, *integrator, is_linear);
    let gpu = Gpu::new(&arguments.device.choice())?;
    let takes_layers = destination.takes_layers();
    let finished = (arguments.layers).finish(&film, &gpu, &tone, takes_layers)?;
    destination.save(&finished.placed(film.region(), film.header().size))
}

/// The pixels that must be complete: x, y, width, height.
fn region(crop: Option<[u32; 4]>, size: (u32, u32)) -> Result<[u32; 4], AppError> {
    let settings = RenderSettings {
        size,
        crop,
        ..RenderSettings::default()
    };
    picture_size(&settings)?;
    Ok(settings.region())
}

/// The outline of each part.
fn outlines(parts: &[PathBuf], interrupt: &Interrupt) -> Result<Vec<FilmOutline>, AppError> {
    let outline = |path: &PathBuf| {
        interrupt.check()?;
        let read = open(path).and_then(FilmOutline::read);
        read.map_err(|error| refused(path, error))
    };
    parts.iter().map(outline).collect()
}

/// The outline of all parts together. If one does not belong to the others, the error names both.
fn whole(parts: &[PathBuf], outlines: &[FilmOutline]) -> Result<FilmOutline, AppError> {
    let mut whole = outlines[0].clone();
    for (index, outline) in outlines.iter().enumerate().skip(1) {
        whole = whole.merge(outline).map_err(|error| {
            let is_other = |earlier: &FilmOutline| earlier.merge(outline).is_err();
            let other = outlines[..index].iter().position(is_other).unwrap_or(0);
            // A damaged header looks like that of another picture.
            for path in [&parts[other], &parts[index]] {
                if let Err(error) = read(path) {
                    return error;
                }
            }
            AppError::Films {
                paths: [parts[other].clone(), parts[index].clone()],
                error,
            }
        })?;
    }
    Ok(whole)
}

/// The film of all parts, whose outline is `whole`.
fn sum(
    parts: &[PathBuf],
    outlines: &[FilmOutline],
    whole: FilmOutline,
    interrupt: &Interrupt,
) -> Result<Film, AppError> {
    if let [only] = parts {
        return read(only);
    }
    let mut film = whole.blank();
    for (path, outline) in parts.iter().zip(outlines) {
        interrupt.check()?;
        let part = read(path)?;
        if part.outline() != *outline {
            let why = "it changed while it was being merged";
            return Err(refused(path, FilmError::Damaged { why }));
        }
        film.add(&part);
    }
    Ok(film)
}

/// A film, with its checksum compared.
fn read(path: &PathBuf) -> Result<Film, AppError> {
    let film = open(path).and_then(Film::read);
    film.map_err(|error| refused(path, error))
}

fn open(path: &PathBuf) -> Result<BufReader<File>, FilmError> {
    Ok(BufReader::new(File::open(path)?))
}

fn refused(path: &Path, error: FilmError) -> AppError {
    AppError::Film {
        path: path.into(),
        error,
    }
}

/// Refuses parts of several adapters, or warns about them.
fn check_adapters(header: &FilmHeader, path: &Path, same_only: bool) -> Result<(), AppError> {
    if header.adapters.len() < 2 {
        return Ok(());
    }
    let adapters: Vec<_> = header.adapters.iter().map(String::as_str).collect();
    let adapters = adapters.join(", ");
    if same_only {
        return Err(AppError::Refused(format!(
            "cannot merge ({}): the parts are of different adapters, {adapters}. Render them on one kind of adapter, or \
             omit --same-adapter.",
            path.display()
        )));
    }
    console::warning(format_args!(
        "the parts are of different adapters ({adapters}), which may round differently; --same-adapter refuses them."
    ));
    Ok(())
}

/// Lists missing parts, without a full stop.
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
        "the picture is incomplete ({}): missing {}{more}",
        path.display(),
        listed.join(", ")
    )
}

/// For each missing part the command that renders it. `SCENE` stands for the scene with its flags.
fn commands(header: &FilmHeader, missing: &[Missing]) -> String {
    let (width, height) = header.size;
    let command = |(index, Missing { region, samples }): (usize, &Missing)| {
        let mut line = format!(
            "glimray render SCENE --integrator {} --size {width}x{height} --samples {}",
            header.integrator.entry().name,
            header.samples
        );
        if *samples != (0..header.samples) {
            let count = samples.end - samples.start;
            line += &format!(" --sample-offset {} --sample-count {count}", samples.start);
        }
        if *region != [0, 0, width, height] {
            let [x, y, across, down] = region;
            line += &format!(" --crop {x},{y},{},{}", x + across, y + down);
        }
        format!("{line} -o missing-{}.film\n", index + 1)
    };
    missing.iter().enumerate().map(command).collect()
}
