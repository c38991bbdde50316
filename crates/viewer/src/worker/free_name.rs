//! Names of files that nothing has yet.

use glimray_app::error::AppError;
use glimray_io::output::OutputError;
use std::ffi::OsStr;
use std::path::{Path, PathBuf};

/// Highest number that is tried.
const MAX: u32 = 1_000_000;

/// `path`, or if it is taken, the next name that is free: `one_2.png` is followed by `one_3.png`, and `one.png` by
/// `one_1.png`.
pub fn free(path: PathBuf, is_taken: impl Fn(&Path) -> bool) -> PathBuf {
    if !is_taken(&path) {
        return path;
    }
    let stem = path.file_stem().unwrap_or_default();
    let numbered = stem.to_str().and_then(|stem| stem.rsplit_once('_'));
    let numbered = numbered
        .and_then(|(before, number)| Some((OsStr::new(before), number.parse::<u32>().ok()?)));
    let (before, number) = numbered.unwrap_or((stem, 0));
    let name = |number: u32| {
        let mut name = before.to_owned();
        name.push(format!("_{number}"));
        if let Some(ending) = path.extension() {
            name.push(".");
            name.push(ending);
        }
        path.with_file_name(name)
    };
    let mut later = (number.saturating_add(1)..=MAX).map(name);
    later.find(|path| !is_taken(path)).unwrap_or(path.clone())
}

/// Writes a file with `save`. If one exists at `path` which must not be replaced, the next name that is free is used:
/// what took long to render is not thrown away. Returns the file's path.
///
/// # Errors
/// `save` failed, unless because the file exists.
pub fn write<E: Into<AppError>>(
    path: &Path,
    mut save: impl FnMut(&Path) -> Result<(), E>,
) -> Result<PathBuf, AppError> {
    let mut name = path.to_owned();
    loop {
        match save(&name).map_err(Into::into) {
            Ok(()) => return Ok(name),
            Err(AppError::Output(OutputError::Exists { path: taken })) => {
                let next = free(name.clone(), |path| *path == name || path.exists());
                if next == name {
                    return Err(OutputError::Exists { path: taken }.into());
                }
                name = next;
            }
            Err(error) => return Err(error),
        }
    }
}

/// The file name without its folder, for messages.
pub fn short(path: &Path) -> String {
    let name = path.file_name().unwrap_or(path.as_os_str());
    name.to_string_lossy().into_owned()
}
