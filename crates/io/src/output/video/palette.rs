//! A palette for all frames of a video, and ordered dithering, which depends only on a pixel's position
//! and colour: static areas do not flicker.

use super::Picture8;
use color_quant::NeuQuant;
use std::collections::BTreeSet;

/// Colours of a palette; the 256th index is reserved for unchanged pixels.
pub(super) const MAX_COLOURS: usize = 255;

/// Number of pixels that a palette is trained on.
const SAMPLES: usize = 1 << 17;

/// Bits per channel in the table of nearest colours.
const TABLE_BITS: u32 = 6;

/// Number of colours that represent one between them, and their order in a 4×4 block (Bayer, ICC 1973).
const MIX: usize = 16;
const BAYER: [[usize; 4]; 4] = [[0, 8, 2, 10], [12, 4, 14, 6], [3, 11, 1, 9], [15, 7, 13, 5]];

/// The next colour of a mix compensates this fraction of the error, limited to this many levels.
/// Compensating all of it would be exact but coarse, and would use distant colours where the palette has
/// gaps.
const FEEDBACK_DIVISOR: i32 = 2;
const MAX_FEEDBACK: i32 = 24;

/// Entries of the cache of mixes, as a power of two.
const CACHE_BITS: u32 = 16;

/// Pixels sampled evenly over all frames.
pub(super) struct Samples {
    frame_count: usize,
    pixels: Vec<[u8; 3]>,
}

impl Samples {
    /// For the number of frames that [`Samples::add`] will see.
    pub(super) fn new(frame_count: usize) -> Self {
        Self {
            frame_count,
            pixels: Vec::new(),
        }
    }

    pub(super) fn add(&mut self, picture: &Picture8) {
        let wanted = (SAMPLES / self.frame_count).max(1);
        let width = picture.width as usize;
        let mut step = (picture.pixels.len() / wanted).max(1);
        // So that every column is sampled.
        while step > 1 && gcd(step, width) > 1 {
            step += 1;
        }
        self.pixels.extend(picture.pixels.iter().step_by(step));
    }

    pub(super) fn palette(self) -> Palette {
        let distinct: BTreeSet<_> = self.pixels.iter().copied().collect();
        if distinct.len() <= MAX_COLOURS {
            return Palette::new(distinct.into_iter().collect());
        }
        // Training shrinks the range of colours, which no mix can exceed: the extreme colour at each
        // corner of the cube is kept unchanged.
        let corner = |signs: usize| {
            let outwards = |pixel: &&[u8; 3]| {
                let along = |c: usize| match signs >> c & 1 {
                    1 => i32::from(pixel[c]),
                    _ => -i32::from(pixel[c]),
                };
                along(0) + along(1) + along(2)
            };
            distinct.iter().max_by_key(outwards).copied()
        };
        let mut colours: BTreeSet<_> = (0..8).filter_map(corner).collect();
        let rgba: Vec<u8> = self
            .pixels
            .iter()
            .flat_map(|&[r, g, b]| [r, g, b, 255])
            .collect();
        let trained = NeuQuant::new(1, MAX_COLOURS - colours.len(), &rgba).color_map_rgb();
        let (trained, _) = trained.as_chunks();
        colours.extend(trained);
        Palette::new(colours.into_iter().collect())
    }
}

fn gcd(a: usize, b: usize) -> usize {
    if b == 0 { a } else { gcd(b, a % b) }
}

/// Colours sorted from dark to light.
pub(super) struct Palette {
    pub(super) colours: Vec<[u8; 3]>,
    /// The index of the nearest colour for the centre of each cell of the colour cube.
    table: Vec<u8>,
}

impl Palette {
    /// A palette of 1 to 255 colours.
    fn new(mut colours: Vec<[u8; 3]>) -> Self {
        colours.sort_by_key(|&[r, g, b]| {
            2126 * u32::from(r) + 7152 * u32::from(g) + 722 * u32::from(b)
        });
        let side = 1 << TABLE_BITS;
        let middle = |cell: usize| ((cell << (8 - TABLE_BITS)) + (1 << (7 - TABLE_BITS))) as i32;
        let cell = |index: usize| [index >> (2 * TABLE_BITS), index >> TABLE_BITS, index];
        let table = (0..side * side * side)
            .map(|index| nearest(&colours, cell(index).map(|c| middle(c % side))))
            .collect();
        Self { colours, table }
    }

    fn nearest(&self, colour: [i32; 3]) -> u8 {
        let [r, g, b] = colour.map(|level| (level.clamp(0, 255) >> (8 - TABLE_BITS)) as usize);
        self.table[r << (2 * TABLE_BITS) | g << TABLE_BITS | b]
    }

    /// The indices whose colours add up to about 16 times `colour`, from dark to light (Knoll's pattern
    /// dithering, US patent 6606166, expired).
    fn mix(&self, colour: [u8; 3]) -> [u8; MIX] {
        let colour = colour.map(i32::from);
        let mut error = [0; 3];
        let mut mix = [0; MIX];
        for index in &mut mix {
            let wanted = |c: usize| {
                colour[c] + (error[c] / FEEDBACK_DIVISOR).clamp(-MAX_FEEDBACK, MAX_FEEDBACK)
            };
            *index = self.nearest([wanted(0), wanted(1), wanted(2)]);
            let got = self.colours[usize::from(*index)];
            for c in 0..3 {
                error[c] += colour[c] - i32::from(got[c]);
            }
        }
        mix.sort_unstable();
        mix
    }
}

/// Dithers, with a cache of recent mixes, because the colours of an image recur.
pub(super) struct Dither<'a> {
    palette: &'a Palette,
    cache: Vec<([u8; 3], [u8; MIX])>,
}

impl<'a> Dither<'a> {
    pub(super) fn new(palette: &'a Palette) -> Self {
        let black = ([0; 3], palette.mix([0; 3]));
        Self {
            palette,
            cache: vec![black; 1 << CACHE_BITS],
        }
    }

    /// The palette index for `colour` in column `x` of row `y`.
    pub(super) fn index(&mut self, colour: [u8; 3], x: usize, y: usize) -> u8 {
        let [r, g, b] = colour;
        // Knuth's multiplicative hashing.
        let hash = u32::from_le_bytes([r, g, b, 0]).wrapping_mul(0x9E37_79B1);
        let entry = &mut self.cache[(hash >> (32 - CACHE_BITS)) as usize];
        if entry.0 != colour {
            *entry = (colour, self.palette.mix(colour));
        }
        entry.1[BAYER[y % 4][x % 4]]
    }
}

fn nearest(colours: &[[u8; 3]], to: [i32; 3]) -> u8 {
    let distance =
        |colour: &[u8; 3]| -> i32 { (0..3).map(|c| (i32::from(colour[c]) - to[c]).pow(2)).sum() };
    let nearest = (0..colours.len()).min_by_key(|&index| distance(&colours[index]));
    nearest.unwrap_or_default() as u8
}
