//! Sums of samples that do not depend on the order of addition.
//!
//! The GPU adds the samples of a block one after the other to f32 sums, always in the same order. Blocks are
//! added as integers, for which addition is associative and commutative. Any split of a picture between blocks,
//! merged in any order, therefore has the same bits as a single run.

/// Samples of a pixel that are summed in f32. A picture can be split at multiples of this number; the last
/// block of a picture may be shorter.
pub const SAMPLE_BLOCK: u32 = 64;

/// Fraction bits of an exact sum.
const FRACTION_BITS: i32 = 50;
/// The largest exact sum of a block, 2^50; larger sums are clamped. That leaves room for the sums of 2^26
/// blocks, the maximum of a picture.
pub(super) const LARGEST: i128 = 1 << 100;
const UNIT: f64 = 1.0 / (1_u64 << FRACTION_BITS) as f64;

/// Sums of pixels, in rows of four for each layer of each pixel.
#[derive(Clone, Debug, PartialEq)]
pub enum Sums {
    /// The sums of one block, as added by the GPU.
    Block(Vec<[f32; 4]>),
    /// The sums of several blocks, in units of 2^-50.
    Totals(Vec<[i128; 4]>),
}

impl Sums {
    /// `rows` rows of zeros, of one block or of several.
    pub fn zeros(rows: usize, is_block: bool) -> Self {
        match is_block {
            true => Self::Block(vec![[0.0; 4]; rows]),
            false => Self::Totals(vec![[0; 4]; rows]),
        }
    }

    /// The total of these sums, if any, and another block with as many rows.
    pub fn with_block(sums: Option<Self>, block: &[[f32; 4]]) -> Self {
        let mut totals = match sums {
            None => return Self::Block(block.to_vec()),
            Some(Self::Block(first)) => first.into_iter().map(|row| row.map(exact)).collect(),
            Some(Self::Totals(totals)) => totals,
        };
        add_blocks(&mut totals, block);
        Self::Totals(totals)
    }

    /// Adds `count` rows of `other`, starting at `from`, to the rows starting at `to`. For sums of one block
    /// this is the first addition.
    pub fn add(&mut self, to: usize, other: &Self, from: usize, count: usize) {
        match (self, other) {
            (Self::Block(own), Self::Block(other)) => {
                own[to..to + count].copy_from_slice(&other[from..from + count]);
            }
            (Self::Totals(own), Self::Block(other)) => {
                add_blocks(&mut own[to..to + count], &other[from..from + count]);
            }
            (Self::Totals(own), Self::Totals(other)) => {
                for (own, other) in own[to..].iter_mut().zip(&other[from..from + count]) {
                    for (own, other) in own.iter_mut().zip(other) {
                        *own += other;
                    }
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
            Self::Totals(totals) => (totals.iter())
                .map(|row| {
                    let [r, g, b, weight] = row.map(|sum| sum as f64 * UNIT);
                    // With more than one block of samples the weights do not cancel.
                    let scale = 1.0 / weight.max(1.0);
                    let any = if weight == 0.0 { 0.0 } else { 1.0 };
                    [r * scale, g * scale, b * scale, any].map(|c| c as f32)
                })
                .collect(),
        }
    }

    /// The sums in f64.
    pub fn rounded(&self) -> Vec<[f64; 4]> {
        match self {
            Self::Block(block) => block.iter().map(|row| row.map(f64::from)).collect(),
            Self::Totals(totals) => (totals.iter())
                .map(|row| row.map(|sum| sum as f64 * UNIT))
                .collect(),
        }
    }
}

fn add_blocks(totals: &mut [[i128; 4]], block: &[[f32; 4]]) {
    for (total, sum) in totals.iter_mut().zip(block) {
        for (total, sum) in total.iter_mut().zip(sum) {
            *total += exact(*sum);
        }
    }
}

/// The sum of a block, rounded to units of 2^-50.
fn exact(sum: f32) -> i128 {
    let scaled = f64::from(sum) / UNIT;
    (scaled.round() as i128).clamp(-LARGEST, LARGEST)
}
