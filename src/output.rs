//! Image → file. A file is complete or absent: the picture is encoded in memory, written beside its
//! name, synced and renamed, and an old file stays intact until then. Pipes and devices are written
//! to directly and never replaced. A symbolic link that a person names stays, and its file is written.
//!
//! What the values of an [`Image`] mean is settled before they get here: PNG and JPEG take them as
//! display values in [0, 1], OpenEXR and Radiance HDR as linear light ([`Format::is_linear`]). Frames
//! become one file in [`video`].

mod atomic;
mod encode;
mod error;
mod format;
mod litter;
pub mod video;

pub use error::OutputError;
pub(crate) use error::reason;
pub use format::Format;
pub(crate) use litter::Litter;
pub use litter::clear_away;

use crate::image::Image;
use std::io::Write;
use std::path::Path;

/// How to write a picture.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct SaveOptions {
    /// `None` goes by the ending of the file's name.
    pub format: Option<Format>,
    /// Of a JPEG: 1 (smallest) to 100 (best). Values outside are clamped.
    pub quality: u8,
    /// Whether a file of that name may be replaced.
    pub clobber: bool,
    /// Whether a name that is a symbolic link stands for the file that it leads to. Names that a person
    /// gave do; a link under a name that the program made up is an error.
    pub follow_links: bool,
}

impl Default for SaveOptions {
    /// The format that the name says, quality 90, replacing what is there, also behind a link.
    fn default() -> Self {
        Self {
            format: None,
            quality: 90,
            clobber: true,
            follow_links: true,
        }
    }
}

/// Writes `image` to `path` in the format that the ending of its name says.
///
/// # Errors
/// As [`save_with`].
pub fn save(path: impl AsRef<Path>, image: &Image) -> Result<(), OutputError> {
    save_with(path, image, &SaveOptions::default())
}

/// Writes `image` to `path`. When it returns an error, whatever was at `path` is still there.
///
/// # Errors
/// An unknown format, a picture too large for its format, and whatever keeps the file from being
/// written: a missing or read-only folder, a full disk, a file that must not be replaced.
pub fn save_with(
    path: impl AsRef<Path>,
    image: &Image,
    options: &SaveOptions,
) -> Result<(), OutputError> {
    let path = path.as_ref();
    let format = format_of(path, options)?;
    format.check_size(image.width, image.height)?;
    let bytes = encode::encode(image, format, options.quality)?;
    atomic::write(path, &bytes, options.clobber, options.follow_links)
}

/// Writes `image` to the standard output, as PNG unless `options` names a format.
///
/// # Errors
/// A picture too large for its format, and a standard output that takes no more.
pub fn save_to_stdout(image: &Image, options: &SaveOptions) -> Result<(), OutputError> {
    let format = options.format.unwrap_or(Format::Png);
    format.check_size(image.width, image.height)?;
    let bytes = encode::encode(image, format, options.quality)?;
    let mut stdout = std::io::stdout().lock();
    stdout
        .write_all(&bytes)
        .and_then(|()| stdout.flush())
        .map_err(|source| OutputError::Stdout { source })
}

/// Finds out, before a picture of `width` × `height` pixels is rendered, whether [`save_with`] can
/// write it to `path`: it tries to create a file beside it. Also removes what processes that were
/// killed while writing to `path` left in its folder (`.NAME.part-PID-…`).
///
/// # Errors
/// Those of [`save_with`] that can be known beforehand.
pub fn check(
    path: impl AsRef<Path>,
    options: &SaveOptions,
    width: u32,
    height: u32,
) -> Result<(), OutputError> {
    let path = path.as_ref();
    format_of(path, options)?.check_size(width, height)?;
    atomic::check(path, options.clobber, options.follow_links)
}

/// Like [`check`], for a file that is no picture.
///
/// # Errors
/// Those of [`write()`] that can be known beforehand.
pub fn check_file(path: impl AsRef<Path>, clobber: bool) -> Result<(), OutputError> {
    atomic::check(path.as_ref(), clobber, true)
}

/// Like [`check_file`], for a name that a program made up: a file of that name may be replaced, and
/// the name must not be a symbolic link, unless it is one to a pipe or a device.
///
/// # Errors
/// Those of [`write_own`] that can be known beforehand.
pub fn check_own(path: impl AsRef<Path>) -> Result<(), OutputError> {
    atomic::check(path.as_ref(), true, false)
}

/// Refuses a name that is a symbolic link, unless it is one to a pipe or a device.
///
/// # Errors
/// [`OutputError::Link`].
pub fn check_no_link(path: impl AsRef<Path>) -> Result<(), OutputError> {
    atomic::check_no_link(path.as_ref())
}

/// Writes any `bytes` to `path` with the care that pictures get. `clobber` says whether a file of
/// that name may be replaced.
///
/// # Errors
/// Whatever keeps the file from being written; what was at `path` is then still there.
pub fn write(path: impl AsRef<Path>, bytes: &[u8], clobber: bool) -> Result<(), OutputError> {
    atomic::write(path.as_ref(), bytes, clobber, true)
}

/// Writes any `bytes` to `path`, a name that the program made up: see [`check_own`].
///
/// # Errors
/// As [`write()`], and [`OutputError::Link`].
pub fn write_own(path: impl AsRef<Path>, bytes: &[u8]) -> Result<(), OutputError> {
    atomic::write(path.as_ref(), bytes, true, false)
}

/// What the options say, else the ending, else PNG for pipes and devices, whose names say nothing.
fn format_of(path: &Path, options: &SaveOptions) -> Result<Format, OutputError> {
    if path.is_dir() {
        return Err(OutputError::IsFolder { path: path.into() });
    }
    let format = options.format.or_else(|| Format::from_path(path));
    let is_stream = || path.metadata().is_ok_and(|found| !found.is_file());
    format
        .or_else(|| is_stream().then_some(Format::Png))
        .ok_or_else(|| OutputError::UnknownFormat { path: path.into() })
}
