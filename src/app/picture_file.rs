//! Reads picture files with limits on size, because a file from elsewhere must not exhaust memory.

use crate::app::error::AppError;
use crate::image::Image;
use crate::output;
use ::image::{DynamicImage, ImageError, ImageReader, Limits};
use std::path::Path;

/// Largest width or height, in pixels.
const MAX_SIDE: u32 = 1 << 16;

/// Largest allocation for decoding, in bytes: enough for 8192×8192 pixels of four floats.
const MAX_BYTES: u64 = 3 << 29;

/// A decoded picture.
pub struct Picture {
    /// Values as stored; integers are scaled to 0..1.
    pub image: Image,
    /// Whether the file stores linear radiance as floats.
    pub is_float: bool,
    /// Whether the file stores opacity.
    pub has_alpha: bool,
}

impl Picture {
    /// Width and height in pixels.
    pub fn size(&self) -> [u32; 2] {
        [self.image.width, self.image.height]
    }
}

/// Reads the picture at `path`: PNG, JPEG, WebP, KTX2, OpenEXR or Radiance HDR, recognised by its first bytes.
///
/// # Errors
/// The file is missing, damaged, of another kind or too large.
pub fn read(path: &Path) -> Result<Picture, AppError> {
    let refused = |why: &str| {
        AppError::Refused(format!(
            "cannot read the picture ({}): {}. Give a PNG, JPEG, WebP, KTX2, OpenEXR or Radiance HDR file.",
            path.display(),
            why.trim_end_matches('.')
        ))
    };
    let decoded = decode(path).map_err(|error| match error {
        ImageError::IoError(error) => refused(&output::reason(&error)),
        error => refused(&error.to_string()),
    })?;
    let (width, height) = (decoded.width(), decoded.height());
    let color = decoded.color();
    let is_float = matches!(
        decoded,
        DynamicImage::ImageRgb32F(_) | DynamicImage::ImageRgba32F(_)
    );
    let pixels = decoded.into_rgba32f().pixels().map(|p| p.0).collect();
    Ok(Picture {
        image: Image {
            width,
            height,
            pixels,
        },
        is_float,
        has_alpha: color.has_alpha(),
    })
}

fn decode(path: &Path) -> Result<DynamicImage, ImageError> {
    let mut reader = ImageReader::open(path)?.with_guessed_format()?;
    let mut limits = Limits::default();
    limits.max_image_width = Some(MAX_SIDE);
    limits.max_image_height = Some(MAX_SIDE);
    limits.max_alloc = Some(MAX_BYTES);
    reader.limits(limits);
    reader.decode()
}
