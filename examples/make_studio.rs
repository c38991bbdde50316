//! Draws `assets/scenes/studio.hdr`, the light of a photographer's studio as an equirectangular picture, for
//! `--environment`:
//!
//! ```sh
//! cargo run --release --example make_studio assets/scenes/studio.hdr
//! ```
//!
//! A large warm soft box at the left, a tall cool strip at the right behind, a ring of light above, and dark walls.

use glimray::image::Image;
use glimray::output;
use std::error::Error;
use std::f32::consts::{PI, TAU};

/// Texels across; there are half as many down.
const WIDTH: u32 = 128;

/// A lamp: azimuth and elevation of its centre in radians, half its extent along both, and its radiance.
type Lamp = ([f32; 2], [f32; 2], [f32; 3]);

/// Azimuths are from −z towards +x.
const LAMPS: [Lamp; 3] = [
    ([-2.2, 0.65], [0.55, 0.4], [13.0, 11.3, 9.4]),
    ([1.1, 0.35], [0.13, 0.75], [6.0, 7.6, 10.0]),
    ([2.75, 0.25], [0.35, 0.3], [1.6, 1.7, 2.0]),
];

fn main() -> Result<(), Box<dyn Error>> {
    let path = std::env::args().nth(1).ok_or("name the picture to write")?;
    let mut studio = Image::new(WIDTH, WIDTH / 2);
    for (i, pixel) in (0..).zip(&mut studio.pixels) {
        let u = ((i % WIDTH) as f32 + 0.5) / WIDTH as f32;
        let v = ((i / WIDTH) as f32 + 0.5) / (WIDTH / 2) as f32;
        let [r, g, b] = radiance((u - 0.5) * TAU, (0.5 - v) * PI);
        *pixel = [r, g, b, 1.0];
    }
    output::save(path, &studio)?;
    Ok(())
}

/// The radiance from an azimuth and an elevation.
fn radiance(azimuth: f32, elevation: f32) -> [f32; 3] {
    // Walls that are lighter towards the floor's edge, a dark floor and a grey ceiling.
    let wall = 0.07 + 0.10 * (-8.0 * elevation * elevation).exp();
    let floor = if elevation < -0.05 { 0.6 } else { 1.0 };
    let mut sum = [0.92, 0.96, 1.05].map(|tint| tint * wall * floor);
    for ([at, up], [across, along], light) in LAMPS {
        let away = (azimuth - at + PI).rem_euclid(TAU) - PI;
        let inside = soft(away / across) * soft((elevation - up) / along);
        for (sum, light) in sum.iter_mut().zip(light) {
            *sum += inside * light;
        }
    }
    let ring = soft((elevation - 1.2) / 0.12);
    sum.map(|channel| channel + 1.4 * ring)
}

/// 1 within −1 to 1, with a soft edge.
fn soft(x: f32) -> f32 {
    ((1.15 - x.abs()) / 0.3).clamp(0.0, 1.0)
}
