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
        let mut levels: Vec<Texels> = Vec::new();
        let mut before: Vec<Vec4> = Vec::new();
        for level in 1..self.level_count() {
            let sizes = (self.level_size(level - 1), self.level_size(level));
            let count = sizes.1[0] * sizes.1[1];
            let stored = levels.last().unwrap_or(&self.texels);
            let values = &before[..];
            let value = |index: usize| match level {
                1 => light.of_texel(index),
                _ => values[index],
            };
            let even = |index| {
                even(sizes, index, |a, b| match level {
                    1 => are_same(stored, a, b),
                    _ => values[a] == values[b],
                })
            };
            let means = threads::collect(count, |index| match even(index) {
                Some(first) => value(first),
                None => mean(sizes, index, value),
            });
            let next = light.stored(stored, count, even, |index| means[index]);
            levels.push(next);
            before = means;
        }
        levels
    }

    /// The next level as a picture; a single texel is returned as it is.
    pub fn halved(&self) -> Self {
        let light = Light::of(self);
        let sizes = (self.level_size(0), self.level_size(1));
        let [width, height] = sizes.1;
        let even = |index| even(sizes, index, |a, b| are_same(&self.texels, a, b));
        let value = |index| mean(sizes, index, |index| light.of_texel(index));
        Self {
            width: width as u32,
            height: height as u32,
            texels: light.stored(&self.texels, width * height, even, value),
            // The sun of a sky is not in its texels, and a name stays a name.
            origin: match self.origin.is_generated() {
                true => self.origin.clone(),
                false => Origin::Texels,
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

    /// Weight of a colour with this alpha. An opaque colour has the weight 1, so that no colour overflows.
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

    /// Averaged values with the precision of the picture. `even` returns a texel of the level `before` for one that has its
    /// value.
    fn stored(
        &self,
        before: &Texels,
        count: usize,
        even: impl Fn(usize) -> Option<usize> + Sync,
        value: impl Fn(usize) -> Vec4 + Sync,
    ) -> Texels {
        let plain = |index: usize| {
            let mean = value(index);
            (mean.truncate() / self.weight(mean.w)).extend(mean.w)
        };
        let code = |value: f32| (value * 255.0).round() as u8;
        let srgb = |index: usize| {
            let texel = plain(index);
            let [r, g, b] = texel.truncate().to_array().map(|c| self.curve.code(c));
            [r, g, b, code(texel.w)]
        };
        fn filled<T: Copy + Send + Sync>(
            before: &[T],
            count: usize,
            even: impl Fn(usize) -> Option<usize> + Sync,
            mean: impl Fn(usize) -> T + Sync,
        ) -> Vec<T> {
            threads::collect(count, |index| match even(index) {
                Some(first) => before[first],
                None => mean(index),
            })
        }
        match before {
            Texels::Srgb8(before) => Texels::Srgb8(filled(before, count, even, srgb)),
            Texels::Linear8(before) => Texels::Linear8(filled(before, count, even, |index| {
                plain(index).to_array().map(code)
            })),
            Texels::Float(before) => Texels::Float(filled(before, count, even, |index| {
                plain(index).min(Vec4::MAX)
            })),
        }
    }
}

/// Whether two texels are equal.
fn are_same(texels: &Texels, a: usize, b: usize) -> bool {
    match texels {
        Texels::Srgb8(texels) | Texels::Linear8(texels) => {
            let texels = &texels[..];
            u32::from_ne_bytes(texels[a]) == u32::from_ne_bytes(texels[b])
        }
        Texels::Float(texels) => texels[a] == texels[b],
    }
}

/// The first texel of those that texel `index` of a level covers if they are all the same, so that their mean need not be
/// computed: large areas of a picture often are. `None` beside odd sizes.
fn even(
    ([width, height], [half_width, half_height]): ([usize; 2], [usize; 2]),
    index: usize,
    are_same: impl Fn(usize, usize) -> bool,
) -> Option<usize> {
    if width != 2 * half_width || height != 2 * half_height {
        return None;
    }
    let first = 2 * (index / half_width * width + index % half_width);
    let below = first + width;
    match are_same(first, first + 1) && are_same(first, below) && are_same(first, below + 1) {
        true => Some(first),
        false => None,
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
    for (row, share) in (rows.first..).zip(&rows.shares[..rows.count]) {
        for (column, part) in (columns.first..).zip(&columns.shares[..columns.count]) {
            sum += share * part * texel(row * width + column);
        }
    }
    sum
}

/// Neighbouring texels and the share of each.
struct Covered {
    first: usize,
    count: usize,
    /// Weights of `count` texels, which add up to 1.
    shares: [f32; 3],
}

/// The texels that texel `index` of `half` covers of `count`: two, or three where `count` is odd.
fn covered(count: usize, half: usize, index: usize) -> Covered {
    let (covers, shares) = if count == 1 {
        (1, [1.0, 0.0, 0.0])
    } else if count == 2 * half {
        (2, [0.5, 0.5, 0.0])
    } else {
        let (whole, place) = (count as f32, half as f32);
        let (before, after) = ((half - index) as f32, (index + 1) as f32);
        (3, [before, place, after].map(|part| part / whole))
    };
    Covered {
        first: 2 * index,
        count: covers,
        shares,
    }
}
