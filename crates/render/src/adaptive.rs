//! Adaptive sampling: decides after each round which pixels need more samples.

mod addition;
mod choice;
mod saved;
mod statistics;
#[cfg(test)]
mod tests;

use super::{
    Integrator,
    film_tile::{FilmTile, GroupOrder},
    layers::{self, COUNT, FIRST, Layer, RADIANCE, SQUARES},
    settings::RenderSettings,
    sums::PixelRows,
};
use bytemuck::allocation::zeroed_vec;
use statistics::{Estimate, Measure, PixelStatistics, compressed};
use std::ops::Range;

/// Samples in the first round; each later round doubles the samples of a pixel.
const FIRST_SAMPLES: u32 = 4;

/// Paths in the first round: few of them find a small lamp, and those that do not agree with each other.
const FIRST_PATHS: u32 = 16;

/// Rounds in which pixels compare with their neighbours. A difference propagates by one pixel per round, so
/// this is its maximum distance and the width of the margin around a crop.
const NEIGHBOUR_ROUNDS: u32 = 32;

/// Pixels are considered in square groups with this side.
const GROUP_SIDE: usize = 8;

/// The accumulated statistics of all rounds, for each pixel of the region.
///
/// A pixel compares with its neighbours, which compared with theirs in the previous round, so it depends on all
/// pixels within as many steps as there are such rounds. A margin of that width is sampled around a crop, so
/// that the crop has the same pixels as the whole picture. Pixels of the margin take part as long as the crop
/// depends on them.
#[derive(Clone, Debug)]
pub struct Adaptive {
    /// The crop and its margin: x, y, width, height.
    region: [u32; 4],
    /// The requested part, in the same coordinates.
    crop: [u32; 4],
    measure: Measure,
    samples: u32,
    /// Samples in the first round.
    first_samples: u32,
    /// Rounds after the first.
    rounds: u32,
    /// Maximum number of pixels of a film tile.
    tile_pixels: usize,
    order: GroupOrder,
    layers: &'static [&'static Layer],
    pixels: Vec<PixelStatistics>,
    /// The rows of all pixels as in film tiles, for films with features or opacity; otherwise empty.
    features: Vec<[f64; 4]>,
    /// The estimates of all pixels.
    estimates: Vec<Estimate>,
    /// For each group of pixels whether the last round sampled some of it.
    sampled: Vec<bool>,
    /// The range of samples of the most sampled pixels in this round.
    front: Range<u32>,
}

impl Adaptive {
    pub fn new(settings: &RenderSettings, tile_side: u32, order: GroupOrder) -> Self {
        let crop = settings.region();
        let (first_samples, brightness): (_, fn(f64) -> f64) = match settings.integrator {
            Integrator::Path => (FIRST_PATHS, compressed),
            _ => (FIRST_SAMPLES, f64::sqrt),
        };
        let first_samples = first_samples.min(settings.samples);
        // With so few samples there is only the first round.
        let has_rounds = settings.samples > first_samples;
        let margin = if has_rounds { NEIGHBOUR_ROUNDS } else { 0 };
        let region = widened(crop, margin, settings.size);
        let [width, height] = [region[2], region[3]].map(|length| length as usize);
        let side = tile_side as usize;
        Self {
            region,
            crop,
            rounds: 0,
            measure: Measure {
                noise: f64::from(settings.noise),
                brightness,
            },
            samples: settings.samples,
            first_samples,
            // The number of rows is that without features.
            tile_pixels: 2 * side * side / layers::rows(layers::of_sampling(settings)),
            order,
            layers: layers::of_sampling(settings),
            features: match settings.has_features() || settings.has_opacity() {
                true => {
                    let rows = layers::rows(layers::of_sampling(settings));
                    zeroed_vec(rows * width * height)
                }
                false => Vec::new(),
            },
            front: 0..first_samples,
            pixels: zeroed_vec(width * height),
            estimates: zeroed_vec(width * height),
            sampled: vec![true; width.div_ceil(GROUP_SIDE) * height.div_ceil(GROUP_SIDE)],
        }
    }

    /// The sampled region: the crop and its margin.
    pub fn region(&self) -> [u32; 4] {
        self.region
    }

    /// The requested region.
    pub fn crop(&self) -> [u32; 4] {
        self.crop
    }

    /// Film tiles over all pixels.
    pub fn first_round(&self, pixels: Vec<[u32; 2]>) -> Vec<FilmTile> {
        self.tiles(pixels, 0..self.first_samples)
    }

    /// Film tiles over the pixels that need more samples, grouped by sample count; empty when all are done. A
    /// round doubles the samples of a pixel.
    pub fn next_round(&mut self) -> Vec<FilmTile> {
        self.rounds += 1;
        let unfinished = self.unfinished_pixels();
        self.sampled.fill(false);
        if let Some((&count, _)) = unfinished.last_key_value() {
            self.front = self.front.end..(2 * count).min(self.samples).max(self.front.end);
        }
        let tiles = |(count, pixels)| self.tiles(pixels, count..(2 * count).min(self.samples));
        unfinished.into_iter().flat_map(tiles).collect()
    }

    /// The progress of the most sampled pixels, in 0..=1.
    pub fn progress(&self, fraction: f64) -> f64 {
        let Range { start, end } = self.front;
        (f64::from(start) + fraction * f64::from(end - start)) / f64::from(self.samples)
    }

    fn tiles(&self, mut pixels: Vec<[u32; 2]>, samples: Range<u32>) -> Vec<FilmTile> {
        let starts = (self.tile_pixels..pixels.len()).step_by(self.tile_pixels);
        let mut lists: Vec<_> = starts.rev().map(|start| pixels.split_off(start)).collect();
        lists.push(pixels);
        let tile = |list| FilmTile::list(list, samples.clone(), self.layers, self.order);
        lists.into_iter().rev().map(tile).collect()
    }

    /// Adds the samples of a finished round.
    pub fn add_round(&mut self, tiles: &[FilmTile]) {
        self.add(tiles, |_| true);
    }

    /// A copy with the samples so far of a round in progress.
    pub fn with_part_of_round(&self, tiles: &[FilmTile]) -> Self {
        let mut so_far = self.clone();
        so_far.add(tiles, |weight| weight != 0.0);
        so_far
    }

    /// Whether the first round, in which all pixels get the same number of samples, is not finished.
    pub fn is_in_first_round(&self) -> bool {
        self.rounds == 0
    }

    /// The mean of a pixel, in the format of a film with one sample; zeros without samples.
    pub fn mean(&self, pixel: [u32; 2]) -> [f32; 4] {
        let statistics = &self.pixels[self.index(pixel)];
        if statistics.count == 0 {
            return [0.0; 4];
        }
        let scale = statistics.scale();
        let [r, g, b] = statistics.sum.map(|c| (c * scale) as f32);
        [r, g, b, 1.0]
    }

    /// For each pixel of the crop its rows of a film: the mean, features if there are any, and a row that starts with
    /// the sample count. The mean has a weight of 1, features have theirs in proportion, and the squares are a mean too.
    pub fn means_and_counts(&self, layers: &[&Layer]) -> Vec<[f32; 4]> {
        let [x, y, width, height] = self.crop;
        let pixels = (y..y + height).flat_map(|y| (x..x + width).map(move |x| [x, y]));
        let mut rows = Vec::with_capacity((width * height) as usize * layers::rows(layers));
        for pixel in pixels {
            for layer in layers {
                if **layer == RADIANCE {
                    rows.push(self.mean(pixel));
                } else if **layer == COUNT {
                    rows.push([self.samples_at(pixel) as f32, 0.0, 0.0, 0.0]);
                } else {
                    rows.extend(self.feature(pixel, layer));
                }
            }
        }
        rows
    }

    /// The rows of a layer of a pixel.
    fn feature(&self, pixel: [u32; 2], layer: &Layer) -> impl Iterator<Item = [f32; 4]> {
        let PixelRows { count, .. } = layers::pixel_rows(self.layers);
        let index = self.index(pixel);
        let first = index * count + layers::row_of(self.layers, layer).unwrap_or_default();
        let rows = self.features[first..].iter().take(layer.rows);
        let statistics = &self.pixels[index];
        let scaled = |row: [f64; 4], scale: f64| row.map(|sum| (sum * scale) as f32);
        let squares = 1.0 / f64::from(statistics.count.max(1));
        rows.map(move |&row| match layer {
            layer if *layer == FIRST => row.map(|number| number as f32),
            layer if *layer == SQUARES => [(row[0] * squares) as f32, 0.0, 0.0, 1.0],
            _ => scaled(row, statistics.scale()),
        })
    }

    pub fn samples_at(&self, pixel: [u32; 2]) -> u32 {
        self.pixels[self.index(pixel)].count
    }

    /// Groups across and down.
    fn group_counts(&self) -> [usize; 2] {
        let [.., width, height] = self.region;
        [width, height].map(|length| (length as usize).div_ceil(GROUP_SIDE))
    }

    fn index(&self, [x, y]: [u32; 2]) -> usize {
        let [x0, y0, width, _] = self.region;
        (y - y0) as usize * width as usize + (x - x0) as usize
    }
}

/// A rectangle enlarged by a margin, clamped to the picture.
fn widened([x, y, width, height]: [u32; 4], margin: u32, size: (u32, u32)) -> [u32; 4] {
    let along = |start: u32, length: u32, most: u32| {
        let first = start.saturating_sub(margin);
        let end = (start + length).saturating_add(margin).min(most);
        (first, end - first)
    };
    let ((x, width), (y, height)) = (along(x, width, size.0), along(y, height, size.1));
    [x, y, width, height]
}
