//! Difference metrics of two pictures of equal size.
//!
//! RMSE and PSNR are computed over all channels of all pixels, with a peak of 1. FLIP is the mean of
//! Andersson et al., "FLIP: A Difference Evaluator for Alternating Images" (2020).

use glimray_app::picture_file::Picture;

/// Largest picture for FLIP, in pixels; larger ones would need gigabytes of memory.
pub const MAX_FLIP_PIXELS: usize = 1 << 24;

/// Difference metrics. One level is 1/255.
pub struct Figures {
    /// Root mean square difference.
    pub rmse: f64,
    /// The mean, 0 (equal) to 1; absent for very large pictures, and without the feature `flip`.
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
            flip: flip(a, b),
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

#[cfg(not(feature = "flip"))]
fn flip(_: &Picture, _: &Picture) -> Option<f32> {
    None
}

#[cfg(feature = "flip")]
fn flip(a: &Picture, b: &Picture) -> Option<f32> {
    if a.image.pixels.len() > MAX_FLIP_PIXELS {
        return None;
    }
    let image = |picture: &Picture| {
        let [width, height] = picture.size();
        nv_flip::FlipImageRgb8::with_data(width, height, &display_levels(picture))
    };
    let error = nv_flip::flip(image(a), image(b), nv_flip::DEFAULT_PIXELS_PER_DEGREE);
    Some(nv_flip::FlipPool::from_image(&error).mean())
}

/// The picture as 8-bit sRGB.
#[cfg(feature = "flip")]
fn display_levels(picture: &Picture) -> Vec<u8> {
    let pixels = picture.image.pixels.iter();
    let channels = pixels.flat_map(|&[r, g, b, _]| [r, g, b]);
    channels
        .map(|value| value.clamp(0.0, 1.0))
        .map(|value| if picture.is_float { srgb(value) } else { value })
        .map(|value| (value * 255.0).round() as u8)
        .collect()
}

/// The sRGB transfer function of IEC 61966-2-1.
#[cfg(feature = "flip")]
fn srgb(linear: f32) -> f32 {
    if linear <= 0.003_130_8 {
        linear * 12.92
    } else {
        1.055 * linear.powf(1.0 / 2.4) - 0.055
    }
}
