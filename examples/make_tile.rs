//! Draws `assets/scenes/tile.png`, a glazed tile with a rosette, for `patterns.toml`:
//!
//! ```sh
//! cargo run --release --example make_tile assets/scenes/tile.png
//! ```
//!
//! The tile repeats seamlessly.

use glimray::image::Image;
use glimray::output;
use std::error::Error;
use std::f32::consts::TAU;

/// Texels along each side, and samples along each side of a texel.
const SIZE: u32 = 128;
const SAMPLES: u32 = 6;

const GLAZE: [f32; 3] = [0.86, 0.84, 0.77];
const COBALT: [f32; 3] = [0.012, 0.055, 0.26];
const SKY: [f32; 3] = [0.16, 0.36, 0.62];
const OCHRE: [f32; 3] = [0.72, 0.36, 0.055];

fn main() -> Result<(), Box<dyn Error>> {
    let path = std::env::args().nth(1).ok_or("name the picture to write")?;
    let mut tile = Image::new(SIZE, SIZE);
    for (i, pixel) in tile.pixels.iter_mut().enumerate() {
        *pixel = texel(i as u32 % SIZE, i as u32 / SIZE).map(srgb);
    }
    output::save(path, &tile)?;
    Ok(())
}

/// The mean of the colours in one texel.
fn texel(x: u32, y: u32) -> [f32; 4] {
    let mut mean = [0.0, 0.0, 0.0, 1.0];
    for i in 0..SAMPLES * SAMPLES {
        let within = |texel: u32, i: u32| {
            (texel as f32 + (i as f32 + 0.5) / SAMPLES as f32) / SIZE as f32 * 2.0 - 1.0
        };
        let color = color(within(x, i % SAMPLES), within(y, i / SAMPLES));
        for (sum, channel) in mean.iter_mut().zip(color) {
            *sum += channel / (SAMPLES * SAMPLES) as f32;
        }
    }
    mean
}

/// The colour at a point of the square from -1 to 1.
fn color(x: f32, y: f32) -> [f32; 3] {
    let (radius, angle) = (x.hypot(y), y.atan2(x));
    // Eight petals, and the ring that they grow out of.
    let petal = (4.0 * angle).cos().abs();
    let corner = (1.0 - x.abs()).hypot(1.0 - y.abs());
    let joint = (1.0 - x.abs()).max(1.0 - y.abs()) < 0.035;
    let edge = 1.0 - x.abs().max(y.abs());
    match () {
        () if radius < 0.1 => OCHRE,
        () if radius < 0.145 => COBALT,
        () if radius < 0.2 + 0.42 * petal => {
            let vein = (8.0 * angle).rem_euclid(TAU) - TAU / 2.0;
            let is_rim = radius > 0.14 + 0.42 * petal;
            if is_rim || vein.abs() > TAU / 2.0 - 0.16 / radius {
                COBALT
            } else {
                SKY
            }
        }
        () if (0.7..0.735).contains(&radius) => COBALT,
        () if joint || corner < 0.16 => OCHRE,
        () if (0.16..0.2).contains(&corner) || (0.42..0.47).contains(&corner) => COBALT,
        () if (0.2..0.42).contains(&corner) => SKY,
        () if (0.02..0.05).contains(&edge) => COBALT,
        () => GLAZE,
    }
}

/// IEC 61966-2-1.
fn srgb(linear: f32) -> f32 {
    if linear <= 0.003_130_8 {
        12.92 * linear
    } else {
        1.055 * linear.powf(1.0 / 2.4) - 0.055
    }
}
