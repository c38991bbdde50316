//! Writes images to files. A file is complete or absent: the image is encoded in memory, written to a
//! temporary file beside its target, synced and renamed; an existing file stays intact until then. Pipes
//! and devices are written to directly and never replaced. A symbolic link given by the user is kept, and
//! its target is written.
//!
//! The values of an [`Image`] are final: PNG and JPEG store display values in [0, 1], OpenEXR and
//! Radiance HDR linear light ([`Format::is_linear`]). [`video`] writes frames to one file.

mod atomic;
mod encode;
mod error;
mod format;
mod layered;
mod remove_on_exit;
pub mod video;

pub use error::OutputError;
pub use error::reason;
pub use format::Format;
pub use layered::{Channel, ImageLayer, LayeredImage, save_layers, save_layers_to_stdout};
pub use remove_on_exit::RemoveOnExit;
pub use remove_on_exit::remove_unfinished_files;

use glimray_scene::image::Image;
use std::fs;
use std::io::{self, BufWriter, ErrorKind, Write};
use std::path::{Path, PathBuf};

/// How to write an image.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct SaveOptions {
    /// `None` selects the format by the file extension.
    pub format: Option<Format>,
    /// JPEG quality: 1 (smallest) to 100 (best). Values outside are clamped.
    pub quality: u8,
    /// Whether an existing file may be replaced.
    pub clobber: bool,
    /// Whether a symbolic link stands for its target. That is right for names given by the user; a link
    /// under a generated name is an error.
    pub follow_links: bool,
    /// Where the image lies in a larger one, which OpenEXR files tell; `None` if it is all of it.
    pub place: Option<Place>,
    /// Whether the file has opacity even if every pixel is opaque, where the format supports it. Without it the file has
    /// opacity if some pixel is not opaque.
    pub opacity: bool,
}

/// The place of an image in a larger one.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Place {
    /// The column and the row of its upper left pixel.
    pub corner: (u32, u32),
    /// Width and height of the larger one in pixels.
    pub whole: (u32, u32),
}

impl Default for SaveOptions {
    /// Format by extension, quality 90, replacing existing files, following links, no larger image, and opacity if some
    /// pixel is not opaque.
    fn default() -> Self {
        Self {
            format: None,
            quality: 90,
            clobber: true,
            follow_links: true,
            place: None,
            opacity: false,
        }
    }
}

/// Writes `image` to `path` in the format of the file extension.
///
/// # Errors
/// See [`save_with`].
pub fn save(path: impl AsRef<Path>, image: &Image) -> Result<(), OutputError> {
    save_with(path, image, &SaveOptions::default())
}

/// Writes `image` to `path`. If it returns an error, the previous contents of `path` are intact.
///
/// # Errors
/// An unknown format, an image too large for its format, and everything that prevents writing the file: a
/// missing or read-only folder, a full disk, a file that must not be replaced.
pub fn save_with(
    path: impl AsRef<Path>,
    image: &Image,
    options: &SaveOptions,
) -> Result<(), OutputError> {
    let path = path.as_ref();
    let format = format_of(path, options)?;
    format.check_size(image.width, image.height)?;
    let bytes = encode::encode(image, format, options)?;
    atomic::write(path, &bytes, options.clobber, options.follow_links)
}

/// The bytes of a file with `image`, as PNG unless `options` names a format.
///
/// # Errors
/// An image too large for its format.
pub fn encoded(image: &Image, options: &SaveOptions) -> Result<Vec<u8>, OutputError> {
    let format = options.format.unwrap_or(Format::Png);
    format.check_size(image.width, image.height)?;
    encode::encode(image, format, options)
}

/// Writes `image` to standard output, as PNG unless `options` names a format.
///
/// # Errors
/// An image too large for its format, or a closed standard output.
pub fn save_to_stdout(image: &Image, options: &SaveOptions) -> Result<(), OutputError> {
    let bytes = encoded(image, options)?;
    let mut stdout = io::stdout().lock();
    stdout
        .write_all(&bytes)
        .and_then(|()| stdout.flush())
        .map_err(|source| OutputError::Stdout { source })
}

/// Checks, before an image of `width` × `height` pixels is rendered, whether [`save_with`] can write it
/// to `path`: it creates a temporary file beside it. Also removes the temporary files
/// (`.NAME.part-PID-…`) that killed processes left for `path`.
///
/// # Errors
/// The errors of [`save_with`] that can be detected in advance.
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

/// Like [`check`], for a file that is not an image.
///
/// # Errors
/// The errors of [`write()`] that can be detected in advance.
pub fn check_file(path: impl AsRef<Path>, clobber: bool) -> Result<(), OutputError> {
    atomic::check(path.as_ref(), clobber, true)
}

/// Renames a file or folder to the first free name of `NAME.old-1`, `NAME.old-2` and so on, and returns that name.
///
/// # Errors
/// Why it cannot be renamed, without a full stop.
pub fn set_aside(path: &Path) -> Result<PathBuf, String> {
    let name = |number: u32| {
        let mut name = path.as_os_str().to_owned();
        name.push(format!(".old-{number}"));
        PathBuf::from(name)
    };
    let is_free = |path: &PathBuf| {
        fs::symlink_metadata(path).is_err_and(|error| error.kind() == ErrorKind::NotFound)
    };
    let aside = (1..1000).map(name).find(is_free);
    let aside = aside.ok_or("all names up to .old-999 are taken")?;
    fs::rename(path, &aside).map_err(|error| reason(&error))?;
    Ok(aside)
}

/// Like [`check_file`], for a generated name: an existing file may be replaced, but the name must not be
/// a symbolic link, except to a pipe or a device.
///
/// # Errors
/// The errors of [`write_own`] that can be detected in advance.
pub fn check_own(path: impl AsRef<Path>) -> Result<(), OutputError> {
    atomic::check(path.as_ref(), true, false)
}

/// Refuses a name that is a symbolic link, except to a pipe or a device.
///
/// # Errors
/// [`OutputError::Link`].
pub fn check_no_link(path: impl AsRef<Path>) -> Result<(), OutputError> {
    atomic::check_no_link(path.as_ref())
}

/// Writes any `bytes` to `path` as safely as images. `clobber` tells whether an existing file may be
/// replaced.
///
/// # Errors
/// Everything that prevents writing the file; the previous contents of `path` are then intact.
pub fn write(path: impl AsRef<Path>, bytes: &[u8], clobber: bool) -> Result<(), OutputError> {
    atomic::write(path.as_ref(), bytes, clobber, true)
}

/// Like [`write()`], for contents too large for memory: `fill` writes them piece by piece.
///
/// # Errors
/// See [`write()`], and those of `fill`.
pub fn write_with(
    path: impl AsRef<Path>,
    clobber: bool,
    fill: impl FnOnce(&mut dyn Write) -> io::Result<()>,
) -> Result<(), OutputError> {
    write_pieces(path.as_ref(), clobber, true, fill)
}

/// Like [`write_own`], for contents too large for memory: `fill` writes them piece by piece.
///
/// # Errors
/// See [`write_own`], and those of `fill`.
pub fn write_own_with(
    path: impl AsRef<Path>,
    fill: impl FnOnce(&mut dyn Write) -> io::Result<()>,
) -> Result<(), OutputError> {
    write_pieces(path.as_ref(), true, false, fill)
}

fn write_pieces(
    path: &Path,
    clobber: bool,
    follow_links: bool,
    fill: impl FnOnce(&mut dyn Write) -> io::Result<()>,
) -> Result<(), OutputError> {
    atomic::write_with(path, clobber, follow_links, |file| {
        let mut file = BufWriter::with_capacity(1 << 20, file);
        let filled = fill(&mut file).and_then(|()| file.flush());
        filled.map_err(|source| OutputError::Io {
            path: path.into(),
            source,
        })
    })
}

/// Writes any `bytes` to `path`, a generated name: see [`check_own`].
///
/// # Errors
/// See [`write()`], and [`OutputError::Link`].
pub fn write_own(path: impl AsRef<Path>, bytes: &[u8]) -> Result<(), OutputError> {
    atomic::write(path.as_ref(), bytes, true, false)
}

/// The format of the options or the extension, or PNG for pipes and devices, which have none.
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
