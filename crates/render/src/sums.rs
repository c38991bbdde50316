//! Sums of samples that do not depend on the order of addition.
//!
//! The GPU adds the samples of a block one after the other to f32 sums, always in the same order. Blocks are
//! added as integers, for which addition is associative and commutative. Any split of a picture between blocks,
//! merged in any order, therefore has the same bits as a single run.

use glimray_scene::threads;
use std::borrow::Cow;

/// Samples of a pixel that are summed in f32. A picture can be split at multiples of this number; the last
/// block of a picture may be shorter.
pub const SAMPLE_BLOCK: u32 = 64;

/// Fraction bits of an exact sum.
const FRACTION_BITS: i32 = 50;
/// The largest exact sum of a block, 2^50; larger sums are clamped. That leaves room for the sums of 2^26
/// blocks, the maximum of a picture.
pub(super) const LARGEST: i128 = 1 << 100;
const UNIT: f64 = 1.0 / (1_u64 << FRACTION_BITS) as f64;

/// The rows of a pixel.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct PixelRows {
    /// The number of rows.
    pub count: usize,
    /// The first row that is not a sum. From it on the rows describe the sample nearest the pixel's centre: the first
    /// number is its nearness, the second its index. Totals hold the bits of these numbers.
    pub nearest: Option<usize>,
}

impl PixelRows {
    /// A single row of sums.
    pub const ONE: Self = Self {
        count: 1,
        nearest: None,
    };

    /// The number of rows that are sums.
    fn sums(self) -> usize {
        self.nearest.unwrap_or(self.count)
    }

    /// A row of a block in a total.
    fn exact(self, index: usize, row: [f32; 4]) -> [i128; 4] {
        match index % self.count < self.sums() {
            true => row.map(exact),
            false => row.map(|number| number.to_bits().into()),
        }
    }

    /// Adds rounded rows of a pixel.
    pub fn add_rounded(self, own: &mut [[f64; 4]], other: impl Fn(usize) -> [f64; 4]) {
        let (sums, nearest) = own.split_at_mut(self.sums());
        for (index, own) in sums.iter_mut().enumerate() {
            for (own, other) in own.iter_mut().zip(other(index)) {
                *own += other;
            }
        }
        let order = |[nearness, sample, ..]: [f64; 4]| (nearness, -sample);
        if let Some(&first) = nearest.first()
            && order(other(self.sums())) > order(first)
        {
            for (index, row) in nearest.iter_mut().enumerate() {
                *row = other(self.sums() + index);
            }
        }
    }

    /// Adds the sums of a pixel to its totals, and keeps the nearest sample.
    fn add(self, totals: &mut [[i128; 4]], other: impl Fn(usize) -> [i128; 4]) {
        let (sums, nearest) = totals.split_at_mut(self.sums());
        for (index, total) in sums.iter_mut().enumerate() {
            for (total, sum) in total.iter_mut().zip(other(index)) {
                *total += sum;
            }
        }
        // The bits of positive numbers are in the order of the numbers.
        let order = |[nearness, sample, ..]: [i128; 4]| (nearness, -sample);
        if let Some(&first) = nearest.first()
            && order(other(self.sums())) > order(first)
        {
            for (index, row) in nearest.iter_mut().enumerate() {
                *row = other(self.sums() + index);
            }
        }
    }
}

/// Sums of pixels, in rows of four for each layer of each pixel.
#[derive(Clone, Debug, PartialEq)]
pub enum Sums {
    /// The sums of one block, as added by the GPU.
    Block(Vec<[f32; 4]>),
    /// The sums of several blocks, in units of 2^-50.
    Totals(Vec<[i128; 4]>),
}

impl Sums {
    /// Bytes of a row, of one block or of several.
    pub fn row_bytes(is_block: bool) -> u64 {
        match is_block {
            true => size_of::<[f32; 4]>() as u64,
            false => size_of::<[i128; 4]>() as u64,
        }
    }

    /// `rows` rows of zeros, of one block or of several.
    pub fn zeros(rows: usize, is_block: bool) -> Self {
        match is_block {
            true => Self::Block(vec![[0.0; 4]; rows]),
            false => Self::Totals(vec![[0; 4]; rows]),
        }
    }

    /// The total of these sums, if any, and another block with as many rows.
    pub fn with_block(sums: Option<Self>, block: &[[f32; 4]], rows: PixelRows) -> Self {
        let mut totals = match sums {
            None => return Self::Block(block.to_vec()),
            Some(Self::Block(first)) => {
                let first = first.into_iter().enumerate();
                first.map(|(index, row)| rows.exact(index, row)).collect()
            }
            Some(Self::Totals(totals)) => totals,
        };
        add_blocks(&mut totals, block, rows);
        Self::Totals(totals)
    }

    /// Adds `count` rows of `other`, starting at `from`, to the rows starting at `to`: whole pixels. For sums of one block
    /// this is the first addition.
    pub fn add(&mut self, to: usize, other: &Self, from: usize, count: usize, rows: PixelRows) {
        match (self, other) {
            (Self::Block(own), Self::Block(other)) => {
                own[to..to + count].copy_from_slice(&other[from..from + count]);
            }
            (Self::Totals(own), Self::Block(other)) => {
                add_blocks(&mut own[to..to + count], &other[from..from + count], rows);
            }
            (Self::Totals(own), Self::Totals(other)) => {
                let own = own[to..to + count].chunks_exact_mut(rows.count);
                let other = other[from..from + count].chunks_exact(rows.count);
                for (own, other) in own.zip(other) {
                    rows.add(own, |index| other[index]);
                }
            }
            // Sums of several blocks are never added to a single block.
            (Self::Block(_), Self::Totals(_)) => {}
        }
    }

    /// The unchanged sums of a single block, otherwise means with a weight of 1; zeros without samples, as in
    /// the padding of film tiles.
    pub fn developable(&self) -> Vec<[f32; 4]> {
        match self {
            Self::Block(block) => block.clone(),
            Self::Totals(totals) => totals.iter().copied().map(mean).collect(),
        }
    }

    /// A row of [`Self::developable`].
    pub fn developable_row(&self, index: usize) -> [f32; 4] {
        match self {
            Self::Block(block) => block[index],
            Self::Totals(totals) => mean(totals[index]),
        }
    }

    /// Puts the rows of a pixel, in f64, into a list.
    pub fn round_pixel(&self, pixel: usize, rows: PixelRows, into: &mut Vec<[f64; 4]>) {
        let first = pixel * rows.count;
        into.clear();
        into.extend((first..first + rows.count).map(|index| self.rounded_row(index, rows)));
    }

    /// A row in f64.
    fn rounded_row(&self, index: usize, rows: PixelRows) -> [f64; 4] {
        match self {
            Self::Block(block) => block[index].map(f64::from),
            Self::Totals(totals) if index % rows.count < rows.sums() => {
                totals[index].map(|sum| sum as f64 * UNIT)
            }
            Self::Totals(totals) => {
                totals[index].map(|bits| f64::from(f32::from_bits(bits as u32)))
            }
        }
    }
}

/// The sums of blocks of a film tile, copied only where they have to be added first.
pub enum Totals<'a> {
    /// As added by the GPU.
    Block(&'a [[f32; 4]]),
    Blocks(Cow<'a, Sums>),
}

impl Totals<'_> {
    /// A row in f64.
    pub fn row(&self, index: usize, rows: PixelRows) -> [f64; 4] {
        match self {
            Self::Block(block) => block[index].map(f64::from),
            Self::Blocks(sums) => sums.rounded_row(index, rows),
        }
    }
}

/// The mean of a row of totals with a weight of 1, or zeros.
fn mean(row: [i128; 4]) -> [f32; 4] {
    let [r, g, b, weight] = row.map(|sum| sum as f64 * UNIT);
    // With more than one block of samples the weights do not cancel.
    let scale = 1.0 / weight.max(1.0);
    let any = if weight == 0.0 { 0.0 } else { 1.0 };
    [r * scale, g * scale, b * scale, any].map(|c| c as f32)
}

fn add_blocks(totals: &mut [[i128; 4]], block: &[[f32; 4]], rows: PixelRows) {
    let pixels = totals.chunks_exact_mut(rows.count);
    for (totals, block) in pixels.zip(block.chunks_exact(rows.count)) {
        rows.add(totals, |index| rows.exact(index, block[index]));
    }
}

/// The sum of a block, rounded to units of 2^-50.
fn exact(sum: f32) -> i128 {
    let scaled = f64::from(sum) / UNIT;
    (scaled.round() as i128).clamp(-LARGEST, LARGEST)
}

/// Makes the pixels of a rectangle (x, y, width, height) of a picture from the rows of their sums, by all cores. `whole` is
/// the rectangle of the picture.
pub fn fill_rectangle<T: Send>(
    picture: &mut [T],
    whole: [u32; 4],
    region: [u32; 4],
    (sums, rows): (&Sums, PixelRows),
    make: impl Fn(&[[f64; 4]]) -> T + Sync,
) {
    let [left, top, full, _] = whole.map(|number| number as usize);
    let [x, y, width, height] = region.map(|number| number as usize);
    let lines = &mut picture[(y - top) * full..][..height * full];
    let count = threads::chunk_len(width * height).div_ceil(width);
    threads::for_each(
        lines.chunks_mut(count * full).enumerate(),
        |(index, lines)| {
            let mut pixel_rows = Vec::new();
            for (row, line) in (index * count..).zip(lines.chunks_exact_mut(full)) {
                for (column, pixel) in line[x - left..][..width].iter_mut().enumerate() {
                    sums.round_pixel(row * width + column, rows, &mut pixel_rows);
                    *pixel = make(&pixel_rows);
                }
            }
        },
    );
}
