//! Rounds over random films beside a plain reference, which considers all pixels and keeps nothing between rounds.

use super::Adaptive;
use crate::{
    Antialias, Integrator, RenderSettings,
    film_tile::{FilmTile, GroupOrder},
    sums::SAMPLE_BLOCK,
};
use glimray_scene::{
    random::{SplitMix64, mixed, unit},
    threads,
};
use std::ops::Range;

/// A pixel and its samples in a round.
type Chosen = ([u32; 2], Range<u32>);

/// The luminance of all samples of a pixel.
#[derive(Clone, Default)]
struct Samples(Vec<f64>);

impl Samples {
    fn mean(&self) -> f64 {
        self.0.iter().sum::<f64>() / self.0.len() as f64
    }

    fn error(&self) -> f64 {
        let (count, mean) = (self.0.len() as f64, self.mean());
        let squares = self.0.iter().map(|sample| (sample - mean).powi(2));
        (squares.sum::<f64>() / count / (count - 1.0)).sqrt()
    }
}

/// All pixels with their samples.
struct Plain<'a> {
    settings: &'a RenderSettings,
    region: [u32; 4],
    pixels: Vec<Samples>,
}

impl Plain<'_> {
    fn at(&self, [x, y]: [u32; 2]) -> &Samples {
        let [left, top, width, _] = self.region;
        &self.pixels[((y - top) * width + x - left) as usize]
    }

    fn brightness(&self, luminance: f64) -> f64 {
        match self.settings.integrator {
            Integrator::Path => (luminance / (1.0 + luminance)).sqrt(),
            _ => luminance.sqrt(),
        }
    }

    fn is_noisy(&self, samples: &Samples) -> bool {
        let (mean, error) = (samples.mean(), samples.error());
        self.brightness(mean + error) - self.brightness(mean) > f64::from(self.settings.noise)
    }

    /// Whether a pixel is in the next round, after so many.
    fn continues(&self, [x, y]: [u32; 2], rounds: u32) -> bool {
        let [left, top, width, height] = self.settings.region();
        let beyond = |at: u32, start: u32, length: u32| {
            start
                .saturating_sub(at)
                .max((at + 1).saturating_sub(start + length))
        };
        let own = self.at([x, y]);
        let steps = beyond(x, left, width).max(beyond(y, top, height));
        if own.0.len() >= self.settings.samples as usize || steps + rounds > 32 {
            return false;
        }
        let first = match self.settings.integrator {
            Integrator::Path => 16,
            _ => 4,
        };
        let [left, top, width, height] = self.region;
        let near = |at: u32, start: u32, length: u32| {
            start.max(at.saturating_sub(1))..(start + length).min(at + 2)
        };
        let around =
            near(y, top, height).flat_map(|y| near(x, left, width).map(move |x| self.at([x, y])));
        let mut missed = around.filter(|other| {
            let difference = self.brightness(other.mean()) - self.brightness(own.mean());
            let is_ahead = other.0.len() >= 4 * own.0.len() && self.is_noisy(other);
            difference.abs() > f64::from(self.settings.noise) && (own.0.len() <= first || is_ahead)
        });
        self.is_noisy(own) || missed.next().is_some()
    }

    /// The pixels of the next round: by sample count, then by group of 8x8 of the region, then row by row.
    fn next_round(&self, rounds: u32) -> Vec<Chosen> {
        let [left, top, width, height] = self.region;
        let pixels = (top..top + height).flat_map(|y| (left..left + width).map(move |x| [x, y]));
        let mut chosen: Vec<_> = pixels
            .filter(|pixel| self.continues(*pixel, rounds))
            .map(|pixel| {
                let count = self.at(pixel).0.len() as u32;
                (pixel, count..(2 * count).min(self.settings.samples))
            })
            .collect();
        chosen.sort_by_key(|([x, y], samples)| {
            (samples.start, (y - top) / 8, (x - left) / 8, *y, *x)
        });
        chosen
    }
}

/// A sample of an even film with a few pixels that are noisy, that are bright, or that show something later on.
fn sample([x, y]: [u32; 2], index: u32, seed: u64) -> f64 {
    let pixel = mixed(seed ^ mixed(u64::from(x) << 32 | u64::from(y)));
    let random = unit(mixed(pixel ^ mixed(u64::from(index) + 1)));
    match pixel % 400 {
        0 => 0.6 * random,
        1 => 0.9,
        2 if index >= 4 => 1.5 * random,
        3 if index >= 16 && random > 0.8 => 20.0,
        _ => 0.3,
    }
}

/// Renders the samples of a tile into its sums, block by block, and adds them to those of the reference.
fn render(tile: &mut FilmTile, plain: &mut Plain, seed: u64) {
    let places = tile.places().to_vec();
    let [left, top, width, _] = plain.region;
    for first in tile.samples.clone().step_by(SAMPLE_BLOCK as usize) {
        if first > tile.samples.start {
            tile.close_block();
        }
        tile.begin_block();
        let end = tile.samples.end.min(first + SAMPLE_BLOCK);
        for ([x, y], rows) in places.iter().zip(tile.sums.chunks_exact_mut(2)) {
            let samples = (first..end).map(|index| sample([*x, *y], index, seed));
            let samples: Vec<f64> = samples.collect();
            let sum = samples.iter().sum::<f64>() as f32;
            rows[0] = [sum, sum, sum, samples.len() as f32];
            rows[1][0] = samples.iter().map(|sample| sample * sample).sum::<f64>() as f32;
            plain.pixels[((y - top) * width + x - left) as usize]
                .0
                .extend(samples);
        }
    }
}

/// The rounds after the first, and how many pixels they had.
fn check_rounds(settings: &RenderSettings, tile_side: u32, seed: u64) -> Vec<usize> {
    let mut adaptive = Adaptive::new(settings, tile_side, GroupOrder::Spread);
    let region = adaptive.region();
    let [left, top, width, height] = region;
    let all = (top..top + height).flat_map(|y| (left..left + width).map(move |x| [x, y]));
    let mut tiles = adaptive.first_round(all.collect());
    let pixels = vec![Samples::default(); (width * height) as usize];
    let mut plain = Plain {
        settings,
        region,
        pixels,
    };
    let mut counts = Vec::new();
    loop {
        for tile in &mut tiles {
            render(tile, &mut plain, seed);
        }
        adaptive.add_round(&tiles);
        tiles = adaptive.next_round();
        let chosen = tiles.iter();
        let chosen: Vec<Chosen> = chosen
            .flat_map(|tile| {
                tile.places()
                    .iter()
                    .map(|place| (*place, tile.samples.clone()))
            })
            .collect();
        let expected = plain.next_round(counts.len() as u32 + 1);
        let differs = chosen
            .iter()
            .zip(&expected)
            .find(|(own, other)| own != other);
        assert!(
            chosen == expected,
            "round {} of {settings:?}, seed {seed}: {} pixels instead of {}, the first that differ are {differs:?}",
            counts.len() + 2,
            chosen.len(),
            expected.len()
        );
        if tiles.is_empty() {
            return counts;
        }
        counts.push(chosen.len());
    }
}

#[test]
fn rounds_have_the_pixels_of_a_plain_reference() {
    let mut random = SplitMix64::new(7);
    for seed in 0..12 {
        let mut number = |from: u32, to: u32| from + (random.unit() * f64::from(to - from)) as u32;
        // Large enough for several threads, and such that groups and bands are cut off at the edges.
        let size = (number(100, 200), number(90, 180));
        let (x, y) = (number(0, 60), number(0, 60));
        let settings = RenderSettings {
            size,
            crop: (seed % 3 == 0).then(|| [x, y, number(x + 1, size.0), number(y + 1, size.1)]),
            antialias: Antialias::Adaptive,
            samples: [40, 64, 200, 300][seed % 4],
            noise: [0.02, 0.05, 0.1][seed % 3],
            integrator: [Integrator::Whitted, Integrator::Path][seed / 4 % 2],
            ..RenderSettings::default()
        };
        let tile_side = [2048, 40][seed % 2];
        let counts = threads::with(1 + seed % 5, || {
            check_rounds(&settings, tile_side, seed as u64)
        });
        assert!(
            counts.len() > 1 && counts[0] > 10,
            "{counts:?} of {settings:?}"
        );
    }
}
