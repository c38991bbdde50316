//! Small copies of pictures.

use glimray_scene::image::ScreenImage;
use image::{RgbaImage, imageops};

/// A copy of at most this width and height, in pixels, with the proportions of the picture: each pixel is the mean of those in its
/// place. `None` without pixels.
pub fn small(picture: &ScreenImage, [most_wide, most_high]: [u32; 2]) -> Option<RgbaImage> {
    let (width, height) = (picture.width, picture.height);
    let whole = RgbaImage::from_raw(width, height, picture.pixels.as_flattened().to_vec())?;
    if width == 0 || height == 0 {
        return None;
    }
    let scale = (f64::from(most_wide) / f64::from(width))
        .min(f64::from(most_high) / f64::from(height))
        .min(1.0);
    let side = |length: u32| ((f64::from(length) * scale).round() as u32).max(1);
    Some(imageops::thumbnail(&whole, side(width), side(height)))
}
