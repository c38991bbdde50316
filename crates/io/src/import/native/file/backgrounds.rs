//! The background of a native scene.

use super::Spanned;
use crate::import::native::values::{Angle, Color, NonNegative, Number, either, words};
use glimray_scene::BuiltIn;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// The background: `bottom` and `top`, `picture`, `environment`, or `sky`.
#[derive(Clone, Debug, Default, Deserialize, Serialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct BackgroundTable {
    /// The colour straight down; it changes linearly with height towards `top`.
    pub bottom: Option<Color>,
    /// The colour straight up.
    pub top: Option<Color>,
    /// The path of an equirectangular image (PNG, JPEG, WebP, KTX2, HDR or EXR) in the scene's folder or below, for
    /// image-based backgrounds. Its centre lies in the direction -z, +x to the right of it, its upper
    /// edge straight up.
    pub picture: Option<Spanned<String>>,
    /// Instead of a picture one of the built-in environments.
    pub environment: Option<NamedBackground>,
    /// Instead of a picture the clear sky with a sun, of which this is the place.
    pub sky: Option<Spanned<SkyTable>>,
    /// Factor on the image; default 1.
    pub strength: Option<NonNegative>,
    /// Rotation of the image in degrees about the y axis, counter-clockwise from above; default 0.
    pub rotation_deg: Option<Angle>,
    /// The same in radians, instead of `rotation_deg`.
    pub rotation: Option<Number>,
}

/// The place of the sun.
#[derive(Clone, Debug, Default, Deserialize, Serialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct SkyTable {
    /// Its angle above the horizon in degrees, 0 to 90; default 45.
    pub elevation_deg: Option<Angle>,
    /// Its angle from -z towards +x in degrees; default -135, at the left behind the camera of a model.
    pub azimuth_deg: Option<Angle>,
}

words! {
    /// A built-in environment, also for `--environment`. Environments without a sun are grey, and their mean radiance over all
    /// directions is 1.
    NamedBackground for BuiltIn {
        /// The clear sky, with the sun at its default place.
        Sky,
        /// The clear sky with the sun 70° above the horizon.
        Noon,
        /// The clear sky with the sun 4° above the horizon.
        Sunset,
        /// The overcast sky of the CIE, three times as bright at the zenith as at the horizon.
        Overcast,
        /// A dim room with a large softbox at the left behind the camera of a model, and a weaker one at the right.
        Studio,
        /// A dim room with a ring light round the camera of a model.
        Ring,
        /// A radiance of 1 from everywhere, in which a white diffuse body vanishes.
        Furnace,
    }
}

either! {
    /// A colour, a gradient from bottom to top, an image, or a built-in environment such as "sky".
    ColorOrBackground { Color(Color), Table(Box<BackgroundTable>), Name(NamedBackground) },
    "a colour ([r, g, b] or \"#rrggbb\"), a gradient, a picture or a built-in environment such as \"sky\"",
    str: Color or Name, seq: Color, map: Table
}
