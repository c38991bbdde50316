//! Images as files that preserve every texel: PNG if it can represent them exactly, otherwise OpenEXR.

use super::text::string;
use super::{ExportError, Writer};
use crate::scene::{Picture, linear_from_srgb};
use image::{ExtendedColorType, ImageEncoder, ImageError};
use std::io::Cursor;

impl Writer<'_> {
    /// The name of the file with an image, in quotes.
    pub fn picture(&mut self, index: usize) -> Result<String, ExportError> {
        if let Some(name) = self.pictures.get(&index) {
            return Ok(string(name));
        }
        let picture = &self.scene.pictures[index];
        let (ending, bytes) = encode(picture).map_err(|error| ExportError::Picture {
            width: picture.width,
            height: picture.height,
            why: error.to_string(),
        })?;
        let number = self.pictures.len() + 1;
        let name = self.beside.add(&format!("picture-{number}"), ending, bytes);
        let quoted = string(&name);
        self.pictures.insert(index, name);
        Ok(quoted)
    }
}

fn encode(picture: &Picture) -> Result<(&'static str, Vec<u8>), ImageError> {
    let (width, height) = (picture.width, picture.height);
    let mut bytes = Vec::new();
    if let Some(codes) = codes(picture) {
        let encoder = image::codecs::png::PngEncoder::new(&mut bytes);
        if codes.iter().all(|code| code % 257 == 0) {
            let codes: Vec<u8> = codes.iter().map(|code| (code / 257) as u8).collect();
            encoder.write_image(&codes, width, height, ExtendedColorType::Rgb8)?;
        } else {
            let codes: Vec<u8> = codes.iter().flat_map(|code| code.to_ne_bytes()).collect();
            encoder.write_image(&codes, width, height, ExtendedColorType::Rgb16)?;
        }
        return Ok(("png", bytes));
    }
    let values = picture.texels.iter().flat_map(|texel| texel.to_array());
    let values: Vec<u8> = values.flat_map(f32::to_ne_bytes).collect();
    let encoder = image::codecs::openexr::OpenExrEncoder::new(Cursor::new(&mut bytes));
    encoder.write_image(&values, width, height, ExtendedColorType::Rgb32F)?;
    Ok(("exr", bytes))
}

/// The 16-bit sRGB codes that decode to exactly these texels, if there are such codes.
fn codes(picture: &Picture) -> Option<Vec<u16>> {
    let curve: Vec<f32> = (0..=u16::MAX)
        .map(|code| linear_from_srgb(f64::from(code) / f64::from(u16::MAX)) as f32)
        .collect();
    let code = |value: f32| {
        let code = curve.partition_point(|known| *known < value);
        let is_it = curve.get(code)?.to_bits() == value.to_bits();
        is_it.then_some(code as u16)
    };
    let values = picture.texels.iter().flat_map(|texel| texel.to_array());
    values.map(code).collect()
}
