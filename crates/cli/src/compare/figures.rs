//! Difference metrics of two pictures of equal size.
//!
//! RMSE and PSNR are computed over all channels of all pixels, with a peak of 1.

use glimray_app::flip::Flip;
use glimray_app::picture_file::Picture;
use glimray_scene::srgb_from_linear;

/// Difference metrics. One level is 1/255.
pub struct Figures {
    /// Root mean square difference.
    pub rmse: f64,
    /// The mean of FLIP, 0 (equal) to 1; absent for very large pictures, and without the feature `flip`.
    pub flip: Option<f32>,
    /// Largest difference in any channel, in levels.
    pub max_levels: f64,
    /// Column and row of a pixel with the largest difference.
    pub max_at: [u32; 2],
    /// Percentage of pixels that differ by more than the tolerance in any channel.
    pub beyond_percent: f64,
}

impl Figures {
    /// Compares pictures of equal size. `tolerance` is the difference, in levels, that still counts as equal.
    pub fn new(a: &Picture, b: &Picture, tolerance: f64) -> Self {
        // Opacity is compared only if a picture has it.
        let channel_count = if a.has_alpha || b.has_alpha { 4 } else { 3 };
        let exact = a.is_float || b.is_float;
        let mut square_sum = 0.0;
        let mut beyond_count = 0_usize;
        let mut largest = (0.0, 0);
        for (index, (a, b)) in a.image.pixels.iter().zip(&b.image.pixels).enumerate() {
            let mut pixel_levels = 0.0_f64;
            for (&a, &b) in a.iter().zip(b).take(channel_count) {
                let levels = levels(a, b, exact);
                square_sum += (levels / 255.0).powi(2);
                pixel_levels = pixel_levels.max(levels);
            }
            beyond_count += usize::from(pixel_levels > tolerance);
            if pixel_levels > largest.0 {
                largest = (pixel_levels, index);
            }
        }

        let pixel_count = a.image.pixels.len().max(1);
        let width = a.image.width.max(1) as usize;
        Self {
            rmse: (square_sum / (pixel_count * channel_count) as f64).sqrt(),
            flip: Flip::new(a.size(), [a, b].map(display_levels)).map(|flip| flip.mean),
            max_levels: largest.0,
            max_at: [(largest.1 % width) as u32, (largest.1 / width) as u32],
            beyond_percent: 100.0 * beyond_count as f64 / pixel_count as f64,
        }
    }

    /// Peak signal-to-noise ratio in decibels; infinite for equal pictures.
    pub fn psnr_db(&self) -> f64 {
        -20.0 * self.rmse.log10()
    }
}

/// The difference of two channels in levels; infinite if just one of them is NaN.
fn levels(a: f32, b: f32, exact: bool) -> f64 {
    let levels = (f64::from(a) - f64::from(b)).abs() * 255.0;
    if levels.is_nan() {
        let alike = a == b || (a.is_nan() && b.is_nan());
        return if alike { 0.0 } else { f64::INFINITY };
    }
    // The levels of integer files carry rounding errors from f32.
    if exact {
        levels
    } else {
        (levels * 1e3).round() / 1e3
    }
}

/// The picture as 8-bit sRGB.
fn display_levels(picture: &Picture) -> Vec<u8> {
    let pixels = picture.image.pixels.iter();
    let channels = pixels.flat_map(|&[r, g, b, _]| [r, g, b]);
    channels
        .map(|value| value.clamp(0.0, 1.0))
        .map(|value| {
            if picture.is_float {
                srgb_from_linear(value)
            } else {
                value
            }
        })
        .map(|value| (value * 255.0).round() as u8)
        .collect()
}
