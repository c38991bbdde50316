//! The state of the dialog for a film.

use crate::model::file_dialog::Reply;
use crate::worker::film::Video;
use crate::worker::free_name;
use glimray_app::clock;
use glimray_app::inputs::Inputs;
use glimray_app::sequence::pattern::Pattern;
use glimray_app::sequence::{Files, frames_folder};
use glimray_io::output::Format;
use glimray_io::output::video::{FrameRate, VideoFormat, VideoOptions};
use std::cell::RefCell;
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
    /// Number of the first frame.
    pub first: u32,
    /// The video; `None` if the frames are the film.
    pub video: Option<Video>,
}

/// A range of frames that follows the frame rate.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Scaled {
    /// The range as it was chosen, and the frame rate then.
    from: [u32; 2],
    fps: f64,
    /// The range that it became.
    to: [u32; 2],
}

/// The state of the dialog for a film.
pub struct FilmDialog {
    /// The typed path.
    pub path: String,
    /// The path that was proposed, which no file has.
    pub(crate) proposed: String,
    /// The motion.
    pub motion: FilmMotion,
    /// Numbers of the first and the last frame of the scene's animation.
    pub range: [u32; 2],
    /// How the range came from another one; `None` if the frame rate has not changed.
    pub(crate) scaled: Option<Scaled>,
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
    /// Whether the background of the frames is transparent, as of the last frame of the window.
    pub(crate) has_opacity: bool,
    /// Whether the name field has not been focused yet.
    pub is_new: bool,
    /// The input files of the scene, which no film may replace.
    pub(crate) inputs: Inputs,
    /// The path from a file dialog, which has confirmed replacing it.
    pub(crate) agreed: Option<PathBuf>,
    pub(crate) asked: Option<Receiver<Reply>>,
    /// The frames that were looked for last, and whether one of them exists.
    pub(crate) looked_up: RefCell<Option<(FrameNames, bool)>>,
}

/// The frames of a film: the typed path, the number of the first, and how many there are.
pub(crate) type FrameNames = (String, u32, u32);

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

    /// Number of the last frame of an animation of `duration` seconds.
    pub fn last_frame(&self, duration: f64) -> u32 {
        clock::last_frame(duration, self.fps, self.loops).min(MAX_FRAME)
    }

    /// Changes the frame rate, above 0. The range keeps its times, and ends with the animation of `duration` seconds if
    /// it did before.
    pub fn set_fps(&mut self, fps: f64, duration: f64) {
        let before = self.scaled.filter(|scaled| scaled.to == self.range);
        // Always from what was chosen, so that rounding does not add up.
        let (from, at) = before.map_or((self.range, self.fps), |scaled| (scaled.from, scaled.fps));
        let ends = from[1] == clock::last_frame(duration, at, self.loops).min(MAX_FRAME);
        self.fps = fps;
        self.range = from.map(|frame| {
            let frame = (f64::from(frame) / at * fps).round();
            frame.min(MAX_FRAME.into()) as u32
        });
        if ends {
            self.range[1] = self.last_frame(duration);
        }
        self.scaled = Some(Scaled {
            from,
            fps: at,
            to: self.range,
        });
    }

    /// Number of the first frame.
    fn first_frame(&self) -> u32 {
        match self.motion {
            FilmMotion::Animation => self.range[0],
            FilmMotion::Turntable => 0,
        }
    }

    /// Gives the path the ending of a format that is offered. A path that was proposed becomes one that no film has;
    /// `is_reserved` tells which ones will be written.
    pub fn set_ending(&mut self, ending: &str, is_reserved: impl Fn(&Path) -> bool) {
        let is_proposed = self.path == self.proposed;
        let path = self.typed();
        let name = path.file_name().unwrap_or_default().to_string_lossy();
        let known = FilmFormat::OFFERED.iter().map(|(.., known)| *known);
        let stem = (known.clone().find_map(|known| name.strip_suffix(known)))
            .or_else(|| name.rsplit_once('.').map(|(stem, _)| stem))
            .unwrap_or(&name);
        let named = |stem: &str| path.with_file_name(format!("{stem}{ending}"));
        let first = self.first_frame();
        let stem = match is_proposed {
            true => free_stem(stem, |stem| {
                let path = named(stem);
                is_reserved(&path) || exists(&path, first)
            }),
            false => stem.to_owned(),
        };
        self.path = named(&stem).to_string_lossy().into_owned();
        if is_proposed {
            self.proposed = self.path.clone();
        }
    }

    /// The files, or why they cannot be written.
    ///
    /// # Errors
    /// One line for the user.
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
                Ok(FilmTarget {
                    files,
                    first: self.first_frame(),
                    video: None,
                })
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
            first: self.first_frame(),
            video: Some(Video {
                path,
                format,
                options,
            }),
        })
    }

    /// Whether replacing an existing video, or existing frames, must be confirmed. A file dialog confirms videos only, as
    /// it does not know the names of frames.
    pub fn must_ask(&self, target: &FilmTarget) -> bool {
        match &target.video {
            Some(video) => video.options.clobber && self.agreed.as_ref() != Some(&video.path),
            None => self.has_frames(target),
        }
    }

    /// Whether any frame exists. Thousands of files are not looked for in each frame of the window, but once for each edit.
    fn has_frames(&self, target: &FilmTarget) -> bool {
        let names = (self.path.clone(), target.first, self.count());
        let mut looked_up = self.looked_up.borrow_mut();
        match &*looked_up {
            Some((known, found)) if *known == names => *found,
            _ => {
                let mut numbers = target.first..target.first.saturating_add(self.count());
                let found = numbers.any(|number| target.files.pattern.path(number).exists());
                *looked_up = Some((names, found));
                found
            }
        }
    }
}

/// Whether a film of this name would replace a file: the video, or the frame of the number `first`.
fn exists(path: &Path, first: u32) -> bool {
    match FilmFormat::of(path) {
        Some(FilmFormat::Frames(_)) => {
            Pattern::parse(path).is_ok_and(|pattern| pattern.path(first).exists())
        }
        Some(FilmFormat::Video(_)) | None => path.exists(),
    }
}

/// `stem`, or if it is taken, the next one that is free.
fn free_stem(stem: &str, is_taken: impl Fn(&str) -> bool) -> String {
    // With an ending, so that no dot of the stem is taken for one.
    let bare = |path: &Path| {
        let stem = path.file_stem().unwrap_or_default();
        stem.to_string_lossy().into_owned()
    };
    let free = free_name::free(PathBuf::from(format!("{stem}.mp4")), |path| {
        is_taken(&bare(path))
    });
    bare(&free)
}

/// Why a film with a transparent background cannot be written.
const NO_OPACITY: &str = "The background is transparent, and this format has no opacity. Choose PNG frames, or another \
                          background.";
