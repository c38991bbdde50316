//! Images as files that preserve every texel: PNG if it can represent them exactly, otherwise OpenEXR.

use super::{ExportError, Writer};
use glam::Vec4;
use glimray_scene::{Origin, Pattern, Picture, Texels, Textures, linear_from_srgb};
use image::{ExtendedColorType, ImageEncoder, ImageError};
use std::io::Cursor;

impl Writer<'_> {
    /// The name of the file with an image that is read in this role.
    pub fn picture(&mut self, index: usize, role: Role) -> Result<String, ExportError> {
        if let Some(name) = self.pictures.get(&(index, role)) {
            return Ok(name.clone());
        }
        let own = &self.scene.pictures[index];
        let (picture, role) = match &own.origin {
            // Readers compute the normals again.
            Origin::Heights { heights, .. } if self.is_relief(index) => (&**heights, Role::Data),
            _ => (&**own, role),
        };
        let (ending, bytes) = encode(picture, role).map_err(|error| ExportError::Picture {
            width: picture.width,
            height: picture.height,
            why: error.to_string(),
        })?;
        let number = self.pictures.len() + 1;
        let name = self.beside.add(&format!("picture-{number}"), ending, bytes);
        self.pictures.insert((index, role), name.clone());
        Ok(name)
    }
}

impl Writer<'_> {
    /// Whether a picture is shown as the normal map of heights, and nowhere otherwise.
    pub fn is_relief(&self, picture: usize) -> bool {
        let scene = self.scene;
        let shows = |texture: usize| matches!(scene.textures[texture].pattern, Pattern::Picture { picture: own, .. } if own == picture);
        let mut others = scene.materials.iter().flat_map(|material| {
            let Textures {
                emission,
                normal: _,
                occlusion,
                alpha,
            } = material.textures;
            let own = [emission, occlusion, alpha].into_iter().flatten();
            own.chain(material.bsdf.texture_indices())
        });
        matches!(scene.pictures[picture].origin, Origin::Heights { .. }) && !others.any(shows)
    }
}

/// Whether importers decode the values of a PNG as sRGB or take them as they are.
#[derive(Clone, Copy, PartialEq, Eq, Hash)]
pub(super) enum Role {
    Color,
    Data,
}

fn encode(picture: &Picture, role: Role) -> Result<(&'static str, Vec<u8>), ImageError> {
    let (width, height) = (picture.width, picture.height);
    let mut bytes = Vec::new();
    let mut png = |codes: &[u8], kind| {
        let encoder = image::codecs::png::PngEncoder::new(&mut bytes);
        encoder.write_image(codes, width, height, kind)
    };
    match (&picture.texels, role) {
        (Texels::Srgb8(texels), Role::Color) | (Texels::Linear8(texels), Role::Data) => {
            if texels.iter().all(|texel| texel[3] == u8::MAX) {
                let codes: Vec<u8> = texels
                    .iter()
                    .flat_map(|[r, g, b, _]| [*r, *g, *b])
                    .collect();
                png(&codes, ExtendedColorType::Rgb8)?;
            } else {
                png(texels.as_flattened(), ExtendedColorType::Rgba8)?;
            }
            return Ok(("png", bytes));
        }
        (Texels::Float(texels), Role::Color) => {
            if let Some(codes) = codes(texels) {
                let codes: Vec<u8> = codes.iter().flat_map(|code| code.to_ne_bytes()).collect();
                png(&codes, ExtendedColorType::Rgba16)?;
                return Ok(("png", bytes));
            }
        }
        // A PNG would be decoded otherwise, and an OpenEXR file is linear in every role; see `Writer::role` for its alpha.
        _ => {}
    }
    let values = picture.linear().flat_map(|texel| texel.to_array());
    let values: Vec<u8> = values.flat_map(f32::to_ne_bytes).collect();
    let encoder = image::codecs::openexr::OpenExrEncoder::new(Cursor::new(&mut bytes));
    encoder.write_image(&values, width, height, ExtendedColorType::Rgba32F)?;
    Ok(("exr", bytes))
}

/// The 16-bit codes of sRGB and alpha that decode to exactly these texels, if there are such codes.
pub(super) fn codes(texels: &[Vec4]) -> Option<Vec<u16>> {
    let value = |code: u16| f64::from(code) / f64::from(u16::MAX);
    let colors: Vec<f32> = (0..=u16::MAX)
        .map(|code| linear_from_srgb(value(code)) as f32)
        .collect();
    let alphas: Vec<f32> = (0..=u16::MAX).map(|code| value(code) as f32).collect();
    let code = |curve: &[f32], value: f32| {
        let code = curve.partition_point(|known| *known < value);
        let is_it = curve.get(code)?.to_bits() == value.to_bits();
        is_it.then_some(code as u16)
    };
    let channels = texels.iter().flat_map(|texel| {
        let [r, g, b, a] = texel.to_array();
        [(&colors, r), (&colors, g), (&colors, b), (&alphas, a)]
    });
    channels.map(|(curve, value)| code(curve, value)).collect()
}
