//! Height fields: triangles of one size, most of them visible.

use super::{Detail, of_mesh, parts::Builder};
use crate::bench::random::{Random, sine};
use glam::dvec3;
use glimray_scene::{Mesh, Scene};

/// Number of octaves of the terrain.
const OCTAVES: u32 = 10;

/// A height field of 180,000 triangles over the unit square.
pub fn height_field(detail: Detail) -> Scene {
    let quads = detail.of(300, 30);
    let view = [dvec3(0.55, 0.45, 0.75), dvec3(0.0, -0.05, 0.0)];
    of_mesh(hills(quads, quads, 0.0), view, dvec3(1.0, 0.9, -0.6))
}

/// A height field of `columns` × `rows` quads over the unit square. `shift` varies its shape.
pub fn hills(columns: u32, rows: u32, shift: f64) -> Mesh {
    let height = |x: f64, z: f64| {
        let x = x + shift;
        0.06 * sine(2.0 * x) * sine(3.0 * z + 0.25) + 0.01 * sine(17.0 * (x + z))
    };
    let at = |i: u32, count: u32| f64::from(i) / f64::from(count) - 0.5;
    let mut builder = Builder::default();
    builder.grid(columns, rows, |i, j| {
        let (x, z) = (at(i, columns), at(j, rows));
        dvec3(x, height(x, z), z)
    });
    builder.mesh()
}

/// A rugged terrain of 4,000,000 triangles, twice as long as wide.
pub fn terrain(detail: Detail) -> Scene {
    let (columns, rows) = detail.of((2000, 1000), (200, 100));
    let at = |i: u32, j: u32| {
        let (x, z) = (
            f64::from(i) / f64::from(rows),
            f64::from(j) / f64::from(rows),
        );
        dvec3(x - 1.0, 0.25 * fractal(x, z), z - 0.5)
    };
    let mut builder = Builder::default();
    builder.grid(columns, rows, at);
    let view = [dvec3(-1.1, 0.45, 0.6), dvec3(0.1, 0.0, -0.1)];
    of_mesh(builder.mesh(), view, dvec3(1.0, 2.0, 1.0))
}

/// Octaves of value noise, each of half the size and half the height of the one before: within −1 to 1.
fn fractal(x: f64, z: f64) -> f64 {
    let octave = |k: u32| {
        let frequency = f64::from(4 << k);
        noise(k, frequency * x, frequency * z) / f64::from(2_u32 << k)
    };
    (0..OCTAVES).map(octave).sum()
}

/// Value noise on the integer lattice, smoothly interpolated: within −1 to 1.
fn noise(octave: u32, x: f64, z: f64) -> f64 {
    let (left, near) = (x.floor(), z.floor());
    let smooth = |t: f64| t * t * (3.0 - 2.0 * t);
    let (u, v) = (smooth(x - left), smooth(z - near));
    let value = |i: f64, j: f64| {
        let index = (left + i) as u64 + ((near + j) as u64) * 1_000_003;
        Random::of(octave.into(), index).between(-1.0, 1.0)
    };
    let row = |j: f64| value(0.0, j) * (1.0 - u) + value(1.0, j) * u;
    row(0.0) * (1.0 - v) + row(1.0) * v
}
