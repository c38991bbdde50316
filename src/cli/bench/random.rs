//! Random numbers that are the same on every machine.

use glam::{DVec3, dvec3};

/// A sequence of random numbers (SplitMix64 by Steele and Vigna). Results are computed with operations that
/// IEEE 754 rounds correctly, without functions of a mathematics library.
#[derive(Clone, Debug)]
pub struct Random(u64);

const GAMMA: u64 = 0x9E37_79B9_7F4A_7C15;

impl Random {
    /// The sequence with this seed.
    pub fn new(seed: u64) -> Self {
        Self(seed)
    }

    /// The sequence for item `index` of a series. Sequences of different items are independent.
    pub fn of(series: u64, index: u64) -> Self {
        Self(mixed(mixed(series.wrapping_add(GAMMA)).wrapping_add(index)))
    }

    /// A number in 0..1.
    pub fn unit(&mut self) -> f64 {
        self.0 = self.0.wrapping_add(GAMMA);
        (mixed(self.0) >> 11) as f64 / (1_u64 << 53) as f64
    }

    /// A number in `low..high`.
    pub fn between(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * self.unit()
    }

    /// A point in the box from `low` to `high`.
    pub fn point(&mut self, low: DVec3, high: DVec3) -> DVec3 {
        let [x, y, z] = [self.unit(), self.unit(), self.unit()];
        low + (high - low) * dvec3(x, y, z)
    }

    /// A unit vector, uniform over all directions.
    pub fn direction(&mut self) -> DVec3 {
        loop {
            let point = self.point(DVec3::NEG_ONE, DVec3::ONE);
            let square = point.length_squared();
            if square <= 1.0 && square > 1e-6 {
                return point / square.sqrt();
            }
        }
    }

    /// A unit vector around the unit vector `normal`, distributed by the cosine of the angle between them.
    pub fn cosine(&mut self, normal: DVec3) -> DVec3 {
        // A point on a sphere that touches the surface, seen from the point of contact.
        let sum = normal + self.direction();
        sum.try_normalize().unwrap_or(normal)
    }
}

/// A bijection that changes about half of the bits when one bit of its argument changes.
fn mixed(bits: u64) -> u64 {
    let bits = (bits ^ (bits >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
    let bits = (bits ^ (bits >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
    bits ^ (bits >> 31)
}

/// About sin(2π `turns`), within 0.001: a parabola with a correction.
pub fn sine(turns: f64) -> f64 {
    let within = turns - turns.floor();
    let half = if within < 0.5 { within } else { within - 1.0 };
    // From −1 to 1 over the period.
    let x = 2.0 * half;
    let parabola = 4.0 * x * (1.0 - x.abs());
    0.225 * (parabola * parabola.abs() - parabola) + parabola
}
