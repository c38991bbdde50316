//! Saving a scene as a native file, with its meshes and pictures beside it.

use super::error::AppError;
use glimray_io::export::{self, Export};
use glimray_io::import::{self, Baking, Memory, Options};
use glimray_io::output;
use glimray_scene::Scene;
use std::fs;
use std::path::{Path, PathBuf};

/// Writes `scene` to `path`, which should end in `.toml`, and its meshes and textures beside it. Returns all
/// paths, the scene's last. Files beside the scene are never replaced: a file with the same contents is used
/// again, otherwise another name is chosen. `clobber` allows replacing the scene file itself.
///
/// # Errors
/// The scene is too large or extreme for a native scene, or a file cannot be written. The old scene file is then unchanged, and new files
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
    check(&made)?;
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

/// Reads what would be written, so that all that is written can be read.
fn check(made: &Export) -> Result<(), AppError> {
    const NAME: &str = "scene.toml";
    let files = made.files.iter();
    let mut memory: Memory = files
        .map(|file| (file.name.as_str(), file.bytes.as_slice()))
        .collect();
    memory.insert(NAME, made.text.as_bytes());
    let options = Options {
        baking: Baking::Never,
        ..Options::default()
    };
    match import::load_from(&memory, NAME, &options) {
        Ok(_) => Ok(()),
        Err(error) => {
            let line = error.fault().excerpt.as_ref();
            let line = line.map_or(String::new(), |it| format!(" (`{}`)", it.text.trim()));
            Err(AppError::Refused(format!(
                "cannot write the scene as a native one: {}{line}. Render the original instead, or change that in it.",
                error.fault().why
            )))
        }
    }
}
