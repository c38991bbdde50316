//! The addition of a round to the statistics, in bands of the region: each thread adds the samples of one.

use super::{Adaptive, Estimate, FilmTile, GROUP_SIDE, Measure, PixelStatistics};
use crate::{
    layers::{self, SQUARES},
    sums::{PixelRows, Totals},
};
use glimray_scene::threads;
use std::{iter, ops::Range};

/// A part of the region, of the same width.
struct Band<'a> {
    /// The first pixel of the band.
    corner: [u32; 2],
    width: usize,
    pixels: &'a mut [PixelStatistics],
    /// Empty without features.
    features: &'a mut [[f64; 4]],
    estimates: &'a mut [Estimate],
    sampled: &'a mut [bool],
}

/// The samples of a round.
struct Round<'a> {
    tiles: Vec<(&'a FilmTile, Totals<'a>)>,
    /// Whether there are none before.
    is_first: bool,
    rows: PixelRows,
    /// The row with the squares.
    squares: usize,
    /// The rows with the opacity and its squares.
    opacity: Range<usize>,
    measure: Measure,
}

impl Adaptive {
    /// Adds the samples of the pixels whose sum of weights is `counted`.
    pub(super) fn add(&mut self, tiles: &[FilmTile], counted: impl Fn(f64) -> bool + Sync) {
        let tiles = tiles.iter();
        let round = Round {
            tiles: tiles
                .filter_map(|tile| Some((tile, tile.totals()?)))
                .collect(),
            is_first: self.is_in_first_round(),
            rows: layers::pixel_rows(self.layers),
            squares: layers::row_of(self.layers, &SQUARES).unwrap_or_default(),
            opacity: layers::rows_of_noisy_opacity(self.layers),
            measure: self.measure,
        };
        threads::for_each(self.bands(round.rows), |mut band| {
            band.add(&round, &counted)
        });
    }

    /// Rows of groups for each thread.
    pub(super) fn band_height(&self) -> usize {
        threads::chunk_len(self.pixels.len()).div_ceil(GROUP_SIDE * self.region[2] as usize)
    }

    /// The region in bands, one for each thread.
    fn bands(&mut self, rows: PixelRows) -> impl Iterator<Item = Band<'_>> {
        let ([columns, _], group_rows) = (self.group_counts(), self.band_height());
        let ([left, top, width, _], height) = (self.region, group_rows * GROUP_SIDE);
        let width = width as usize;
        let features = self.features.chunks_mut(height * width * rows.count);
        (top..)
            .step_by(height)
            .zip(self.pixels.chunks_mut(height * width))
            .zip(features.chain(iter::repeat_with(Default::default)))
            .zip(self.estimates.chunks_mut(height * width))
            .zip(self.sampled.chunks_mut(group_rows * columns))
            .map(
                move |((((y, pixels), features), estimates), sampled)| Band {
                    corner: [left, y],
                    width,
                    pixels,
                    features,
                    estimates,
                    sampled,
                },
            )
    }
}

impl Band<'_> {
    fn add(&mut self, round: &Round, counted: impl Fn(f64) -> bool) {
        let (rows, columns) = (round.rows, self.width.div_ceil(GROUP_SIDE));
        for (tile, totals) in &round.tiles {
            let sample_count = tile.samples.end - tile.samples.start;
            for (place, pixel) in tile.places().iter().enumerate() {
                let total = |row| totals.row(place * rows.count + row, rows);
                let Some([x, y]) = self.within(*pixel).filter(|_| counted(total(0)[3])) else {
                    continue;
                };
                let index = y * self.width + x;
                let statistics = &mut self.pixels[index];
                let features = match self.features {
                    [] => &mut [],
                    _ => &mut self.features[index * rows.count..][..rows.count],
                };
                if round.is_first {
                    // New memory costs two page faults if it is read before it is written.
                    *statistics = PixelStatistics::default();
                    features.fill([0.0; 4]);
                }
                statistics.add(total(0), total(round.squares)[0], sample_count);
                if !features.is_empty() {
                    rows.add_rounded(features, total);
                }
                let opacity = &features[round.opacity.clone()];
                self.estimates[index] = round.measure.estimate(statistics, opacity);
                self.sampled[y / GROUP_SIDE * columns + x / GROUP_SIDE] = true;
            }
        }
    }

    /// The position of a pixel of the region in the band, if it is there.
    fn within(&self, [x, y]: [u32; 2]) -> Option<[usize; 2]> {
        let [left, top] = self.corner;
        let y = y.checked_sub(top)? as usize;
        (y * self.width < self.pixels.len()).then_some([(x - left) as usize, y])
    }
}
