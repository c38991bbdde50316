//! Encodes numbered frames as a video: MP4, GIF or Y4M. A frame is a [`Picture8`]; all frames have the
//! size of the first.

#[cfg(feature = "video")]
mod gif;
#[cfg(feature = "video")]
mod mp4;
#[cfg(feature = "video")]
mod palette;
mod picture;
mod rate;
mod y4m;
mod yuv;

pub use picture::{Picture8, read_frame};
pub use rate::FrameRate;
pub use y4m::Y4mWriter;
pub use yuv::Planes;

use super::{OutputError, atomic};
use std::fmt;
use std::path::Path;

/// A video file format.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum VideoFormat {
    /// H.264 in MP4: small, lossy, plays nearly everywhere.
    Mp4,
    /// 255 colours without sound; supported wherever images are.
    Gif,
    /// YUV4MPEG2, uncompressed: for other programs' encoders that read from a pipe.
    Y4m,
}

impl VideoFormat {
    /// The extensions that [`VideoFormat::from_path`] knows, for messages.
    pub const ENDINGS: &str = ".mp4, .gif, .y4m";

    /// The format of the extension of `path`, in upper or lower case.
    pub fn from_path(path: &Path) -> Option<Self> {
        let ending = path.extension()?.to_str()?.to_ascii_lowercase();
        match ending.as_str() {
            "mp4" => Some(Self::Mp4),
            "gif" => Some(Self::Gif),
            "y4m" => Some(Self::Y4m),
            _ => None,
        }
    }

    /// Width and height in pixels of the video for frames of `width` × `height`. In MP4, chroma
    /// subsampling needs even sides, and the encoder needs sides of at least 16: the last column and row
    /// are repeated.
    pub fn padded_size(self, width: u32, height: u32) -> (u32, u32) {
        let padded = |side: u32| side.max(16).next_multiple_of(2);
        match self {
            Self::Mp4 => (padded(width), padded(height)),
            Self::Gif | Self::Y4m => (width, height),
        }
    }

    /// The largest longer and shorter side in pixels.
    fn max_sides(self) -> (u32, u32) {
        match self {
            // OpenH264's limit: level 5.2.
            Self::Mp4 => (3840, 2160),
            Self::Gif => (0xFFFF, 0xFFFF),
            Self::Y4m => (i32::MAX as u32, i32::MAX as u32),
        }
    }

    /// The lowest and the highest number of frames per second.
    fn rates(self) -> (f64, f64) {
        match self {
            // Delays are counted in 1/100 s with 16 bits; players treat a delay of 1 as 10.
            Self::Gif => (0.01, 50.0),
            Self::Mp4 | Self::Y4m => (0.0, f64::INFINITY),
        }
    }

    fn check(self, rate: FrameRate, width: u32, height: u32) -> Result<(), OutputError> {
        if cfg!(not(feature = "video")) && self != Self::Y4m {
            return Err(OutputError::VideoLeftOut { format: self });
        }
        let (long, short) = self.max_sides();
        if width.max(height) > long || width.min(height) > short {
            return Err(OutputError::VideoTooLarge {
                format: self,
                width,
                height,
                long,
                short,
            });
        }
        let (least, most) = self.rates();
        if !(least..=most).contains(&rate.as_f64()) {
            return Err(OutputError::VideoRate {
                format: self,
                rate,
                least,
                most,
            });
        }
        Ok(())
    }
}

impl fmt::Display for VideoFormat {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Mp4 => "MP4",
            Self::Gif => "GIF",
            Self::Y4m => "Y4M",
        })
    }
}

/// How to write a video.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct VideoOptions {
    /// Frames per second.
    pub rate: FrameRate,
    /// MP4 quality: 1 (smallest) to 100 (best), the same for every frame. Values outside are clamped.
    pub quality: u8,
    /// Whether a GIF repeats forever.
    pub repeat: bool,
    /// Whether an existing file may be replaced.
    pub clobber: bool,
}

impl Default for VideoOptions {
    /// 24 frames per second, quality 75, repeating, replacing existing files.
    fn default() -> Self {
        Self {
            rate: FrameRate::FILM,
            quality: 75,
            repeat: true,
            clobber: true,
        }
    }
}

/// Encodes `count` frames and writes the file: complete or absent. `frame` returns each frame by its
/// number, from 0 in order; for a GIF, some of them are read once before that. The same frames and
/// options give the same bytes.
///
/// # Errors
/// The errors of `frame`; frames of different sizes, unsupported sizes and rates, and everything that prevents writing
/// the file.
pub fn encode(
    path: &Path,
    format: VideoFormat,
    options: &VideoOptions,
    count: usize,
    frame: &mut dyn FnMut(usize) -> Result<Picture8, OutputError>,
) -> Result<(), OutputError> {
    let frames = Frames::new(format, options.rate, count, frame)?;
    match format {
        #[cfg(feature = "video")]
        VideoFormat::Mp4 => super::write(path, &mp4::encode(frames, options)?, options.clobber),
        #[cfg(feature = "video")]
        VideoFormat::Gif => super::write(path, &gif::encode(frames, options)?, options.clobber),
        #[cfg(not(feature = "video"))]
        VideoFormat::Mp4 | VideoFormat::Gif => Err(OutputError::VideoLeftOut { format }),
        // Y4M alone is streamed: it need not be held in memory, and is too large for that.
        VideoFormat::Y4m => atomic::write_with(path, options.clobber, true, |file| {
            y4m::encode(frames, options.rate, path, file)
        }),
    }
}

/// Checks, before frames of `width` × `height` pixels are rendered, whether [`encode`] can write them to
/// `path`.
///
/// # Errors
/// The errors of [`encode`] that can be detected in advance.
pub fn check(
    path: &Path,
    format: VideoFormat,
    options: &VideoOptions,
    width: u32,
    height: u32,
) -> Result<(), OutputError> {
    format.check(options.rate, width, height)?;
    super::check_file(path, options.clobber)
}

/// The frames of one video, checked against the first.
struct Frames<'a> {
    count: usize,
    fetch: &'a mut dyn FnMut(usize) -> Result<Picture8, OutputError>,
    /// In pixels.
    width: u32,
    height: u32,
    first: Option<Picture8>,
}

impl<'a> Frames<'a> {
    fn new(
        format: VideoFormat,
        rate: FrameRate,
        count: usize,
        fetch: &'a mut dyn FnMut(usize) -> Result<Picture8, OutputError>,
    ) -> Result<Self, OutputError> {
        if count == 0 {
            return Err(failed(format, "there is no frame"));
        }
        let first = fetch(0)?;
        let (width, height) = (first.width, first.height);
        if width == 0 || height == 0 {
            return Err(failed(format, "the first frame has no pixels"));
        }
        format.check(rate, width, height)?;
        let mut frames = Self {
            count,
            fetch,
            width,
            height,
            first: None,
        };
        frames.check(0, &first)?;
        frames.first = Some(first);
        Ok(frames)
    }

    fn get(&mut self, index: usize) -> Result<Picture8, OutputError> {
        if index == 0
            && let Some(first) = self.first.take()
        {
            return Ok(first);
        }
        let picture = (self.fetch)(index)?;
        self.check(index, &picture)?;
        Ok(picture)
    }

    fn check(&self, index: usize, picture: &Picture8) -> Result<(), OutputError> {
        let (width, height) = (picture.width, picture.height);
        if (width, height) != (self.width, self.height) {
            return Err(OutputError::FrameSize {
                index,
                width,
                height,
                first_width: self.width,
                first_height: self.height,
            });
        }
        if picture.pixels.len() as u64 != u64::from(width) * u64::from(height) {
            return Err(OutputError::Misshapen {
                width,
                height,
                pixel_count: picture.pixels.len(),
            });
        }
        Ok(())
    }
}

/// An encoder's message as a clause.
fn failed(format: VideoFormat, reason: impl fmt::Display) -> OutputError {
    let reason = reason.to_string();
    OutputError::VideoEncode {
        format,
        reason: reason.trim_end_matches('.').into(),
    }
}
