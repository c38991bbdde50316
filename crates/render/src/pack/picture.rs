//! Packs pictures: their texels are words of one array on the GPU.

use super::PackError;
use super::segments::{Run, Segments};
use crate::{
    bvh::threads,
    layout::{PICTURE_HALF, PICTURE_SRGB},
};
use bytemuck::try_cast_slice;
use glimray_scene::{LARGEST_TEXEL, Pattern, Picture, Scene, Texels};
use half::f16;
use std::sync::Arc;

/// Maximum number of words: those of the largest array of layers that WebGPU guarantees.
const MAX_WORDS: usize = 1 << 30;

/// A picture and its words.
#[derive(Clone, Debug)]
pub struct PackedPicture {
    pub picture: Arc<Picture>,
    /// Where each level of its mipmap starts, then its texels level by level: one word for each of 8 bits per channel, which
    /// is that of the picture, two for half floats.
    pub words: Segments<u32>,
    /// 1 without a mipmap.
    level_count: u32,
    /// Whether no texture shows it, so that its colours may be divided by a scale.
    may_scale: bool,
    /// Factor on the colours of the words, a power of two.
    pub scale: f32,
}

/// All pictures of a scene, and for each the first word with its `PICTURE_` bits, width and height. Pictures that
/// were packed `before` are reused. Those of textures that are minified have a mipmap.
pub fn pictures(
    scene: &Scene,
    before: &[PackedPicture],
) -> Result<(Vec<PackedPicture>, Vec<[u32; 3]>), PackError> {
    let mut level_counts = vec![1; scene.pictures.len()];
    let mut may_scale = vec![true; scene.pictures.len()];
    for texture in &scene.textures {
        if let Pattern::Picture {
            picture, minify, ..
        } = texture.pattern
        {
            may_scale[picture] = false;
            if minify.has_levels() {
                level_counts[picture] = scene.pictures[picture].level_count();
            }
        }
    }
    let count = (scene.pictures.iter().zip(&level_counts))
        .map(|(picture, level_count)| word_count(picture, *level_count))
        .sum();
    if count > MAX_WORDS {
        return Err(PackError::TooMany {
            what: "words of texels",
            count,
            limit: MAX_WORDS,
        });
    }
    let mut next = 0;
    let mut pictures = Vec::with_capacity(scene.pictures.len());
    let mut places = Vec::with_capacity(scene.pictures.len());
    let kinds = level_counts.into_iter().zip(may_scale);
    for (picture, (level_count, may_scale)) in scene.pictures.iter().zip(kinds) {
        let is_same = |known: &&PackedPicture| {
            Arc::ptr_eq(&known.picture, picture)
                && (known.level_count, known.may_scale) == (level_count, may_scale)
        };
        let known = before.iter().find(is_same).cloned();
        let packed = known.unwrap_or_else(|| {
            let scale = if may_scale {
                picture.texels.scale()
            } else {
                1.0
            };
            PackedPicture {
                picture: picture.clone(),
                words: words(picture, level_count, scale),
                level_count,
                may_scale,
                scale,
            }
        });
        let format = match &picture.texels {
            Texels::Srgb8(_) => PICTURE_SRGB,
            Texels::Linear8(_) => 0,
            Texels::Float(_) => PICTURE_HALF,
        };
        let first = next + (level_count - 1);
        places.push([first | format, picture.width, picture.height]);
        next += packed.words.len() as u32;
        pictures.push(packed);
    }
    Ok((pictures, places))
}

/// The number of words of a picture.
fn word_count(picture: &Picture, level_count: u32) -> usize {
    let texel_count = match level_count {
        1 => picture.texels.len(),
        _ => picture.mipmap_len(),
    };
    texel_words(&picture.texels) * texel_count + level_count as usize - 1
}

/// The number of words of a texel.
fn texel_words(texels: &Texels) -> usize {
    match texels {
        Texels::Srgb8(_) | Texels::Linear8(_) => 1,
        Texels::Float(_) => 2,
    }
}

/// The words of a picture: see [`PackedPicture::words`].
fn words(picture: &Arc<Picture>, level_count: u32, scale: f32) -> Segments<u32> {
    let levels = match level_count {
        1 => Vec::new(),
        _ => picture.levels(),
    };
    let mut starts = Vec::with_capacity(levels.len());
    let mut start = 0;
    for level in [&picture.texels]
        .into_iter()
        .chain(&levels)
        .take(levels.len())
    {
        start += level.len() * texel_words(level);
        starts.push(start as u32);
    }
    starts.reverse();
    let mut words = Segments::default();
    words.push(Arc::new(Arc::<[u32]>::from(starts)));
    words.push(match picture.texels.elements() {
        [] => Arc::new(copied(&picture.texels, scale)),
        _ => picture.clone(),
    });
    for level in levels {
        words.push(match level.elements() {
            [] => Arc::new(copied(&level, scale)),
            _ => Arc::new(level),
        });
    }
    words
}

impl Run<u32> for Picture {
    fn elements(&self) -> &[u32] {
        self.texels.elements()
    }
}

impl Run<u32> for Texels {
    /// None if words are not what is in memory: floats become half floats.
    fn elements(&self) -> &[u32] {
        match self {
            Self::Srgb8(texels) | Self::Linear8(texels) if cfg!(target_endian = "little") => {
                try_cast_slice(texels).unwrap_or_default()
            }
            _ => &[],
        }
    }
}

/// The words of texels whose colours are divided by `scale`.
fn copied(texels: &Texels, scale: f32) -> Arc<[u32]> {
    let half = |value: f32| u32::from(f16::from_f32(value.min(LARGEST_TEXEL)).to_bits());
    match texels {
        Texels::Srgb8(texels) | Texels::Linear8(texels) => {
            (texels.iter().copied()).map(u32::from_le_bytes).collect()
        }
        Texels::Float(texels) => threads::collect_shared(2 * texels.len(), |index| {
            let texel = texels[index / 2];
            let [low, high] = match index % 2 {
                0 => [texel.x / scale, texel.y / scale],
                _ => [texel.z / scale, texel.w],
            };
            half(low) | half(high) << 16
        }),
    }
}
