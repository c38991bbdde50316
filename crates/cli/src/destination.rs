//! Where a picture is written: a file, a pipe or standard output.

use crate::args::OutputFlags;
use crate::layers::Finished;
use glimray_app::error::AppError;
use glimray_io::output::{self, Format, SaveOptions};
use glimray_render::Film;
use std::io::IsTerminal;
use std::path::{Path, PathBuf};

/// The output of a picture.
pub struct Destination {
    /// As given on the command line; `-` is standard output.
    path: PathBuf,
    options: SaveOptions,
}

impl Destination {
    /// The output that the flags name. The default is `stem` with the format's extension, in the current
    /// folder.
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

    /// Whether a film is written, to be merged or developed later.
    pub fn is_film(&self) -> bool {
        let ending = self.path.extension().unwrap_or_default();
        self.options.format.is_none() && ending.eq_ignore_ascii_case("film")
    }

    /// Whether the format stores linear radiance rather than display values.
    pub fn is_linear(&self) -> bool {
        let format = self.options.format;
        format
            .or_else(|| Format::from_path(&self.path))
            .is_some_and(Format::is_linear)
    }

    /// Whether it keeps opacity.
    pub fn takes_opacity(&self) -> bool {
        let format = self.options.format;
        let format = format.or_else(|| Format::from_path(&self.path));
        self.is_film() || format.unwrap_or(Format::Png).has_opacity()
    }

    /// Finds errors of writing the output before rendering starts.
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
        let clobber = self.options.clobber;
        Ok(output::write_with(&self.path, clobber, |file| {
            film.write(file)
        })?)
    }

    /// Whether it can take layers.
    pub fn takes_layers(&self) -> bool {
        let format = self.options.format;
        let format = format.or_else(|| Format::from_path(&self.path));
        self.is_film() || format.is_some_and(Format::has_layers)
    }

    pub fn save(&self, picture: &Finished) -> Result<(), AppError> {
        let saved = match self.is_stdout() {
            true => picture.save_to_stdout(&self.options),
            false => picture.save(&self.path, &self.options),
        };
        saved.map_err(AppError::from)
    }
}

/// Refuses to write `what` to standard output if that is a terminal or closed.
pub fn check_stdout(what: &str) -> Result<(), AppError> {
    if std::io::stdout().is_terminal() {
        return Err(AppError::Usage(format!(
            "cannot write {what} (standard output): it is a terminal. \
             Redirect it to a file or a program."
        )));
    }
    check_open(what)
}

/// Refuses to write `what` to standard output if that is closed.
pub fn check_open(what: &str) -> Result<(), AppError> {
    match is_stdout_closed() {
        false => Ok(()),
        true => Err(AppError::Unwritable(format!(
            "cannot write {what} (standard output): it is closed. Redirect it to a file or a program."
        ))),
    }
}

/// Whether the program was started with standard output closed. Rust then opens `/dev/null` in its place
/// before `main`, for reading and writing; a shell that redirects to `/dev/null` opens it for writing only.
fn is_stdout_closed() -> bool {
    let is_null =
        std::fs::read_link("/proc/self/fd/1").is_ok_and(|to| to == Path::new("/dev/null"));
    let info = is_null.then(|| std::fs::read_to_string("/proc/self/fdinfo/1").ok());
    let info = info.flatten().unwrap_or_default();
    let flags = info.lines().find_map(|line| line.strip_prefix("flags:"));
    // The lower two bits of the last octal digit are the access mode; 2 is read and write.
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
