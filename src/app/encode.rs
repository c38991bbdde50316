//! Frames → video: what the program needs of [`crate::output`]'s video writers, which a build
//! without the feature `video` does not have.

use super::exit::AppError;
use std::path::Path;

#[cfg(feature = "video")]
pub use crate::output::video::{
    FrameRate, Picture8, VideoFormat, VideoOptions, Y4mWriter, read_frame,
};
#[cfg(not(feature = "video"))]
pub use absent::{FrameRate, Picture8, VideoFormat, VideoOptions, Y4mWriter, read_frame};

/// How often a video shows a frame.
///
/// # Errors
/// No video can have that many.
pub fn rate(fps: f64) -> Result<FrameRate, AppError> {
    FrameRate::from_f64(fps).ok_or_else(|| {
        AppError::Usage(format!(
            "cannot write a video of {fps} frames per second (--fps, --step): no format has that \
             rate. Choose another one."
        ))
    })
}

/// Refuses, before any rendering, what would fail after it.
#[cfg(feature = "video")]
pub fn check(
    path: &Path,
    format: VideoFormat,
    options: &VideoOptions,
    (width, height): (u32, u32),
) -> Result<(), AppError> {
    Ok(crate::output::video::check(
        path, format, options, width, height,
    )?)
}

/// Writes a video of `count` frames.
#[cfg(feature = "video")]
pub fn encode(
    path: &Path,
    format: VideoFormat,
    options: &VideoOptions,
    count: usize,
    frame: &mut dyn FnMut(usize) -> Result<Picture8, crate::output::OutputError>,
) -> Result<(), AppError> {
    Ok(crate::output::video::encode(
        path, format, options, count, frame,
    )?)
}

#[cfg(not(feature = "video"))]
pub use absent::{check, encode};

/// Stands where the video writers would be.
#[cfg(not(feature = "video"))]
mod absent {
    use super::{AppError, Path};
    use crate::image::Image;
    use crate::output::OutputError;
    use std::io;

    #[derive(Clone, Copy, Debug, PartialEq, Eq)]
    pub enum VideoFormat {
        Mp4,
        Gif,
        Y4m,
    }

    impl VideoFormat {
        pub const ENDINGS: &str = ".mp4, .gif, .y4m";

        pub fn from_path(path: &Path) -> Option<Self> {
            match path.extension()?.to_str()?.to_ascii_lowercase().as_str() {
                "mp4" => Some(Self::Mp4),
                "gif" => Some(Self::Gif),
                "y4m" => Some(Self::Y4m),
                _ => None,
            }
        }
    }

    #[derive(Clone, Copy, Debug)]
    pub struct FrameRate;

    impl FrameRate {
        pub fn from_f64(_: f64) -> Option<Self> {
            Some(Self)
        }
    }

    pub struct Picture8;

    impl From<&Image> for Picture8 {
        fn from(_: &Image) -> Self {
            Self
        }
    }

    #[expect(dead_code, reason = "there is no writer to read them")]
    pub struct VideoOptions {
        pub rate: FrameRate,
        pub quality: u8,
        pub repeat: bool,
        pub clobber: bool,
    }

    pub struct Y4mWriter<W>(W);

    impl<W: io::Write> Y4mWriter<W> {
        pub fn new(_: W, _: u32, _: u32, _: FrameRate) -> io::Result<Self> {
            Err(io::ErrorKind::Unsupported.into())
        }

        pub fn write(&mut self, _: &Picture8) -> io::Result<()> {
            Err(io::ErrorKind::Unsupported.into())
        }

        pub fn finish(mut self) -> io::Result<()> {
            self.0.flush()
        }
    }

    pub fn read_frame(path: &Path) -> Result<Picture8, OutputError> {
        Err(OutputError::Io {
            path: path.into(),
            source: io::ErrorKind::Unsupported.into(),
        })
    }

    pub fn check(
        path: &Path,
        _: VideoFormat,
        _: &VideoOptions,
        _: (u32, u32),
    ) -> Result<(), AppError> {
        Err(AppError::Usage(format!(
            "cannot write a video ({}): this build of glimray has no feature `video`. Write numbered \
             frames, such as frame_%04d.png.",
            path.display()
        )))
    }

    pub fn encode(
        path: &Path,
        format: VideoFormat,
        options: &VideoOptions,
        _: usize,
        _: &mut dyn FnMut(usize) -> Result<Picture8, OutputError>,
    ) -> Result<(), AppError> {
        check(path, format, options, (0, 0))
    }
}
