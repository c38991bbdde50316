//! Flags without effect. One that would change the picture of other settings gets a warning, as scripts may give the same
//! flags for several pictures; one that asks for something that would be missing is refused.

use crate::args::{PictureFlags, SceneFlags};
use glimray_app::console;
use glimray_app::error::AppError;
use glimray_app::inputs::may_be_model;
use glimray_app::value_names::{ANTIALIAS, INTEGRATORS};
use glimray_render::{Antialias, Integrator, RenderSettings};
use std::path::Path;

/// Warns about flags that do not change a picture with these settings.
pub fn warn(given: &PictureFlags, settings: &RenderSettings) {
    let is_path = settings.integrator == Integrator::Path;
    for (flag, is_given) in [
        ("--transparent-shadows", given.transparent_shadows),
        ("--bsdf", given.bsdf.is_some()),
        ("--clamp-indirect", given.clamp_indirect.is_some()),
    ] {
        if is_given && !is_path {
            let integrator = INTEGRATORS.name(&settings.integrator);
            console::warning(format_args!(
                "{flag} has no effect (--integrator {integrator}): it is for paths. Choose --integrator path, or leave it \
                 out."
            ));
        }
    }
    if given.noise.is_some() && settings.antialias != Antialias::Adaptive {
        let antialias = ANTIALIAS.name(&settings.antialias);
        console::warning(format_args!(
            "--noise has no effect (--antialias {antialias}): it is for adaptive sampling. Choose --antialias adaptive, \
             or leave it out."
        ));
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
            console::warning(format_args!(
                "{flag} has no effect ({path}): nothing is added to a scene, only to models. Leave it out."
            ));
        }
    }
    Ok(())
}
