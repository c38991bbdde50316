//! The table from which paths sample a picture in the background in proportion to its luminance above the mean.
//!
//! It is a tree of sums over a grid of directions, see `shaders/lib/quad_warp.wesl`: the word of the root, the words of
//! each level row by row from the lowest elevation on, and then the density of each cell as a float. The sun of a sky is not in
//! it, but has a part of the samples.

use super::picture::PackedPicture;
use super::{PackedScene, light_cluster::LUMINANCE};
use glam::Vec3;
use glimray_scene::{self as scene, Background, LARGEST_TEXEL, Picture, Scene, sky};
use std::f64::consts::PI;
use std::sync::Arc;

/// The grid has at most 2 to this power rows.
const MAX_LEVELS: u32 = 10;

/// The grid has 2 to this power times as many rows as the picture: the edge of a sun goes through cells, and what
/// differs within a cell is noise.
const FINER_LEVELS: u32 = 2;

/// The grid of a sky has 2 to this power rows: it is smooth, as its sun is not in the picture.
const SKY_LEVELS: u32 = 7;

/// A picture has no table if the variance of its luminance over all directions, divided by the square of the mean, is less
/// than this: paths find its light so well that a second ray at each surface does not pay (`benches/log/2026-11.md`,
/// 2026-11-28). A gradient from black has 1/3.
const LEAST_VARIANCE: f64 = 0.5;

/// A chance is a multiple of 1 divided by this.
const STEPS: u32 = 1023;

/// The smallest density of a cell with light.
const LEAST_DENSITY: f64 = 1e-30;

/// A picture in the background.
#[derive(Clone, Debug)]
pub struct Environment {
    /// Index of the picture in the scene.
    index: usize,
    picture: Arc<Picture>,
    /// The largest value of its texels that is shown.
    largest: f32,
    /// The table that samples it; `None` if light samples do not pay.
    table: Option<Table>,
}

/// The table of a picture.
#[derive(Clone, Debug)]
pub struct Table {
    /// Tree and densities.
    pub words: Arc<[u32]>,
    /// Columns of the grid.
    pub width: u32,
    /// The part of the light of the background for which there are light samples.
    pub part: f64,
    /// The part of these that are of the sun of a sky.
    pub sun_chance: f64,
}

/// The picture in the scene's background, if there is one. What is known of it from `before` is reused if that is the same.
pub fn of_scene(
    scene: &Scene,
    packed: &[PackedPicture],
    before: Option<&Environment>,
) -> Option<Environment> {
    let Background::Picture { picture: index, .. } = scene.background else {
        return None;
    };
    let picture = &scene.pictures[index];
    let largest = LARGEST_TEXEL * packed[index].scale;
    let is_same =
        |known: &&Environment| Arc::ptr_eq(&known.picture, picture) && known.largest == largest;
    if let Some(known) = before.filter(is_same) {
        return Some(Environment {
            index,
            ..known.clone()
        });
    }
    Some(Environment {
        index,
        picture: picture.clone(),
        largest,
        table: table_of(picture, largest),
    })
}

/// The table of a picture; `None` if that is about as bright everywhere. Skies with a sun have one.
fn table_of(picture: &Picture, largest: f32) -> Option<Table> {
    let sun = sky::sun_of(picture);
    let levels = match sun {
        Some(_) => SKY_LEVELS,
        None => (picture.height.next_power_of_two().ilog2() + FINER_LEVELS).min(MAX_LEVELS),
    };
    let width = 2 << levels;
    let mut weights = weights(picture, largest, levels);
    // Weights add up to the mean luminance times the columns.
    let sun = sun.map_or(0.0, |sun| {
        f64::from(width) * sky::SUN_SOLID_ANGLE / (4.0 * PI) * sun.radiance.dot(scene::LUMINANCE)
    });
    let total = weights.iter().sum::<f64>() + sun;
    let pays = sun > 0.0 || relative_variance(&weights, levels) > LEAST_VARIANCE;
    compensate(&mut weights, levels);
    let samples = weights.iter().sum::<f64>() + sun;
    (pays && samples > 0.0).then(|| Table {
        words: words(weights, levels).into(),
        width,
        part: samples / total,
        sun_chance: sun / samples,
    })
}

impl Environment {
    /// The table for light samples.
    pub fn table(&self) -> Option<&Table> {
        self.table.as_ref()
    }
}

impl PackedScene {
    /// The index of the first word of the tables of albedos, which come before that of the environment.
    pub(super) fn albedo_first(&self) -> u32 {
        self.environment_first() - super::albedo::words().len() as u32
    }

    /// The index of the first word of the table of the environment.
    pub(super) fn environment_first(&self) -> u32 {
        let table = self.environment.as_ref().and_then(Environment::table);
        (self.texels.len() - table.map_or(0, |table| table.words.len())) as u32
    }

    /// The table of a background; `None` if light samples find no light in it.
    pub(super) fn environment_of(&self, background: &Background) -> Option<&Table> {
        let environment = self.environment.as_ref()?;
        match *background {
            Background::Picture {
                picture, strength, ..
            } if picture == environment.index && strength > 0.0 => environment.table(),
            _ => None,
        }
    }
}

/// The light of a row of cells that a texel has.
struct Spread {
    /// The first cell that it lights. Beyond the last one the row begins anew.
    first: usize,
    /// The integrals of its weight in linear interpolation over that cell and those after it, in cells.
    parts: Vec<f32>,
}

/// How `from` texels spread over as many cells as `to`. The first and the last texel are neighbours if the row
/// `wraps`, otherwise they go on to its ends.
fn spreads(from: u32, to: u32, wraps: bool) -> Vec<Spread> {
    let scale = f64::from(to) / f64::from(from);
    // The integral of the weight of a texel up to a distance from its centre, in texels: from 0 at -1 to 1 at 1.
    let integral = |distance: f64| {
        let d = distance.clamp(-1.0, 1.0);
        0.5 + d - 0.5 * d * d.abs()
    };
    let spread = |index: u32| {
        let center = f64::from(index) + 0.5;
        let start = ((center - 1.0) * scale).floor();
        let end = ((center + 1.0) * scale).ceil();
        let weight = |cell: i64, own: f64| {
            let edges = [cell as f64, (cell + 1) as f64].map(|edge| edge / scale - own);
            scale * (integral(edges[1]) - integral(edges[0]))
        };
        let part = |cell: i64| {
            // At an end of the row the texel stands for those beyond it too.
            let before = if index == 0 && !wraps {
                weight(cell, center - 1.0)
            } else {
                0.0
            };
            let after = if index + 1 == from && !wraps {
                weight(cell, center + 1.0)
            } else {
                0.0
            };
            (weight(cell, center) + before + after) as f32
        };
        let cells = match wraps {
            true => start as i64..end as i64,
            false => (start as i64).max(0)..(end as i64).min(i64::from(to)),
        };
        Spread {
            first: cells.start.rem_euclid(i64::from(to)) as usize,
            parts: cells.map(part).collect(),
        }
    };
    (0..from).map(spread).collect()
}

/// The luminance that each cell of the grid sends, up to a common factor, row by row from the lowest elevation on.
/// The picture is interpolated as lookups do, so that no cell that looks bright anywhere is without weight.
fn weights(picture: &Picture, largest: f32, levels: u32) -> Vec<f64> {
    let (width, height) = (picture.width as usize, picture.height as usize);
    let (columns, rows) = (2_usize << levels, 1_usize << levels);
    let largest = Vec3::splat(largest);
    let luminance = |texel: glam::Vec4| LUMINANCE.dot(texel.truncate().min(largest));
    let texels: Vec<f32> = picture.linear().map(luminance).collect();
    let across = spreads(picture.width, columns as u32, true);
    let up = spreads(picture.height, rows as u32, false);
    let mut sums = vec![0.0_f64; columns * rows];
    let mut cells = vec![0.0_f32; columns];
    for (y, rise) in up.iter().enumerate() {
        // Texels are stored from the top row down.
        let line = &texels[(height - 1 - y) * width..][..width];
        cells.fill(0.0);
        for (texel, spread) in line.iter().zip(&across) {
            let mut cell = spread.first;
            for part in &spread.parts {
                cells[cell] += part * texel;
                cell = if cell + 1 == columns { 0 } else { cell + 1 };
            }
        }
        for (sums, part) in sums.chunks_mut(columns).skip(rise.first).zip(&rise.parts) {
            for (sum, cell) in sums.iter_mut().zip(&cells) {
                *sum += f64::from(part * cell);
            }
        }
    }
    for (line, band) in sums.chunks_mut(columns).zip(bands(levels)) {
        line.iter_mut().for_each(|sum| *sum *= band);
    }
    sums
}

/// The variance of the luminance over all directions, divided by the square of its mean; 0 without light.
fn relative_variance(weights: &[f64], levels: u32) -> f64 {
    let columns = 2 << levels;
    let lines = weights.chunks(columns).zip(bands(levels));
    let squares = lines.map(|(line, band)| {
        line.iter()
            .map(|weight| weight * weight / band)
            .sum::<f64>()
    });
    let mean = weights.iter().sum::<f64>() / columns as f64;
    let mean_square = squares.sum::<f64>() / columns as f64;
    if mean > 0.0 {
        mean_square / (mean * mean) - 1.0
    } else {
        0.0
    }
}

/// Takes the mean radiance off these weights. Paths find light of the mean radiance by themselves, so light samples are for
/// what is brighter (Karlík et al. 2019, MIS Compensation).
fn compensate(weights: &mut [f64], levels: u32) {
    let total: f64 = weights.iter().sum();
    for (line, band) in weights.chunks_mut(2 << levels).zip(bands(levels)) {
        let mean = total * band / line.len() as f64;
        line.iter_mut()
            .for_each(|weight| *weight = (*weight - mean).max(0.0));
    }
}

/// The part of all directions that is in each row of the grid.
fn bands(levels: u32) -> impl Iterator<Item = f64> {
    let rows = 1_u32 << levels;
    let sine_at = move |edge: u32| (PI * (f64::from(edge) / f64::from(rows) - 0.5)).sin();
    (0..rows).map(move |row| (sine_at(row + 1) - sine_at(row)) / 2.0)
}

/// The part `first` of the sum in steps: 0 or all of them only if the one or the other half has nothing.
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

/// The table of these weights, of which some is more than 0.
fn words(weights: Vec<f64>, levels: u32) -> Vec<u32> {
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
    let root = steps(pyramid[0][0], pyramid[0][1]);
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
    words
}
