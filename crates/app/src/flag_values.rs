//! Reads the values of flags that place the camera, choose the moment and develop the picture.

use super::overrides::{BackgroundChoice, Exposure, SectionChoice};
use super::value_forms::{list, within};
use glam::{DVec3, Vec3};
use glimray_scene::{Section, Shutter};

/// Largest absolute value of a coordinate.
pub const MAX_COORDINATE: f64 = 1e9;

/// `X,Y,Z`, a point or a direction in scene units.
///
/// # Errors
/// One line for the user: other than three numbers, or one out of range.
pub fn vector(text: &str) -> Result<DVec3, String> {
    let part = |part: &str| within(part, -MAX_COORDINATE, MAX_COORDINATE, "every coordinate");
    list(text, "X,Y,Z", part).map(DVec3::from_array)
}

/// `R,G,B`, a linear radiance.
///
/// # Errors
/// One line for the user: other than three numbers, or one out of 0 to 10⁶.
pub fn color(text: &str) -> Result<Vec3, String> {
    let part = |part: &str| within(part, 0.0, 1e6_f32, "every channel");
    list(text, "R,G,B", part).map(Vec3::from_array)
}

/// `R,G,B` or `transparent`.
///
/// # Errors
/// As [`color`].
pub fn background(text: &str) -> Result<BackgroundChoice, String> {
    match text {
        "transparent" => Ok(BackgroundChoice::Transparent),
        _ => color(text).map(BackgroundChoice::Color),
    }
}

/// `X,Y,Z,OFFSET`, a plane with the normal (x, y, z) of any length, of the points p with p·(x, y, z) = offset; or `none`.
///
/// # Errors
/// One line for the user: other than four numbers, one out of range, or no direction.
pub fn section(text: &str) -> Result<SectionChoice, String> {
    if text == "none" {
        return Ok(SectionChoice(None));
    }
    let part = |part: &str| within(part, -MAX_COORDINATE, MAX_COORDINATE, "every number");
    let [x, y, z, offset] = list(text, "X,Y,Z,OFFSET or none", part)?;
    let (normal, offset) = match DVec3::new(x, y, z) {
        // A direction that is already normalised keeps all its digits.
        unit if (unit.length_squared() - 1.0).abs() <= 8.0 * f64::EPSILON => (unit, offset),
        any => {
            let unit = any.try_normalize().ok_or("the direction cannot be 0,0,0")?;
            (unit, offset / any.length())
        }
    };
    Ok(SectionChoice(Some(Section { normal, offset })))
}

/// `EV`, `auto`, or `auto+EV` and `auto-EV`.
///
/// # Errors
/// One line for the user: another word, or stops out of -64 to 64.
pub fn exposure(text: &str) -> Result<Exposure, String> {
    let stops = |text: &str| {
        let number = within(text, -64.0, 64.0, "it");
        number.map_err(|why| format!("{why}; `auto`, `auto+1` and the like are allowed too"))
    };
    match text.trim().strip_prefix("auto") {
        Some("") => Ok(Exposure {
            is_auto: true,
            stops: 0.0,
        }),
        Some(change) if change.starts_with(['+', '-']) => Ok(Exposure {
            is_auto: true,
            stops: stops(change)?,
        }),
        Some(_) | None => Ok(Exposure {
            is_auto: false,
            stops: stops(text)?,
        }),
    }
}

/// A vertical field of view in degrees.
///
/// # Errors
/// One line for the user: no number from 0.001 to 179.9.
pub fn fov_y(text: &str) -> Result<f64, String> {
    within(text, 0.001, 179.9, "it")
}

/// The height of an orthographic view in scene units.
///
/// # Errors
/// One line for the user: no number from 10⁻⁹ to [`MAX_COORDINATE`].
pub fn orthographic(text: &str) -> Result<f64, String> {
    within(text, 1e-9, MAX_COORDINATE, "it")
}

/// Frames per second.
///
/// # Errors
/// One line for the user: no number from 0.01 to 1000.
pub fn fps(text: &str) -> Result<f64, String> {
    within(text, 0.01, 1000.0, "it")
}

/// A time in seconds.
///
/// # Errors
/// One line for the user: no number from -10⁶ to 10⁶.
pub fn time(text: &str) -> Result<f64, String> {
    within(text, -1e6, 1e6, "it")
}

/// Longest exposure, and largest offset from a frame's time, in frames.
const MAX_SHUTTER: f64 = 16.0;

/// `0.5`, `180deg` or `-0.25..0.25`.
///
/// # Errors
/// One line for the user: times out of range, or a shutter that closes before it opens.
pub fn shutter(text: &str) -> Result<Shutter, String> {
    if let Some((open, close)) = text.split_once("..") {
        let end = |text: &str| within(text, -MAX_SHUTTER, MAX_SHUTTER, "opening and closing");
        let (open, close) = (end(open)?, end(close)?);
        return if open <= close {
            Ok(Shutter { open, close })
        } else {
            Err("it closes before it opens: put the earlier time first, as in -0.25..0.25".into())
        };
    }
    let close = match text.trim().strip_suffix("deg") {
        Some(degrees) => within(degrees, 0.0, MAX_SHUTTER * 360.0, "the angle")? / 360.0,
        None => within(text, 0.0, MAX_SHUTTER, "it")?,
    };
    Ok(Shutter { open: 0.0, close })
}
