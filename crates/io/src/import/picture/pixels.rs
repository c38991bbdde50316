//! Image files that do not become part of a scene.

use super::opened::{Unfit, Values};
use super::opening;
use crate::import::error::{ImportError, fault};
use glam::Vec4;
use std::path::Path;

/// Limit of the number of texels: 16384×16384.
const MOST_TEXELS: u64 = 1 << 28;

/// The values of an image file.
#[derive(Clone, Debug, PartialEq)]
pub struct Pixels {
    /// In pixels.
    pub width: u32,
    /// In pixels.
    pub height: u32,
    /// Red, green, blue and alpha, row by row from the top left; colours are not multiplied by alpha, which is 1 if the
    /// file has none. Light in linear Rec. 709, also negative, infinite or NaN if the file has that; or codes from 0 to 1.
    pub values: Vec<[f32; 4]>,
    /// Whether the values are light: those of OpenEXR and Radiance HDR.
    pub is_light: bool,
    /// Whether the file has alpha.
    pub has_alpha: bool,
    /// Clauses whose subject is the file, on all that it says and the values do not follow.
    pub ignored: Vec<String>,
}

/// The pixels of the image in `bytes`, which errors show as `path`: PNG, JPEG, WebP, KTX2, Radiance HDR or OpenEXR.
///
/// # Errors
/// The image is damaged, of an unsupported kind, or has more than 16384 × 16384 pixels.
pub fn pixels(path: &Path, bytes: &[u8]) -> Result<Pixels, ImportError> {
    let unfit = Unfit {
        name: "it",
        most_texels: MOST_TEXELS,
    };
    let opened = opening::head(bytes, &unfit).and_then(|head| opening::open(bytes, head, &unfit));
    let opened = opened.map_err(|refused| {
        refused.into_error(|why, todo| {
            ImportError::Malformed(fault("picture refused", path, &why, todo))
        })
    })?;
    let straight = |texel: &Vec4| opened.straight(*texel).to_array();
    let (values, is_light) = match &opened.values {
        Values::Floats(texels) => (texels.iter().map(straight).collect(), true),
        Values::Codes(image) => {
            let pixels = image.to_rgba32f();
            (pixels.pixels().map(|pixel| pixel.0).collect(), false)
        }
    };
    let ignored = opened.ignored.into_iter().map(|it| it.clause).collect();
    Ok(Pixels {
        width: opened.width,
        height: opened.height,
        values,
        is_light,
        has_alpha: opened.has_alpha,
        ignored,
    })
}
