//! Pictures for materials.

use image::{Rgba, RgbaImage};
use std::f32::consts::TAU;

/// A picture of so many columns and rows; `texel` gets the position from 0 to 1, v downwards, and returns values from 0
/// to 1.
pub fn picture([width, height]: [u32; 2], texel: impl Fn(f32, f32) -> [f32; 4]) -> RgbaImage {
    RgbaImage::from_fn(width, height, |x, y| {
        let at = |i: u32, size: u32| (i as f32 + 0.5) / size as f32;
        let values = texel(at(x, width), at(y, height));
        Rgba(values.map(|value| (value.clamp(0.0, 1.0) * 255.0).round() as u8))
    })
}

/// Waves of many directions and lengths that repeat over the picture, about from -1 to 1.
pub fn waves(u: f32, v: f32) -> f32 {
    let mut sum = 0.0;
    for i in 1..=6 {
        let i = i as f32;
        let (a, b) = ((i * 2.4).sin() * (2.0 + i), (i * 4.1).cos() * (2.0 + i));
        sum += (TAU * (a.round() * u + b.round() * v) + 1.7 * i).sin() / i;
    }
    sum / 2.0
}

/// Wood around the axis of a turned disc: grain along v, which runs across the disc.
pub fn wood() -> RgbaImage {
    picture([256; 2], |u, v| {
        let grain = (TAU * (22.0 * v + 0.3 * waves(u, v))).sin() * 0.5 + 0.5;
        let mix = |dark: f32, light: f32| dark + (light - dark) * grain.powf(0.6);
        [mix(0.33, 0.46), mix(0.19, 0.28), mix(0.1, 0.15), 1.0]
    })
}

/// A normal map of shallow dents.
pub fn dents() -> RgbaImage {
    normals([128; 2], |u, v| {
        0.012 * waves(3.0 * u, v) + 0.004 * waves(11.0 * u, 5.0 * v)
    })
}

/// The normal map of a height over u and v, which are 1 long.
pub fn normals(size: [u32; 2], height: impl Fn(f32, f32) -> f32) -> RgbaImage {
    picture(size, |u, v| {
        const STEP: f32 = 1.0 / 512.0;
        let slope = |ahead: f32, behind: f32| (ahead - behind) / (2.0 * STEP);
        let x = -slope(height(u + STEP, v), height(u - STEP, v));
        // v points down in the picture, but the bitangent up.
        let y = slope(height(u, v + STEP), height(u, v - STEP));
        let length = (x * x + y * y + 1.0).sqrt();
        let [x, y, z] = [x, y, 1.0].map(|c| 0.5 + 0.5 * c / length);
        [x, y, z, 1.0]
    })
}

/// A leaf from its stalk at the bottom to its tip at the top, with veins; the rest is transparent.
pub fn leaf() -> RgbaImage {
    picture([256; 2], |u, v| {
        let along = 1.0 - v;
        let side = (u - 0.5).abs() * 2.0;
        let width = (along.powf(0.55) * (1.0 - along).powf(0.8) * 1.75).min(1.0);
        let is_leaf = side < width.max(if along < 0.12 { 0.06 } else { 0.0 });
        let rib = (1.0 - side / 0.05).max(0.0);
        let vein = ((TAU * (9.0 * along - 2.2 * side)).sin() - 0.86).max(0.0) * 4.0;
        let light = (rib + vein).min(1.0) * 0.35 + 0.08 * waves(u, v);
        [
            0.16 + 0.5 * light,
            0.4 + 0.45 * light,
            0.1 + 0.2 * light,
            f32::from(is_leaf),
        ]
    })
}
