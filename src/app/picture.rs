//! Scene → picture in a file: what `render` and `demo` share.

use super::cli::{DeviceFlags, INTEGRATORS, LogFlags, PictureFlags};
use super::console::{self, Console};
use super::destination::Destination;
use super::device;
use super::exit::AppError;
use super::interrupt::Interrupt;
use super::progress::Progress;
use super::report::{self, ImageReport, Memory, Report, SceneReport, Seconds};
use crate::gpu::Gpu;
use crate::image::Image;
use crate::output;
use crate::render::{Integrator, Renderer, Settings, Tone};
use crate::scene::{OutputDefaults, Scene, ToneCurve, Transfer};
use std::path::Path;
use std::time::Instant;

/// A scene to be rendered, and everything the command line says about it.
pub struct Job<'a> {
    /// The command's name, for the report.
    pub command: &'static str,
    /// The scene's name, for the report.
    pub scene_path: String,
    /// With flags that win over it applied.
    pub scene: Scene,
    pub destination: Destination,
    pub picture: &'a PictureFlags,
    pub device: &'a DeviceFlags,
    pub log: &'a LogFlags,
    /// When the process began.
    pub started: Instant,
    /// What it took to read the scene.
    pub load_seconds: f64,
}

impl<'a> Job<'a> {
    /// Renders the picture and writes it, and the report if one is asked for.
    ///
    /// # Errors
    /// Whatever goes wrong on the way; nothing is then left on the disk.
    pub fn run(self) -> Result<(), AppError> {
        let interrupt = Interrupt::install()?;
        let console = Console::new(self.log);
        for skipped in &self.scene.skipped {
            console::warning(skipped);
        }
        let settings = settings(&self.scene.output, self.picture, self.device, self.log);
        let (width, height) = picture_size(&settings)?;
        self.destination.check(width, height)?;
        check_report(self.log.report.as_deref(), &self.destination)?;

        let mut seconds = Seconds {
            load: self.load_seconds,
            ..Seconds::default()
        };
        let mut renderer = self.prepare(&settings, console, &mut seconds)?;
        let image = {
            let _deferred = interrupt.defer();
            let image = self.trace(&mut renderer, &settings, &interrupt)?;
            let started = Instant::now();
            self.destination.save(&image)?;
            seconds.write = started.elapsed().as_secs_f64();
            image
        };
        self.finish(&renderer, &settings, &image, console, seconds)
    }

    /// Opens the adapter and hands it the scene.
    fn prepare(
        &self,
        settings: &Settings,
        console: Console,
        seconds: &mut Seconds,
    ) -> Result<Renderer, AppError> {
        let started = Instant::now();
        let gpu = Gpu::new(&self.device.choice())?;
        seconds.gpu = started.elapsed().as_secs_f64();
        let (width, height) = settings.size;
        let adapter = device::describe(gpu.adapter());
        console.status(format_args!("rendering {width}×{height} on {adapter}"));

        let (renderer, bvh_seconds) = device::renderer(gpu, &self.scene, settings.clone())?;
        seconds.bvh = bvh_seconds;
        Ok(renderer)
    }

    fn trace(
        &self,
        renderer: &mut Renderer,
        settings: &Settings,
        interrupt: &Interrupt,
    ) -> Result<Image, AppError> {
        let mut progress = Progress::new(self.log);
        while !renderer.is_done() {
            interrupt.check()?;
            renderer.step()?;
            progress.update(renderer.progress());
        }
        let tone = tone(
            &self.scene.output,
            self.picture,
            settings.integrator,
            self.destination.is_linear(),
        );
        let image = renderer.develop(&tone)?;
        interrupt.check()?;
        Ok(image)
    }

    /// Says what there is to say about the finished picture.
    fn finish(
        &self,
        renderer: &Renderer,
        settings: &Settings,
        image: &Image,
        console: Console,
        mut seconds: Seconds,
    ) -> Result<(), AppError> {
        let stats = renderer.stats();
        seconds.compile = stats.compile_seconds;
        seconds.upload = stats.upload_seconds;
        seconds.trace = stats.trace_seconds;
        seconds.develop = stats.develop_seconds;
        seconds.total = self.started.elapsed().as_secs_f64();
        if stats.device_losses > 0 {
            console::warning(format_args!(
                "the GPU was lost {} time(s); the work went on from the last finished slice.",
                stats.device_losses
            ));
        }
        if stats.nonfinite_samples > 0 {
            console::warning(format_args!(
                "{} samples were not finite and were dropped.",
                stats.nonfinite_samples
            ));
        }
        if stats.cut_off_trees > 0 {
            console::warning(format_args!(
                "{} samples had too many rays and were cut off. Lower --max-depth, or raise \
                 --min-throughput.",
                stats.cut_off_trees
            ));
        }
        let path = self.destination.path().display().to_string();
        console.status(format_args!("wrote {path} ({:.2} s)", seconds.total));
        let report = Report {
            glimray: env!("CARGO_PKG_VERSION"),
            command: self.command,
            scene: SceneReport::new(&self.scene_path, &self.scene),
            image: ImageReport {
                path,
                width: image.width,
                height: image.height,
                samples: settings.samples,
                mean_samples: stats.samples as f64
                    / (f64::from(image.width) * f64::from(image.height)),
                integrator: INTEGRATORS.word(&settings.integrator),
                max_depth: settings.max_depth,
                seed: settings.seed,
            },
            adapter: renderer.adapter().into(),
            seconds,
            rays: stats.rays.as_ref().map(Into::into),
            submissions: stats.into(),
            nonfinite_samples: stats.nonfinite_samples,
            cut_off_trees: stats.cut_off_trees,
            memory: Memory {
                gpu_bytes: stats.gpu_bytes,
                host_peak_bytes: report::host_peak_bytes(),
            },
        };
        details(console, &report);
        match &self.log.report {
            Some(path) => write_report(path, &report),
            None => Ok(()),
        }
    }
}

fn settings(
    scene: &OutputDefaults,
    picture: &PictureFlags,
    device: &DeviceFlags,
    log: &LogFlags,
) -> Settings {
    let output = OutputDefaults {
        samples: picture.size.samples.unwrap_or(scene.samples),
        antialias: picture.antialias.or(scene.antialias),
        ..scene.clone()
    };
    let filter = picture.filter.unwrap_or(scene.filter);
    // A radius of the scene goes with the filter of the scene.
    let scene_radius = scene.filter_radius.filter(|_| filter == scene.filter);
    let defaults = Settings::from(&output);
    Settings {
        size: picture.size.size.unwrap_or(scene.size),
        crop: picture.crop,
        noise: picture.noise.unwrap_or(defaults.noise),
        filter,
        filter_radius: (picture.filter_radius.or(scene_radius)).unwrap_or(filter.default_radius()),
        light_samples: picture.light_samples.unwrap_or(scene.light_samples),
        integrator: picture.integrator.unwrap_or(defaults.integrator),
        triangle_test: picture.triangle_test.unwrap_or(defaults.triangle_test),
        brute_force: picture.no_bvh,
        seed: picture.seed,
        max_depth: picture.max_depth.unwrap_or(defaults.max_depth),
        min_throughput: picture.min_throughput.unwrap_or(defaults.min_throughput),
        count_rays: log.count_rays,
        memory_limit_bytes: device.memory_limit_bytes(),
        ..defaults
    }
}

/// Width and height of what is written: the crop's where there is one.
fn picture_size(settings: &Settings) -> Result<(u32, u32), AppError> {
    let (width, height) = settings.size;
    match settings.crop {
        None => Ok((width, height)),
        Some([x0, y0, x1, y1]) if x1 <= width && y1 <= height => Ok((x1 - x0, y1 - y0)),
        Some([.., x1, y1]) => Err(AppError::Usage(format!(
            "cannot crop (--crop): it ends at {x1},{y1}, outside of {width}×{height} pixels. \
             Move its corner inside."
        ))),
    }
}

/// Flags win. Without them, linear formats get what was traced, debug views are stored as they
/// are, and pictures are developed as the scene says.
fn tone(
    scene: &OutputDefaults,
    flags: &PictureFlags,
    integrator: Integrator,
    linear_format: bool,
) -> Tone {
    let default = if linear_format || integrator != Integrator::Whitted {
        (0.0, ToneCurve::None, Transfer::Linear)
    } else {
        (scene.exposure_ev, scene.tone, scene.transfer)
    };
    Tone {
        exposure_ev: flags.exposure.unwrap_or(default.0),
        curve: flags.tone.unwrap_or(default.1),
        transfer: flags.transfer.unwrap_or(default.2),
    }
}

fn check_report(path: Option<&Path>, picture: &Destination) -> Result<(), AppError> {
    match path {
        Some(path) if path == picture.path() => Err(AppError::Usage(format!(
            "cannot write the report ({}): the picture goes there. Choose another name.",
            path.display()
        ))),
        Some(path) if path != Path::new("-") => Ok(output::check_file(path, true)?),
        _ => Ok(()),
    }
}

fn write_report(path: &Path, report: &Report) -> Result<(), AppError> {
    let mut text = serde_json::to_string_pretty(report)
        .map_err(|error| AppError::Internal(format!("report: {error}")))?;
    text.push('\n');
    if path == Path::new("-") {
        console::print_bytes(text.as_bytes())
    } else {
        Ok(output::write(path, text.as_bytes(), true)?)
    }
}

fn details(console: Console, report: &Report) {
    let Seconds {
        load,
        bvh,
        gpu,
        compile,
        upload,
        trace,
        develop,
        write,
        ..
    } = &report.seconds;
    console.detail(format_args!(
        "seconds: load {load:.3}, bvh {bvh:.3}, gpu {gpu:.3}, compile {compile:.3}, \
         upload {upload:.3}, trace {trace:.3}, develop {develop:.3}, write {write:.3}"
    ));
    console.detail(format_args!(
        "{} submissions, the longest {:.1} ms; {:.1} MiB on the GPU",
        report.submissions.count,
        report.submissions.longest_ms,
        report.memory.gpu_bytes as f64 / f64::from(1 << 20)
    ));
}
