//! A frame of 8 bits per channel, from a file or from a developed image.

use crate::output::OutputError;
use crate::output::encode::level;
use ::image::{DynamicImage, ImageReader};
use glimray_scene::image::Image;
use std::path::Path;

/// An image of 8 bits per channel, sRGB-encoded.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Picture8 {
    /// In pixels.
    pub width: u32,
    /// In pixels.
    pub height: u32,
    /// Red, green and blue, row by row from the top left; `width * height` of them.
    pub pixels: Vec<[u8; 3]>,
}

impl From<&Image> for Picture8 {
    /// Converts display values in [0, 1], like PNG files, and drops opacity.
    fn from(image: &Image) -> Self {
        let levels = |&[r, g, b, _]: &[f32; 4]| [r, g, b].map(level);
        Self {
            width: image.width,
            height: image.height,
            pixels: image.pixels.iter().map(levels).collect(),
        }
    }
}

/// Reads a frame from a PNG, JPEG, OpenEXR or Radiance HDR file. Linear light of the latter two is
/// clamped to [0, 1] and sRGB-encoded; opacity is dropped.
///
/// # Errors
/// The file cannot be opened, has another format, is damaged, or is unreasonably large.
pub fn read_frame(path: &Path) -> Result<Picture8, OutputError> {
    let unreadable = |reason: String| OutputError::UnreadableFrame {
        path: path.into(),
        reason,
    };
    let picture = ImageReader::open(path)
        .and_then(ImageReader::with_guessed_format)
        .map_err(|error| unreadable(crate::output::reason(&error)))?
        .decode()
        .map_err(|error| unreadable(error.to_string()))?;
    let (width, height) = (picture.width(), picture.height());
    let pixels = match picture {
        DynamicImage::ImageRgb32F(_) | DynamicImage::ImageRgba32F(_) => picture
            .into_rgb32f()
            .pixels()
            .map(|pixel| pixel.0.map(|linear| level(srgb_from_linear(linear))))
            .collect(),
        _ => {
            let samples = picture.into_rgb8().into_raw();
            let (pixels, _) = samples.as_chunks();
            pixels.to_vec()
        }
    };
    Ok(Picture8 {
        width,
        height,
        pixels,
    })
}

/// IEC 61966-2-1.
fn srgb_from_linear(linear: f32) -> f32 {
    if linear <= 0.003_130_8 {
        linear * 12.92
    } else {
        1.055 * linear.powf(1.0 / 2.4) - 0.055
    }
}
