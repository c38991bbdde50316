//! Encodes frame files to a video.

use crate::error::AppError;
use glimray_io::output::OutputError;
use glimray_io::output::video::{self, VideoFormat, VideoOptions};
use std::io::{self, ErrorKind};
use std::path::{Path, PathBuf};

/// Encodes the frames in these files. `before` is told the index of each frame before it is read, and may end the work.
///
/// # Errors
/// `before` failed, a frame cannot be read, or the video cannot be written; the video is then absent.
pub fn encode(
    path: &Path,
    format: VideoFormat,
    options: &VideoOptions,
    files: &[PathBuf],
    mut before: impl FnMut(usize) -> Result<(), AppError>,
) -> Result<(), AppError> {
    let mut stopped = None;
    let encoded = video::encode(path, format, options, files.len(), &mut |index| {
        let path = &files[index];
        if let Err(error) = before(index) {
            stopped = Some(error);
            let source = io::Error::from(ErrorKind::Interrupted);
            let path = path.clone();
            return Err(OutputError::Io { path, source });
        }
        video::read_frame(path)
    });
    match stopped {
        Some(stopped) => Err(stopped),
        None => Ok(encoded?),
    }
}
