//! Encodes frame files to a video.

use crate::interrupt::Interrupt;
use glimray_app::error::AppError;
use glimray_io::output::OutputError;
use glimray_io::output::video::{self, VideoFormat, VideoOptions};
use std::io::{self, ErrorKind};
use std::path::{Path, PathBuf};

/// Encodes the frames in these files. `progress` is told the index of each frame before it is read.
///
/// # Errors
/// A signal; those of reading frames and of writing the video, which is then absent.
pub fn encode(
    path: &Path,
    format: VideoFormat,
    options: &VideoOptions,
    files: &[PathBuf],
    interrupt: &Interrupt,
    mut progress: impl FnMut(usize),
) -> Result<(), AppError> {
    let mut stopped = None;
    let encoded = video::encode(path, format, options, files.len(), &mut |index| {
        let path = &files[index];
        if let Err(error) = interrupt.check() {
            stopped = Some(error);
            let source = io::Error::from(ErrorKind::Interrupted);
            let path = path.clone();
            return Err(OutputError::Io { path, source });
        }
        progress(index);
        video::read_frame(path)
    });
    match stopped {
        Some(stopped) => Err(stopped),
        None => Ok(encoded?),
    }
}
