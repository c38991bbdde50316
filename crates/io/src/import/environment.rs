//! The environment that replaces or changes the background of a scene.

use super::error::{ImportError, fault};
use super::options::{Environment, EnvironmentSource, Options};
use super::step::{self, Step};
use super::{folder, paths, picture, range, source};
use glimray_scene::{Background, Picture, Scene, sky};
use std::path::Path;
use std::sync::Arc;

impl Environment {
    /// The file that it is read from.
    pub fn file(&self) -> Option<&Path> {
        match &self.source {
            Some(EnvironmentSource::File(path)) => Some(path),
            Some(EnvironmentSource::Sky { .. } | EnvironmentSource::BuiltIn(_)) | None => None,
        }
    }
}

/// Replaces or changes the background of `scene`, which was read from `path`. `report` is called before a file is read.
///
/// # Errors
/// The file cannot be read or is no panorama, or a background that is no picture is to be turned.
pub(super) fn apply(
    scene: &mut Scene,
    path: &Path,
    options: &Options,
    report: &dyn Fn(Step),
) -> Result<(), ImportError> {
    let wanted = &options.environment;
    let picture = match &wanted.source {
        None => None,
        Some(EnvironmentSource::Sky {
            elevation_deg,
            azimuth_deg,
        }) => Some(sky::picture(
            elevation_deg.to_radians(),
            azimuth_deg.to_radians(),
        )),
        Some(EnvironmentSource::BuiltIn(environment)) => Some(environment.picture()),
        Some(EnvironmentSource::File(file)) => {
            let (picture, notes) = read(file, options, report)?;
            scene.skipped.extend(notes);
            Some(picture)
        }
    };
    if let Some(picture) = picture {
        let halvings = scene.set_environment(Arc::new(picture));
        if halvings > 0 {
            scene.skipped.push(picture::smaller_pictures(halvings));
        }
    }
    if let Some(factor) = wanted.strength {
        match &mut scene.background {
            Background::Color(color) => *color *= factor,
            Background::Gradient { bottom, top } => {
                *bottom *= factor;
                *top *= factor;
            }
            Background::Picture { strength, .. } => *strength *= factor,
        }
        range::limit(scene);
    }
    match (wanted.rotation_deg, &mut scene.background) {
        (None, _) => Ok(()),
        (Some(degrees), Background::Picture { rotation, .. }) => {
            *rotation += (degrees % 360.0).to_radians();
            Ok(())
        }
        (Some(_), Background::Color(_) | Background::Gradient { .. }) => {
            let why = "the background is no picture, so it cannot be turned";
            let todo = "Leave out the rotation, or name a picture as the environment";
            let fault = fault("environment refused", path, why, todo);
            Err(ImportError::Malformed(fault))
        }
    }
}

/// The picture in `file`, and notes on what was repaired or halved.
///
/// # Errors
/// As [`apply`].
pub(super) fn read(
    file: &Path,
    options: &Options,
    report: &dyn Fn(Step),
) -> Result<(Picture, Vec<String>), ImportError> {
    let limit = picture::MAX_BYTES;
    let bytes = step::read(file, report, || folder::read(file, limit));
    let bytes = bytes.map_err(|error| paths::unreadable(file, &error, limit))?;
    let name = file.file_name().unwrap_or_default().to_string_lossy();
    let name = source::quote(name.as_bytes());
    let (picture, mut notes) = picture::environment(&bytes, &name).map_err(|refused| {
        refused.into_error(|why, todo| {
            ImportError::Malformed(fault("picture refused", file, &why, todo))
        })
    })?;
    let (width, height) = (picture.width, picture.height);
    let picture = match options.texture_limit {
        Some(most) => picture.limited(most.get()),
        None => picture,
    };
    if picture.width < width {
        notes.push(format!(
            "{name} was reduced from {width} × {height} to {} × {} texels",
            picture.width, picture.height
        ));
    }
    Ok((picture, notes))
}
