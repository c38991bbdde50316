//! Parsers for the values of flags, with their error messages.

use crate::args::{ProgressMode, Range, SequenceFormat};
use clap::builder::{PossibleValue, PossibleValuesParser, TypedValueParser};
use glam::DVec3;
pub use glimray_app::flag_values::{
    background, color, exposure, fov_y, fps, orthographic, section, shutter, time, vector,
};
pub use glimray_app::value_forms::crop;
use glimray_app::value_forms::{list, within};
use glimray_app::value_names::ValueNames;
use glimray_io::import::{Axis, Baking, EnvironmentSource, Ground};
use glimray_io::output::Format;
use glimray_io::output::video::VideoFormat;
use glimray_render::gpu::Backend;
use glimray_render::{Integrator, MAX_SIDE};
use glimray_scene::{BuiltIn, sky};
use std::num::NonZero;
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
    let known = names.0.iter().map(|(name, help, _)| (*name, *help));
    possible(known).try_map(|given| names.value(&given).ok_or("unknown"))
}

/// Accepts these names, each with a description.
pub fn possible(names: impl Iterator<Item = (&'static str, &'static str)>) -> PossibleValuesParser {
    PossibleValuesParser::new(names.map(|(name, help)| PossibleValue::new(name).help(help)))
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

pub fn pixel(text: &str) -> Result<[u32; 2], String> {
    list(text, "X,Y", |part| {
        within(part, 0, MAX_SIDE, "column and row")
    })
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

/// A file, a built-in environment, or a sky with the place of its sun.
pub fn environment(text: &str) -> Result<EnvironmentSource, String> {
    let place = match text.strip_prefix("sky") {
        Some("") => Some(""),
        Some(rest) => rest.strip_prefix(':'),
        None => None,
    };
    let Some(place) = place else {
        return match BuiltIn::named(text) {
            Some(environment) => Ok(EnvironmentSource::BuiltIn(environment)),
            None if text.is_empty() => {
                let names = BuiltIn::ALL
                    .iter()
                    .map(|it| format!("`{}`", it.entry().name));
                let names: Vec<_> = names.collect();
                Err(format!(
                    "a file name or one of {} is expected",
                    names.join(", ")
                ))
            }
            None => Ok(EnvironmentSource::File(text.into())),
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

pub fn seconds(text: &str) -> Result<f64, String> {
    within(text, 0.01, 1e4, "it")
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
