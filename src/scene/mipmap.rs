//! Mipmaps: copies of a picture, each of half the width and height of the one before, rounded down (Williams,
//! Pyramidal Parametrics, 1983). Each texel is the mean of the area it covers, in linear light. Alpha weights colours, so
//! that what is transparent lends its surroundings no colour; values that are not colours are averaged as they are.

use super::{Origin, Picture, SrgbCurve, Texels};
use crate::threads;
use glam::Vec4;

/// The weight of a colour whose alpha is 0, relative to an opaque one: such texels count only where all are
/// transparent.
const LEAST_WEIGHT: f32 = 1.0 / 4096.0;

impl Picture {
    /// The number of levels of its mipmap, itself included.
    pub fn level_count(&self) -> u32 {
        self.width.max(self.height).max(1).ilog2() + 1
    }

    /// The number of texels of all levels.
    pub fn mipmap_len(&self) -> usize {
        let sizes = (0..self.level_count()).map(|level| self.level_size(level));
        sizes.map(|[width, height]| width * height).sum()
    }

    /// Width and height of a level in texels.
    fn level_size(&self, level: u32) -> [usize; 2] {
        [self.width, self.height].map(|side| (side >> level).max(1) as usize)
    }

    /// The levels after the first, which is the picture itself.
    pub fn levels(&self) -> Vec<Texels> {
        let light = Light::of(self);
        let mut levels = Vec::new();
        let mut before: Vec<Vec4> = Vec::new();
        for level in 1..self.level_count() {
            let sizes = (self.level_size(level - 1), self.level_size(level));
            let count = sizes.1[0] * sizes.1[1];
            before = match level {
                1 => threads::collect(count, |i| mean(sizes, i, |index| light.of_texel(index))),
                _ => threads::collect(count, |i| mean(sizes, i, |index| before[index])),
            };
            levels.push(light.stored(count, |index| before[index]));
        }
        levels
    }

    /// The next level as a picture; a single texel is returned as it is.
    pub fn halved(&self) -> Self {
        let light = Light::of(self);
        let sizes = (self.level_size(0), self.level_size(1));
        let [width, height] = sizes.1;
        let texel = |i: usize| mean(sizes, i, |index| light.of_texel(index));
        Self {
            width: width as u32,
            height: height as u32,
            texels: light.stored(width * height, texel),
            // The sun of a sky is not in its texels.
            origin: match self.origin {
                Origin::Sky { .. } => self.origin.clone(),
                _ => Origin::Texels,
            },
        }
    }
}

/// Texels as linear values that may be averaged: colours are multiplied with their weight, in 0..=1.
struct Light<'a> {
    texels: &'a Texels,
    curve: SrgbCurve,
    is_weighted: bool,
}

impl<'a> Light<'a> {
    fn of(picture: &'a Picture) -> Self {
        Self {
            texels: &picture.texels,
            curve: SrgbCurve::default(),
            is_weighted: !matches!(picture.texels, Texels::Linear8(_)),
        }
    }

    /// Of a colour with this alpha. That of an opaque one is 1, so that no colour overflows.
    fn weight(&self, alpha: f32) -> f32 {
        match self.is_weighted {
            true => (alpha + LEAST_WEIGHT) / (1.0 + LEAST_WEIGHT),
            false => 1.0,
        }
    }

    fn of_texel(&self, index: usize) -> Vec4 {
        let texel = self.texels.linear(&self.curve, index);
        (texel.truncate() * self.weight(texel.w)).extend(texel.w)
    }

    /// Averaged values with the precision of the picture.
    fn stored(&self, count: usize, value: impl Fn(usize) -> Vec4 + Sync) -> Texels {
        let plain = |index: usize| {
            let mean = value(index);
            (mean.truncate() / self.weight(mean.w)).extend(mean.w)
        };
        let code = |value: f32| (value * 255.0).round() as u8;
        match self.texels {
            Texels::Srgb8(_) => Texels::Srgb8(threads::collect(count, |index| {
                let texel = plain(index);
                let [r, g, b] = texel.truncate().to_array().map(|c| self.curve.code(c));
                [r, g, b, code(texel.w)]
            })),
            Texels::Linear8(_) => Texels::Linear8(threads::collect(count, |index| {
                plain(index).to_array().map(code)
            })),
            Texels::Float(_) => {
                Texels::Float(threads::collect(count, |index| plain(index).min(Vec4::MAX)))
            }
        }
    }
}

/// The mean of what texel `index` of a level covers of the one before, with their sizes.
fn mean(
    ([width, height], [half_width, half_height]): ([usize; 2], [usize; 2]),
    index: usize,
    texel: impl Fn(usize) -> Vec4,
) -> Vec4 {
    let columns = covered(width, half_width, index % half_width);
    let rows = covered(height, half_height, index / half_width);
    let mut sum = Vec4::ZERO;
    for (row, share) in rows {
        for (column, part) in columns {
            sum += share * part * texel(row * width + column);
        }
    }
    sum
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
