//! `glimray farm plan SCENE`: measures, cuts, and writes the folder.

use super::manifest::{Frames, Manifest, Measured};
use super::measure::{Costs, measure};
use super::merge_costs::MergeCosts;
use super::target::Target;
use super::work::Work;
use super::{Folder, archive, command, flags, simulate};
use crate::animate::Timeline;
use crate::args::FarmPlanArgs;
use crate::device;
use crate::idle_flags;
use crate::interrupt::Interrupt;
use crate::job::Job;
use crate::memory;
use clap::ArgMatches;
use glimray_app::clock::Clock;
use glimray_app::console;
use glimray_app::error::AppError;
use glimray_app::overrides::picture_size;
use glimray_io::import::{self, EnvironmentSource};
use glimray_io::output::OutputError;
use glimray_render::Fingerprint;
use glimray_render::pack;
use std::ffi::OsString;
use std::fs;
use std::path::{Path, PathBuf};
use std::time::Instant;

pub fn run(
    arguments: &FarmPlanArgs,
    matches: &ArgMatches,
    started: Instant,
) -> Result<(), AppError> {
    let interrupt = Interrupt::install()?;
    let output = std::path::absolute(&arguments.path).map_err(|source| OutputError::Io {
        path: arguments.path.clone(),
        source,
    })?;
    let target = Target::parse(&arguments.path)?;
    let folder = Folder(
        arguments
            .dir
            .clone()
            .unwrap_or_else(|| beside(&arguments.path)),
    );
    if arguments.simulate.is_empty() {
        check_free(&folder)?;
    }
    idle_flags::check(&arguments.reading, &arguments.scene)?;
    let options = (arguments.camera).import_options(&arguments.reading, &arguments.picture);
    memory::check_file(&arguments.scene)?;
    let (scene, mut files) = import::load_watched(&arguments.scene, &options, &|_| ());
    let mut scene = scene?;
    arguments
        .camera
        .overrides(&arguments.reading)
        .apply(&mut scene)?;
    let clock = Clock::new(&scene.output, &arguments.motion.overrides());
    let timeline = match target.is_animation() {
        true => Some(Timeline::new(&scene, &arguments.range, clock)?),
        false => None,
    };
    let shutters: Vec<_> = match &timeline {
        Some(timeline) => timeline
            .numbers()
            .map(|number| timeline.clock.frame(number))
            .collect(),
        None => vec![clock.moment(&arguments.moment.moment())],
    };
    let job = Job {
        scene,
        picture: &arguments.picture,
        device: &arguments.device,
        log: &arguments.log,
        layers: &arguments.layers,
    };
    job.warn_of_skipped()?;
    target.check(&job, arguments, timeline.as_ref())?;
    let settings = job.settings();
    let path = arguments.scene.display().to_string();
    memory::check_scene(&job.scene, &path, picture_size(&settings)?)?;
    let gpu = device::open(&arguments.device)?;
    job.announce("a sample of ", &settings, gpu.adapter());
    let costs = measure(&job, &settings, gpu, &shutters, (started, &interrupt))?;
    let work = Work {
        settings: &settings,
        timeline,
        costs,
    };
    if !arguments.simulate.is_empty() {
        let Costs {
            film, sample, gpu, ..
        } = &work.costs;
        let output = (arguments.path.as_path(), arguments.quality);
        let merging = MergeCosts::measure(film, sample, gpu, output)?;
        return console::print(&simulate::table(&work, &arguments.simulate, &merging)?);
    }
    let total = work.seconds();
    let count = match (arguments.parts, arguments.minutes) {
        (Some(parts), _) => parts as usize,
        (None, Some(minutes)) => {
            let each = (60.0 * minutes - work.costs.start).max(1.0);
            (total / each).ceil().max(1.0) as usize
        }
        (None, None) => 1,
    };
    let parts = work.cut(count);
    let unfinished = folder.create()?;
    // The panorama has a path of its own and is copied beside the archive.
    let panorama = match &arguments.reading.environment {
        Some(EnvironmentSource::File(file)) => Some(file),
        Some(EnvironmentSource::Sky { .. } | EnvironmentSource::BuiltIn(_)) | None => None,
    };
    let environment =
        (panorama.map(|file| archive::copy(file, "environment", &folder))).transpose()?;
    files.retain(|file| Some(file) != panorama);
    let packed = archive::pack(&arguments.scene, &files, &folder)?;
    check_packed(&job, arguments, &options, &folder.path().join(&packed.file))?;
    let mut given = flags::given(matches);
    if environment.is_some() {
        given.retain(|flag| !flag.starts_with("--environment="));
    }
    let of_film = work.costs.film.header();
    let mut manifest = Manifest {
        version: Manifest::VERSION,
        glimray: env!("CARGO_PKG_VERSION").into(),
        output,
        quality: arguments.quality,
        scene: packed,
        environment,
        flags: given,
        scene_fingerprint: of_film.scene.to_string(),
        view_fingerprint: (!target.is_animation()).then(|| of_film.view.to_string()),
        settings_fingerprint: of_film.settings.to_string(),
        size: settings.size.into(),
        samples: settings.samples,
        frames: work.timeline.as_ref().map(|timeline| Frames {
            first: timeline.first,
            step: timeline.step,
            count: timeline.count as u32,
            fps: timeline.video_fps(),
            repeat: timeline.repeat,
        }),
        measured: Measured {
            adapter: work.costs.adapter.clone(),
            start_seconds: work.costs.start,
            render_seconds: total,
        },
        parts,
        checksum: String::new(),
    };
    // The manifest comes last: a folder without one is no farm.
    manifest.write(folder.path())?;
    unfinished.keep();
    report(&job, &manifest, count, &folder);
    Ok(())
}

fn beside(output: &Path) -> PathBuf {
    let mut folder = OsString::from(output);
    folder.push(".farm");
    folder.into()
}

/// Refuses a folder that has something in it.
fn check_free(folder: &Folder) -> Result<(), AppError> {
    let mut entries = fs::read_dir(folder.path()).into_iter().flatten();
    match entries.next().is_some() || folder.path().is_file() {
        true => Err(AppError::Unwritable(format!(
            "cannot plan ({}): the folder is not empty. Remove it, or name another one with --dir.",
            folder.path().display()
        ))),
        false => Ok(()),
    }
}

/// Checks that the packed scene is the scene.
fn check_packed(
    job: &Job,
    arguments: &FarmPlanArgs,
    options: &import::Options,
    path: &Path,
) -> Result<(), AppError> {
    let options = import::Options {
        allow_dirs: Vec::new(),
        ..options.clone()
    };
    let mut scene = import::load_with(path, &options)?;
    arguments
        .camera
        .overrides(&arguments.reading)
        .apply(&mut scene)?;
    let fingerprint = |scene| Ok::<_, AppError>(Fingerprint::of_scene(&pack::scene(scene)?));
    match fingerprint(&scene)? == fingerprint(&job.scene)? {
        true => Ok(()),
        false => Err(AppError::Refused(format!(
            "cannot pack the scene ({}): packed, it is not the same. Keep its files in one folder.",
            arguments.scene.display()
        ))),
    }
}

/// Says what was planned and what to do next.
fn report(job: &Job, manifest: &Manifest, wanted: usize, folder: &Folder) {
    let console = job.console();
    let count = manifest.parts.len();
    if count < wanted {
        console::warning(format_args!(
            "the picture cannot be cut into {wanted} parts, only into {count}."
        ));
    }
    let longest = (manifest.parts.iter()).map(|part| part.seconds);
    let longest = longest.fold(0.0, f64::max);
    console.status(format_args!(
        "planned {count} parts in {}: {:.1} s of rendering, {:.1} s for the longest part, and {:.1} s to start each",
        folder.path().display(),
        manifest.measured.render_seconds,
        longest,
        manifest.measured.start_seconds,
    ));
    console.status(format_args!(
        "next: {} --all, or {} --engine slurm",
        command("run", folder),
        command("submit", folder)
    ));
}
