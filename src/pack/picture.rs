//! Packs pictures: their texels are words of one array on the GPU.

use super::PackError;
use crate::{
    layout::{PICTURE_HALF, PICTURE_SRGB},
    scene::{Picture, Scene, Texels},
};
use glam::Vec4;
use half::f16;
use std::sync::Arc;

/// Maximum number of words: those of the largest array of layers that WebGPU guarantees.
const MAX_WORDS: usize = 1 << 30;

/// A picture and the words of its texels: one for each texel of 8 bits per channel, two for half floats.
pub type PackedPicture = (Arc<Picture>, Arc<[u32]>);

/// All pictures of a scene, and for each the first word with its `PICTURE_` bits, width and height. Pictures that
/// were packed `before` are reused.
pub fn pictures(
    scene: &Scene,
    before: &[PackedPicture],
) -> Result<(Vec<PackedPicture>, Vec<[u32; 3]>), PackError> {
    let word_count = |picture: &Arc<Picture>| match &picture.texels {
        Texels::Srgb8(texels) | Texels::Linear8(texels) => texels.len(),
        Texels::Float(texels) => 2 * texels.len(),
    };
    let count = scene.pictures.iter().map(word_count).sum();
    if count > MAX_WORDS {
        return Err(PackError::TooMany {
            what: "words of texels",
            count,
            limit: MAX_WORDS,
        });
    }
    let mut first = 0;
    let mut pictures = Vec::with_capacity(scene.pictures.len());
    let mut places = Vec::with_capacity(scene.pictures.len());
    for picture in &scene.pictures {
        let known = before.iter().find(|(known, _)| Arc::ptr_eq(known, picture));
        let texels = known.map_or_else(|| words(&picture.texels), |(_, texels)| texels.clone());
        let format = match &picture.texels {
            Texels::Srgb8(_) => PICTURE_SRGB,
            Texels::Linear8(_) => 0,
            Texels::Float(_) => PICTURE_HALF,
        };
        places.push([first | format, picture.width, picture.height]);
        first += texels.len() as u32;
        pictures.push((picture.clone(), texels));
    }
    Ok((pictures, places))
}

fn words(texels: &Texels) -> Arc<[u32]> {
    let half = |value: f32| u32::from(f16::from_f32(value.min(f16::MAX.to_f32())).to_bits());
    let halves = |texel: &Vec4| {
        let [r, g, b, a] = texel.to_array().map(half);
        [r | g << 16, b | a << 16]
    };
    match texels {
        Texels::Srgb8(texels) | Texels::Linear8(texels) => texels
            .iter()
            .map(|texel| u32::from_le_bytes(*texel))
            .collect(),
        Texels::Float(texels) => texels.iter().flat_map(halves).collect(),
    }
}
