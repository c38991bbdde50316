//! Built-in environments, in one table. All are computed, so scenes store their names alone.
//!
//! Environments without a sun are grey, and their mean radiance over all directions is 1: in its mean light, white diffuse
//! paper has a radiance of 1. They are as dark or bright as they are by their shape alone.

use super::{Origin, Picture, sky};
use crate::threads;
use glam::{DVec3, Vec3};
use std::f64::consts::{PI, TAU};

/// Size of the pictures in texels.
const WIDTH: u32 = 512;
const HEIGHT: u32 = 256;

/// A row of the table of environments.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BuiltInEntry {
    /// The name in scene files and on the command line. It never changes.
    pub name: &'static str,
    /// The name in menus.
    pub title: &'static str,
    /// One line without a full stop.
    pub description: &'static str,
    /// Elevation and azimuth of its sun in degrees, as in [`sky::picture`]; `None` without a sun.
    pub sun_deg: Option<[f64; 2]>,
}

macro_rules! environments {
    ($($(#[$attribute:meta])* $variant:ident { $($field:ident: $value:expr,)* })*) => {
        /// A built-in environment.
        #[derive(Clone, Copy, Debug, PartialEq, Eq)]
        pub enum BuiltIn {
            $($(#[$attribute])* $variant,)*
        }

        impl BuiltIn {
            /// All, in the order of the table.
            pub const ALL: &[Self] = &[$(Self::$variant,)*];

            /// The environment's row of the table.
            pub const fn entry(self) -> &'static BuiltInEntry {
                match self { $(Self::$variant => &BuiltInEntry { $($field: $value,)* },)* }
            }
        }
    };
}

environments! {
    /// The clear sky of [`sky`] with the sun at its usual place.
    Sky {
        name: "sky",
        title: "Sky",
        description: "A clear sky with a sun that can be moved",
        sun_deg: Some([sky::SUN_ELEVATION_DEG, sky::SUN_AZIMUTH_DEG]),
    }
    /// That sky with a high sun.
    Noon {
        name: "noon",
        title: "Clear noon",
        description: "The clear sky with the sun 70° above the horizon",
        sun_deg: Some([70.0, sky::SUN_AZIMUTH_DEG]),
    }
    /// That sky with a sun just above the horizon.
    Sunset {
        name: "sunset",
        title: "Sunset",
        description: "The clear sky with the sun 4° above the horizon",
        sun_deg: Some([4.0, sky::SUN_AZIMUTH_DEG]),
    }
    /// The overcast sky of the CIE: the zenith is three times as bright as the horizon.
    Overcast {
        name: "overcast",
        title: "Overcast",
        description: "The overcast sky of the CIE, three times as bright at the zenith as at the horizon",
        sun_deg: None,
    }
    /// A dim room with a large and a small softbox.
    Studio {
        name: "studio",
        title: "Studio",
        description: "A dim room with a large softbox at the left behind the camera and a weaker one at the right",
        sun_deg: None,
    }
    /// A dim room with a ring light behind the camera.
    Ring {
        name: "ring",
        title: "Ring light",
        description: "A dim room with a ring light round the camera of a model",
        sun_deg: None,
    }
    /// Equal radiance from all directions.
    Furnace {
        name: "furnace",
        title: "Furnace",
        description: "A radiance of 1 from everywhere, in which a white diffuse body vanishes",
        sun_deg: None,
    }
}

impl BuiltIn {
    /// The environment with this name.
    pub fn named(name: &str) -> Option<Self> {
        let mut all = Self::ALL.iter().copied();
        all.find(|environment| environment.entry().name == name)
    }

    /// The environment that a picture in the background is; `None` for others, and for a sky with its sun elsewhere.
    pub fn of(picture: &Picture) -> Option<Self> {
        let mut all = Self::ALL.iter().copied();
        all.find(|environment| environment.origin() == picture.origin)
    }

    fn origin(self) -> Origin {
        match self.entry().sun_deg {
            Some(sun) => {
                let [elevation, azimuth] = sun.map(f64::to_radians);
                Origin::Sky { elevation, azimuth }
            }
            None => Origin::BuiltIn(self),
        }
    }

    /// The equirectangular picture of linear Rec. 709 radiance: its centre lies in the direction −Z, +X to the right of it.
    /// A sun is added by the background.
    pub fn picture(self) -> Picture {
        match self.origin() {
            Origin::Sky { elevation, azimuth } => sky::picture(elevation, azimuth),
            origin => Picture {
                origin,
                ..self.painted()
            },
        }
    }

    fn painted(self) -> Picture {
        let values = threads::collect((WIDTH * HEIGHT) as usize, |index| {
            let (x, y) = (index as u32 % WIDTH, index as u32 / WIDTH);
            let elevation = PI * (0.5 - (f64::from(y) + 0.5) / f64::from(HEIGHT));
            let azimuth = TAU * ((f64::from(x) + 0.5) / f64::from(WIDTH) - 0.5);
            self.relative_radiance(sky::towards_sun(elevation, azimuth))
        });
        let edge = |y: u32| (PI * (0.5 - f64::from(y) / f64::from(HEIGHT))).sin();
        let rows = (0..HEIGHT).zip(values.chunks(WIDTH as usize));
        let sum: f64 = rows
            .map(|(y, row)| 0.5 * (edge(y) - edge(y + 1)) * row.iter().sum::<f64>())
            .sum();
        let mean = sum / f64::from(WIDTH);
        let greys = values
            .iter()
            .map(|value| Vec3::splat((value / mean) as f32));
        Picture::opaque(WIDTH, HEIGHT, greys)
    }

    /// The radiance from a direction of unit length, up to a factor.
    fn relative_radiance(self, towards: DVec3) -> f64 {
        match self {
            Self::Overcast => overcast(towards),
            Self::Studio => {
                0.08 + 0.07 * (0.5 + 0.5 * towards.y)
                    + 6.0 * softbox(towards, [38.0, -128.0], [26.0, 20.0])
                    + 2.0 * softbox(towards, [22.0, 112.0], [11.0, 22.0])
            }
            Self::Ring => {
                let from_axis =
                    towards.angle_between(sky::towards_sun(RING_DEG[0].to_radians(), PI));
                let [inner, outer] = [RING_DEG[1], RING_DEG[2]].map(f64::to_radians);
                let soft = 1f64.to_radians();
                0.15 + 12.0 * step(from_axis - inner, soft) * step(outer - from_axis, soft)
            }
            // The others have a sun.
            Self::Furnace | Self::Sky | Self::Noon | Self::Sunset => 1.0,
        }
    }
}

/// Elevation of the middle of the ring light, and its inner and outer radius, in degrees.
const RING_DEG: [f64; 3] = [10.0, 16.0, 26.0];

/// The sky of CIE S 011 of type 16, over ground as bright as that of [`sky`].
fn overcast(towards: DVec3) -> f64 {
    match towards.y >= 0.0 {
        true => (1.0 + 2.0 * towards.y) / 3.0,
        // The irradiance of a level surface is 7 π / 9 of the radiance of the zenith.
        false => sky::GROUND_ALBEDO * 7.0 / 9.0,
    }
}

/// The share of a soft-edged rectangle that faces the origin: its elevation and azimuth, and half its width and height as
/// angles, in degrees.
fn softbox(towards: DVec3, place_deg: [f64; 2], half_deg: [f64; 2]) -> f64 {
    let [elevation, azimuth] = place_deg.map(f64::to_radians);
    let ahead = sky::towards_sun(elevation, azimuth);
    let right = ahead.cross(DVec3::Y).normalize();
    let depth = towards.dot(ahead);
    if depth <= 0.0 {
        return 0.0;
    }
    let [width, height] = half_deg.map(|degrees| degrees.to_radians().tan());
    let u = towards.dot(right) / depth;
    let v = towards.dot(right.cross(ahead)) / depth;
    step(width - u.abs(), 0.03) * step(height - v.abs(), 0.03)
}

/// A smooth step from 0 below `-soft` to 1 above `soft`.
fn step(value: f64, soft: f64) -> f64 {
    let share = (0.5 + 0.5 * value / soft).clamp(0.0, 1.0);
    share * share * (3.0 - 2.0 * share)
}
