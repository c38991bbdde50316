//! Saving a scene as a native file, with its meshes and pictures beside it.

use super::error::AppError;
use crate::export;
use crate::output;
use crate::scene::Scene;
use std::fs;
use std::path::{Path, PathBuf};

/// Writes `scene` to `path`, which should end in `.toml`, and what belongs to it beside it, and returns
/// all paths, that of the scene last. Files beside it are never replaced: what is there with the same
/// contents is used, else another name is taken. `clobber` says whether the scene file itself may be.
///
/// # Errors
/// There is too much in the scene, or a file cannot be written; the old scene file is then still there
/// and whole, and new files beside it are gone again.
pub fn save(path: &Path, scene: &Scene, clobber: bool) -> Result<Vec<PathBuf>, AppError> {
    let folder = path.parent().unwrap_or(Path::new(""));
    let stem = path.file_stem().unwrap_or_default().to_string_lossy();
    let is_taken = |name: &str, bytes: &[u8]| {
        let path = folder.join(name);
        let is_there = path.symlink_metadata().is_ok();
        is_there && fs::read(&path).map_or(true, |found| found != bytes)
    };
    let made = export::native(scene, &stem, &is_taken);
    let made = made.map_err(|error| AppError::Refused(error.to_string()))?;
    output::check_file(path, clobber)?;
    let mut written = Vec::new();
    let mut all = Vec::with_capacity(made.files.len() + 1);
    let outcome = made.files.iter().try_for_each(|file| {
        let path = folder.join(&file.name);
        all.push(path.clone());
        if path.exists() {
            return Ok(());
        }
        output::write(&path, &file.bytes, false)?;
        written.push(path);
        Ok(())
    });
    // The scene last: as long as it is the old one, all that it names is there.
    let outcome = outcome.and_then(|()| output::write(path, made.text.as_bytes(), clobber));
    if let Err(error) = outcome {
        for path in written {
            let _ = fs::remove_file(path);
        }
        return Err(error.into());
    }
    all.push(path.to_owned());
    Ok(all)
}
