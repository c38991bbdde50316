//! The statistics of a pixel, and what they say about its noise.

#[cfg(doc)]
use crate::render::layers;
use crate::render::luminance::luminance;
use bytemuck::Zeroable;

/// The statistics of a pixel.
#[derive(Clone, Copy, Debug, Default, Zeroable)]
pub(super) struct PixelStatistics {
    pub sum: [f64; 3],
    pub weight: f64,
    /// Sum of squared luminance.
    pub squares: f64,
    pub count: u32,
}

impl PixelStatistics {
    /// Adds samples: the row of their radiance, the sum of their squares, and their number.
    pub fn add(&mut self, [r, g, b, weight]: [f64; 4], squares: f64, count: u32) {
        for (sum, more) in self.sum.iter_mut().zip([r, g, b]) {
            *sum += more;
        }
        self.weight += weight;
        self.squares += squares;
        self.count += count;
    }

    /// The factor from sum to mean. Weights of both signs may cancel; the remainder is then meaningless, as in
    /// the shader that develops (lib/filter.wesl).
    pub fn scale(&self) -> f64 {
        if self.weight.abs() > 0.5 {
            1.0 / self.weight
        } else {
            0.0
        }
    }

    /// The mean luminance in front of a white picture, and its standard error. `opacity` are the rows of
    /// [`layers::OPACITY`], or none if nothing is behind.
    fn luminance(&self, opacity: &[[f64; 4]]) -> (f64, f64) {
        let count = f64::from(self.count);
        let [white, white_squares] = match opacity {
            [first, second] => [first[2], second[2]].map(|sum| sum * self.scale()),
            _ => [0.0; 2],
        };
        let mean = (luminance(self.sum) * self.scale() + white).max(0.0);
        let squares = self.squares / count + white_squares;
        let variance = (squares - mean * mean).max(0.0) / (count - 1.0).max(1.0);
        (mean, variance.sqrt())
    }
}

/// How noise is measured.
#[derive(Clone, Copy, Debug)]
pub(super) struct Measure {
    /// The threshold.
    pub noise: f64,
    /// The brightness of a luminance.
    pub brightness: fn(f64) -> f64,
}

/// What the samples of a pixel say.
#[derive(Clone, Copy, Debug, Zeroable)]
pub(super) struct Estimate {
    pub brightness: f64,
    pub count: u32,
    /// Whether one standard error changes the brightness by more than the threshold.
    pub is_noisy: bool,
}

impl Measure {
    /// What the statistics of a pixel say, with its rows of [`layers::OPACITY`] if it has them.
    pub fn estimate(self, statistics: &PixelStatistics, opacity: &[[f64; 4]]) -> Estimate {
        let (mean, error) = statistics.luminance(opacity);
        let brightness = (self.brightness)(mean);
        let change = (self.brightness)(mean + error) - brightness;
        Estimate {
            brightness,
            count: statistics.count,
            is_noisy: change > self.noise,
        }
    }
}

/// Brightness for pictures of any range: as the square root of a small luminance, which is close to what the eye sees,
/// and 1 for an infinite one, since tone curves show all highlights as white.
pub(super) fn compressed(luminance: f64) -> f64 {
    (luminance / (1.0 + luminance)).sqrt()
}
