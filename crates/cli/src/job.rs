//! Code shared by `render`, `demo` and `animate`: a scene with its command-line options, and the messages and
//! statistics at the end.

use crate::args::{DeviceFlags, LayerFlags, LogFlags, PictureFlags};
use crate::destination;
use crate::device::{self, Opening};
use crate::idle_flags;
use crate::layers::Finished;
use crate::memory;
use crate::report;
use crate::report::{
    AnimationReport, AnyReport, Draft, ImageReport, Memory, Report, SceneReport, Seconds,
    SettingsReport, SheetReport,
};
use glimray_app::advice::UNLIT;
use glimray_app::console;
use glimray_app::console::Console;
use glimray_app::error::AppError;
use glimray_app::host;
use glimray_app::inputs;
use glimray_app::overrides;
use glimray_app::value_names::BSDF_MODELS;
use glimray_io::output;
use glimray_render::gpu::{AdapterChoice, AdapterReport, Gpu};
use glimray_render::pack::{PackedScene, PackedView};
use glimray_render::{
    self as render, ExecutionPolicy, Integrator, RenderSettings, Renderer, Stats, Tone,
};
use glimray_scene::bytes::size;
use glimray_scene::{Backdrop, LightTransport, Scene};
use std::borrow::Cow;
use std::panic::resume_unwind;
use std::path::Path;
use std::sync::Arc;
use std::thread;
use std::time::Instant;

/// A scene to render, with the options from the command line.
pub struct Job<'a> {
    /// The scene, with overriding flags applied.
    pub scene: Scene,
    pub picture: &'a PictureFlags,
    pub device: &'a DeviceFlags,
    pub log: &'a LogFlags,
    pub layers: &'a LayerFlags,
}

/// The result of a job.
pub struct Outcome<'a> {
    /// Output path; `-` is standard output.
    pub path: &'a Path,
    /// Width and height of every picture.
    pub size: (u32, u32),
    /// Number of pixels that were rendered, in all pictures.
    pub pixels: u64,
    /// `None` if no adapter was needed.
    pub adapter: Option<&'a AdapterReport>,
    pub stats: &'a Stats,
    /// `Some` for an animation.
    pub animation: Option<AnimationReport>,
    /// `Some` for a sheet.
    pub sheet: Option<SheetReport>,
}

impl Job<'_> {
    pub fn console(&self) -> Console {
        Console::new(self.log.quiet, self.log.verbose)
    }

    /// Warns about skipped parts of the scene (and with --verbose tells its remarks), missing lights, materials that paths change and flags without effect.
    ///
    /// # Errors
    /// As [`idle_flags::warn`].
    pub fn warn_of_skipped(&self) -> Result<(), AppError> {
        for skipped in &self.scene.skipped {
            console::warning(skipped);
        }
        for remark in &self.scene.remarks {
            self.console().detail(remark);
        }
        if self.scene.blind_cameras > 0 {
            let of = |index: usize| overrides::label((index, &self.scene.cameras[index]));
            self.console().status(format_args!(
                "camera {} takes the place of camera {}, which sees nothing that is lit; --camera 0 shows that",
                of(self.scene.camera_index),
                of(0)
            ));
        }
        idle_flags::warn(self.picture, &self.settings())?;
        if self.is_unlit() {
            console::warning(UNLIT);
        }
        self.warn_of_depth();
        let is_path = self.settings().integrator == Integrator::Path;
        let mut gaining = self.scene.materials_that_gain_light();
        if is_path && let Some(first) = gaining.next() {
            let others = match gaining.count() {
                0 => String::new(),
                count => format!(" and {count} more"),
            };
            console::warning(format_args!(
                "a material may reflect more light than arrives ({}{others}): paths scale it down. Use colours of at \
                 most 1, and a specular coefficient of at most (shininess + 1)/2.",
                console::quoted(&first.name)
            ));
        }
        Ok(())
    }

    /// Whether all surfaces are black for lack of light. Only paths find that of the background on every surface.
    pub fn is_unlit(&self) -> bool {
        let is_path = self.settings().integrator == Integrator::Path;
        self.scene.is_unlit() && !(is_path && self.scene.background_shines())
    }

    /// Warns of mirrors and glass at a depth of 0 that nobody asked for: that of course scenes.
    fn warn_of_depth(&self) {
        let settings = self.settings();
        let asked = self.picture.settings.given.max_depth.is_some()
            || settings.integrator != Integrator::Whitted;
        let count = self.scene.mirrors_and_glass().count();
        if asked || settings.max_depth > 0 || count == 0 {
            return;
        }
        let depth = LightTransport::Whitted.max_depth();
        console::warning(format_args!(
            "depth 0 follows no reflected or refracted ray, so {count} material(s) of mirror or glass show only their own \
             colour. Use --max-depth {depth} to follow them; --max-depth 0 silences this."
        ));
    }

    pub fn settings(&self) -> RenderSettings {
        let settings = self.picture.overrides().settings(&self.scene.output);
        RenderSettings {
            features: settings.features || !self.layers.layers.is_empty(),
            ..settings
        }
    }

    /// The picture of a renderer that is done, for a file that may take layers.
    pub fn finish(
        &self,
        renderer: &mut Renderer,
        tone: &Tone,
        takes_layers: bool,
    ) -> Result<Finished, AppError> {
        let settings = self.settings();
        let finished = match settings.features {
            true => (self.layers).finish(&renderer.film()?, renderer.gpu(), tone, takes_layers)?,
            false => Finished::plain(renderer.develop(tone)?, settings.has_opacity()),
        };
        Ok(finished.placed(settings.region(), settings.size))
    }

    /// Refuses layers and opacity that the integrator cannot render, or that the file does not keep.
    pub fn check_format(
        &self,
        settings: &RenderSettings,
        path: &Path,
        takes_layers: bool,
        takes_opacity: bool,
    ) -> Result<(), AppError> {
        let denoise = self.picture.develop.denoise() == Some(true);
        (self.layers).check(denoise, settings.integrator, path, takes_layers)?;
        Self::check_backdrop(settings, path, takes_opacity)
    }

    /// Refuses a transparent background that the integrator cannot render, or that the file does not keep.
    ///
    /// # Errors
    /// Such a picture.
    pub fn check_backdrop(
        settings: &RenderSettings,
        path: &Path,
        takes_opacity: bool,
    ) -> Result<(), AppError> {
        if settings.backdrop != Backdrop::Transparent {
            return Ok(());
        }
        if settings.integrator == Integrator::Whitted {
            return Err(AppError::Usage(
                "cannot render a transparent background (--integrator whitted): only paths keep opacity. Choose \
                 --integrator path."
                    .into(),
            ));
        }
        match settings.has_opacity() && !takes_opacity {
            true => Err(AppError::Usage(no_opacity(path))),
            false => Ok(()),
        }
    }

    pub fn policy(&self) -> ExecutionPolicy {
        policy(self.device, self.log.count_rays)
    }

    /// How a picture is developed, for a format that stores linear radiance or for one that does not.
    pub fn tone(&self, settings: &RenderSettings, linear_format: bool) -> Tone {
        let tone = self.picture.develop.overrides();
        tone.tone(&self.scene.output, settings.integrator, linear_format)
    }

    /// The `image` part of the report.
    pub fn image(&self, path: &Path, settings: &RenderSettings, size: (u32, u32)) -> ImageReport {
        ImageReport {
            path: path.display().to_string(),
            width: size.0,
            height: size.1,
            settings: SettingsReport(Some(settings.clone())),
            mean_samples: None,
            denoise: self.tone(settings, false).denoise,
        }
    }

    /// Refuses pictures of `size` pixels that exceed the memory limit of the process.
    pub fn check_memory(&self, size: (u32, u32), draft: &Draft) -> Result<(), AppError> {
        memory::check_scene(&self.scene, &draft.scene_path, size)
    }

    /// Packs the scene while the adapter is being opened, for `what`, the first part of the message about it. The first
    /// picture is exposed from `shutter.0` to `shutter.1`, in seconds.
    pub fn pack(
        &self,
        opening: Opening,
        shutter: (f64, f64),
        what: &str,
        (settings, policy): (&RenderSettings, &ExecutionPolicy),
        draft: &mut Draft,
    ) -> Result<(Gpu, (Arc<PackedScene>, PackedView)), AppError> {
        let started = Instant::now();
        let host = host::current();
        let previous = host.as_ref().and_then(|host| host.packed());
        let mut scene = Cow::Borrowed(&self.scene);
        if let Some(previous) = &previous {
            scene.to_mut().share(&previous.0);
        }
        let (gpu, packed) = thread::scope(|scope| {
            let packing = scope.spawn(|| {
                let previous = previous.as_ref().map(|previous| &*previous.1);
                let packed = device::packed(&scene, previous, shutter)?;
                let module = match memory::is_limited() {
                    true => None,
                    false => render::early_module(&packed.0, &packed.1, settings, policy),
                };
                Ok::<_, AppError>((packed, module))
            });
            let gpu = opening.wait()?;
            draft.adapter = Some(gpu.adapter().into());
            self.announce(what, settings, gpu.adapter());
            let (packed, module) = packing
                .join()
                .unwrap_or_else(|panic| resume_unwind(panic))?;
            Ok::<_, AppError>((gpu.with_early_module(module), packed))
        })?;
        draft.seconds.bvh = packed.0.build_seconds;
        draft.seconds.gpu = (started.elapsed().as_secs_f64() - draft.seconds.bvh).max(0.0);
        if let Some(host) = host {
            host.keep_packed(Arc::new((scene.into_owned(), packed.0.clone())));
        }
        Ok((gpu, packed))
    }

    /// Opens the adapter, for pictures of `size` pixels.
    pub fn open_gpu(&self, size: (u32, u32), draft: &mut Draft) -> Result<Gpu, AppError> {
        self.check_memory(size, draft)?;
        let started = Instant::now();
        let gpu = device::open(self.device)?;
        draft.seconds.gpu = started.elapsed().as_secs_f64();
        draft.adapter = Some(gpu.adapter().into());
        Ok(gpu)
    }

    /// Prints what is about to be rendered, and on which adapter.
    pub fn announce(&self, what: &str, settings: &RenderSettings, adapter: &AdapterReport) {
        let (width, height) = settings.size;
        let described = device::describe(adapter);
        let console = self.console();
        console.status(format_args!(
            "rendering {what}{width}×{height} on {described}"
        ));
        let is_chosen = self.device.choice() != AdapterChoice::default();
        if let Some(advice) = device::faster_driver(adapter).filter(|_| !is_chosen) {
            console.status(format_args!("{advice}"));
        }
    }

    /// Refuses a report that would overwrite an input or cannot be written.
    pub fn check_report(&self, draft: &Draft) -> Result<(), AppError> {
        match self.log.report.as_deref() {
            Some(report) if report != Path::new("-") => {
                draft
                    .inputs
                    .refuse_overwrite(report, "report", "--report")?;
                Ok(output::check_file(report, true)?)
            }
            Some(_) => destination::check_open("the report"),
            None => Ok(()),
        }
    }

    /// Warns about device losses, dropped samples and truncated ray trees.
    pub fn warn_of_losses(stats: &Stats) {
        if stats.device_losses > 0 {
            console::warning(format_args!(
                "the GPU was lost {} time(s); rendering resumed after the last completed submission.",
                stats.device_losses
            ));
        }
        if stats.nonfinite_samples > 0 {
            console::warning(format_args!(
                "{} samples were not finite, or brighter than 10^12, and were dropped.",
                stats.nonfinite_samples
            ));
        }
        if stats.cut_off_trees > 0 {
            console::warning(format_args!(
                "{} samples were truncated: they had too many rays, or a ray was inside more than 4 \
                 transparent objects at once. Lower --max-depth, raise --min-throughput, or nest fewer \
                 objects.",
                stats.cut_off_trees
            ));
        }
    }

    /// Ends a run whose picture of `size` pixels is at `path`: its times, warnings of losses, a status line and the report.
    /// `pixels` were rendered.
    ///
    /// # Errors
    /// The report cannot be written.
    pub fn conclude(
        &self,
        settings: &RenderSettings,
        (path, size, pixels): (&Path, (u32, u32), u64),
        renderer: &Renderer,
        sheet: Option<SheetReport>,
        draft: &mut Draft,
    ) -> Result<(), AppError> {
        let stats = renderer.stats();
        draft.seconds.set_render_times(stats);
        draft.seconds.total = draft.started.elapsed().as_secs_f64();
        Self::warn_of_losses(stats);
        self.console().status(format_args!(
            "wrote {} ({:.2} s)",
            path.display(),
            draft.seconds.total
        ));
        let outcome = Outcome {
            path,
            size,
            pixels,
            adapter: Some(renderer.adapter()),
            stats,
            animation: None,
            sheet,
        };
        self.report(settings, outcome, draft)
    }

    /// Writes the report if one was requested.
    pub fn report(
        &self,
        settings: &RenderSettings,
        outcome: Outcome,
        draft: &Draft,
    ) -> Result<(), AppError> {
        let stats = outcome.stats;
        let of_paths = settings.integrator == Integrator::Path;
        let report = Report {
            glimray: Report::VERSION,
            command: draft.command,
            scene: SceneReport::new(&draft.scene_path, &self.scene),
            image: ImageReport {
                // Avoids 0/0 when nothing was rendered.
                mean_samples: Some(stats.samples as f64 / outcome.pixels.max(1) as f64),
                ..self.image(outcome.path, settings, outcome.size)
            },
            adapter: outcome.adapter.map(Into::into),
            fetch: draft.fetch.clone(),
            seconds: Seconds {
                denoise: (draft.seconds.denoise).or(of_paths.then_some(0.0)),
                ..draft.seconds.clone()
            },
            rays: stats.rays.as_ref().map(Into::into),
            submissions: stats.into(),
            nonfinite_samples: stats.nonfinite_samples,
            cut_off_trees: stats.cut_off_trees,
            paths: of_paths.then_some(stats.samples),
            energy_cut: of_paths.then(|| stats.energy_cut()),
            catcher_cut: draft.catcher_light.cut(),
            memory: Memory {
                gpu_bytes: stats.gpu_bytes,
                host_peak_bytes: report::host_peak_bytes(),
            },
            resumed: draft.resumed,
            animation: outcome.animation,
            sheet: outcome.sheet,
            error: (),
        };
        details(self.console(), settings, &report);
        match (host::current(), &self.log.report) {
            (Some(host), _) => {
                host.report(&report::text(AnyReport::Done(&report))?);
                Ok(())
            }
            (None, Some(path)) => report::write(path, AnyReport::Done(&report)),
            (None, None) => Ok(()),
        }
    }
}

/// Why a transparent picture cannot be written there.
pub fn no_opacity(path: &Path) -> String {
    format!(
        "cannot write a transparent background ({}): the format has no opacity. Choose a name that ends in .png or \
         .exr, or a colour with --background R,G,B.",
        path.display()
    )
}

/// Refuses a report at the output path or at another path that is `taken` by the output.
pub fn check_report_name(
    log: &LogFlags,
    path: &Path,
    taken: impl FnOnce(&Path) -> bool,
) -> Result<(), AppError> {
    match log.report.as_deref() {
        Some(report) if inputs::is_same(report, path) || taken(report) => {
            Err(AppError::Usage(format!(
                "cannot write the report ({}): the picture goes there. Choose another name.",
                report.display()
            )))
        }
        _ => Ok(()),
    }
}

impl Seconds {
    /// Sets the times that the renderer measured.
    pub fn set_render_times(&mut self, stats: &Stats) {
        self.compile = stats.compile_seconds;
        self.upload = stats.upload_seconds;
        self.trace = stats.trace_seconds;
        self.develop = stats.develop_seconds;
    }
}

/// Execution options, which do not affect the picture.
pub fn policy(device: &DeviceFlags, count_rays: bool) -> ExecutionPolicy {
    ExecutionPolicy {
        count_rays,
        memory_limit_bytes: device.memory_limit_bytes(),
        ..ExecutionPolicy::default()
    }
}

/// How paths are traced, for people; `None` if none are.
fn sentence(settings: &RenderSettings) -> Option<String> {
    let shadows = match settings.transparent_shadows {
        true => "all glass lets shadow rays pass, without caustics",
        false => "smooth thin walls let shadow rays pass",
    };
    let clamp = match settings.clamp_indirect {
        Some(limit) => format!("indirect light is clamped to {limit}"),
        None => "no light is clamped".to_owned(),
    };
    let bsdf = BSDF_MODELS.name(&settings.bsdf);
    (settings.integrator == Integrator::Path)
        .then(|| format!("paths: BSDF {bsdf}; {shadows}; {clamp}"))
}

fn details(console: Console, settings: &RenderSettings, report: &Report) {
    let denoise = report.seconds.denoise.unwrap_or_default();
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
         upload {upload:.3}, trace {trace:.3}, develop {develop:.3}, denoise {denoise:.3}, \
         write {write:.3}"
    ));
    if let Some(sentence) = sentence(settings) {
        console.detail(sentence);
    }
    if let Some(cut) = report.energy_cut {
        let percent = 100.0 * cut;
        console.detail(format_args!(
            "the limit of bounces and clamps removed about {percent:.2} % of the light"
        ));
    }
    if let Some(cut) = report.catcher_cut {
        let percent = 100.0 * cut;
        console.detail(format_args!(
            "the cap of single samples removed {percent:.2} % of the light on shadow catchers"
        ));
    }
    if let Some(fetch) = &report.fetch {
        console.detail(format_args!("{}", fetch.sentence()));
    }
    console.detail(format_args!(
        "{} submissions, the longest {:.1} ms; {} on the GPU",
        report.submissions.count,
        report.submissions.longest_ms,
        size(report.memory.gpu_bytes)
    ));
}
