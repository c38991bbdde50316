//! What has been gathered so far, tile by tile as the GPU works on it.
//!
//! Without adaptive sampling there is one round: all samples, tile by tile. With it
//! (adaptive.rs) there are several, and a tile is a list of the pixels that go on.

use super::{
    adaptive::Adaptive,
    film::{Film, FilmError, FilmHeader, Piece},
    film_tile::{FilmTile, rectangles},
    layers,
    settings::RenderSettings,
    sums::{SAMPLE_BLOCK, Sums},
};
use std::ops::Range;

/// All tiles of a picture, row by row, and the samples that they are to get.
#[derive(Clone, Debug)]
pub struct FilmTiles {
    pub list: Vec<FilmTile>,
    adaptive: Option<Adaptive>,
    /// In film rows, of all rounds.
    largest: usize,
}

impl FilmTiles {
    /// Cuts the region into tiles of at most so many pixels a side and plans the first round.
    pub fn new(settings: &RenderSettings, tile_side: u32) -> Self {
        let adaptive = (settings.is_adaptive()).then(|| Adaptive::new(settings, tile_side));
        let region = (adaptive.as_ref()).map_or(settings.region(), Adaptive::region);
        // Of adaptive sampling only the mean is laid out in rectangles, to be developed.
        let rows = match adaptive {
            Some(_) => 1,
            None => layers::rows(layers::of_sampling(settings)),
        };
        let side = tile_side / (rows as u32).isqrt();
        let mut tiles = Self {
            list: rectangles(region, side, settings.samples_to_render(), rows),
            adaptive,
            largest: 0,
        };
        tiles.largest = tiles.largest_row_count();
        if let Some(adaptive) = &tiles.adaptive {
            // In the order of groups, so that what lies together stays together.
            let rectangles = tiles.list.iter();
            let pixels = rectangles
                .flat_map(|tile| (0..tile.pixel_count()).filter_map(|index| tile.pixel_at(index)));
            tiles.list = adaptive.first_round(pixels.collect());
            tiles.largest = tiles.largest.max(tiles.largest_row_count());
        }
        tiles
    }

    /// How far the sampling is in all when `fraction` of the tiles of this round are done, in 0..=1.
    pub fn progress(&self, fraction: f64) -> f64 {
        match &self.adaptive {
            None => fraction,
            Some(adaptive) => adaptive.progress(fraction),
        }
    }

    /// Ends the round. If there is another, the tiles are what goes on.
    pub fn next_round(&mut self) -> bool {
        let Some(adaptive) = &mut self.adaptive else {
            return false;
        };
        adaptive.add_round(std::mem::take(&mut self.list));
        self.list = adaptive.next_round();
        !self.list.is_empty()
    }

    /// The tiles to develop: rectangles with what has been gathered so far.
    pub fn developable(&self, tile_side: u32) -> Vec<(FilmTile, Vec<[f32; 4]>)> {
        let Some(adaptive) = &self.adaptive else {
            let tiles = self.list.iter();
            return tiles
                .map(|tile| (tile.blank(), tile.developable()))
                .collect();
        };
        let means = |tile: FilmTile| {
            let mean = |index| {
                tile.pixel_at(index)
                    .map_or([0.0; 4], |at| adaptive.mean(at))
            };
            let rows = (0..tile.pixel_count()).map(mean).collect();
            (tile, rows)
        };
        rectangles(adaptive.crop(), tile_side, 0..0, 1)
            .into_iter()
            .map(means)
            .collect()
    }

    /// The film of what has been gathered so far: all samples of the first `done` tiles, and of the
    /// next one those before `sample` that are in finished blocks.
    pub fn film(&self, header: FilmHeader, done: usize, sample: u32) -> Result<Film, FilmError> {
        let mut pieces = Vec::new();
        if let Some(adaptive) = &self.adaptive {
            if !self.list.is_empty() {
                return Err(FilmError::Unfinished);
            }
            pieces.push(Piece {
                region: adaptive.crop(),
                samples: 0..header.samples,
                sums: Sums::Block(adaptive.means_and_counts()),
            });
        }
        for (index, tile) in self.list.iter().enumerate() {
            let Range { start, end } = tile.samples;
            let (samples, sums) = match index < done {
                true => (start..end, tile.all_sums()),
                false => (start..sample - sample % SAMPLE_BLOCK, tile.closed.clone()),
            };
            if let (Some(sums), true) = (sums, index <= done) {
                pieces.push(piece(tile, samples, &sums));
            }
        }
        Film::new(header, pieces)
    }

    /// Whether some pixels are to get more samples than a block has.
    pub fn has_totals(&self) -> bool {
        let is_more = |tile: &FilmTile| tile.samples.len() > SAMPLE_BLOCK as usize;
        self.adaptive.is_none() && self.list.iter().any(is_more)
    }

    /// Whether the whole picture is sampled at once, every pixel in its turn.
    pub fn is_one_rectangle(&self) -> bool {
        self.adaptive.is_none() && self.list.len() == 1
    }

    /// Whether moreover all samples so far are in one block.
    pub fn is_one_block(&self) -> bool {
        self.is_one_rectangle() && self.list[0].closed.is_none()
    }

    /// The samples that a pixel of the picture has got.
    pub fn samples_at(&self, pixel: [u32; 2]) -> u32 {
        match &self.adaptive {
            None => self.list.first().map_or(0, |tile| tile.samples.end),
            Some(adaptive) => adaptive.samples_at(pixel),
        }
    }

    /// The most rows that a tile has.
    pub fn largest(&self) -> usize {
        self.largest
    }

    fn largest_row_count(&self) -> usize {
        let counts = self.list.iter().map(FilmTile::row_count);
        counts.max().unwrap_or(0)
    }
}

/// The sums of a tile, its pixels row by row.
fn piece(tile: &FilmTile, samples: Range<u32>, sums: &Sums) -> Piece {
    let rows = tile.rows_per_pixel();
    let pixels = tile.sampled_pixels() as usize;
    let mut ordered = Sums::zeros(rows * pixels, matches!(sums, Sums::Block(_)));
    for index in 0..tile.pixel_count() {
        if let Some([x, y]) = tile.pixel_at(index) {
            let to = (y - tile.y) as usize * tile.width as usize + (x - tile.x) as usize;
            ordered.add(rows * to, sums, rows * index, rows);
        }
    }
    Piece {
        region: [tile.x, tile.y, tile.width, tile.height],
        samples,
        sums: ordered,
    }
}
