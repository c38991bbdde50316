//! The native part of the Python module `glimray`. Users import `glimray/__init__.py`, which documents what they see; here
//! arguments are those of the command line, and arrays are bytes in the machine's order.

mod devices;
mod errors;
mod host;
mod picture;
mod query;

use pyo3::prelude::*;

/// The native part of `glimray`.
#[pymodule]
mod _native {
    #[pymodule_export]
    use super::{
        Ran, convert, driver_environment, encode, from_toml, keywords, read_picture, run, to_toml,
        version,
    };
    #[pymodule_export]
    use crate::devices::{close, is_open};
    #[pymodule_export]
    use crate::picture::{Picture, compare, render};
    #[pymodule_export]
    use crate::query::RayQuery;
}

use errors::Failure;
use glimray_cli::embedded;
use glimray_io::output::{self, Format, SaveOptions};
use glimray_scene::image::Image;
use host::Session;
use pyo3::types::PyBytes;
use std::collections::BTreeMap;
use std::ffi::OsString;
use std::path::PathBuf;

/// Files in memory by name.
type Files = Option<BTreeMap<String, Vec<u8>>>;

/// A function that takes the finished fraction of the work.
type Progress = Option<Py<PyAny>>;

/// The output of a command.
#[pyclass(frozen, get_all)]
struct Ran {
    /// Bytes for standard output.
    printed: Vec<u8>,
    /// The report as JSON, or nothing.
    report: String,
    /// Warnings, a text each.
    warnings: Vec<String>,
}

/// The version of the program.
#[pyfunction]
fn version() -> &'static str {
    env!("CARGO_PKG_VERSION")
}

/// The keywords of a command, as JSON.
#[pyfunction]
fn keywords(command: &str) -> PyResult<String> {
    let found = serde_json::to_string(&embedded::keywords(command));
    found.map_err(|error| errors::internal(&error))
}

/// Variables of the environment that drivers need and that are missing, and what was said.
#[pyfunction]
fn driver_environment(py: Python) -> PyResult<(Vec<(&'static str, OsString)>, Ran)> {
    Session::default().run(py, |host| Ok(embedded::driver_environment(host)))
}

/// Runs a command.
#[pyfunction]
fn run(py: Python, arguments: Vec<PathBuf>, files: Files, progress: Progress) -> PyResult<Ran> {
    let session = Session::new(files, progress);
    let ((), said) = session.run(py, move |host| embedded::run(host, &words(arguments)))?;
    Ok(said)
}

/// A scene in the native format: its text, its companion files, and what `convert` said.
#[pyfunction]
#[expect(clippy::type_complexity, reason = "a tuple of Python")]
fn convert<'py>(
    py: Python<'py>,
    arguments: Vec<PathBuf>,
    files: Files,
) -> PyResult<(String, Vec<(String, Bound<'py, PyBytes>)>, Ran)> {
    let session = Session::new(files, None);
    let native = move |host| embedded::native(host, &words(arguments));
    let (export, said) = session.run(py, native)?;
    let files = export.files.iter();
    let files = files.map(|file| (file.name.clone(), PyBytes::new(py, &file.bytes)));
    Ok((export.text, files.collect(), said))
}

/// The command line of Python's words.
fn words(arguments: Vec<PathBuf>) -> Vec<OsString> {
    arguments.into_iter().map(Into::into).collect()
}

/// A native scene as JSON, from its text.
#[pyfunction]
fn from_toml(text: &str) -> PyResult<String> {
    let table: toml::Table = text.parse().map_err(|error| errors::scene(&error))?;
    serde_json::to_string(&table).map_err(|error| errors::internal(&error))
}

/// A native scene as text, from JSON.
#[pyfunction]
fn to_toml(json: &str) -> PyResult<String> {
    let value: serde_json::Value =
        serde_json::from_str(json).map_err(|error| errors::scene(&error))?;
    toml::to_string(&value).map_err(|error| errors::scene(&error))
}

/// The bytes of a picture file, of pixels of four floats.
#[pyfunction]
fn encode<'py>(
    py: Python<'py>,
    size: (u32, u32),
    pixels: &[u8],
    ending: &str,
) -> PyResult<Bound<'py, PyBytes>> {
    let image = picture::image(size, pixels)?;
    let options = SaveOptions {
        format: Format::from_path(format!("a.{ending}").as_ref()),
        ..SaveOptions::default()
    };
    let bytes = py.detach(|| output::encoded(&image, &options));
    let bytes = bytes.map_err(|error| Failure::App(error.into()).raised(py))?;
    Ok(PyBytes::new(py, &bytes))
}

/// The size of a picture file, pixels of four floats, whether they are radiance, and whether there is opacity.
type ReadPicture<'py> = ((u32, u32), Bound<'py, PyBytes>, bool, bool);

/// Reads a picture file.
#[pyfunction]
fn read_picture<'py>(py: Python<'py>, path: PathBuf) -> PyResult<ReadPicture<'py>> {
    let read = py.detach(|| glimray_app::picture_file::read(&path));
    let read = read.map_err(|error| Failure::App(error).raised(py))?;
    let Image { width, height, .. } = read.image;
    let pixels = picture::bytes(py, &read.image.pixels);
    Ok(((width, height), pixels, read.is_float, read.has_alpha))
}
