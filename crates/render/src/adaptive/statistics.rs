//! The statistics of a pixel, and what they say about its noise.

#[cfg(doc)]
use crate::layers;
use crate::luminance::luminance;
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
    /// [`layers::OPACITY`] and [`layers::OPACITY_SQUARES`], or none if the film has no opacity.
    fn mean_and_error(&self, opacity: &[[f64; 4]]) -> (f64, f64) {
        let behind = match <[[f64; 4]; 4]>::try_from(opacity) {
            Ok(rows) => Behind::new(rows.map(|row| row.map(|sum| sum * self.scale()))),
            Err(_) => Behind::default(),
        };
        let count = f64::from(self.count);
        let rest = (count - 1.0).max(1.0);
        let mean = (luminance(self.sum) * self.scale() + behind.white).max(0.0);
        let squares = self.squares / count + behind.squares;
        let of_samples = (squares - mean * mean).max(0.0) / rest;
        let of_light = ((behind.variance / rest).sqrt() - behind.excess).max(0.0);
        (mean, (of_samples + of_light * of_light).sqrt())
    }
}

/// The contribution of a white picture behind to a pixel.
#[derive(Default)]
struct Behind {
    /// To the luminance, and to the mean of its squares, with the final ratio of the light on catchers.
    white: f64,
    squares: f64,
    /// The variance of what a sample adds by its own light on a catcher: a ratio of means has that of its linearisation.
    variance: f64,
    /// How far it is beyond the end of opacity at 0.
    excess: f64,
}

impl Behind {
    /// From the means of the four rows.
    fn new([seen, light, of_light, of_white]: [[f64; 4]; 4]) -> Self {
        let ([nothing, catchers, ..], [light, unshadowed, ..]) = (seen, light);
        let [light_squares, products, unshadowed_squares, _] = of_light;
        let [alone, mixed, catcher_squares, _] = of_white;
        let (whole, part) = match unshadowed > 0.0 {
            true => (light / unshadowed, catchers / unshadowed),
            false => (1.0, 0.0),
        };
        let ratio = whole.min(1.0);
        let rest = light_squares - 2.0 * ratio * products + ratio * ratio * unshadowed_squares;
        Self {
            white: nothing + ratio * catchers,
            squares: alone + ratio * (2.0 * mixed + ratio * catcher_squares),
            variance: rest.max(0.0) * part.powi(2),
            excess: (whole - ratio) * catchers,
        }
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

/// The estimate of a pixel from its samples.
#[derive(Clone, Copy, Debug, Zeroable)]
pub(super) struct Estimate {
    pub brightness: f64,
    pub count: u32,
    /// Whether one standard error changes the brightness by more than the threshold.
    pub is_noisy: bool,
}

impl Measure {
    /// The estimate of a pixel from its statistics. `opacity` is that of [`PixelStatistics::mean_and_error`].
    pub fn estimate(self, statistics: &PixelStatistics, opacity: &[[f64; 4]]) -> Estimate {
        let (mean, error) = statistics.mean_and_error(opacity);
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
