//! Mipmaps: copies of a picture, each of half the width and height of the one before, rounded down (Williams,
//! Pyramidal Parametrics, 1983). Each texel is the mean of the area it covers, in linear light.

use crate::{
    bvh::threads,
    scene::{Picture, SrgbCurve, Texels},
};
use glam::Vec4;

/// The weight of a colour whose alpha is 0, relative to an opaque one: such texels count only where all are
/// transparent.
const LEAST_WEIGHT: f32 = 1.0 / 4096.0;

/// The number of levels of a picture, itself included.
pub fn level_count(picture: &Picture) -> u32 {
    picture.width.max(picture.height).max(1).ilog2() + 1
}

/// The number of texels of all levels.
pub fn texel_count(picture: &Picture) -> usize {
    let sizes = (0..level_count(picture)).map(|level| size(picture, level));
    sizes.map(|[width, height]| width * height).sum()
}

/// Width and height of a level in texels.
fn size(picture: &Picture, level: u32) -> [usize; 2] {
    [picture.width, picture.height].map(|side| (side >> level).max(1) as usize)
}

/// The levels of a picture after the first, which is the picture itself. Alpha weights colours, so that what is
/// transparent lends its surroundings no colour; values that are not colours are averaged as they are.
pub fn levels(picture: &Picture) -> Vec<Texels> {
    let is_weighted = !matches!(picture.texels, Texels::Linear8(_));
    let curve = SrgbCurve::default();
    let first = |index: usize| {
        let texel = picture.texels.linear(&curve, index);
        match is_weighted {
            true => (texel.truncate() * (texel.w + LEAST_WEIGHT)).extend(texel.w),
            false => texel,
        }
    };
    let mut levels = Vec::new();
    let mut before: Vec<Vec4> = Vec::new();
    for level in 1..level_count(picture) {
        let sizes = (size(picture, level - 1), size(picture, level));
        let texels = match level {
            1 => halved(sizes, &first),
            _ => halved(sizes, &|index| before[index]),
        };
        let plain = |texel: &Vec4| match is_weighted {
            true => (texel.truncate() / (texel.w + LEAST_WEIGHT)).extend(texel.w),
            false => *texel,
        };
        levels.push(stored(&picture.texels, &curve, texels.iter().map(plain)));
        before = texels;
    }
    levels
}

/// The texels of a level from those of the one before, with their sizes.
fn halved(
    ([width, height], [half_width, half_height]): ([usize; 2], [usize; 2]),
    texel: &(impl Fn(usize) -> Vec4 + Sync),
) -> Vec<Vec4> {
    threads::collect(half_width * half_height, |index| {
        let columns = covered(width, half_width, index % half_width);
        let rows = covered(height, half_height, index / half_width);
        let mut sum = Vec4::ZERO;
        for (row, share) in rows {
            for (column, part) in columns {
                sum += share * part * texel(row * width + column);
            }
        }
        sum
    })
}

/// The texels that texel `index` of `half` covers of `count`, and the share of each: two, or three where `count` is
/// odd. A share may be 0.
fn covered(count: usize, half: usize, index: usize) -> [(usize, f32); 3] {
    if count == 1 {
        return [(0, 1.0), (0, 0.0), (0, 0.0)];
    }
    let first = 2 * index;
    if count == 2 * half {
        return [(first, 0.5), (first + 1, 0.5), (first, 0.0)];
    }
    let (whole, place) = (count as f32, half as f32);
    [
        (first, (half - index) as f32 / whole),
        (first + 1, place / whole),
        (first + 2, (index + 1) as f32 / whole),
    ]
}

/// Linear values with the precision of `like`.
fn stored(like: &Texels, curve: &SrgbCurve, values: impl Iterator<Item = Vec4>) -> Texels {
    let code = |value: f32| (value * 255.0).round() as u8;
    match like {
        Texels::Srgb8(_) => Texels::Srgb8(
            values
                .map(|v| {
                    let [r, g, b] = v.truncate().to_array().map(|c| curve.code(c));
                    [r, g, b, code(v.w)]
                })
                .collect(),
        ),
        Texels::Linear8(_) => Texels::Linear8(values.map(|v| v.to_array().map(code)).collect()),
        Texels::Float(_) => Texels::Float(values.collect()),
    }
}
