//! The state of the dialog for a film.

use crate::model::file_dialog::Reply;
use crate::worker::film::Video;
use glimray_app::inputs::Inputs;
use glimray_app::sequence::pattern::Pattern;
use glimray_app::sequence::{Files, frames_folder};
use glimray_io::output::Format;
use glimray_io::output::video::{FrameRate, VideoFormat, VideoOptions};
use std::path::{Path, PathBuf};
use std::sync::mpsc::Receiver;

/// Largest number of frames of a turn, and the highest number of a frame.
pub const MAX_FRAME: u32 = 1_000_000;

/// The motion in a film.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum FilmMotion {
    /// The scene, by its own animation.
    Animation,
    /// The camera, once round the pivot of the view.
    Turntable,
}

/// The kind of the files of a film.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum FilmFormat {
    /// A video.
    Video(VideoFormat),
    /// A file per frame.
    Frames(Format),
}

impl FilmFormat {
    /// The formats that the dialog offers, with titles and endings. Others can be typed.
    pub const OFFERED: [(Self, &'static str, &'static str); 3] = [
        (Self::Video(VideoFormat::Mp4), "MP4", ".mp4"),
        (Self::Video(VideoFormat::Gif), "GIF", ".gif"),
        (Self::Frames(Format::Png), "PNG frames", "_%04d.png"),
    ];

    /// The format of a file name.
    pub fn of(path: &Path) -> Option<Self> {
        (VideoFormat::from_path(path).map(Self::Video))
            .or_else(|| Format::from_path(path).map(Self::Frames))
    }
}

/// Where a film is written.
#[derive(Clone, Debug)]
pub struct FilmTarget {
    /// The frames.
    pub files: Files,
    /// The video; `None` if the frames are the film.
    pub video: Option<Video>,
}

/// The state of the dialog for a film.
pub struct FilmDialog {
    /// The typed path.
    pub path: String,
    /// The motion.
    pub motion: FilmMotion,
    /// Numbers of the first and the last frame of the scene's animation.
    pub range: [u32; 2],
    /// Duration of a turn.
    pub seconds: f64,
    /// Whether the scene appears to turn clockwise, seen from above.
    pub clockwise: bool,
    /// Frames per second.
    pub fps: f64,
    /// Width and height in pixels.
    pub size: [u32; 2],
    /// Samples per pixel.
    pub samples: u32,
    /// Whether frames are denoised.
    pub denoise: bool,
    /// Whether the animation loops, as a GIF then does.
    pub loops: bool,
    /// Quality of videos and JPEG frames, 1 to 100.
    pub quality: u8,
    /// Whether the background of the frames is transparent.
    pub(crate) has_opacity: bool,
    /// Whether the name field has not been focused yet.
    pub is_new: bool,
    /// The input files of the scene, which no film may replace.
    pub(crate) inputs: Inputs,
    /// The path from a file dialog, which has confirmed replacing it.
    pub(crate) agreed: Option<PathBuf>,
    pub(crate) asked: Option<Receiver<Reply>>,
}

impl FilmDialog {
    /// The number of frames.
    pub fn count(&self) -> u32 {
        match self.motion {
            FilmMotion::Animation => self.range[1].saturating_sub(self.range[0]) + 1,
            FilmMotion::Turntable => {
                let frames = (self.seconds * self.fps).round();
                frames.clamp(1.0, MAX_FRAME.into()) as u32
            }
        }
    }

    /// The typed path.
    pub fn typed(&self) -> PathBuf {
        PathBuf::from(self.path.trim())
    }

    /// Gives the path the ending of a format that is offered.
    pub fn set_ending(&mut self, ending: &str) {
        let path = self.typed();
        let name = path.file_name().unwrap_or_default().to_string_lossy();
        let known = FilmFormat::OFFERED.iter().map(|(.., known)| *known);
        let stem = (known.clone().find_map(|known| name.strip_suffix(known)))
            .or_else(|| name.rsplit_once('.').map(|(stem, _)| stem))
            .unwrap_or(&name);
        let path = path.with_file_name(format!("{stem}{ending}"));
        self.path = path.to_string_lossy().into_owned();
    }

    /// The files, or why they cannot be written.
    pub fn target(&self) -> Result<FilmTarget, String> {
        let path = self.typed();
        if path.as_os_str().is_empty() {
            return Err("Enter a name, such as film.mp4.".to_owned());
        }
        let Some(format) = FilmFormat::of(&path) else {
            return Err(format!(
                "The name must end in one of {} for a video, or {} for frames.",
                VideoFormat::ENDINGS,
                Format::ENDINGS
            ));
        };
        if path.is_dir() {
            return Err("This is a folder.".to_owned());
        }
        let folder = (path.parent()).filter(|folder| !folder.as_os_str().is_empty());
        if folder.is_some_and(|folder| !folder.is_dir()) {
            return Err("The folder does not exist.".to_owned());
        }
        if self.inputs.contain(&path) {
            return Err("The scene uses this file. Choose another name.".to_owned());
        }
        if self.motion == FilmMotion::Animation && self.range[1] < self.range[0] {
            return Err("The last frame comes before the first.".to_owned());
        }
        match format {
            FilmFormat::Video(format) => self.video(path, format),
            FilmFormat::Frames(format) => {
                let pattern = Pattern::parse(&path).map_err(|why| {
                    format!("The frames have no numbers: {why} An example is film_%04d.png.")
                })?;
                let mut files = Files::new(pattern, format, self.quality);
                files.options.opacity = self.has_opacity;
                if self.has_opacity && !format.has_opacity() {
                    return Err(NO_OPACITY.to_owned());
                }
                Ok(FilmTarget { files, video: None })
            }
        }
    }

    fn video(&self, path: PathBuf, format: VideoFormat) -> Result<FilmTarget, String> {
        let rate = FrameRate::from_f64(self.fps);
        let rate = rate.ok_or("No video has that frame rate. Choose another one.")?;
        let options = VideoOptions {
            rate,
            quality: self.quality,
            repeat: self.loops || self.motion == FilmMotion::Turntable,
            clobber: path.exists(),
        };
        if self.has_opacity {
            return Err(NO_OPACITY.to_owned());
        }
        let files = Files::of_video(&frames_folder(&path), self.quality);
        Ok(FilmTarget {
            files,
            video: Some(Video {
                path,
                format,
                options,
            }),
        })
    }

    /// Whether replacing an existing video must be confirmed.
    pub fn must_ask(&self, target: &FilmTarget) -> bool {
        (target.video.as_ref())
            .is_some_and(|video| video.options.clobber && self.agreed.as_ref() != Some(&video.path))
    }
}

/// Why a film with a transparent background cannot be written.
const NO_OPACITY: &str = "The background is transparent, and this format has no opacity. Choose PNG frames, or another \
                          background.";
