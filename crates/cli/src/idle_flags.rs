//! Flags without effect. One that would change the picture of other settings gets a warning, as scripts may give the same
//! flags for several pictures; one that asks for something that would be missing is refused. A host's programmer chooses
//! flags one by one, so that any is refused.

use crate::args::{PictureFlags, SceneFlags};
use glimray_app::console;
use glimray_app::error::AppError;
use glimray_app::host;
use glimray_app::inputs::may_be_model;
use glimray_app::settings::{SETTINGS, Scope};
use glimray_render::RenderSettings;
use std::path::Path;

/// Warns about flags that do not change a picture with these settings.
///
/// # Errors
/// A host gave such a flag.
pub fn warn(given: &PictureFlags, settings: &RenderSettings) -> Result<(), AppError> {
    for setting in SETTINGS {
        if let Some(scope) = &setting.scope
            && (setting.is_given)(&given.settings.given)
            && !setting.applies(settings)
        {
            let Scope { flag, value, noun } = scope;
            let found = scope.found(settings).unwrap_or_default();
            idle(format!(
                "{} has no effect ({flag} {found}): it is for {noun}. Choose {flag} {value}, or leave it out.",
                setting.flag
            ))?;
        }
    }
    Ok(())
}

fn idle(text: String) -> Result<(), AppError> {
    match host::current() {
        Some(_) => Err(AppError::Usage(text)),
        None => {
            console::warning(text);
            Ok(())
        }
    }
}

/// Checks the flags about what is added to models, for a scene that is none: warns about those that leave something out,
/// and refuses a ground.
pub fn check(given: &SceneFlags, path: &Path) -> Result<(), AppError> {
    if may_be_model(path) {
        return Ok(());
    }
    let path = path.display();
    if given.ground.is_some() {
        return Err(AppError::Usage(format!(
            "cannot add a ground (--ground, {path}): only models get one. Leave it out, or add a plane to the scene."
        )));
    }
    for (flag, is_given) in [
        ("--fit", given.fit),
        ("--bare", given.bare),
        ("--no-lights", given.no_lights),
        ("--no-background", given.no_background),
        ("--no-ground", given.no_ground),
    ] {
        if is_given {
            idle(format!(
                "{flag} has no effect ({path}): nothing is added to a scene, only to models. Leave it out."
            ))?;
        }
    }
    Ok(())
}
