//! Adaptive sampling: decides after each round which pixels need more samples.

mod saved;

use super::{
    Integrator,
    film_tile::FilmTile,
    layers::{self, COUNT, FIRST, Layer, RADIANCE, SQUARES},
    luminance::luminance,
    settings::RenderSettings,
    sums::PixelRows,
};
use std::{collections::BTreeMap, ops::Range};

/// Samples in the first round; each later round doubles the samples of a pixel.
const FIRST_SAMPLES: u32 = 4;

/// The same for paths: few of them find a small lamp, and those that do not agree with each other.
const FIRST_PATHS: u32 = 16;

/// A pixel with this many times fewer samples than a noisy neighbour needs more.
const BEHIND: u32 = 4;

/// Rounds in which pixels compare with their neighbours. A difference propagates by one pixel per round, so
/// this is its maximum distance and the width of the margin around a crop.
const NEIGHBOUR_ROUNDS: u32 = 32;

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
    noise: f64,
    /// The brightness of a luminance, on which noise is measured.
    brightness: fn(f64) -> f64,
    samples: u32,
    /// Samples in the first round.
    first_samples: u32,
    /// Rounds after the first.
    rounds: u32,
    /// Maximum number of pixels of a film tile.
    tile_pixels: usize,
    layers: &'static [&'static Layer],
    pixels: Vec<PixelStatistics>,
    /// The rows of all pixels as in film tiles, for films with features or opacity; otherwise empty.
    features: Vec<[f64; 4]>,
    /// The range of samples of the most sampled pixels in this round.
    front: Range<u32>,
}

/// The statistics of a pixel.
#[derive(Clone, Copy, Debug, Default)]
struct PixelStatistics {
    sum: [f64; 3],
    weight: f64,
    /// Sum of squared luminance.
    squares: f64,
    count: u32,
}

impl Adaptive {
    pub fn new(settings: &RenderSettings, tile_side: u32) -> Self {
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
        let [.., width, height] = region;
        let side = tile_side as usize;
        Self {
            region,
            crop,
            rounds: 0,
            noise: f64::from(settings.noise),
            brightness,
            samples: settings.samples,
            first_samples,
            // As many rows as without features.
            tile_pixels: 2 * side * side / layers::rows(layers::of_sampling(settings)),
            layers: layers::of_sampling(settings),
            features: match settings.has_features() || settings.has_opacity() {
                true => {
                    let rows = layers::rows(layers::of_sampling(settings));
                    vec![[0.0; 4]; rows * width as usize * height as usize]
                }
                false => Vec::new(),
            },
            front: 0..first_samples,
            pixels: vec![PixelStatistics::default(); width as usize * height as usize],
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
        let [x0, y0, width, height] = self.region;
        let groups = |length: u32| 0..length.div_ceil(8);
        let mut unfinished: BTreeMap<u32, Vec<[u32; 2]>> = BTreeMap::new();
        for (ty, tx) in groups(height).flat_map(|y| groups(width).map(move |x| (y, x))) {
            for (y, x) in (0..8).flat_map(|y| (0..8).map(move |x| (8 * ty + y, 8 * tx + x))) {
                if x < width && y < height && self.needs_more_samples(x, y) {
                    let list = unfinished.entry(self.statistics(x, y).count).or_default();
                    list.push([x0 + x, y0 + y]);
                }
            }
        }
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

    fn tiles(&self, pixels: Vec<[u32; 2]>, samples: Range<u32>) -> Vec<FilmTile> {
        let lists = pixels.chunks(self.tile_pixels);
        lists
            .map(|list| FilmTile::list(list.to_vec(), samples.clone(), self.layers))
            .collect()
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

    /// Adds the samples of the pixels whose sum of weights is `counted`.
    fn add(&mut self, tiles: &[FilmTile], counted: impl Fn(f64) -> bool) {
        let squares = layers::row_of(self.layers, &SQUARES).unwrap_or_default();
        for tile in tiles {
            let sample_count = tile.samples.end - tile.samples.start;
            let rows = tile.totals();
            let pixels = rows.chunks_exact(tile.rows_per_pixel());
            let sampled =
                (tile.places().iter().zip(pixels)).filter(|(_, rows)| counted(rows[0][3]));
            for (place, rows) in sampled {
                let index = self.index(*place);
                let statistics = &mut self.pixels[index];
                for (sum, row) in statistics.sum.iter_mut().zip(rows[0]) {
                    *sum += row;
                }
                statistics.weight += rows[0][3];
                statistics.squares += rows[squares][0];
                statistics.count += sample_count;
                if !self.features.is_empty() {
                    let own = &mut self.features[index * rows.len()..][..rows.len()];
                    layers::pixel_rows(self.layers).add_rounded(own, rows);
                }
            }
        }
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
    /// the sample count. Means have a weight of 1, and the squares are a mean too.
    pub fn means_and_counts(&self, layers: &[&Layer]) -> Vec<[f32; 4]> {
        let [x, y, width, height] = self.crop;
        let pixels = (y..y + height).flat_map(|y| (x..x + width).map(move |x| [x, y]));
        let mut rows = Vec::new();
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
    fn feature(&self, pixel: [u32; 2], layer: &Layer) -> Vec<[f32; 4]> {
        let PixelRows { count, .. } = layers::pixel_rows(self.layers);
        let index = self.index(pixel);
        let first = index * count + layers::row_of(self.layers, layer).unwrap_or_default();
        let rows = self.features[first..].iter().take(layer.rows);
        let statistics = &self.pixels[index];
        let to_mean = |[x, y, z, _]: [f64; 4], scale: f64| {
            let [x, y, z] = [x, y, z].map(|sum| (sum * scale) as f32);
            [x, y, z, 1.0]
        };
        let squares = 1.0 / f64::from(statistics.count.max(1));
        rows.map(|&row| match layer {
            layer if *layer == FIRST => row.map(|number| number as f32),
            layer if *layer == SQUARES => to_mean([row[0], 0.0, 0.0, 0.0], squares),
            _ => to_mean(row, statistics.scale()),
        })
        .collect()
    }

    pub fn samples_at(&self, pixel: [u32; 2]) -> u32 {
        self.pixels[self.index(pixel)].count
    }

    fn index(&self, [x, y]: [u32; 2]) -> usize {
        let [x0, y0, width, _] = self.region;
        (y - y0) as usize * width as usize + (x - x0) as usize
    }

    /// Whether a pixel needs another round: its own error is too large, or it may have missed something that
    /// its neighbours found. A few samples can all miss the same feature and then agree. After the first round
    /// a difference from a neighbour is therefore enough; later the neighbour must also be noisy and have many
    /// more samples.
    fn needs_more_samples(&self, x: u32, y: u32) -> bool {
        let statistics = self.statistics(x, y);
        let rounds_left = NEIGHBOUR_ROUNDS.saturating_sub(self.rounds);
        if statistics.count >= self.samples || self.steps_to_crop(x, y) > rounds_left {
            return false;
        }
        let brightness = |of: &PixelStatistics| (self.brightness)(of.luminance());
        let missed = |other: &PixelStatistics| {
            let differs = (brightness(other) - brightness(statistics)).abs() > self.noise;
            let is_ahead = other.count >= BEHIND * statistics.count && self.is_noisy(other);
            differs && (statistics.count <= self.first_samples || is_ahead)
        };
        let looks_at_neighbours = self.rounds <= NEIGHBOUR_ROUNDS;
        self.is_noisy(statistics) || (looks_at_neighbours && self.around(x, y).any(missed))
    }

    /// Whether one standard error changes the brightness of a pixel by more than the threshold.
    fn is_noisy(&self, statistics: &PixelStatistics) -> bool {
        let mean = statistics.luminance();
        let change = (self.brightness)(mean + statistics.error()) - (self.brightness)(mean);
        change > self.noise
    }

    /// Distance in pixels from a pixel of the region to the crop; 0 inside it.
    fn steps_to_crop(&self, x: u32, y: u32) -> u32 {
        let [x0, y0, ..] = self.region;
        let [left, top, width, height] = self.crop;
        let beyond = |at: u32, start: u32, length: u32| {
            let last = start + length - 1;
            start.saturating_sub(at).max(at.saturating_sub(last))
        };
        beyond(x0 + x, left, width).max(beyond(y0 + y, top, height))
    }

    /// The pixel and its neighbours.
    fn around(&self, x: u32, y: u32) -> impl Iterator<Item = &PixelStatistics> {
        let [.., width, height] = self.region;
        let near =
            |center: u32, length: u32| center.saturating_sub(1)..=(center + 1).min(length - 1);
        near(y, height).flat_map(move |y| near(x, width).map(move |x| self.statistics(x, y)))
    }

    fn statistics(&self, x: u32, y: u32) -> &PixelStatistics {
        &self.pixels[y as usize * self.region[2] as usize + x as usize]
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

impl PixelStatistics {
    /// The factor from sum to mean. Weights of both signs may cancel; the remainder is then meaningless, as in
    /// the shader that develops (lib/filter.wesl).
    fn scale(&self) -> f64 {
        if self.weight.abs() > 0.5 {
            1.0 / self.weight
        } else {
            0.0
        }
    }

    fn luminance(&self) -> f64 {
        (luminance(self.sum) * self.scale()).max(0.0)
    }

    /// The standard error of the luminance.
    fn error(&self) -> f64 {
        let count = f64::from(self.count);
        let mean = self.luminance();
        let variance = (self.squares / count - mean * mean).max(0.0) / (count - 1.0).max(1.0);
        variance.sqrt()
    }
}

/// Brightness for pictures of any range: as the square root of a small luminance, which is close to what the eye sees,
/// and 1 for an infinite one, since tone curves show all highlights as white.
fn compressed(luminance: f64) -> f64 {
    (luminance / (1.0 + luminance)).sqrt()
}
