//! A clear sky with a sun, by the model of Preetham, Shirley and Smits (1999), A Practical Analytic Model for Daylight.
//!
//! The luminance and the chromaticity of the sky follow their fits of Perez's formula for a turbidity of 3. The light of
//! the sun is attenuated by the formulas of their appendix for molecules and aerosols, each channel at its own
//! wavelength; ozone, gases and water vapour, which take a few percent, are left out. The disc of the sun, of which a texel
//! would be a large part, is not in the picture: the background adds it. Below the horizon is even grey ground.

use super::{Origin, Picture};
use crate::threads;
use glam::{DMat3, DVec3, dvec3};
use std::f64::consts::{FRAC_PI_2, PI, TAU};

/// Size of the picture in texels.
const WIDTH: u32 = 1024;
const HEIGHT: u32 = 512;

/// Haze: 1 is pure air, 3 a clear day.
const TURBIDITY: f64 = 3.0;

/// The luminance of 1 in the picture, in cd/m².
pub const UNIT: f64 = 25_000.0;

/// Where the sun stands unless something else is asked for, in degrees: at the left behind the camera of a model.
pub const SUN_ELEVATION_DEG: f64 = 45.0;
/// See [`SUN_ELEVATION_DEG`].
pub const SUN_AZIMUTH_DEG: f64 = -135.0;

/// Angular radius of the sun's disc in radians: half of 0.53°.
pub const SUN_RADIUS: f64 = 0.265 * PI / 180.0;
/// The solid angle of the disc, in steradians; without the terms of its series beyond the first, which are 2e-6 of it.
pub const SUN_SOLID_ANGLE: f64 = PI * SUN_RADIUS * SUN_RADIUS;

/// Illuminance of the sun above the atmosphere, in lux.
const SUN_ILLUMINANCE: f64 = 128_000.0;

/// The wavelengths of red, green and blue for the attenuation of the sun, in µm.
const WAVELENGTHS: DVec3 = dvec3(0.61, 0.55, 0.465);

/// Albedo of the ground.
pub const GROUND_ALBEDO: f64 = 0.2;

/// The sun of a sky.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sun {
    /// The unit vector to its centre.
    pub direction: DVec3,
    /// The linear Rec. 709 radiance of its disc, in units of [`UNIT`] cd/m² of white.
    pub radiance: DVec3,
}

/// The sun that a picture has in the background; `None` if it is not one of [`picture`].
pub fn sun_of(picture: &Picture) -> Option<Sun> {
    match picture.origin {
        Origin::Sky { elevation, azimuth } => Some(Sun {
            direction: towards_sun(elevation, azimuth),
            // The cosine of directions in the disc is 1 within 1e-5.
            radiance: sun_irradiance(elevation) / SUN_SOLID_ANGLE,
        }),
        _ => None,
    }
}

/// The direction to the sun: `azimuth` is counted from −Z towards +X. Both are in radians.
pub fn towards_sun(elevation: f64, azimuth: f64) -> DVec3 {
    let (sine, cosine) = elevation.sin_cos();
    dvec3(cosine * azimuth.sin(), sine, -cosine * azimuth.cos())
}

/// The irradiance of a surface that faces the sun at this elevation in radians, 0 to π/2, in units of [`UNIT`]
/// lux.
pub fn sun_irradiance(elevation: f64) -> DVec3 {
    let zenith = FRAC_PI_2 - elevation;
    // Relative optical mass, for the angle in degrees.
    let mass = 1.0 / (zenith.cos() + 0.15 * (93.885 - zenith.to_degrees()).powf(-1.253));
    let haze = 0.04608 * TURBIDITY - 0.04586;
    let transmitted = WAVELENGTHS.to_array().map(|wavelength| {
        let molecules = 0.008735 * wavelength.powf(-4.08);
        let aerosols = haze * wavelength.powf(-1.3);
        (-(molecules + aerosols) * mass).exp()
    });
    SUN_ILLUMINANCE / UNIT * DVec3::from(transmitted)
}

/// An equirectangular picture of the sky for a sun at `elevation`, 0 to π/2, and `azimuth`, counted from −Z towards +X, in
/// radians, without the sun itself. Its values are linear Rec. 709 radiance in units of [`UNIT`] cd/m² of white.
pub fn picture(elevation: f64, azimuth: f64) -> Picture {
    let sky = Sky::new(elevation);
    let sun = towards_sun(elevation, azimuth);
    let towards = |index: usize| {
        let (x, y) = (index as u32 % WIDTH, index as u32 / WIDTH);
        direction(f64::from(x) + 0.5, f64::from(y) + 0.5)
    };
    let above = (WIDTH * HEIGHT / 2) as usize;
    let mut colors = threads::collect(above, |index| sky.radiance(towards(index), sun));
    let mut irradiance = sun.y.max(0.0) * sun_irradiance(elevation);
    for (y, row) in (0..).zip(colors.chunks(WIDTH as usize)) {
        let flux: DVec3 = row.iter().sum();
        irradiance += towards((y * WIDTH) as usize).y * solid_angle(y) * flux;
    }
    let ground = GROUND_ALBEDO / PI * irradiance;
    colors.resize(2 * above, ground);
    Picture {
        origin: Origin::Sky { elevation, azimuth },
        ..Picture::opaque(WIDTH, HEIGHT, colors.into_iter().map(DVec3::as_vec3))
    }
}

/// The direction of a place in the picture, in texels from its upper left corner.
fn direction(x: f64, y: f64) -> DVec3 {
    let elevation = PI * (0.5 - y / f64::from(HEIGHT));
    towards_sun(elevation, TAU * (x / f64::from(WIDTH) - 0.5))
}

/// The solid angle of a texel in row `y`.
fn solid_angle(y: u32) -> f64 {
    let height = |edge: u32| (PI * (0.5 - f64::from(edge) / f64::from(HEIGHT))).sin();
    TAU / f64::from(WIDTH) * (height(y) - height(y + 1))
}

/// Perez's formula with its coefficients for luminance and for x and y of the chromaticity.
struct Sky {
    coefficients: [[f64; 5]; 3],
    /// Luminance in units of [`UNIT`], x and y at the zenith, divided by the formula there.
    scale: [f64; 3],
}

impl Sky {
    /// The fits of Preetham et al. for a sun at this elevation in radians.
    fn new(elevation: f64) -> Self {
        let t = TURBIDITY;
        let coefficients = [
            [
                0.1787 * t - 1.4630,
                -0.3554 * t + 0.4275,
                -0.0227 * t + 5.3251,
                0.1206 * t - 2.5771,
                -0.0670 * t + 0.3703,
            ],
            [
                -0.0193 * t - 0.2592,
                -0.0665 * t + 0.0008,
                -0.0004 * t + 0.2125,
                -0.0641 * t - 0.8989,
                -0.0033 * t + 0.0452,
            ],
            [
                -0.0167 * t - 0.2608,
                -0.0950 * t + 0.0092,
                -0.0079 * t + 0.2102,
                -0.0441 * t - 1.6537,
                -0.0109 * t + 0.0529,
            ],
        ];
        let zenith = FRAC_PI_2 - elevation;
        let bend = (4.0 / 9.0 - t / 120.0) * (PI - 2.0 * zenith);
        let luminance = (4.0453 * t - 4.9710) * bend.tan() - 0.2155 * t + 2.4192;
        // Rows for t², t and 1; columns for the cube, the square, the zenith angle itself and 1.
        let fitted = |rows: [[f64; 4]; 3]| {
            let row = |[a, b, c, d]: [f64; 4]| ((a * zenith + b) * zenith + c) * zenith + d;
            (row(rows[0]) * t + row(rows[1])) * t + row(rows[2])
        };
        let x = fitted([
            [0.00166, -0.00375, 0.00209, 0.0],
            [-0.02903, 0.06377, -0.03202, 0.00394],
            [0.11693, -0.21196, 0.06052, 0.25886],
        ]);
        let y = fitted([
            [0.00275, -0.00610, 0.00317, 0.0],
            [-0.04214, 0.08970, -0.04153, 0.00516],
            [0.15346, -0.26756, 0.06670, 0.26688],
        ]);
        let at_zenith = [1000.0 * luminance.max(0.0) / UNIT, x, y];
        let scale = std::array::from_fn(|index| {
            at_zenith[index] / perez(&coefficients[index], 1.0, zenith)
        });
        Self {
            coefficients,
            scale,
        }
    }

    /// The linear Rec. 709 radiance from a direction above the horizon.
    fn radiance(&self, towards: DVec3, sun: DVec3) -> DVec3 {
        let from_sun = towards.angle_between(sun);
        let [luminance, x, y] = std::array::from_fn(|index| {
            self.scale[index] * perez(&self.coefficients[index], towards.y.max(1e-3), from_sun)
        });
        let xyz = luminance / y * dvec3(x, y, 1.0 - x - y);
        // IEC 61966-2-1.
        let rgb_from_xyz = DMat3::from_cols(
            dvec3(3.2406, -0.9689, 0.0557),
            dvec3(-1.5372, 1.8758, -0.2040),
            dvec3(-0.4986, 0.0415, 1.0570),
        );
        (rgb_from_xyz * xyz).max(DVec3::ZERO)
    }
}

/// Perez's formula for the cosine of the angle from the zenith, and the angle from the sun.
fn perez([a, b, c, d, e]: &[f64; 5], cosine: f64, from_sun: f64) -> f64 {
    let around_sun = 1.0 + c * (d * from_sun).exp() + e * from_sun.cos().powi(2);
    (1.0 + a * (b / cosine).exp()) * around_sun
}
