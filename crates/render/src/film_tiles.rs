//! The accumulated samples of a picture, by film tile.
//!
//! Without adaptive sampling there is one round: all samples, tile by tile. With it (adaptive.rs) there are
//! several rounds, and a tile is a list of the pixels that need more samples.

mod saved;

use super::{
    adaptive::Adaptive,
    film::{Film, FilmError, FilmHeader, Piece},
    film_tile::{FilmTile, GroupOrder, rectangles},
    layers::{self, Layer},
    settings::RenderSettings,
    sums::{PixelRows, SAMPLE_BLOCK, Sums, Totals},
};
use std::borrow::Cow;
use std::ops::Range;

/// All film tiles of a picture, row by row.
#[derive(Clone, Debug)]
pub struct FilmTiles {
    pub list: Vec<FilmTile>,
    adaptive: Option<Adaptive>,
    /// Maximum number of film rows of a tile, over all rounds.
    largest: usize,
}

impl FilmTiles {
    /// Splits the region into tiles of at most `tile_side` pixels a side and plans the first round.
    pub fn new(settings: &RenderSettings, tile_side: u32, order: GroupOrder) -> Self {
        let adaptive = (settings.is_adaptive()).then(|| Adaptive::new(settings, tile_side, order));
        let region = (adaptive.as_ref()).map_or(settings.region(), Adaptive::region);
        // With adaptive sampling, only the mean is arranged in rectangles, to be developed.
        let rows = match adaptive {
            Some(_) => PixelRows::ONE,
            None => layers::pixel_rows(layers::of_sampling(settings)),
        };
        let side = tile_side / (rows.count as u32).isqrt();
        let mut tiles = Self {
            list: rectangles(region, side, settings.samples_to_render(), rows, order),
            adaptive,
            largest: 0,
        };
        tiles.largest = tiles.largest_row_count();
        if let Some(adaptive) = &tiles.adaptive {
            // In workgroup order, so that neighbouring pixels stay together.
            let mut pixels = Vec::with_capacity(tiles.list.iter().map(FilmTile::pixel_count).sum());
            for tile in &tiles.list {
                tile.pixels().flatten().for_each(|pixel| pixels.push(pixel));
            }
            tiles.list = adaptive.first_round(pixels);
            tiles.largest = tiles.largest.max(tiles.largest_row_count());
        }
        tiles
    }

    /// Allocates the rows of the first tile and writes to them: the first write to memory takes long.
    pub fn touch_memory(&mut self) {
        if let Some(first) = self.list.first_mut() {
            first.touch_memory();
        }
    }

    /// Overall progress when `fraction` of the tiles of this round are done, in 0..=1.
    pub fn progress(&self, fraction: f64) -> f64 {
        match &self.adaptive {
            None => fraction,
            Some(adaptive) => adaptive.progress(fraction),
        }
    }

    /// Ends the round and plans the next one. Returns whether there is one.
    pub fn next_round(&mut self) -> bool {
        let Some(adaptive) = &mut self.adaptive else {
            return false;
        };
        adaptive.add_round(&self.list);
        self.list = adaptive.next_round();
        !self.list.is_empty()
    }

    /// The rectangles to develop, with the samples so far.
    pub fn developable(&self, tile_side: u32) -> Vec<(FilmTile, Vec<[f32; 4]>)> {
        let Some(adaptive) = &self.adaptive else {
            let tiles = self.list.iter();
            return tiles
                .map(|tile| (tile.blank(), tile.developable()))
                .collect();
        };
        let so_far = match self.list.is_empty() {
            true => Cow::Borrowed(adaptive),
            false => Cow::Owned(adaptive.with_part_of_round(&self.list)),
        };
        let means = |tile: FilmTile| {
            let rows = tile.rows_of(|pixel| so_far.mean(pixel));
            (tile, rows)
        };
        rectangles(
            adaptive.crop(),
            tile_side,
            0..0,
            PixelRows::ONE,
            GroupOrder::Diagonal,
        )
        .into_iter()
        .map(means)
        .collect()
    }

    /// The film of the samples so far: all samples of the first `done` tiles, and the finished blocks of the
    /// next one before `sample`.
    pub fn film(&self, header: FilmHeader, done: usize, sample: u32) -> Result<Film, FilmError> {
        let mut pieces = Vec::new();
        if let Some(adaptive) = &self.adaptive {
            if !self.list.is_empty() {
                return Err(FilmError::Unfinished);
            }
            pieces.push(Piece {
                region: adaptive.crop(),
                samples: 0..header.samples,
                sums: Sums::Block(adaptive.means_and_counts(header.layers)),
            });
        }
        for (index, tile) in self.list.iter().enumerate() {
            let Range { start, end } = tile.samples;
            let (samples, sums) = match index < done {
                true => (start..end, tile.totals()),
                false => {
                    let closed = tile.closed.as_ref().map(Cow::Borrowed);
                    (
                        start..sample - sample % SAMPLE_BLOCK,
                        closed.map(Totals::Blocks),
                    )
                }
            };
            if let (Some(sums), true) = (sums, index <= done) {
                pieces.push(Piece {
                    region: tile.region(),
                    samples,
                    sums: tile.by_rows(&sums),
                });
            }
        }
        Film::new(header, pieces)
    }

    /// The sums of the pixels with samples so far, in the order of films, by rectangle (x, y, width, height).
    pub fn sums(&self, layers: &[&Layer]) -> Vec<([u32; 4], Sums)> {
        if let Some(adaptive) = &self.adaptive {
            let so_far = match self.list.is_empty() {
                true => Cow::Borrowed(adaptive),
                false => Cow::Owned(adaptive.with_part_of_round(&self.list)),
            };
            let rows = so_far.means_and_counts(layers);
            return vec![(adaptive.crop(), Sums::Block(rows))];
        }
        let of_tile = |tile: &FilmTile| Some((tile.region(), tile.by_rows(&tile.totals()?)));
        self.list.iter().filter_map(of_tile).collect()
    }

    /// Whether some pixels will have more samples than one block.
    pub fn has_totals(&self) -> bool {
        let is_more = |tile: &FilmTile| tile.samples.len() > SAMPLE_BLOCK as usize;
        self.adaptive.is_none() && self.list.iter().any(is_more)
    }

    /// Whether the whole picture is a single rectangle, sampled evenly.
    pub fn is_one_rectangle(&self) -> bool {
        self.adaptive.is_none() && self.list.len() == 1
    }

    /// Whether all pixels are sampled together, so that each has as many samples as the others.
    pub fn is_even(&self) -> bool {
        self.list.len() == 1 && (self.adaptive.as_ref()).is_none_or(Adaptive::is_in_first_round)
    }

    /// Whether in addition all samples so far are in one block.
    pub fn is_one_block(&self) -> bool {
        self.is_one_rectangle() && self.list[0].closed.is_none()
    }

    /// The number of samples of a pixel.
    pub fn samples_at(&self, pixel: [u32; 2]) -> u32 {
        match &self.adaptive {
            None => self.list.first().map_or(0, |tile| tile.samples.end),
            Some(adaptive) => adaptive.samples_at(pixel),
        }
    }

    /// Film rows of a pixel.
    pub fn rows_per_pixel(&self) -> usize {
        self.list.first().map_or(1, FilmTile::rows_per_pixel)
    }

    /// Maximum number of film rows of a tile.
    pub fn largest(&self) -> usize {
        self.largest
    }

    fn largest_row_count(&self) -> usize {
        let counts = self.list.iter().map(FilmTile::row_count);
        counts.max().unwrap_or(0)
    }
}
