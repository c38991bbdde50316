//! The table from which paths sample a picture in the background in proportion to its luminance.
//!
//! It is a tree of sums over a grid of directions, see `shaders/lib/quad_warp.wesl`: the word of the root, the words of
//! each level row by row from the lowest elevation on, and then the density of each cell as a float.

use super::{PackedScene, light_cluster::LUMINANCE};
use crate::scene::{Background, Picture, Scene};
use glam::Vec3;
use half::f16;
use std::f64::consts::PI;
use std::sync::Arc;

/// The grid has at most 2 to this power rows.
const MAX_LEVELS: u32 = 9;

/// A chance is a multiple of 1 divided by this.
const STEPS: u32 = 1023;

/// The smallest density of a cell with light.
const LEAST_DENSITY: f64 = 1e-30;

/// The table of a picture.
#[derive(Clone, Debug)]
pub struct Environment {
    /// Its index in the scene.
    index: usize,
    picture: Arc<Picture>,
    /// Tree and densities.
    pub words: Arc<[u32]>,
    /// Columns of the grid.
    width: u32,
}

/// The table of the scene's background; `None` if that is no picture, or a black one. The table `before` is reused if
/// it is of the same picture.
pub fn of_scene(scene: &Scene, before: Option<&Environment>) -> Option<Environment> {
    let Background::Picture { picture: index, .. } = scene.background else {
        return None;
    };
    let picture = &scene.pictures[index];
    if let Some(known) = before.filter(|known| Arc::ptr_eq(&known.picture, picture)) {
        return Some(Environment {
            index,
            ..known.clone()
        });
    }
    let levels = (picture.height.max(2).next_power_of_two().ilog2()).min(MAX_LEVELS);
    Some(Environment {
        index,
        picture: picture.clone(),
        words: words(weights(picture, levels), levels)?.into(),
        width: 2 << levels,
    })
}

impl PackedScene {
    /// The index of the first word of the tables of albedos, which come before that of the environment.
    pub(super) fn albedo_first(&self) -> u32 {
        let table = self
            .environment
            .as_ref()
            .map_or(0, |table| table.words.len());
        (self.texels.len() - table - super::albedo::words().len()) as u32
    }

    /// The first word and the columns of the table of a background; `None` if there is none, or no light in it.
    pub(super) fn environment_of(&self, background: &Background) -> Option<(u32, u32)> {
        let table = self.environment.as_ref()?;
        match *background {
            Background::Picture {
                picture, strength, ..
            } if picture == table.index && strength > 0.0 => {
                let first = self.texels.len() - table.words.len();
                Some((first as u32, table.width))
            }
            _ => None,
        }
    }
}

/// The parts of the cells of a row of `to` that each texel of a row of `from` covers, in texels: for each texel its
/// first cell, and the part in that and in those after it.
fn overlaps(from: u32, to: u32) -> Vec<(usize, Vec<f32>)> {
    let scale = f64::from(to) / f64::from(from);
    let texel = |index: u32| {
        let (start, end) = (f64::from(index) * scale, f64::from(index + 1) * scale);
        let first = start as u32;
        let last = (end.ceil() as u32).clamp(first + 1, to);
        let part = |cell: u32| (f64::from(cell + 1).min(end) - f64::from(cell).max(start)).max(0.0);
        let parts = (first..last).map(|cell| part(cell) as f32).collect();
        (first as usize, parts)
    };
    (0..from).map(texel).collect()
}

/// The luminance that each cell of the grid sends, up to a common factor, row by row from the lowest elevation on.
/// The picture is filtered as lookups do, so that no cell that looks bright anywhere is without weight.
fn weights(picture: &Picture, levels: u32) -> Vec<f64> {
    let (width, height) = (picture.width as usize, picture.height as usize);
    let (columns, rows) = (2_usize << levels, 1_usize << levels);
    let largest = Vec3::splat(f16::MAX.to_f32());
    let luminance = |texel: glam::Vec4| LUMINANCE.dot(texel.truncate().min(largest));
    let texels: Vec<f32> = picture.linear().map(luminance).collect();
    let across = overlaps(picture.width, columns as u32);
    let up = overlaps(picture.height, rows as u32);
    let mut sums = vec![0.0_f64; columns * rows];
    let mut row = vec![0.0_f32; width];
    let mut cells = vec![0.0_f32; columns];
    // The mean of a linear interpolation over a texel has the weights 1, 6 and 1 of the texel and its neighbours.
    let mean = |before: f32, own: f32, after: f32| (before + 6.0 * own + after) / 8.0;
    for (y, (first_row, parts_up)) in up.iter().enumerate() {
        // Texels are stored from the top row down.
        let line = |y: usize| &texels[(height - 1 - y) * width..][..width];
        let (below, own) = (line(y.saturating_sub(1)), line(y));
        let above = line((y + 1).min(height - 1));
        for (x, value) in row.iter_mut().enumerate() {
            *value = mean(below[x], own[x], above[x]);
        }
        cells.fill(0.0);
        for (x, (first, parts)) in across.iter().enumerate() {
            let before = row[(x + width - 1) % width];
            let value = mean(before, row[x], row[(x + 1) % width]);
            for (cell, part) in cells[*first..].iter_mut().zip(parts) {
                *cell += part * value;
            }
        }
        for (index, part) in (*first_row..).zip(parts_up) {
            let sums = &mut sums[index * columns..][..columns];
            for (sum, cell) in sums.iter_mut().zip(&cells) {
                *sum += f64::from(part * cell);
            }
        }
    }
    for (index, line) in sums.chunks_mut(columns).enumerate() {
        let sine_at = |edge: usize| (PI * (edge as f64 / rows as f64 - 0.5)).sin();
        let band = sine_at(index + 1) - sine_at(index);
        line.iter_mut().for_each(|sum| *sum *= band);
    }
    sums
}

/// Of `total`, the part `first` in steps: 0 or all of them only if the one or the other half has nothing.
fn steps(first: f64, second: f64) -> u32 {
    match (first > 0.0, second > 0.0) {
        (_, false) => STEPS,
        (false, true) => 0,
        (true, true) => {
            let exact = first / (first + second) * f64::from(STEPS);
            (exact.round() as u32).clamp(1, STEPS - 1)
        }
    }
}

/// The chances of both halves.
fn chances(steps: u32) -> [f64; 2] {
    let first = f64::from(steps) / f64::from(STEPS);
    [first, f64::from(STEPS - steps) / f64::from(STEPS)]
}

/// The table of these weights; `None` if all are 0.
fn words(weights: Vec<f64>, levels: u32) -> Option<Vec<u32>> {
    // From the cells up to the two halves of the root.
    let mut pyramid = vec![weights];
    for level in (0..levels).rev() {
        let columns = 2_usize << level;
        let finer = &pyramid[pyramid.len() - 1];
        let sum = |index: usize| {
            let at = 4 * columns * (index / columns) + 2 * (index % columns);
            let upper = at + 2 * columns;
            finer[at] + finer[at + 1] + finer[upper] + finer[upper + 1]
        };
        let sums = (0..columns << level).map(sum).collect();
        pyramid.push(sums);
    }
    pyramid.reverse();
    let halves = &pyramid[0];
    if halves[0] + halves[1] <= 0.0 {
        return None;
    }
    let root = steps(halves[0], halves[1]);
    let mut words = vec![root];
    let mut probabilities = chances(root).to_vec();
    for level in 0..levels {
        let columns = 2_usize << level;
        let finer = &pyramid[level as usize + 1];
        let mut next = vec![0.0; 4 * probabilities.len()];
        for (index, probability) in probabilities.iter().enumerate() {
            let at = 4 * columns * (index / columns) + 2 * (index % columns);
            let starts = [at, at + 2 * columns];
            let sums = starts.map(|start| [finer[start], finer[start + 1]]);
            let rows = steps(sums[0].iter().sum(), sums[1].iter().sum());
            let parts = sums.map(|[left, right]| steps(left, right));
            words.push(rows | parts[0] << 10 | parts[1] << 20);
            for ((start, row), part) in starts.into_iter().zip(chances(rows)).zip(parts) {
                let [left, right] = chances(part);
                next[start] = probability * row * left;
                next[start + 1] = probability * row * right;
            }
        }
        probabilities = next;
    }
    let cell_count = probabilities.len() as f64;
    words.extend(probabilities.into_iter().map(|probability| {
        let density = match probability > 0.0 {
            true => (probability * cell_count).max(LEAST_DENSITY),
            false => 0.0,
        };
        (density as f32).to_bits()
    }));
    Some(words)
}
