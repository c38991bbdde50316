//! Films: numbered frames on a thread of their own, and the video that they are encoded to.

use crate::worker::free_name;
use crate::worker::job::JobControl;
use crate::worker::progressive_image::policy;
use crate::worker::still::Still;
use glimray_app::clock::Clock;
use glimray_app::error::AppError;
use glimray_app::lock::Lock;
use glimray_app::sequence::Files;
use glimray_app::sequence::encode::encode;
use glimray_app::sequence::frames::{self, Frames};
use glimray_app::sequence::journal::{Journal, State};
use glimray_io::output;
use glimray_io::output::video::{self, VideoFormat, VideoOptions};
use glimray_render::gpu::Gpu;
use glimray_render::{ExecutionPolicy, RenderSettings, Tone};
use glimray_scene::Scene;
use std::fs;
use std::path::{Path, PathBuf};
use std::sync::Arc;

/// The share of encoding in the work of a video, whose frames take nearly all of it.
const ENCODING: f64 = 0.02;

/// Everything that a film depends on.
#[derive(Clone, Debug)]
pub struct FilmRequest {
    /// The scene with the camera and the background of the film.
    pub scene: Arc<Scene>,
    /// Frame rate and shutter.
    pub clock: Clock,
    /// Number of the first frame.
    pub first: u32,
    /// Number of frames, at least 1.
    pub count: u32,
    /// The settings of every frame.
    pub settings: RenderSettings,
    /// How frames are developed.
    pub tone: Tone,
    /// The render policy; the worker chooses the time slices.
    pub policy: ExecutionPolicy,
    /// Where the frames are.
    pub files: Files,
    /// The video that they are encoded to; `None` if they are the film.
    pub video: Option<Video>,
}

/// The video of a film.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Video {
    /// The file.
    pub path: PathBuf,
    /// The format.
    pub format: VideoFormat,
    /// How it is encoded.
    pub options: VideoOptions,
}

impl FilmRequest {
    /// The video, or the name pattern of the frames.
    pub fn path(&self) -> &Path {
        match &self.video {
            Some(video) => &video.path,
            None => self.files.pattern.text(),
        }
    }

    fn numbers(&self) -> impl Iterator<Item = u32> + use<> {
        (self.first..).take(self.count as usize)
    }
}

/// Renders the frames that are missing or out of date, and writes the video if one is requested. Returns what was
/// written, or `None` once `control` is cancelled: finished frames are then kept, and the next run uses them.
///
/// # Errors
/// The scene cannot be rendered, a file cannot be written, or a frame's name is that of a file that no film wrote.
pub fn render(
    gpu: Gpu,
    request: &FilmRequest,
    control: &JobControl,
) -> Result<Option<PathBuf>, AppError> {
    // Whoever cancels from here on waits for this thread, which will hold the lock of the folder.
    control.begin();
    if control.is_cancelled() {
        return Ok(None);
    }
    if let Some(Video {
        path,
        format,
        options,
    }) = &request.video
    {
        // A name that is taken is no error: the next one that is free is used.
        let options = VideoOptions {
            clobber: true,
            ..options.clone()
        };
        let [.., width, height] = request.settings.region();
        video::check(path, *format, &options, width, height)?;
    }
    let files = &request.files;
    let folder = files.pattern.folder();
    if !folder.exists() {
        fs::create_dir(folder).map_err(|source| output::OutputError::Io {
            path: folder.into(),
            source,
        })?;
    }
    let lock = Lock::of_folder(folder)?;
    let mut journal = Journal::open(&files.pattern, |_| ());
    let done = render_frames(gpu, request, &mut journal, control);
    journal.close();
    if !done? {
        return Ok(None);
    }
    let Some(video) = &request.video else {
        return Ok(Some(files.pattern.text().to_owned()));
    };
    let Some(path) = encode_video(video, request, control)? else {
        return Ok(None);
    };
    // The video is complete and in its place from here on.
    journal.discard(&files.pattern, request.numbers());
    drop(lock);
    // Fails if the folder has other files, and then it is kept.
    let _ = fs::remove_dir(folder);
    Ok(Some(path))
}

/// Renders the frames. Returns whether all are done.
fn render_frames(
    gpu: Gpu,
    request: &FilmRequest,
    journal: &mut Journal,
    control: &JobControl,
) -> Result<bool, AppError> {
    let FilmRequest {
        scene,
        settings,
        tone,
        files,
        ..
    } = request;
    let policy = policy(&gpu, request.policy);
    let fingerprint = frames::of_settings(settings, tone, Some(files), "");
    let (settings, gpu) = (settings.clone(), Some(gpu));
    let mut frames = Frames::new(scene, request.clock, settings, fingerprint, gpu)?;
    let mut missing = Vec::new();
    for number in request.numbers() {
        let origin = || Ok(frames.origin(&frames.view(number)?));
        match journal.state(&files.pattern, number, origin)? {
            State::Done => {}
            State::Foreign if request.video.is_none() => {
                return Err(AppError::Unwritable(format!(
                    "cannot write frame {number} ({}): the file exists, and no film wrote it. Choose another name.",
                    files.pattern.path(number).display()
                )));
            }
            State::Foreign | State::Absent | State::Stale(_) => missing.push(number),
        }
        if control.is_cancelled() {
            return Ok(false);
        }
    }
    let count = f64::from(request.count);
    let reused = count - missing.len() as f64;
    let whole = match request.video {
        Some(_) => 1.0 - ENCODING,
        None => 1.0,
    };
    let picture_count = u32::try_from(missing.len().max(1)).unwrap_or(u32::MAX);
    control.report(whole * reused / count);
    for (index, &number) in missing.iter().enumerate() {
        let done = reused + index as f64;
        control.begin_step(format!("frame {} of {}", done + 1.0, request.count));
        let view = frames.view(number)?;
        let policy = ExecutionPolicy {
            picture_count,
            ..policy
        };
        let renderer = frames.begin(&view, || Ok(policy))?;
        while !renderer.is_done() {
            if control.is_cancelled() {
                return Ok(false);
            }
            renderer.step()?;
            control.report(whole * (done + renderer.progress()) / count);
        }
        let still = Still::developed(renderer, tone, files.format.has_layers())?;
        let size = (still.image.width, still.image.height);
        let origin = frames.origin(&view);
        journal.write(files, number, origin, size, |path| {
            still.save(path, &files.options)
        })?;
    }
    Ok(true)
}

/// Encodes the frames. Returns the video's path, or `None` if it was cancelled. If the name has been taken since, the
/// next one that is free is used.
fn encode_video(
    video: &Video,
    request: &FilmRequest,
    control: &JobControl,
) -> Result<Option<PathBuf>, AppError> {
    control.begin_step("encoding".to_owned());
    let pattern = &request.files.pattern;
    let paths: Vec<_> = request
        .numbers()
        .map(|number| pattern.path(number))
        .collect();
    let written = free_name::write(&video.path, |path| {
        encode(path, video.format, &video.options, &paths, |index| {
            control.report(1.0 - ENCODING * (1.0 - index as f64 / paths.len() as f64));
            match control.is_cancelled() {
                true => Err(AppError::Refused("cancelled".to_owned())),
                false => Ok(()),
            }
        })
    });
    match written {
        Err(_) if control.is_cancelled() => Ok(None),
        written => written.map(Some),
    }
}
