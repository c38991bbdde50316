//! Where moving pictures go: frames in files, a video made of them, or a stream.

use crate::app::error::AppError;
use crate::app::inputs::Inputs;
use crate::cli::animate::lock;
use crate::cli::animate::pattern::Pattern;
use crate::cli::args::{LogFlags, SequenceFlags, SequenceFormat};
use crate::cli::{destination, job};
use crate::output::video::{self, VideoFormat, VideoOptions};
use crate::output::{self, Format, OutputError, SaveOptions};
use std::ffi::OsString;
use std::path::{Path, PathBuf};

/// The way out.
pub struct Target {
    /// As on the command line; `-` is the standard output.
    pub path: PathBuf,
    /// Absent for a stream of which no frames are kept.
    pub frames: Option<Files>,
    pub video: Option<Video>,
}

/// A file for each frame.
pub struct Files {
    pub pattern: Pattern,
    pub format: Format,
    pub options: SaveOptions,
}

/// What the frames are joined to.
pub enum Video {
    File(VideoFormat),
    /// Y4M into the standard output, a pipe or a device, frame by frame.
    Stream,
}

impl Target {
    /// What the flags say; without a name, a video called `stem` in the current folder. A pipe or a device
    /// has no frames beside it: Y4M is streamed into it, other videos need a folder for their frames.
    ///
    /// # Errors
    /// The name says no format, has no place for a number, or does not go with the other flags.
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
                     Write --format y4m, or name a file."
                        .into(),
                ));
            }
            SequenceFormat::Video(format) if is_stream(&path) && flags.frames_dir.is_none() => {
                return Err(AppError::Usage(format!(
                    "cannot write {format} ({shown}): its frames are kept in a folder, and a pipe or a \
                     device has none beside it. Name one with --frames-dir, or write --format y4m."
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
                Some((pattern, format))
            }
            (_, Some(Video::Stream)) => (flags.frames_dir.as_deref()).map(kept),
            _ => {
                let beside = || {
                    let mut folder = OsString::from(&path);
                    folder.push(".frames");
                    folder.into()
                };
                let folder = flags.frames_dir.clone().unwrap_or_else(beside);
                Some(kept(&folder))
            }
        };
        for (given, flag) in [
            (flags.frames_dir.is_some(), "--frames-dir"),
            (flags.discard_frames, "--discard-frames"),
            (flags.encode_only, "--encode-only"),
        ] {
            if given && (video.is_none() || frames.is_none()) {
                return Err(AppError::Usage(format!(
                    "cannot use {flag} ({shown}): it is for the frames of a video, of which there \
                     are none here. Name a video ({}), or leave it out.",
                    VideoFormat::ENDINGS
                )));
            }
        }
        Ok(Self {
            frames: frames.map(|(pattern, format)| Files {
                pattern,
                format,
                options: SaveOptions {
                    format: Some(format),
                    quality: flags.quality,
                    clobber: true,
                    follow_links: false,
                },
            }),
            path,
            video,
        })
    }

    /// Whether the frames hold linear light rather than display values.
    pub fn is_linear(&self) -> bool {
        (self.frames.as_ref()).is_some_and(|frames| frames.format.is_linear())
    }

    /// Refuses a report that would go where the video or a frame goes.
    pub fn check_report_name(&self, log: &LogFlags) -> Result<(), AppError> {
        job::check_report_name(log, &self.path, |report| {
            (self.frames.as_ref()).is_some_and(|files| files.pattern.names(report))
        })
    }

    /// Refuses to replace what the run reads, by the video or by what is written beside the frames.
    pub fn spare(&self, inputs: &Inputs) -> Result<(), AppError> {
        if matches!(self.video, Some(Video::File(_))) {
            inputs.spare(&self.path, "video", "-o")?;
        }
        let Some(files) = &self.frames else {
            return Ok(());
        };
        if self.video.is_some() && files.pattern.names(&self.path) {
            return Err(AppError::Usage(format!(
                "cannot write the video ({}): a frame of it goes there. Choose another name.",
                self.path.display()
            )));
        }
        let beside = [files.pattern.journal(), lock::path(files.pattern.folder())];
        (beside.iter()).try_for_each(|path| inputs.spare(path, "file", files.flag(self)))
    }

    /// Refuses, before any rendering, what would fail after it; makes the folder of the frames if
    /// only that is missing. `first` is the first frame's number;
    /// without `may_render` they must be there.
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
                "cannot use the frames ({}): there is no such folder. Leave out --encode-only to have \
                 them rendered.",
                folder.display()
            )));
        }
        if !folder.exists() {
            make_folder(folder)?;
        }
        output::check_own(files.pattern.journal())?;
        let (width, height) = size;
        // A link may be to a frame that is done, and is refused where it is not.
        let mut paths = (first..).map(|number| files.pattern.path(number));
        let path = paths.find(|path| !path.is_symlink()).unwrap_or_default();
        Ok(output::check(path, &files.options, width, height)?)
    }
}

impl Files {
    /// The flag that says where they are.
    pub fn flag(&self, target: &Target) -> &'static str {
        match target.video {
            Some(_) => "--frames-dir",
            None => "-o",
        }
    }
}

/// Whether `path` is the standard output, a pipe or a device.
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
    // A percent sign of the scene's name is no placeholder.
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
                "cannot tell the format ({}): the name has none of the endings {} of a video, or {} \
                 of frames. Choose one of them or write --format.",
                path.display(),
                VideoFormat::ENDINGS,
                Format::ENDINGS
            ))
        })
}

/// The frames that are kept for a video.
fn kept(folder: &Path) -> (Pattern, Format) {
    (Pattern::in_folder(folder, "frame_", ".png"), Format::Png)
}

/// Makes the last folder of a path, not those above it.
fn make_folder(folder: &Path) -> Result<(), AppError> {
    std::fs::create_dir(folder).map_err(|source| {
        let path = folder.to_path_buf();
        let above = match folder.parent() {
            Some(above) if !above.as_os_str().is_empty() => above.to_path_buf(),
            _ => PathBuf::from("."),
        };
        AppError::from(if above.exists() {
            OutputError::Io { path, source }
        } else {
            OutputError::MissingFolder {
                path,
                folder: above,
            }
        })
    })
}
