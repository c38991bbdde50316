//! The light of the background, as a hand turns it: a sky by the place of its sun, another picture by its rotation.

use glam::DVec2;
use glimray_scene::{Background, Origin, Scene};

/// Degrees for a drag over the height of the picture.
const TURN_DEG: f64 = 180.0;
/// Numbers are rounded to this many steps per degree.
const STEPS: f64 = 10.0;

/// Where the light of a background comes from.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum BackgroundLight {
    /// A sky with a sun.
    Sky {
        /// Angle of the sun above the horizon in degrees, 0 to 90.
        elevation_deg: f64,
        /// Angle of the sun in the picture of the sky, from −Z towards +X in degrees.
        azimuth_deg: f64,
        /// Rotation of that picture about +Y in degrees, counter-clockwise from above.
        rotation_deg: f64,
    },
    /// A picture.
    Picture {
        /// The rotation of the picture about +Y in degrees, counter-clockwise from above.
        rotation_deg: f64,
    },
}

impl BackgroundLight {
    /// That of the scene's background; `None` if it is no picture.
    pub fn of(scene: &Scene) -> Option<Self> {
        let Background::Picture {
            picture, rotation, ..
        } = scene.background
        else {
            return None;
        };
        let rotation_deg = rotation.to_degrees();
        Some(match scene.pictures[picture].origin {
            Origin::Sky { elevation, azimuth } => Self::Sky {
                elevation_deg: elevation.to_degrees(),
                azimuth_deg: azimuth.to_degrees(),
                rotation_deg,
            },
            _ => Self::Picture { rotation_deg },
        })
    }

    /// The light after a drag in a picture of `size`, both in pixels with y down. What is ahead follows the pointer to the
    /// right and to the left; up raises a sun, as far as the zenith. Angles are rounded to tenths of a degree.
    pub fn dragged(self, drag: DVec2, size: DVec2) -> Self {
        let turn = TURN_DEG * drag / size.y;
        match self {
            Self::Sky {
                elevation_deg,
                azimuth_deg,
                rotation_deg,
            } => Self::Sky {
                elevation_deg: rounded(elevation_deg - turn.y).clamp(0.0, 90.0),
                azimuth_deg: wrapped(azimuth_deg + turn.x),
                rotation_deg,
            },
            Self::Picture { rotation_deg } => Self::Picture {
                rotation_deg: wrapped(rotation_deg - turn.x),
            },
        }
    }

    /// Elevation and azimuth of the sun in the world in degrees; `None` without a sun.
    pub fn sun_deg(self) -> Option<[f64; 2]> {
        match self {
            Self::Sky {
                elevation_deg,
                azimuth_deg,
                rotation_deg,
            } => Some([elevation_deg, azimuth_deg - rotation_deg]),
            Self::Picture { .. } => None,
        }
    }

    /// The sky with its sun at this elevation and azimuth in the world in degrees, rounded to tenths; a picture without a sun
    /// stays as it is.
    pub fn with_sun(self, [elevation, azimuth]: [f64; 2]) -> Self {
        match self {
            Self::Sky { rotation_deg, .. } => Self::Sky {
                elevation_deg: rounded(elevation).clamp(0.0, 90.0),
                azimuth_deg: wrapped(azimuth + rotation_deg),
                rotation_deg,
            },
            picture => picture,
        }
    }

    /// Gives the light to a scene whose background is such a picture.
    pub fn apply(self, scene: &mut Scene) {
        match self {
            Self::Sky {
                elevation_deg,
                azimuth_deg,
                ..
            } => scene.set_sky(elevation_deg.to_radians(), azimuth_deg.to_radians()),
            Self::Picture { rotation_deg } => {
                if let Background::Picture { rotation, .. } = &mut scene.background {
                    *rotation = rotation_deg.to_radians();
                }
            }
        }
    }

    /// The numbers, such as "Sun elevation 35°, azimuth −120.5°".
    pub fn label(self) -> String {
        let degrees = |value: f64| format!("{}°", rounded(value)).replace('-', "−");
        match self {
            Self::Sky {
                elevation_deg,
                azimuth_deg,
                ..
            } => format!(
                "Sun elevation {}, azimuth {}",
                degrees(elevation_deg),
                degrees(azimuth_deg)
            ),
            Self::Picture { rotation_deg } => format!("Rotation {}", degrees(rotation_deg)),
        }
    }

    /// The name of an edit that turns it.
    pub fn edit_name(self) -> &'static str {
        match self {
            Self::Sky { .. } => "move the sun",
            Self::Picture { .. } => "turn the environment",
        }
    }
}

fn rounded(degrees: f64) -> f64 {
    // Adding 0 turns −0 into 0.
    (degrees * STEPS).round() / STEPS + 0.0
}

/// The angle rounded and in (−180, 180].
fn wrapped(degrees: f64) -> f64 {
    let angle = rounded(degrees.rem_euclid(360.0));
    if angle > 180.0 {
        rounded(angle - 360.0)
    } else {
        angle
    }
}
