//! Errors of an image by its pixels, relative to another one.

use super::difference::{Pixels, Placed, pairs};
use super::{Image, ScreenImage};

/// Keeps errors relative to black finite, in the unit of the images.
pub const RELATIVE_EPSILON: f64 = 0.01;

/// One error of each pixel.
#[derive(Clone, Debug, PartialEq)]
pub struct Errors {
    /// In pixels.
    pub width: u32,
    /// In pixels.
    pub height: u32,
    /// From 0, row by row from the top left; `None` where one of the images has no opaque pixel, or a value is not finite.
    pub errors: Vec<Option<f32>>,
}

impl Errors {
    /// The mean over the colour channels of |a - b| / (|b| + ε): how far the first image is from the second, of linear values.
    /// ε is [`RELATIVE_EPSILON`].
    pub fn relative(first: Placed<Image>, second: Placed<Image>) -> Self {
        Self::of(first, second, |a, b| {
            (a - b).abs() / (b.abs() + RELATIVE_EPSILON)
        })
    }

    /// The mean over the colour channels of (a - b)² / (b² + ε). Its mean over the pixels is known as relMSE: Rousselle et al.,
    /// "Adaptive Sampling and Reconstruction using Greedy Error Minimization" (2011). ε is [`RELATIVE_EPSILON`].
    pub fn relative_squared(first: Placed<Image>, second: Placed<Image>) -> Self {
        Self::of(first, second, |a, b| {
            (a - b).powi(2) / (b * b + RELATIVE_EPSILON)
        })
    }

    fn of(first: Placed<Image>, second: Placed<Image>, error: impl Fn(f64, f64) -> f64) -> Self {
        let [width, height] = first.image.size();
        let mean = |[first, second]: [[f32; 3]; 2]| {
            let channels = first.iter().zip(&second);
            let errors = channels.map(|(a, b)| error(f64::from(*a), f64::from(*b)));
            (errors.sum::<f64>() / 3.0) as f32
        };
        let pairs = pairs(first, second).into_iter();
        Self {
            width,
            height,
            errors: (pairs.map(|pair| pair.map(mean).filter(|error| error.is_finite()))).collect(),
        }
    }

    /// The mean of the errors; 0 without any.
    pub fn mean(&self) -> f64 {
        self.average(|error| error)
    }

    /// The root of the mean square of the errors; 0 without any.
    pub fn rms(&self) -> f64 {
        self.average(|error| error * error).sqrt()
    }

    fn average(&self, of: fn(f64) -> f64) -> f64 {
        let (mut sum, mut count) = (0.0, 0_u64);
        for error in self.errors.iter().flatten() {
            sum += of((*error).into());
            count += 1;
        }
        sum / count.max(1) as f64
    }

    /// An opaque image of the errors, each with the colour, in levels of 255, that `color` gives it. Black where there is none.
    pub fn painted(&self, color: impl Fn(f32) -> [f32; 3]) -> ScreenImage {
        let paint = |error: &Option<f32>| {
            let [r, g, b] = error.map_or([0; 3], |error| {
                color(error).map(|level| level.round() as u8)
            });
            [r, g, b, u8::MAX]
        };
        ScreenImage {
            width: self.width,
            height: self.height,
            pixels: self.errors.iter().map(paint).collect(),
        }
    }
}
