//! Parsers for the values of flags, with their error messages.

use crate::args::{ProgressMode, Range, SequenceFormat};
use clap::builder::{PossibleValue, PossibleValuesParser, TypedValueParser};
use glam::{DVec3, Vec3};
use glimray_app::overrides::{BackgroundChoice, Exposure};
use glimray_app::value_names::ValueNames;
use glimray_io::import::{Axis, Baking, EnvironmentSource, Ground};
use glimray_io::output::Format;
use glimray_io::output::video::VideoFormat;
use glimray_render::gpu::Backend;
use glimray_render::{Integrator, MAX_SIDE};
use glimray_scene::{Shutter, sky};
use std::fmt::Display;
use std::num::NonZero;
use std::str::FromStr;
use std::time::Duration;

/// When to bake for this integrator; `None` is the scene's own.
pub fn baking(integrator: Option<Integrator>) -> Baking {
    match integrator {
        None => Baking::IfClassical,
        Some(integrator) if integrator.is_classical() => Baking::Always,
        Some(_) => Baking::Never,
    }
}

/// Parses one of a setting's names.
pub fn one_of<T: Clone + Send + Sync>(
    names: &'static ValueNames<T>,
) -> impl TypedValueParser<Value = T> {
    let known = names.0.iter();
    PossibleValuesParser::new(known.map(|(name, help, _)| PossibleValue::new(name).help(help)))
        .try_map(|given| {
            let found = names.0.iter().find(|(name, ..)| *name == given);
            found.map(|(.., value)| value.clone()).ok_or("unknown")
        })
}

pub static FORMATS: ValueNames<Format> = ValueNames(&[
    ("png", "8 bits per channel, lossless", Format::Png),
    ("jpeg", "8 bits per channel, lossy", Format::Jpeg),
    ("jpg", "same as jpeg", Format::Jpeg),
    ("exr", "OpenEXR, linear float", Format::Exr),
    ("hdr", "Radiance RGBE, linear", Format::Hdr),
]);

pub static SEQUENCE_FORMATS: ValueNames<SequenceFormat> = ValueNames(&[
    (
        "png",
        "PNG frames, 8 bits per channel, lossless",
        SequenceFormat::Frames(Format::Png),
    ),
    (
        "jpeg",
        "JPEG frames, 8 bits per channel, lossy",
        SequenceFormat::Frames(Format::Jpeg),
    ),
    ("jpg", "same as jpeg", SequenceFormat::Frames(Format::Jpeg)),
    (
        "exr",
        "OpenEXR frames, linear float",
        SequenceFormat::Frames(Format::Exr),
    ),
    (
        "hdr",
        "Radiance RGBE frames, linear",
        SequenceFormat::Frames(Format::Hdr),
    ),
    (
        "mp4",
        "H.264 video",
        SequenceFormat::Video(VideoFormat::Mp4),
    ),
    (
        "gif",
        "animated GIF, 256 colours",
        SequenceFormat::Video(VideoFormat::Gif),
    ),
    (
        "y4m",
        "YUV4MPEG2, uncompressed, for other programs",
        SequenceFormat::Video(VideoFormat::Y4m),
    ),
]);

pub static BACKENDS: ValueNames<Backend> = ValueNames(&[
    ("vulkan", "Linux, Windows, Android", Backend::Vulkan),
    ("metal", "macOS, iOS", Backend::Metal),
    ("dx12", "Windows", Backend::Dx12),
    ("gl", "OpenGL ES 3.1 and later", Backend::Gl),
]);

pub static PROGRESS: ValueNames<ProgressMode> = ValueNames(&[
    (
        "auto",
        "bar on a terminal, otherwise nothing",
        ProgressMode::Auto,
    ),
    ("bar", "bar on a terminal", ProgressMode::Bar),
    ("json", "JSON lines", ProgressMode::Json),
    ("none", "nothing", ProgressMode::None),
]);

pub static GROUNDS: ValueNames<Ground> = ValueNames(&[
    ("surface", "a grey plane", Ground::Surface),
    (
        "shadow",
        "only the shadow on it, with a transparent background",
        Ground::Shadow,
    ),
]);

/// Largest absolute value of a coordinate.
const MAX_COORDINATE: f64 = 1e9;

pub fn size(text: &str) -> Result<(u32, u32), String> {
    let (width, height) = text
        .split_once(['x', 'X', '×'])
        .ok_or("it must be WIDTHxHEIGHT in pixels, such as 640x480")?;
    let side = |text: &str| within(text, 1, MAX_SIDE, "width and height");
    Ok((side(width)?, side(height)?))
}

pub fn crop(text: &str) -> Result<[u32; 4], String> {
    let edges @ [x0, y0, x1, y1] = list(text, "X0,Y0,X1,Y1", |part| {
        within(part, 0, MAX_SIDE, "every edge")
    })?;
    if x0 < x1 && y0 < y1 {
        Ok(edges)
    } else {
        Err("it is empty: X1 must be more than X0, and Y1 more than Y0".into())
    }
}

pub fn pixel(text: &str) -> Result<[u32; 2], String> {
    list(text, "X,Y", |part| {
        within(part, 0, MAX_SIDE, "column and row")
    })
}

pub fn vector(text: &str) -> Result<DVec3, String> {
    let part = |part: &str| within(part, -MAX_COORDINATE, MAX_COORDINATE, "every coordinate");
    list(text, "X,Y,Z", part).map(DVec3::from_array)
}

pub fn color(text: &str) -> Result<Vec3, String> {
    let part = |part: &str| within(part, 0.0, 1e6_f32, "every channel");
    list(text, "R,G,B", part).map(Vec3::from_array)
}

/// `R,G,B` or `transparent`.
pub fn background(text: &str) -> Result<BackgroundChoice, String> {
    match text {
        "transparent" => Ok(BackgroundChoice::Transparent),
        _ => color(text).map(BackgroundChoice::Color),
    }
}

pub fn noise(text: &str) -> Result<f32, String> {
    within(text, 1e-6, 1.0, "it")
}

pub fn clamp_indirect(text: &str) -> Result<f32, String> {
    within(text, 1e-6, 1e6, "it")
}

pub fn fraction(text: &str) -> Result<f32, String> {
    within(text, 0.0, 1.0, "it")
}

/// `EV`, `auto`, or `auto+EV` and `auto-EV`.
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

pub fn fov_y(text: &str) -> Result<f64, String> {
    within(text, 0.001, 179.9, "it")
}

pub fn orthographic(text: &str) -> Result<f64, String> {
    within(text, 1e-9, MAX_COORDINATE, "it")
}

pub fn texture_limit(text: &str) -> Result<NonZero<u32>, String> {
    let limit = within(text, 1, MAX_SIDE, "it")?;
    Ok(NonZero::new(limit).unwrap_or(NonZero::<u32>::MIN))
}

pub fn environment_strength(text: &str) -> Result<f32, String> {
    within(text, 0.0, 1e6, "it")
}

/// Seconds, with or without an `s`.
pub fn interval(text: &str) -> Result<Duration, String> {
    let number = text.trim();
    let number = number.strip_suffix('s').unwrap_or(number);
    within(number, 0.01, 1e6, "it").map(Duration::from_secs_f64)
}

pub fn angle(text: &str) -> Result<f64, String> {
    within(text, -1e6, 1e6, "it")
}

/// A file, or a sky with the place of its sun.
pub fn environment(text: &str) -> Result<EnvironmentSource, String> {
    let place = match text.strip_prefix("sky") {
        Some("") => Some(""),
        Some(rest) => rest.strip_prefix(':'),
        None => None,
    };
    let Some(place) = place else {
        return match text {
            "" => Err("a file name or `sky` is expected".to_owned()),
            _ => Ok(EnvironmentSource::File(text.into())),
        };
    };
    let (elevation, azimuth) = place.split_once(',').unwrap_or((place, ""));
    let or = |text: &str, default: f64, parse: fn(&str) -> Result<f64, String>| match text {
        "" => Ok(default),
        text => parse(text),
    };
    let of_sun = |text: &str| within(text, 0.0, 90.0, "the elevation");
    Ok(EnvironmentSource::Sky {
        elevation_deg: or(elevation, sky::SUN_ELEVATION_DEG, of_sun)?,
        azimuth_deg: or(azimuth, sky::SUN_AZIMUTH_DEG, |text| {
            within(text, -360.0, 360.0, "the azimuth")
        })?,
    })
}

pub fn filter_radius(text: &str) -> Result<f32, String> {
    within(text, 0.01, 16.0, "it")
}

pub fn light_samples(text: &str) -> Result<f32, String> {
    within(text, 0.001, 1000.0, "it")
}

pub fn tolerance(text: &str) -> Result<f64, String> {
    within(text, 0.0, f64::MAX, "it")
}

pub fn percent(text: &str) -> Result<f64, String> {
    within(text, 0.0, 100.0, "it")
}

/// The mean of FLIP.
pub fn flip(text: &str) -> Result<f64, String> {
    within(text, 0.0, 1.0, "it")
}

/// The highest frame number.
pub const MAX_FRAME: u32 = 9_999_999;

pub fn fps(text: &str) -> Result<f64, String> {
    within(text, 0.01, 1000.0, "it")
}

pub fn seconds(text: &str) -> Result<f64, String> {
    within(text, 0.01, 1e4, "it")
}

pub fn time(text: &str) -> Result<f64, String> {
    within(text, -1e6, 1e6, "it")
}

pub fn elevation(text: &str) -> Result<f64, String> {
    within(text, -89.0, 89.0, "it")
}

pub fn turn_fov_y(text: &str) -> Result<f64, String> {
    within(text, 1.0, 170.0, "it")
}

pub fn margin(text: &str) -> Result<f64, String> {
    within(text, 0.0, 0.9, "it")
}

/// A direction of unit length.
pub fn axis(text: &str) -> Result<DVec3, String> {
    match text.trim() {
        "x" | "X" => Ok(DVec3::X),
        "y" | "Y" => Ok(DVec3::Y),
        "z" | "Z" => Ok(DVec3::Z),
        other => (vector(other).ok())
            .and_then(DVec3::try_normalize)
            .ok_or_else(|| {
                format!("it must be x, y, z or a direction such as 0,1,0, not `{other}`")
            }),
    }
}

/// Which direction is up.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Up {
    /// In the picture.
    Camera(DVec3),
    /// In a model.
    Model(Axis),
}

impl Up {
    /// The axis of a model, if it is one.
    pub fn axis(self) -> Option<Axis> {
        match self {
            Self::Camera(_) => None,
            Self::Model(axis) => Some(axis),
        }
    }
}

/// A direction, or the axis of a model.
pub fn up(text: &str) -> Result<Up, String> {
    match model_axis(text) {
        Ok(axis) => Ok(Up::Model(axis)),
        Err(_) => vector(text).map(Up::Camera),
    }
}

/// The axis of a model that points up.
pub fn model_axis(text: &str) -> Result<Axis, String> {
    match text.trim() {
        "x" | "X" => Ok(Axis::X),
        "y" | "Y" => Ok(Axis::Y),
        "z" | "Z" => Ok(Axis::Z),
        other => Err(format!("it must be x, y or z, not `{other}`")),
    }
}

/// Longest exposure, and largest offset from a frame's time, in frames.
const MAX_SHUTTER: f64 = 16.0;

/// `0.5`, `180deg` or `-0.25..0.25`.
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

/// `A..B`, `A..`, `..B` or `A`.
pub fn frames(text: &str) -> Result<Range, String> {
    let number = |text: &str| within(text, 0, MAX_FRAME, "a frame number");
    let Some((first, last)) = text.split_once("..") else {
        let first = number(text)?;
        return Ok(Range {
            first,
            last: Some(first),
        });
    };
    let is_given = |text: &str| !text.trim().is_empty();
    // Accept Rust's inclusive syntax, A..=B.
    let last = last.strip_prefix('=').unwrap_or(last);
    let first = if is_given(first) { number(first)? } else { 0 };
    let last = is_given(last).then(|| number(last)).transpose()?;
    match last {
        Some(last) if last < first => Err(format!(
            "it is empty: {last} is before {first}. Put the smaller number first"
        )),
        _ => Ok(Range { first, last }),
    }
}

pub fn override_of(text: &str) -> Result<String, String> {
    match text.split_once('=') {
        Some((key, _)) if !key.trim().is_empty() => Ok(text.into()),
        _ => Err("it must be KEY=VALUE, such as camera.fov_y_deg=30".into()),
    }
}

/// `N` comma-separated values.
fn list<T, const N: usize>(
    text: &str,
    shape: &str,
    part: impl Fn(&str) -> Result<T, String>,
) -> Result<[T; N], String> {
    let parts = text.split(',').map(part).collect::<Result<Vec<_>, _>>()?;
    let count = parts.len();
    parts
        .try_into()
        .map_err(|_| format!("it must be {shape}: {N} numbers, not {count}"))
}

/// A number from `min` to `max`. NaN is out of every range.
fn within<T>(text: &str, min: T, max: T, what: &str) -> Result<T, String>
where
    T: FromStr + PartialOrd + Display,
{
    match text.trim().parse::<T>() {
        Ok(number) if number >= min && number <= max => Ok(number),
        _ => Err(format!(
            "{what} must be a number from {min} to {max}, not `{}`",
            text.trim()
        )),
    }
}

#[cfg(feature = "archive")]
pub fn minutes(text: &str) -> Result<f64, String> {
    within(text, 0.01, 1e5, "it")
}

#[cfg(feature = "archive")]
pub fn lease(text: &str) -> Result<f64, String> {
    within(text, 1.0, 86400.0, "it")
}

/// `I/N`, with I below N.
#[cfg(feature = "archive")]
pub fn slice(text: &str) -> Result<(u32, u32), String> {
    let parsed = text
        .split_once('/')
        .and_then(|(first, step)| Some((first.parse().ok()?, step.parse().ok()?)));
    match parsed {
        Some((first, step)) if first < step => Ok((first, step)),
        _ => Err("it must be I/N with I below N, such as 0/4".into()),
    }
}
