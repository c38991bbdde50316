//! Encodes images in memory: the encoders of `image` ignore errors of a full disk (PNG's last chunk is
//! written in `Drop`), but writing to memory cannot fail.

use super::{Format, OutputError, SaveOptions, layered};
use ::image::codecs::{
    hdr::HdrEncoder, jpeg::JpegEncoder, openexr::OpenExrEncoder, png::PngEncoder,
};
use ::image::{DynamicImage, ImageBuffer, Pixel, Rgb, Rgba};
use glimray_scene::image::Image;
use std::io::Cursor;

/// The contents of the file. It has opacity if the format supports it, and either the options ask for it or any pixel is
/// not opaque.
pub(super) fn encode(
    image: &Image,
    format: Format,
    options: &SaveOptions,
) -> Result<Vec<u8>, OutputError> {
    if let (Format::Exr, Some(place)) = (format, options.place) {
        return layered::encode(&layered::plain(image, options.opacity), Some(place));
    }
    let alpha = format.has_opacity() && (options.opacity || !image.is_opaque());
    let pixels = match (format, alpha) {
        (Format::Png, true) => raster(image, |p| Rgba(p.map(level))),
        (Format::Png | Format::Jpeg, _) => raster(image, |p| Rgb(rgb(p).map(level))),
        (Format::Exr, true) => {
            let pixels = image.premultiplied().collect();
            raster(&Image { pixels, ..*image }, Rgba)
        }
        (Format::Exr, false) => raster(image, |p| Rgb(rgb(p))),
        // `max` also turns a NaN into 0.
        (Format::Hdr, _) => raster(image, |p| Rgb(rgb(p).map(|v| v.max(0.0)))),
    }
    .ok_or(OutputError::Misshapen {
        width: image.width,
        height: image.height,
        pixel_count: image.pixels.len(),
    })?;

    let mut file = Cursor::new(Vec::new());
    match format {
        Format::Png => pixels.write_with_encoder(PngEncoder::new(&mut file)),
        Format::Jpeg => pixels.write_with_encoder(JpegEncoder::new_with_quality(
            &mut file,
            options.quality.clamp(1, 100),
        )),
        Format::Exr => pixels.write_with_encoder(OpenExrEncoder::new(&mut file)),
        Format::Hdr => pixels.write_with_encoder(HdrEncoder::new(&mut file)),
    }
    .map_err(|source| OutputError::Encode { format, source })?;
    Ok(file.into_inner())
}

/// The pixels in the layout that the encoders of `image` expect; `None` if their number is wrong.
fn raster<P: Pixel>(image: &Image, convert: impl Fn([f32; 4]) -> P) -> Option<DynamicImage>
where
    DynamicImage: From<ImageBuffer<P, Vec<P::Subpixel>>>,
{
    if image.pixels.len() as u64 != u64::from(image.width) * u64::from(image.height) {
        return None;
    }
    let mut samples = Vec::with_capacity(image.pixels.len() * usize::from(P::CHANNEL_COUNT));
    for &pixel in &image.pixels {
        samples.extend_from_slice(convert(pixel).channels());
    }
    ImageBuffer::from_raw(image.width, image.height, samples).map(DynamicImage::from)
}

fn rgb([r, g, b, _]: [f32; 4]) -> [f32; 3] {
    [r, g, b]
}

/// The nearest of 256 levels to a value, clamped to [0, 1]; 0 for NaN.
pub(super) fn level(value: f32) -> u8 {
    (value.clamp(0.0, 1.0) * 255.0).round() as u8
}
