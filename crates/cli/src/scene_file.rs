//! Reading a scene file and the files that it names.

use super::interrupt::Interrupt;
use super::memory;
use glimray_app::error::AppError;
use glimray_app::host;
use glimray_app::inputs::Inputs;
use glimray_io::import::{self, Options};
use glimray_scene::Scene;
use std::path::Path;

/// Reads a scene, from the files of a host if it has any; if `is_strict`, refuses one of which anything was skipped. The second
/// value has the files on the disk that were read or looked for, even if reading failed.
pub fn load(path: &Path, options: &Options, is_strict: bool) -> (Result<Scene, AppError>, Inputs) {
    // Reading may take long, and is then to end like the rest.
    let ready = memory::check_file(path).and_then(|()| Interrupt::install());
    if let Err(error) = ready {
        return (Err(error), Inputs::new([path]));
    }
    let host = host::current();
    let (scene, files) = match host.as_ref().and_then(|host| host.files()) {
        Some(files) => {
            let scene = import::load_from(files, &path.to_string_lossy(), options);
            let read = options.environment.file().map(Path::to_owned);
            (scene, read.into_iter().collect())
        }
        None => import::load_watched(path, options, &|_| ()),
    };
    let scene = scene.map_err(AppError::from);
    (
        scene.and_then(|scene| strict(path, is_strict, scene)),
        Inputs::new(files),
    )
}

fn strict(path: &Path, is_strict: bool, scene: Scene) -> Result<Scene, AppError> {
    match scene.skipped.first() {
        Some(first) if is_strict => Err(AppError::Refused(format!(
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
