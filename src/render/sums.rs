//! Sums of samples that are the same in whatever order they come together.
//!
//! The GPU adds the samples of a block one after the other to f32 sums, always in the same order. Blocks
//! are added as integers, which are associative and commutative: so any cut of a picture between blocks,
//! merged in any order, has the bits of one run.

/// Samples of a pixel that are summed in f32. A picture can be cut at multiples of it; the last block of a
/// picture may be shorter.
pub const SAMPLE_BLOCK: u32 = 64;

/// Bits of an exact sum below 1.
const FRACTION_BITS: i32 = 50;
/// The largest exact sum of a block, 2^50: a larger one counts as this one. That leaves room for the sums of
/// 2^26 blocks, which are all that a picture can have.
pub(super) const LARGEST: i128 = 1 << 100;
const UNIT: f64 = 1.0 / (1_u64 << FRACTION_BITS) as f64;

/// Sums of some pixels, in rows of four for each layer of each pixel.
#[derive(Clone, Debug, PartialEq)]
pub enum Sums {
    /// Of one block, as the GPU has added them.
    Block(Vec<[f32; 4]>),
    /// Of several blocks, in units of 2^-50.
    Totals(Vec<[i128; 4]>),
}

impl Sums {
    /// So many rows of zeros, of one block or of several.
    pub fn zeros(rows: usize, is_block: bool) -> Self {
        match is_block {
            true => Self::Block(vec![[0.0; 4]; rows]),
            false => Self::Totals(vec![[0; 4]; rows]),
        }
    }

    /// These sums, if there are any, and those of another block with as many rows.
    pub fn with_block(sums: Option<Self>, block: &[[f32; 4]]) -> Self {
        let mut totals = match sums {
            None => return Self::Block(block.to_vec()),
            Some(Self::Block(first)) => first.into_iter().map(|row| row.map(exact)).collect(),
            Some(Self::Totals(totals)) => totals,
        };
        add_blocks(&mut totals, block);
        Self::Totals(totals)
    }

    /// Adds rows of other sums to those from `to` on. To sums of one block they are the first.
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
            // Several blocks never become one.
            (Self::Block(_), Self::Totals(_)) => {}
        }
    }

    /// The sums as they are where one block holds them all, else means and ones; zeros where there are no
    /// samples, as in what pads tiles.
    pub fn developable(&self) -> Vec<[f32; 4]> {
        match self {
            Self::Block(block) => block.clone(),
            Self::Totals(totals) => (totals.iter())
                .map(|row| {
                    let [r, g, b, weight] = row.map(|sum| sum as f64 * UNIT);
                    // More than a block of samples: their weights do not cancel.
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

/// The sum of a block in units of 2^-50, to the nearest.
fn exact(sum: f32) -> i128 {
    let scaled = f64::from(sum) / UNIT;
    (scaled.round() as i128).clamp(-LARGEST, LARGEST)
}
