//! `glimray farm plan SCENE`: measures, cuts, and writes the folder.

use super::cut::{self, Picture};
use super::manifest::{self, Frames, Manifest, Measured, Part};
use super::measure::{Costs, measure};
use super::simulate::{Spread, drawn, efficiency};
use super::{Folder, archive, command, flags, write};
use crate::app::clock::Clock;
use crate::app::console;
use crate::app::error::AppError;
use crate::app::overrides::picture_size;
use crate::cli::animate::{Pattern, Timeline};
use crate::cli::args::FarmPlanArgs;
use crate::cli::interrupt::Interrupt;
use crate::cli::job::Job;
use crate::cli::memory;
use crate::gpu::Gpu;
use crate::import::{self, EnvironmentSource};
use crate::output::video::VideoFormat;
use crate::output::{Format, OutputError};
use crate::pack;
use crate::render::{Fingerprint, RenderSettings, SAMPLE_BLOCK};
use clap::ArgMatches;
use std::ffi::OsString;
use std::fs;
use std::path::{Path, PathBuf};
use std::time::Instant;

/// Parts for each machine that `--simulate` tries.
const PARTS_PER_NODE: [usize; 7] = [1, 2, 4, 8, 16, 32, 64];

/// Spread of the costs in a simulation, and the seed of their errors.
const SPREAD: Spread = Spread(0.1);
const SEED: u64 = 18;

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
    let is_animation = check_output(&arguments.path)?;
    let folder = Folder(
        arguments
            .dir
            .clone()
            .unwrap_or_else(|| beside(&arguments.path)),
    );
    if arguments.simulate.is_empty() {
        check_free(&folder)?;
    }
    let size = arguments.picture.size.size;
    let options = arguments.reading.import_options(
        arguments.camera.model_axis(),
        size,
        arguments.picture.integrator,
    );
    memory::check_file(&arguments.scene)?;
    let (scene, mut files) = import::load_watched(&arguments.scene, &options, &|_| ());
    let mut scene = scene?;
    arguments
        .camera
        .overrides(&arguments.reading)
        .apply(&mut scene)?;
    let clock = Clock::new(&scene.output, &arguments.motion.overrides());
    let timeline = match is_animation {
        true => Some(Timeline::new(&scene, &arguments.range, clock)?),
        false => None,
    };
    let shutters: Vec<_> = match &timeline {
        Some(timeline) => timeline
            .numbers()
            .map(|number| clock.frame(number))
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
    job.warn_of_skipped();
    let settings = job.settings();
    let path = arguments.scene.display().to_string();
    memory::check_scene(&job.scene, &path, picture_size(&settings)?)?;
    let gpu = Gpu::new(&arguments.device.choice())?;
    job.announce("a sample of ", &settings, gpu.adapter());
    let costs = measure(&job, &settings, gpu, &shutters, (started, &interrupt))?;
    let work = Work {
        settings: &settings,
        timeline,
        costs,
    };
    if !arguments.simulate.is_empty() {
        return console::print(&simulation(&work, &arguments.simulate));
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
    folder.create()?;
    // It is read from a path of its own, and copied beside the archive.
    let panorama = match &arguments.reading.environment {
        Some(EnvironmentSource::File(file)) => Some(file),
        Some(EnvironmentSource::Sky { .. }) | None => None,
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
    let manifest = Manifest {
        version: Manifest::VERSION,
        glimray: env!("CARGO_PKG_VERSION").into(),
        output,
        quality: arguments.quality,
        scene: packed,
        environment,
        flags: given,
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
    };
    // The manifest comes last: a folder without one is no farm.
    write(&folder.path().join(manifest::NAME), &manifest)?;
    report(&job, &manifest, count, &folder);
    Ok(())
}

/// What is to be cut.
struct Work<'a> {
    settings: &'a RenderSettings,
    timeline: Option<Timeline>,
    costs: Costs,
}

impl Work<'_> {
    fn seconds(&self) -> f64 {
        self.costs.frames.iter().sum()
    }

    /// At least `count` parts, or as many as there can be.
    fn cut(&self, count: usize) -> Vec<Part> {
        let Some(timeline) = &self.timeline else {
            return self.pieces(None, self.costs.frames[0], count);
        };
        let numbers: Vec<u32> = timeline.numbers().collect();
        if count <= numbers.len() {
            let ranges = cut::even(&self.costs.frames, count);
            let part = |range: std::ops::Range<usize>| Part {
                frames: Some([numbers[range.start], numbers[range.end - 1]]),
                samples: None,
                crop: None,
                seconds: self.costs.frames[range].iter().sum(),
            };
            return ranges.into_iter().map(part).collect();
        }
        let each = count.div_ceil(numbers.len());
        (numbers.iter().zip(&self.costs.frames))
            .flat_map(|(number, seconds)| self.pieces(Some(*number), *seconds, each))
            .collect()
    }

    /// The parts of one picture, which takes `seconds`.
    fn pieces(&self, frame: Option<u32>, seconds: f64, count: usize) -> Vec<Part> {
        let [x, y, width, height] = self.settings.region();
        let region = [x, y, x + width, y + height];
        let known: f64 = self.costs.rows.iter().sum();
        let factor = if known > 0.0 { seconds / known } else { 0.0 };
        let picture = Picture {
            region,
            samples: self.settings.samples,
            has_blocks: !self.settings.is_adaptive(),
            rows: self.costs.rows.iter().map(|row| row * factor).collect(),
        };
        let pieces = picture.cut(count);
        // A frame that is not cut is rendered as a frame.
        let is_whole_frame = frame.is_some() && pieces.len() == 1;
        let whole = [0, 0, self.settings.size.0, self.settings.size.1];
        let part = |piece: cut::Piece| Part {
            frames: frame.map(|frame| [frame, frame]),
            samples: (!is_whole_frame && piece.samples != (0..self.settings.samples))
                .then_some([piece.samples.start, piece.samples.end]),
            crop: (!is_whole_frame && piece.crop != whole).then_some(piece.crop),
            seconds: piece.seconds,
        };
        pieces.into_iter().map(part).collect()
    }
}

/// A table of what the cut is worth on these numbers of machines.
fn simulation(work: &Work, nodes: &[u32]) -> String {
    let rows = work.settings.region()[3];
    let (width, height) = work.settings.size;
    let what = match &work.timeline {
        Some(timeline) => format!("{} frames of ", timeline.count),
        None => String::new(),
    };
    let mut table = format!(
        "{what}{width}x{height} with {} samples: {:.0} s of rendering on {}, {:.1} s to start a process\n\n\
         | machines | parts | a part, s | all, s | efficiency | part, MB | merge, MB read | memory, MB |\n\
         |---|---|---|---|---|---|---|---|\n",
        work.settings.samples,
        work.seconds(),
        work.costs.adapter,
        work.costs.start,
    );
    for &nodes in nodes {
        let nodes = nodes as usize;
        let candidates = PARTS_PER_NODE.iter().map(|each| {
            let parts = work.cut(each * nodes);
            let seconds: Vec<f64> = parts.iter().map(|part| part.seconds).collect();
            let seconds = drawn(&seconds, SPREAD, SEED);
            (
                efficiency(&seconds, work.costs.start, nodes),
                seconds,
                parts,
            )
        });
        let best = candidates.max_by(|(a, ..), (b, ..)| a.total_cmp(b));
        let Some((share, seconds, parts)) = best else {
            continue;
        };
        let total: f64 = seconds.iter().sum();
        let bytes: u64 = parts
            .iter()
            .map(|part| film_bytes(work.settings, part))
            .sum();
        let largest = parts.iter().map(|part| film_bytes(work.settings, part));
        let largest = largest.max().unwrap_or(0);
        // Sums of the whole picture, and one part.
        let pixels = u64::from(width) * u64::from(rows);
        let memory = match parts[0].is_film() {
            true => pixels * row_bytes(work.settings.samples) + largest,
            false => pixels * 4 * size_of::<f32>() as u64,
        };
        let mega = |bytes: u64| bytes as f64 / 1e6;
        table += &format!(
            "| {nodes} | {} | {:.1} | {:.1} | {share:.3} | {:.1} | {:.0} | {:.0} |\n",
            parts.len(),
            total / parts.len() as f64,
            total / (share * nodes as f64),
            mega(largest),
            mega(bytes),
            mega(memory),
        );
    }
    table += "\nCosts are drawn with a spread of 10 % around what was measured.\n";
    table
}

/// Bytes of a row of a pixel with so many samples in a film: f32 sums of one block, or exact totals.
fn row_bytes(samples: u32) -> u64 {
    match samples <= SAMPLE_BLOCK {
        true => size_of::<[f32; 4]>() as u64,
        false => size_of::<[i128; 4]>() as u64,
    }
}

/// Bytes of the film of a part without layers; 0 for whole frames.
fn film_bytes(settings: &RenderSettings, part: &Part) -> u64 {
    if !part.is_film() {
        return 0;
    }
    let [x0, y0, x1, y1] = part
        .crop
        .unwrap_or([0, 0, settings.size.0, settings.size.1]);
    let samples = part
        .samples
        .map_or(settings.samples, |[start, end]| end - start);
    u64::from(x1 - x0) * u64::from(y1 - y0) * row_bytes(samples)
}

/// Whether the output is an animation.
///
/// # Errors
/// Its name says neither a picture nor an animation.
fn check_output(path: &Path) -> Result<bool, AppError> {
    let ending = path.extension().unwrap_or_default();
    if VideoFormat::from_path(path).is_some() || Pattern::parse(path).is_ok() {
        return Ok(true);
    }
    match Format::from_path(path).is_some() || ending.eq_ignore_ascii_case("film") {
        true => Ok(false),
        false => Err(AppError::Usage(format!(
            "cannot plan ({}): the name is none of a picture ({}, .film), of a video ({}) or of frames. Choose another \
             name.",
            path.display(),
            Format::ENDINGS,
            VideoFormat::ENDINGS
        ))),
    }
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
