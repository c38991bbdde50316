//! The denoiser on a noisy picture: the whole step, and its passes on the adapter.

use super::figure::Figure;
use super::random::Random;
use glimray_app::error::AppError;
use glimray_render::gpu::Gpu;
use glimray_render::{Features, PixelFeatures};
use glimray_scene::image::Image;
use serde::Serialize;
use std::time::Instant;

pub const NAME: &str = "denoiser";
const SIZE: (u32, u32) = (1920, 1080);
const QUICK_SIZE: (u32, u32) = (480, 270);
/// The picture shows spheres of this many pixels across.
const ACROSS: u32 = 120;

/// The picture with its features, and the measurements.
pub struct Denoiser {
    picture: Image,
    features: Features,
    seconds: Vec<f64>,
    /// Empty if the adapter has no timestamps.
    pass_seconds: Vec<f64>,
}

/// The figures of all repeats.
#[derive(Debug, Serialize)]
pub struct Row {
    name: &'static str,
    width: u32,
    height: u32,
    /// From the picture and its features on the host to the denoised picture there.
    denoise_seconds: Figure,
    /// The passes alone, by the adapter's timestamps.
    pass_seconds: Option<Figure>,
}

impl Denoiser {
    /// Makes the picture, and denoises it once so that the kernels are compiled.
    ///
    /// # Errors
    /// The device failed.
    pub fn new(gpu: &Gpu, is_quick: bool) -> Result<Self, AppError> {
        let (width, height) = if is_quick { QUICK_SIZE } else { SIZE };
        let mut random = Random::new(7);
        let places = (0..height).flat_map(|y| (0..width).map(move |x| (x, y)));
        let pixels: Vec<_> = places.map(|(x, y)| pixel(x, y, &mut random)).collect();
        let features = Features {
            width,
            height,
            pixels,
        };
        let picture = features.picture();
        glimray_render::denoise(&picture, gpu, &features)?;
        Ok(Self {
            picture,
            features,
            seconds: Vec::new(),
            pass_seconds: Vec::new(),
        })
    }

    /// Measures everything once more.
    ///
    /// # Errors
    /// The device failed.
    pub fn run(&mut self, gpu: &Gpu) -> Result<(), AppError> {
        let started = Instant::now();
        let denoised = glimray_render::denoise(&self.picture, gpu, &self.features)?;
        self.seconds.push(started.elapsed().as_secs_f64());
        self.pass_seconds.extend(denoised.pass_seconds);
        Ok(())
    }

    /// The figures of all repeats.
    pub fn row(&self) -> Row {
        let figure = |values: &[f64]| Figure::of(values.iter().copied());
        Row {
            name: NAME,
            width: self.features.width,
            height: self.features.height,
            denoise_seconds: figure(&self.seconds),
            pass_seconds: (!self.pass_seconds.is_empty()).then(|| figure(&self.pass_seconds)),
        }
    }
}

/// A sample of a matte sphere under a lamp whose shadow rays are blocked half of the time.
fn pixel(x: u32, y: u32, random: &mut Random) -> PixelFeatures {
    let [u, v] = [x, y].map(|place| 2.0 * ((place % ACROSS) as f32 + 0.5) / ACROSS as f32 - 1.0);
    let height = (1.0 - u * u - v * v).max(0.0).sqrt();
    let normal = match height > 0.0 {
        true => [u, -v, height],
        false => [0.0, 0.0, 1.0],
    };
    let light = if random.unit() < 0.5 { 0.0 } else { 2.0 };
    let cosine = (0.4 * normal[0] + 0.6 * normal[1] + 0.69 * normal[2]).max(0.0);
    let albedo = [0.2, 0.5, 0.8].map(|part| part + 0.1 * u);
    PixelFeatures {
        radiance: albedo.map(|part| part * cosine * light),
        albedo,
        normal,
        depth: 5.0 - height,
        variance: 1.0,
        samples: 4.0,
        ..PixelFeatures::default()
    }
}

impl Row {
    /// A line for people.
    pub fn text(&self) -> String {
        let passes = match &self.pass_seconds {
            Some(seconds) => format!(", passes on the adapter {seconds:.4} s"),
            None => String::new(),
        };
        format!(
            "{:<20} {}×{}: {:.4} s{passes}\n",
            self.name, self.width, self.height, self.denoise_seconds
        )
    }
}
