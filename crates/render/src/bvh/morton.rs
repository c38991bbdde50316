//! Morton codes: boxes whose codes are near each other are mostly near each other in space.

use super::Aabb;
use glam::DVec3;

/// Bits of a code for each axis.
const BITS: u32 = 21;

/// Bits of a code.
pub const CODE_BITS: u32 = 3 * BITS;

/// Cells round some boxes.
pub struct Cells {
    low: DVec3,
    /// Cells per unit, on all axes: neighbours in cubic cells have smaller joint boxes than those in flat ones.
    per_unit: f64,
}

impl Cells {
    /// The cells round at least one box.
    pub fn round(boxes: &[Aabb]) -> Self {
        let all = boxes[1..].iter().fold(boxes[0], |a, b| a.union(*b));
        let low = all.min.as_dvec3();
        let extent = (all.max.as_dvec3() - low).max_element();
        Self {
            low,
            per_unit: f64::from((1 << BITS) - 1) / extent.max(f64::from(f32::MIN_POSITIVE)),
        }
    }

    /// The code of the cell of a box's centre, of [`CODE_BITS`] bits. Its upper bits are the code in larger cells.
    pub fn code(&self, aabb: &Aabb) -> u64 {
        let center = (aabb.min.as_dvec3() + aabb.max.as_dvec3()) * 0.5;
        let cell = (center - self.low) * self.per_unit;
        let [x, y, z] = cell.to_array().map(|c| spread_bits(c as u64));
        x | y << 1 | z << 2
    }
}

/// Spreads [`BITS`] bits out to every third bit.
fn spread_bits(x: u64) -> u64 {
    let x = (x | x << 32) & 0x001f_0000_0000_ffff;
    let x = (x | x << 16) & 0x001f_0000_ff00_00ff;
    let x = (x | x << 8) & 0x100f_00f0_0f00_f00f;
    let x = (x | x << 4) & 0x10c3_0c30_c30c_30c3;
    (x | x << 2) & 0x1249_2492_4924_9249
}
