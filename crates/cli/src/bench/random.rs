//! Random numbers, points and directions of scenes and rays.

use glam::{DVec3, dvec3};
use glimray_scene::random::{GAMMA, SplitMix64, mixed};

/// A sequence of random numbers. Results are computed with operations that IEEE 754 rounds correctly, without
/// functions of a mathematics library.
#[derive(Clone, Debug)]
pub struct Random(SplitMix64);

impl Random {
    /// The sequence with this seed.
    pub fn new(seed: u64) -> Self {
        Self(SplitMix64::new(seed))
    }

    /// The sequence for item `index` of a series. Sequences of different items are independent.
    pub fn of(series: u64, index: u64) -> Self {
        Self::new(mixed(mixed(series.wrapping_add(GAMMA)).wrapping_add(index)))
    }

    /// A number in 0..1.
    pub fn unit(&mut self) -> f64 {
        self.0.unit()
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

/// About sin(2π `turns`), within 0.001: a parabola with a correction.
pub fn sine(turns: f64) -> f64 {
    let within = turns - turns.floor();
    let half = if within < 0.5 { within } else { within - 1.0 };
    // From −1 to 1 over the period.
    let x = 2.0 * half;
    let parabola = 4.0 * x * (1.0 - x.abs());
    0.225 * (parabola * parabola.abs() - parabola) + parabola
}
