//! The background of a native scene.

use super::color_or::color_or;
use crate::import::native::values::{Angle, Color, NonNegative, Number};
use glimray_scene::sky;
use schemars::JsonSchema;
use serde::Deserialize;
use serde::de::{self, Deserializer, MapAccess, SeqAccess, Visitor};
use std::fmt;
use toml::Spanned;

/// The background: `bottom` and `top`, `picture`, or `sky`.
#[derive(Clone, Debug, Default, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub(in crate::import::native) struct BackgroundTable {
    /// The colour straight down; it changes linearly with height towards `top`.
    pub bottom: Option<Color>,
    /// The colour straight up.
    pub top: Option<Color>,
    /// The path of an equirectangular image (PNG, JPEG, WebP, KTX2, HDR or EXR) in the scene's folder or below, for
    /// image-based backgrounds. Its centre lies in the direction -z, +x to the right of it, its upper
    /// edge straight up.
    #[schemars(with = "Option<String>")]
    pub picture: Option<Spanned<String>>,
    /// Instead of a picture the clear sky with a sun, of which this is the place.
    #[schemars(with = "Option<SkyTable>")]
    pub sky: Option<Spanned<SkyTable>>,
    /// Factor on the image; default 1.
    pub strength: Option<NonNegative>,
    /// Rotation of the image in degrees about the y axis, counter-clockwise from above; default 0.
    pub rotation_deg: Option<Angle>,
    /// The same in radians, instead of `rotation_deg`.
    #[schemars(with = "Option<f64>")]
    pub rotation: Option<Number>,
}

/// The place of the sun.
#[derive(Clone, Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub(in crate::import::native) struct SkyTable {
    /// Its angle above the horizon in degrees, 0 to 90; default 45.
    pub elevation_deg: Angle,
    /// Its angle from -z towards +x in degrees; default -135, at the left behind the camera of a model.
    pub azimuth_deg: Angle,
}

impl Default for SkyTable {
    fn default() -> Self {
        Self {
            elevation_deg: Angle(sky::SUN_ELEVATION_DEG),
            azimuth_deg: Angle(sky::SUN_AZIMUTH_DEG),
        }
    }
}

/// A background without numbers.
#[derive(Clone, Copy, Debug, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub(in crate::import::native) enum NamedBackground {
    /// The clear sky, with the sun at its default place.
    Sky,
}

color_or!(
    /// A colour, a gradient from bottom to top, an image, or "sky".
    ColorOrBackground(BackgroundTable, NamedBackground),
    "a colour ([r, g, b] or \"#rrggbb\"), a gradient, a picture or \"sky\""
);
