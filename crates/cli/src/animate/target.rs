//! Where an animation is written: frame files, a video, or a stream.

use crate::args::{LogFlags, SequenceFlags, SequenceFormat};
use crate::{destination, job};
use glimray_app::error::AppError;
use glimray_app::inputs::Inputs;
use glimray_app::lock;
use glimray_app::sequence::pattern::Pattern;
use glimray_app::sequence::{Files, frames_folder};
use glimray_io::output::video::{self, VideoFormat, VideoOptions};
use glimray_io::output::{self, Format, OutputError};
use std::path::{Path, PathBuf};

/// The output of an animation.
pub struct Target {
    /// As given on the command line; `-` is standard output.
    pub path: PathBuf,
    /// `None` for a stream without kept frames.
    pub frames: Option<Files>,
    /// Whether the frames stay when all is written.
    pub keeps_frames: bool,
    pub video: Option<Video>,
}

/// The video that the frames are encoded to.
pub enum Video {
    File(VideoFormat),
    /// Y4M to standard output, a pipe or a device, frame by frame.
    Stream,
}

impl Target {
    /// The target that the flags name. The default is a video called `stem` in the current folder. Beside a
    /// pipe or a device no frames can be kept: Y4M is streamed to it, and other formats need a folder for
    /// their frames.
    ///
    /// # Errors
    /// The name has no known extension, lacks a placeholder for the frame number, or contradicts other flags.
    pub fn new(flags: &SequenceFlags, stem: &Path) -> Result<Self, AppError> {
        let path = flags.path.clone().unwrap_or_else(|| default(flags, stem));
        let shown = path.display();
        let format = match flags.format {
            Some(format) => format,
            None if path == Path::new("-") => SequenceFormat::Video(VideoFormat::Y4m),
            None => match format_of(&path) {
                Err(_) if is_stream(&path) => SequenceFormat::Video(VideoFormat::Y4m),
                format => format?,
            },
        };
        let video = match format {
            SequenceFormat::Video(VideoFormat::Y4m) if is_stream(&path) => Some(Video::Stream),
            _ if path == Path::new("-") => {
                return Err(AppError::Usage(
                    "cannot write that format (standard output): only Y4M can be streamed. \
                     Use --format y4m, or name a file."
                        .into(),
                ));
            }
            SequenceFormat::Video(format) if is_stream(&path) && flags.frames_dir.is_none() => {
                return Err(AppError::Usage(format!(
                    "cannot write {format} ({shown}): its frames need a folder, and there is none beside a \
                     pipe or a device. Name one with --frames-dir, or use --format y4m."
                )));
            }
            SequenceFormat::Video(format) => Some(Video::File(format)),
            SequenceFormat::Frames(_) => None,
        };
        let frames = match (format, &video) {
            (SequenceFormat::Frames(format), _) => {
                let pattern = Pattern::parse(&path).map_err(|why| {
                    AppError::Usage(format!(
                        "cannot number the frames ({shown}): {why} Write NAME_%04d.png, or choose a \
                         video ({}).",
                        VideoFormat::ENDINGS
                    ))
                })?;
                Some(Files::new(pattern, format, flags.quality))
            }
            (_, video) => {
                let beside = || frames_folder(&path);
                let usual = (!matches!(video, Some(Video::Stream))).then(beside);
                let folder = flags.frames_dir.clone().or(usual);
                folder.map(|folder| Files::of_video(&folder, flags.quality))
            }
        };
        for (given, flag) in [
            (flags.frames_dir.is_some(), "--frames-dir"),
            (flags.keep_frames, "--keep-frames"),
            (flags.discard_frames, "--discard-frames"),
            (flags.encode_only, "--encode-only"),
        ] {
            if given && (video.is_none() || frames.is_none()) {
                return Err(AppError::Usage(format!(
                    "cannot use {flag} ({shown}): it applies only to the kept frames of a video. Name a \
                     video file ({}), or omit the flag.",
                    VideoFormat::ENDINGS
                )));
            }
        }
        let is_asked_for =
            video.is_none() || flags.keep_frames || flags.frames_dir.is_some() || flags.encode_only;
        Ok(Self {
            keeps_frames: is_asked_for && !flags.discard_frames,
            frames,
            path,
            video,
        })
    }

    /// The flag that names where the frames are.
    pub fn frames_flag(&self) -> &'static str {
        match self.video {
            Some(_) => "--frames-dir",
            None => "-o",
        }
    }

    /// Whether the frames store linear radiance rather than display values.
    pub fn is_linear(&self) -> bool {
        (self.frames.as_ref()).is_some_and(|frames| frames.format.is_linear())
    }

    /// Whether the frames can take layers.
    pub fn takes_layers(&self) -> bool {
        (self.frames.as_ref()).is_some_and(|frames| frames.format.has_layers())
    }

    /// Whether the frames keep opacity; a video has none.
    pub fn takes_opacity(&self) -> bool {
        let frames = self.frames.as_ref().filter(|_| self.video.is_none());
        frames.is_some_and(|frames| frames.format.has_opacity())
    }

    /// Refuses a report at the path of the video or of a frame.
    pub fn check_report_name(&self, log: &LogFlags) -> Result<(), AppError> {
        job::check_report_name(log, &self.path, |report| {
            (self.frames.as_ref()).is_some_and(|files| files.pattern.names(report))
        })
    }

    /// Refuses to overwrite an input with the video, the journal or the lock file.
    pub fn protect(&self, inputs: &Inputs) -> Result<(), AppError> {
        if matches!(self.video, Some(Video::File(_))) {
            inputs.refuse_overwrite(&self.path, "video", "-o")?;
        }
        let Some(files) = &self.frames else {
            return Ok(());
        };
        if self.video.is_some() && files.pattern.names(&self.path) {
            return Err(AppError::Usage(format!(
                "cannot write the video ({}): one of its frames has that name. Choose another one.",
                self.path.display()
            )));
        }
        let beside = [files.pattern.journal(), lock::path(files.pattern.folder())];
        (beside.iter())
            .try_for_each(|path| inputs.refuse_overwrite(path, "file", self.frames_flag()))
    }

    /// Finds errors of writing the output before rendering starts, and creates the folder of the frames if
    /// only that is missing. `first` is the first frame's number. Without `may_render` the folder must exist.
    pub fn check(
        &self,
        size: (u32, u32),
        first: u32,
        video: Option<&VideoOptions>,
        may_render: bool,
    ) -> Result<(), AppError> {
        match (&self.video, video) {
            (Some(Video::File(format)), Some(options)) => {
                video::check(&self.path, *format, options, size.0, size.1)?;
            }
            (Some(Video::Stream), Some(_)) if self.path == Path::new("-") => {
                destination::check_stdout("a video")?;
            }
            _ => {}
        }
        let Some(files) = &self.frames else {
            return Ok(());
        };
        let folder = files.pattern.folder();
        if !folder.exists() && !may_render {
            return Err(AppError::Refused(format!(
                "cannot use the frames ({}): there is no such folder. Omit --encode-only to render \
                 them.",
                folder.display()
            )));
        }
        if !folder.exists() {
            create_folder(folder)?;
        }
        output::check_own(files.pattern.journal())?;
        let (width, height) = size;
        // A link may lead to a finished frame, so it is checked later.
        let mut paths = (first..).map(|number| files.pattern.path(number));
        let path = paths.find(|path| !path.is_symlink()).unwrap_or_default();
        Ok(output::check(path, &files.options, width, height)?)
    }
}

/// Whether `path` is standard output, a pipe or a device.
fn is_stream(path: &Path) -> bool {
    let found = || path.metadata();
    path == Path::new("-") || found().is_ok_and(|found| !found.is_file() && !found.is_dir())
}

fn default(flags: &SequenceFlags, stem: &Path) -> PathBuf {
    let ending = match flags.format {
        None | Some(SequenceFormat::Video(VideoFormat::Mp4)) => "mp4",
        Some(SequenceFormat::Video(VideoFormat::Gif)) => "gif",
        Some(SequenceFormat::Video(VideoFormat::Y4m)) => "y4m",
        Some(SequenceFormat::Frames(Format::Png)) => "png",
        Some(SequenceFormat::Frames(Format::Jpeg)) => "jpg",
        Some(SequenceFormat::Frames(Format::Exr)) => "exr",
        Some(SequenceFormat::Frames(Format::Hdr)) => "hdr",
    };
    // A percent sign in the scene's name must not become a placeholder.
    let stem = stem.to_string_lossy();
    match flags.format {
        Some(SequenceFormat::Frames(_)) => {
            format!("{}_%04d.{ending}", stem.replace('%', "%%")).into()
        }
        _ => format!("{stem}.{ending}").into(),
    }
}

fn format_of(path: &Path) -> Result<SequenceFormat, AppError> {
    let video = VideoFormat::from_path(path).map(SequenceFormat::Video);
    video
        .or_else(|| Format::from_path(path).map(SequenceFormat::Frames))
        .ok_or_else(|| {
            AppError::Usage(format!(
                "cannot determine the format ({}): the name has none of the extensions {} of a video, or {} \
                 of frames. Choose one of them, or use --format.",
                path.display(),
                VideoFormat::ENDINGS,
                Format::ENDINGS
            ))
        })
}

/// Creates the last folder of a path, but not its parents.
fn create_folder(folder: &Path) -> Result<(), AppError> {
    std::fs::create_dir(folder).map_err(|source| {
        let path = folder.to_path_buf();
        let parent = match folder.parent() {
            Some(parent) if !parent.as_os_str().is_empty() => parent.to_path_buf(),
            _ => PathBuf::from("."),
        };
        AppError::from(if parent.exists() {
            OutputError::Io { path, source }
        } else {
            OutputError::MissingFolder {
                path,
                folder: parent,
            }
        })
    })
}
