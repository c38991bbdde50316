//! Luminance in false colours: one for each stop around middle grey, as on a film set.

use glimray_scene::LUMINANCE;
use glimray_scene::image::{Image, ScreenImage};

/// Middle grey: the luminance at 0 stops.
pub const MIDDLE_GREY: f64 = 0.18;

/// The stops from middle grey of the first and of the last colour, which are also those of everything beyond.
pub const ENDS: [i32; 2] = [-6, 6];

/// The colours of the stops, sRGB: cold ones below middle grey, which is grey, and warm ones above it.
pub const COLORS: [[u8; 3]; 13] = [
    [20, 8, 40],
    [56, 20, 110],
    [44, 50, 180],
    [24, 104, 214],
    [20, 160, 196],
    [40, 172, 112],
    [128, 128, 128],
    [150, 196, 60],
    [226, 212, 50],
    [246, 164, 40],
    [240, 104, 40],
    [214, 36, 48],
    [255, 255, 255],
];

/// The nearest whole stop from middle grey, within [`ENDS`], of a linear colour. A colour without light has the first.
pub fn stop(color: [f32; 3]) -> i32 {
    let luminance = LUMINANCE.dot(glam::DVec3::from(color.map(f64::from)));
    let [first, last] = ENDS.map(f64::from);
    // The logarithm of 0 is below all others.
    (luminance.max(0.0) / MIDDLE_GREY)
        .log2()
        .clamp(first, last)
        .round() as i32
}

/// A picture of linear radiance, after the exposure, in false colours. Pixels keep their opacity.
pub fn picture(radiance: &Image) -> ScreenImage {
    let painted = |&[r, g, b, opacity]: &[f32; 4]| {
        let index = usize::try_from(stop([r, g, b]) - ENDS[0]).unwrap_or_default();
        let opacity = opacity.clamp(0.0, 1.0);
        let [r, g, b] = COLORS[index].map(|level| (f32::from(level) * opacity).round() as u8);
        [r, g, b, (opacity * 255.0).round() as u8]
    };
    ScreenImage {
        width: radiance.width,
        height: radiance.height,
        pixels: radiance.pixels.iter().map(painted).collect(),
    }
}
