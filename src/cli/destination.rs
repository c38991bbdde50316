//! Where a picture goes: a file, a pipe, or the standard output.

use crate::app::error::AppError;
use crate::cli::args::OutputFlags;
use crate::image::Image;
use crate::output::{self, Format, SaveOptions};
use crate::render::Film;
use std::io::IsTerminal;
use std::path::{Path, PathBuf};

/// The picture's way out.
pub struct Destination {
    /// As on the command line; `-` is the standard output.
    path: PathBuf,
    options: SaveOptions,
}

impl Destination {
    /// What the flags say; without a name, `stem` with the format's ending in the current folder.
    pub fn new(flags: &OutputFlags, stem: &Path) -> Self {
        let default = || stem.with_extension(flags.format.map_or("png", ending));
        Self {
            path: flags.path.clone().unwrap_or_else(default),
            options: SaveOptions {
                format: flags.format,
                quality: flags.quality,
                clobber: !flags.no_clobber,
                ..SaveOptions::default()
            },
        }
    }

    pub fn path(&self) -> &Path {
        &self.path
    }

    pub fn is_stdout(&self) -> bool {
        self.path == Path::new("-")
    }

    /// Whether the sums themselves are kept, to be merged and developed later.
    pub fn is_film(&self) -> bool {
        let ending = self.path.extension().unwrap_or_default();
        self.options.format.is_none() && ending.eq_ignore_ascii_case("film")
    }

    /// Whether the file holds linear light rather than display values.
    pub fn is_linear(&self) -> bool {
        let format = self.options.format;
        format
            .or_else(|| Format::from_path(&self.path))
            .is_some_and(Format::is_linear)
    }

    /// Refuses, before any rendering, what would fail after it.
    pub fn check(&self, width: u32, height: u32) -> Result<(), AppError> {
        if self.is_film() {
            return Ok(output::check_file(&self.path, self.options.clobber)?);
        }
        if !self.is_stdout() {
            return Ok(output::check(&self.path, &self.options, width, height)?);
        }
        check_stdout("a picture")
    }

    pub fn save_film(&self, film: &Film) -> Result<(), AppError> {
        let mut bytes = Vec::new();
        let written = film.write(&mut bytes);
        written.map_err(|error| AppError::Internal(format!("film: {error}")))?;
        Ok(output::write(&self.path, &bytes, self.options.clobber)?)
    }

    pub fn save(&self, image: &Image) -> Result<(), AppError> {
        let saved = if self.is_stdout() {
            output::save_to_stdout(image, &self.options)
        } else {
            output::save_with(&self.path, image, &self.options)
        };
        saved.map_err(AppError::from)
    }
}

/// Refuses to write `what` to a standard output that shows no pictures, or that is not there.
pub fn check_stdout(what: &str) -> Result<(), AppError> {
    if std::io::stdout().is_terminal() {
        return Err(AppError::Usage(format!(
            "cannot show {what} (standard output): it is a terminal. \
             Redirect it to a file or a program."
        )));
    }
    check_open(what)
}

/// Refuses to write `what` to a standard output that is not there.
pub fn check_open(what: &str) -> Result<(), AppError> {
    match is_stdout_closed() {
        false => Ok(()),
        true => Err(AppError::Unwritable(format!(
            "cannot write {what} (standard output): it is closed. Redirect it to a file or a program."
        ))),
    }
}

/// Whether the program was started without a standard output. Rust opens `/dev/null` in its place before
/// `main`, for reading and writing; a shell that redirects to it opens it for writing only.
fn is_stdout_closed() -> bool {
    let is_null =
        std::fs::read_link("/proc/self/fd/1").is_ok_and(|to| to == Path::new("/dev/null"));
    let info = is_null.then(|| std::fs::read_to_string("/proc/self/fdinfo/1").ok());
    let info = info.flatten().unwrap_or_default();
    let flags = info.lines().find_map(|line| line.strip_prefix("flags:"));
    // The last octal digit has the access mode in its lower two bits: 2 is for both.
    flags.is_some_and(|flags| flags.trim().ends_with(['2', '6']))
}

fn ending(format: Format) -> &'static str {
    match format {
        Format::Png => "png",
        Format::Jpeg => "jpg",
        Format::Exr => "exr",
        Format::Hdr => "hdr",
    }
}
