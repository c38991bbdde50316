//! `glimray animate SCENE`: renders an animation to numbered frames or a video. `turntable` shares
//! [`Sequence`] and everything below it.
//!
//! Frames are first written to files. A run renders the frames that are missing or out of date and then
//! encodes all of them. So runs are resumable, and a video whose frames are kept can be encoded again without rendering.

mod frame_renderer;
mod plan;
mod target;
mod timeline;

pub use target::Target;
pub use timeline::Timeline;

use crate::args::{AnimateArgs, LogFlags, SequenceFlags};
use crate::idle_flags;
use crate::interrupt::Interrupt;
use crate::job::{Job, Outcome};
use crate::progress::FrameProgress;
use crate::report::{AnimationReport, Draft};
use frame_renderer::{FrameRenderer, Sink};
use glimray_app::clock::Clock;
use glimray_app::console;
use glimray_app::error::AppError;
use glimray_app::lock::Lock;
use glimray_app::overrides::picture_size;
use glimray_app::sequence::Files;
use glimray_app::sequence::encode::encode;
use glimray_app::sequence::journal::Journal;
use glimray_io::output::video::{FrameRate, VideoOptions};
use glimray_render::Stats;
use plan::Plan;
use std::fs;
use std::path::Path;
use std::time::Instant;
use target::Video;

pub fn run(arguments: &AnimateArgs, started: Instant) -> Result<(), AppError> {
    let AnimateArgs {
        scene, output, log, ..
    } = arguments;
    with_report(
        ("animate", "video"),
        scene,
        output,
        log,
        started,
        |target, draft| render(arguments, target, draft),
    )
}

/// Calls `render` with the target of an animation and the draft of its report, and completes the report with
/// the outcome. The target is the one that `output` names; its default name is that of the scene, or `stem`.
pub fn with_report(
    (command, stem): (&'static str, &str),
    scene: &Path,
    output: &SequenceFlags,
    log: &LogFlags,
    started: Instant,
    render: impl FnOnce(Target, &mut Draft) -> Result<(), AppError>,
) -> Result<(), AppError> {
    let stem = scene.file_stem().unwrap_or(stem.as_ref());
    let target = Target::new(output, Path::new(stem))?;
    target.check_report_name(log)?;
    let name = scene.display().to_string();
    let mut draft = Draft::new(command, log, name, &target.path, started);
    let outcome = render(target, &mut draft);
    draft.finish(outcome)
}

fn render(arguments: &AnimateArgs, target: Target, draft: &mut Draft) -> Result<(), AppError> {
    idle_flags::check(&arguments.reading, &arguments.scene)?;
    let options = (arguments.camera).import_options(&arguments.reading, &arguments.picture);
    let mut scene = draft.load(&arguments.scene, &options, arguments.reading.strict)?;
    arguments
        .camera
        .overrides(&arguments.reading)
        .apply(&mut scene)?;
    let clock = Clock::new(&scene.output, &arguments.motion.overrides());
    let timeline = Timeline::new(&scene, &arguments.range, clock)?;
    let job = Job {
        scene,
        picture: &arguments.picture,
        device: &arguments.device,
        log: &arguments.log,
        layers: &arguments.layers,
    };
    if let Some(end) = timeline.ends_before_last(&job.scene) {
        job.console().status(format_args!(
            "the animation ends at frame {end}: in later frames clips begin again, and the rest stays as it is"
        ));
    }
    let flags = &arguments.output;
    Sequence {
        job,
        timeline,
        flags,
        target,
    }
    .run(draft)
}

/// An animation to render and encode.
pub struct Sequence<'a> {
    pub job: Job<'a>,
    pub timeline: Timeline,
    pub flags: &'a SequenceFlags,
    pub target: Target,
}

/// The result of rendering the frames.
struct Rendered {
    plan: Plan,
    rendered: usize,
    /// Time for rendering, developing and writing them, in seconds.
    seconds: f64,
    adapter: Option<glimray_render::gpu::AdapterReport>,
    stats: Stats,
}

impl<'a> Sequence<'a> {
    /// Renders the frames that are not done, and writes the video and the report if they were requested.
    ///
    /// # Errors
    /// Any error of rendering, encoding and writing. Finished frames are then kept, and a video is complete or
    /// absent.
    pub fn run(&self, draft: &mut Draft) -> Result<(), AppError> {
        let interrupt = Interrupt::install()?;
        self.job.warn_of_skipped()?;
        let settings = self.job.settings();
        let files = self.target.frames.as_ref();
        (self.job).check_format(
            &settings,
            &self.target.path,
            self.target.takes_layers(),
            self.target.takes_opacity(),
        )?;
        let size = picture_size(&settings)?;
        let video = self.video_options()?;
        draft.set_image(self.job.image(&self.target.path, &settings, size));
        self.target.protect(&draft.inputs)?;
        self.job.check_report(draft)?;
        let gpu = if self.flags.encode_only {
            None
        } else {
            Some(self.job.open_gpu(size, draft)?)
        };
        let first = self.timeline.first;
        self.target
            .check(size, first, video.as_ref(), !self.flags.encode_only)?;
        let mut renderer = FrameRenderer::new(self, settings, gpu)?;
        draft.seconds.bvh = renderer.build_seconds();

        // The folder is locked from here on, so a signal must not end the program at once.
        let _deferred = interrupt.defer();
        let lock = files.map(|files| Lock::of_folder(files.pattern.folder()));
        let lock = lock.transpose()?;
        let mut journal = files.map(|files| Journal::open(&files.pattern, console::warning));
        let origin = |number| renderer.origin(number);
        let plan = Plan::new(self, origin, journal.as_ref(), &interrupt)?;
        plan.protect(self, &draft.inputs)?;
        let sink = match (&self.target.video, &video) {
            (Some(Video::Stream), Some(options)) => {
                Some(Sink::new(&self.target.path, size, options)?)
            }
            _ => None,
        };
        let frames = renderer.render(plan, journal.as_mut(), sink, &interrupt)?;
        if let Some(journal) = &mut journal {
            journal.close();
        }
        draft.seconds.set_render_times(&frames.stats);
        draft.fetch = renderer.fetch();
        draft.catcher_light = renderer.catcher_light();
        draft.seconds.write = renderer.write_seconds();
        let is_denoised = self.job.tone(renderer.settings(), false).denoise;
        draft.seconds.denoise = is_denoised.then(|| renderer.denoise_seconds());
        let encode_seconds = match &video {
            Some(options) => self.encode(options, &interrupt)?,
            None => 0.0,
        };
        // The video is complete and in its place from here on.
        if let (false, Some(files), Some(journal)) = (self.target.keeps_frames, files, journal) {
            journal.discard(&files.pattern, self.timeline.numbers());
            drop(lock);
            // Fails if the folder has other files, and then it is kept.
            let _ = fs::remove_dir(files.pattern.folder());
        }
        draft.seconds.total = draft.started.elapsed().as_secs_f64();
        Job::warn_of_losses(&frames.stats);
        self.print_summary(&frames, draft.seconds.total, encode_seconds);
        let animation = self.report(&frames, encode_seconds);
        self.job.report(
            renderer.settings(),
            Outcome {
                path: &self.target.path,
                size,
                pixels: frames.rendered as u64 * u64::from(size.0) * u64::from(size.1),
                adapter: frames.adapter.as_ref(),
                stats: &frames.stats,
                animation: Some(animation),
                sheet: None,
            },
            draft,
        )
    }

    fn video_options(&self) -> Result<Option<VideoOptions>, AppError> {
        if self.target.video.is_none() {
            return Ok(None);
        }
        Ok(Some(VideoOptions {
            rate: rate(self.timeline.video_fps())?,
            quality: self.flags.quality,
            repeat: self.timeline.repeat,
            clobber: !self.flags.no_clobber,
        }))
    }

    /// Encodes the frame files to a video, and returns the time in seconds.
    fn encode(&self, options: &VideoOptions, interrupt: &Interrupt) -> Result<f64, AppError> {
        let (Some(Video::File(format)), Some(files)) = (&self.target.video, &self.target.frames)
        else {
            return Ok(0.0);
        };
        let started = Instant::now();
        let count = self.timeline.count;
        let mut progress = FrameProgress::encoding(self.job.log, count);
        let numbers = self.timeline.numbers();
        let paths: Vec<_> = numbers.map(|number| files.pattern.path(number)).collect();
        let encoded = encode(&self.target.path, *format, options, &paths, |index| {
            interrupt.check()?;
            progress.encoded(index);
            Ok(())
        });
        match encoded {
            Ok(()) => Ok(started.elapsed().as_secs_f64()),
            Err(error) => Err(AppError::Stopped {
                error: Box::new(error),
                kept: format!(
                    "All {count} frames are kept in {}; the same command resumes with encoding.",
                    files.pattern.folder().display()
                ),
            }),
        }
    }

    /// Prints what was written.
    fn print_summary(&self, frames: &Rendered, total: f64, encode_seconds: f64) {
        let console = self.job.console();
        let count = self.timeline.count;
        let rate = match frames.per_second() {
            Some(rate) => format!(", {} frames/s", short(rate)),
            None => String::new(),
        };
        let rendered = frames.rendered;
        match (&self.target.video, &self.target.frames) {
            (None, Some(files)) if rendered == 0 => console.status(format_args!(
                "all {count} frames of {} are already done ({total:.2} s)",
                files.pattern.text().display()
            )),
            (None, Some(files)) => console.status(format_args!(
                "wrote {rendered} of {count} frames to {} ({total:.2} s{rate})",
                files.pattern.text().display()
            )),
            _ => {
                let fps = self.timeline.video_fps();
                console.status(format_args!(
                    "wrote {}: {count} frames, {} s at {} frames/s ({rendered} rendered{rate}, encoded \
                     in {encode_seconds:.2} s, {total:.2} s in total)",
                    self.target.path.display(),
                    short(count as f64 / fps),
                    short(fps)
                ));
            }
        }
    }

    fn report(&self, frames: &Rendered, encode_seconds: f64) -> AnimationReport {
        let Timeline {
            clock, first, step, ..
        } = self.timeline;
        let files: Option<&Files> = self.target.frames.as_ref();
        AnimationReport {
            first,
            last: self.timeline.last(),
            step,
            frames: self.timeline.count,
            fps: clock.fps,
            shutter: [clock.shutter.open, clock.shutter.close],
            rendered: frames.rendered,
            reused: frames.plan.done_count(),
            redone: frames.plan.redone(),
            frame_files: files
                .filter(|_| self.target.keeps_frames)
                .map(|files| files.pattern.text().display().to_string()),
            video: (self.target.video.is_some()).then(|| self.target.path.display().to_string()),
            encode_seconds,
            frames_per_second: frames.per_second(),
        }
    }
}

impl Rendered {
    /// Rendered frames per second; `None` if no frame was rendered.
    fn per_second(&self) -> Option<f64> {
        (self.rendered > 0 && self.seconds > 0.0).then(|| self.rendered as f64 / self.seconds)
    }
}

/// Rounds to three decimals.
fn short(value: f64) -> f64 {
    (value * 1e3).round() / 1e3
}

/// The frame rate of a video.
///
/// # Errors
/// No video format supports the rate.
pub fn rate(fps: f64) -> Result<FrameRate, AppError> {
    FrameRate::from_f64(fps).ok_or_else(|| {
        AppError::Usage(format!(
            "cannot write a video of {fps} frames per second (--fps, --step): no format supports \
             that rate. Choose another one."
        ))
    })
}
