//! Renders frames. All of them share one renderer, so that only moving geometry is uploaded per frame.

use crate::animate::plan::Plan;
use crate::animate::{Rendered, Sequence};
use crate::device;
use crate::interrupt::Interrupt;
use crate::layers::Finished;
use crate::progress::FrameProgress;
use crate::report::FetchReport;
use glimray_app::error::AppError;
use glimray_app::sequence::frames::{self, Frames};
use glimray_app::sequence::journal::{Journal, Origin};
use glimray_app::storage;
use glimray_io::output::OutputError;
use glimray_io::output::video::{self, Picture8, VideoOptions, Y4mWriter};
use glimray_render::gpu::Gpu;
use glimray_render::pack::PackedView;
use glimray_render::{CatcherLight, ExecutionPolicy, RenderSettings, Stats, Tone};
use std::fs::File;
use std::io::{self, Write};
use std::path::{Path, PathBuf};
use std::time::Instant;

/// Renders, develops and saves the frames of a sequence.
pub struct FrameRenderer<'a> {
    sequence: &'a Sequence<'a>,
    frames: Frames<'a>,
    tone: Tone,
    /// The number of frames to be rendered.
    missing: usize,
    write_seconds: f64,
    denoise_seconds: f64,
    catcher_light: CatcherLight,
    /// How many of the frames are black.
    black: usize,
    /// `None` before a frame is rendered.
    fetch: Option<FetchReport>,
}

impl<'a> FrameRenderer<'a> {
    /// Packs the scene. Without `gpu` no frame can be rendered.
    pub fn new(
        sequence: &'a Sequence<'a>,
        settings: RenderSettings,
        gpu: Option<Gpu>,
    ) -> Result<Self, AppError> {
        let tone = (sequence.job).tone(&settings, sequence.target.is_linear());
        let layers = &sequence.job.layers.layers;
        let layers = match layers.is_empty() {
            false => format!(" {layers:?}"),
            true => String::new(),
        };
        let files = sequence.target.frames.as_ref();
        let fingerprint = frames::of_settings(&settings, &tone, files, &layers);
        let (scene, clock) = (&sequence.job.scene, sequence.timeline.clock);
        Ok(Self {
            frames: Frames::new(scene, clock, settings, fingerprint, gpu)?,
            sequence,
            tone,
            missing: 0,
            write_seconds: 0.0,
            denoise_seconds: 0.0,
            catcher_light: CatcherLight::default(),
            black: 0,
            fetch: None,
        })
    }

    pub fn settings(&self) -> &RenderSettings {
        self.frames.settings()
    }

    /// Time to build the BVHs, in seconds.
    pub fn build_seconds(&self) -> f64 {
        self.frames.build_seconds()
    }

    /// Time to write frames, in seconds.
    pub fn write_seconds(&self) -> f64 {
        self.write_seconds
    }

    /// Time to denoise frames, in seconds.
    pub fn denoise_seconds(&self) -> f64 {
        self.denoise_seconds
    }

    /// The light on shadow catchers of all frames that were rendered.
    pub fn catcher_light(&self) -> CatcherLight {
        self.catcher_light
    }

    /// Where the kernels read the frames from; `None` if none was rendered.
    pub fn fetch(&self) -> Option<FetchReport> {
        self.fetch.clone()
    }

    /// The origin of frame `number`.
    pub fn origin(&self, number: u32) -> Result<Origin, AppError> {
        Ok(self.frames.origin(&self.frames.view(number)?))
    }

    /// Renders every frame that is not done, and sends all of them to `sink`.
    ///
    /// # Errors
    /// Any error of rendering and writing, with the number of frames that are kept.
    pub fn render(
        &mut self,
        plan: Plan,
        mut journal: Option<&mut Journal>,
        mut sink: Option<Sink>,
        interrupt: &Interrupt,
    ) -> Result<Rendered, AppError> {
        let (count, reused) = (plan.count(), plan.done_count());
        self.missing = count - reused;
        if let Some(adapter) = self.frames.adapter().filter(|_| reused < count) {
            let what = match count - reused {
                1 => "1 frame of ".to_owned(),
                missing => format!("{missing} frames of "),
            };
            (self.sequence.job).announce(&what, self.settings(), adapter);
        }
        let started = Instant::now();
        let mut progress = FrameProgress::new(self.sequence.job.log, count, reused);
        let mut rendered = 0;
        for (sent, (number, done)) in plan.frames().enumerate() {
            let mut step = || {
                interrupt.check()?;
                if !done {
                    let view = self.frames.view(number)?;
                    let picture = self.frame(number, &view, &mut progress, interrupt)?;
                    self.save(number, &view, &picture, journal.as_deref_mut())?;
                    rendered += 1;
                    progress.finish_frame();
                    if let Some(sink) = &mut sink {
                        sink.send(&Picture8::from(&picture.image))?;
                    }
                } else if let (Some(sink), Some(files)) = (&mut sink, &self.sequence.target.frames)
                {
                    sink.send(&video::read_frame(&files.pattern.path(number))?)?;
                }
                Ok(())
            };
            if let Err(error) = step() {
                if let Some(journal) = journal {
                    journal.close();
                }
                let kept = (self.sequence.target.frames.is_some()).then_some(reused + rendered);
                return Err(stopped(error, number, kept, sent, count));
            }
        }
        if let Some(sink) = sink {
            sink.finish()?;
        }
        if rendered > 0 && self.black == rendered {
            (self.sequence.job).warn_of_darkness(&self.tone, self.settings());
        }
        Ok(Rendered {
            rendered,
            seconds: started.elapsed().as_secs_f64(),
            adapter: self.frames.adapter().cloned(),
            stats: self.stats(),
            plan,
        })
    }

    fn frame(
        &mut self,
        number: u32,
        view: &PackedView,
        progress: &mut FrameProgress,
        interrupt: &Interrupt,
    ) -> Result<Finished, AppError> {
        let (job, missing) = (&self.sequence.job, self.missing.max(1));
        let renderer = self.frames.begin(view, || {
            storage::with_requested(ExecutionPolicy {
                picture_count: u32::try_from(missing).unwrap_or(u32::MAX),
                ..job.policy()
            })
        })?;
        if self.fetch.is_none() {
            self.fetch = Some(device::fetch_report(renderer)?);
        }
        while !renderer.is_done() {
            interrupt.check()?;
            renderer.step()?;
            progress.update(number, renderer.progress());
        }
        self.catcher_light += renderer.catcher_light()?;
        let takes_layers = self.sequence.target.takes_layers();
        let picture = (self.sequence.job).finish(renderer, &self.tone, takes_layers)?;
        self.denoise_seconds += picture.denoise_seconds().unwrap_or_default();
        let is_black = (self.sequence.job).is_black(&picture.image, &self.tone, self.settings());
        self.black += usize::from(is_black);
        Ok(picture)
    }

    fn save(
        &mut self,
        number: u32,
        view: &PackedView,
        picture: &Finished,
        journal: Option<&mut Journal>,
    ) -> Result<(), AppError> {
        let (Some(files), Some(journal)) = (&self.sequence.target.frames, journal) else {
            return Ok(());
        };
        let started = Instant::now();
        let (origin, image) = (self.frames.origin(view), &picture.image);
        let size = (image.width, image.height);
        journal.write(files, number, origin, size, |path| {
            picture.save(path, &files.options)
        })?;
        self.write_seconds += started.elapsed().as_secs_f64();
        Ok(())
    }

    fn stats(&self) -> Stats {
        (self.frames.renderer()).map_or_else(Stats::default, |renderer| renderer.stats().clone())
    }
}

/// Streams frames as Y4M to standard output, a pipe or a device.
pub struct Sink {
    writer: Y4mWriter<Box<dyn Write>>,
    path: PathBuf,
}

impl Sink {
    /// Opens the stream; `-` is standard output.
    pub fn new(
        path: &Path,
        (width, height): (u32, u32),
        options: &VideoOptions,
    ) -> Result<Self, AppError> {
        let failed = |source| write_error(path, source);
        let out: Box<dyn Write> = match path == Path::new("-") {
            true => Box::new(io::stdout()),
            false => Box::new(File::options().write(true).open(path).map_err(failed)?),
        };
        let writer = Y4mWriter::new(out, width, height, options.rate).map_err(failed)?;
        Ok(Self {
            writer,
            path: path.into(),
        })
    }

    fn send(&mut self, picture: &Picture8) -> Result<(), AppError> {
        let sent = self.writer.write(picture);
        Ok(sent.map_err(|source| write_error(&self.path, source))?)
    }

    fn finish(self) -> Result<(), AppError> {
        let Self { writer, path } = self;
        Ok(writer
            .finish()
            .map_err(|source| write_error(&path, source))?)
    }
}

fn write_error(path: &Path, source: io::Error) -> OutputError {
    match path == Path::new("-") {
        true => OutputError::Stdout { source },
        false => OutputError::Io {
            path: path.into(),
            source,
        },
    }
}

/// Adds to an error at frame `number` how to resume: `kept` frames are in files, or, without files, `sent`
/// frames were streamed.
fn stopped(
    error: AppError,
    number: u32,
    kept: Option<usize>,
    sent: usize,
    count: usize,
) -> AppError {
    let kept = match kept {
        Some(0) if !matches!(error, AppError::Interrupted { .. }) => return error,
        Some(kept) => {
            format!("{kept} of {count} frames are kept; the same command resumes from there.")
        }
        None => format!("{sent} of {count} frames were sent."),
    };
    let is_interrupted = matches!(error, AppError::Interrupted { .. });
    AppError::Stopped {
        error: Box::new(error),
        kept: if is_interrupted {
            kept
        } else {
            format!("The error occurred at frame {number}; {kept}")
        },
    }
}
