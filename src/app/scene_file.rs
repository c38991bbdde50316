//! Reads and writes scene files together with the files that they reference.

use super::cli::SceneFlags;
use super::error::AppError;
use super::inputs::Inputs;
use super::memory;
use crate::export;
use crate::import;
use crate::output;
use crate::scene::Scene;
use std::fs;
use std::path::{Path, PathBuf};

/// Reads a scene; with `--strict`, refuses one of which anything was skipped. The second value has the files
/// that were read or looked for, even if reading failed.
pub fn load(path: &Path, flags: &SceneFlags) -> (Result<Scene, AppError>, Inputs) {
    if let Err(error) = memory::check_file(path) {
        return (Err(error), Inputs::new([path]));
    }
    let (scene, files) = import::load_watched(path, &flags.import_options());
    let scene = scene.map_err(AppError::from);
    (
        scene.and_then(|scene| strict(path, flags, scene)),
        Inputs::new(files),
    )
}

fn strict(path: &Path, flags: &SceneFlags, scene: Scene) -> Result<Scene, AppError> {
    match scene.skipped.first() {
        Some(first) if flags.strict => Err(AppError::Refused(format!(
            "refusing the scene ({}): {first}{}. Repair it or omit --strict.",
            path.display(),
            match scene.skipped.len() - 1 {
                0 => String::new(),
                more => format!(" (and {more} more)"),
            }
        ))),
        _ => Ok(scene),
    }
}

/// Writes `scene` to `path`, which should end in `.toml`, and the files that it references beside it. Returns
/// all paths, the scene's last. Referenced files never replace existing ones: a file with the same contents is
/// reused, otherwise another name is chosen. `clobber` allows replacing the scene file itself.
///
/// # Errors
/// The scene is too large, or a file cannot be written. The old scene file is then unchanged, and new files
/// beside it are removed.
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
    // The scene is written last, so that all files referenced by an existing scene file exist.
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
