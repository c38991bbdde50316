//! What has been gathered so far, window by window as the GPU works on it.
//!
//! The GPU adds samples one after the other to f32 sums; after each slice they are copied here, so
//! a lost device costs one slice. Every [`SAMPLE_BLOCK`] samples the sums are added to exact totals and
//! start again from zero.
//!
//! Without adaptive sampling there is one round: all samples, window by window. With it
//! (adaptive.rs) there are several, and a window is a list of the pixels that go on.

use super::{
    adaptive::Adaptive,
    film::{Film, FilmError, FilmHeader, Piece},
    layers::{self, Layer, SQUARES},
    settings::RenderSettings,
    sums::{SAMPLE_BLOCK, Sums},
};
use std::ops::Range;

/// Pixels of a tile; one workgroup each.
pub const TILE_PIXELS: usize = 64;
const TILE_SIDE: u32 = 8;

/// A rectangle of the picture that is on the GPU at a time. Its pixels are in film order: tile by
/// tile in the shader's order, 64 lanes each, edges padded.
#[derive(Clone, Debug)]
pub struct Window {
    pub x: u32,
    pub y: u32,
    pub width: u32,
    pub height: u32,
    /// The samples that its pixels are to get.
    pub samples: Range<u32>,
    /// The pixels of a list, in film order; empty for a rectangle.
    places: Vec<[u32; 2]>,
    /// Rows of the film for each pixel, and in a list which of them holds its place.
    rows_per_pixel: usize,
    place_row: usize,
    /// Rows of the film in the current block, layer by layer for each pixel; empty before it has begun.
    pub sums: Vec<[f32; 4]>,
    /// The same of all finished blocks.
    closed: Option<Sums>,
}

impl Window {
    /// A rectangle of the picture.
    pub fn new(
        [x, y, width, height]: [u32; 4],
        samples: Range<u32>,
        rows_per_pixel: usize,
    ) -> Self {
        Self {
            x,
            y,
            width,
            height,
            samples,
            places: Vec::new(),
            rows_per_pixel,
            place_row: 0,
            sums: Vec::new(),
            closed: None,
        }
    }

    /// A list of pixels of the picture, at least one.
    pub fn list(places: Vec<[u32; 2]>, samples: Range<u32>, layers: &[&Layer]) -> Self {
        let side = TILE_SIDE;
        let mut window = Self::new([0, 0, side, side], samples, layers::rows(layers));
        window.place_row = layers::row_of(layers, &SQUARES).unwrap_or_default();
        window.places = places;
        window
    }

    /// The same rectangle without anything in it.
    fn blank(&self) -> Self {
        let region = [self.x, self.y, self.width, self.height];
        Self::new(region, self.samples.clone(), self.rows_per_pixel)
    }

    /// Its pixels without padding.
    pub fn sampled_pixels(&self) -> u64 {
        if self.places.is_empty() {
            u64::from(self.width) * u64::from(self.height)
        } else {
            self.places.len() as u64
        }
    }

    /// The pixels of a list.
    pub fn places(&self) -> &[[u32; 2]] {
        &self.places
    }

    /// Rows of the film for each pixel.
    pub fn rows_per_pixel(&self) -> usize {
        self.rows_per_pixel
    }

    pub fn tile_columns(&self) -> u32 {
        self.width.div_ceil(TILE_SIDE)
    }

    pub fn tile_count(&self) -> u32 {
        if self.places.is_empty() {
            self.tile_columns() * self.height.div_ceil(TILE_SIDE)
        } else {
            self.places.len().div_ceil(TILE_PIXELS) as u32
        }
    }

    /// A stride coprime to the tile count that steps to the next tile down and right: neighbours
    /// share what is in the caches, and any run of tiles longer than the window is high samples all
    /// of its height.
    pub fn tile_stride(&self) -> u32 {
        let count = self.tile_count();
        let columns = match self.places.len() {
            0 => self.tile_columns(),
            _ => count.isqrt(),
        };
        (columns + 1..count)
            .find(|&stride| gcd(stride, count) == 1)
            .unwrap_or(1)
    }

    /// Number of pixels in film order, padding included.
    pub fn pixel_count(&self) -> usize {
        self.tile_count() as usize * TILE_PIXELS
    }

    /// Rows of its film.
    pub fn row_count(&self) -> usize {
        self.pixel_count() * self.rows_per_pixel()
    }

    /// Makes room for the sums, all zero.
    pub fn begin(&mut self) {
        self.sums.clear();
        self.sums.resize(self.row_count(), [0.0; 4]);
        let pixels = self.sums.chunks_exact_mut(self.rows_per_pixel);
        for (rows, [x, y]) in pixels.zip(&self.places) {
            rows[self.place_row] = [0.0, *x as f32, *y as f32, 1.0];
        }
    }

    /// The pixel at a place in the film of a rectangle: its x and y in the picture, or `None` for
    /// padding. The same order as in the shader (scene/slice.wesl).
    pub fn pixel_at(&self, film_index: usize) -> Option<[u32; 2]> {
        let (index, lane) = (film_index / TILE_PIXELS, (film_index % TILE_PIXELS) as u32);
        let tile =
            (index as u64 * u64::from(self.tile_stride()) % u64::from(self.tile_count())) as u32;
        let bit = |shift: u32, to: u32| ((lane >> shift) & 1) << to;
        let x = tile % self.tile_columns() * TILE_SIDE + (bit(0, 0) | bit(2, 1) | bit(4, 2));
        let y = tile / self.tile_columns() * TILE_SIDE + (bit(1, 0) | bit(3, 1) | bit(5, 2));
        (x < self.width && y < self.height).then_some([self.x + x, self.y + y])
    }

    /// Closes a block: its sums become part of the totals.
    pub fn close_block(&mut self) {
        self.closed = Some(Sums::with_block(self.closed.take(), &self.sums));
        self.sums.clear();
    }

    /// The sums of all samples, `None` before the first.
    fn all(&self) -> Option<Sums> {
        match self.sums.is_empty() {
            true => self.closed.clone(),
            false => Some(Sums::with_block(self.closed.clone(), &self.sums)),
        }
    }

    /// The rows of all blocks together; those of a list hold its places as often as there were
    /// blocks, and are of no use there.
    pub fn totals(&self) -> Vec<[f64; 4]> {
        self.all().map_or_else(Vec::new, |sums| sums.rounded())
    }

    /// What `develop` reads: sums and weights where one block holds them all, else means and ones.
    pub fn developable(&self) -> Vec<[f32; 4]> {
        match self.all() {
            None => vec![[0.0; 4]; self.row_count()],
            Some(sums) => sums.developable(),
        }
    }

    /// Its sums, its pixels row by row.
    fn piece(&self, samples: Range<u32>, sums: &Sums) -> Piece {
        let rows = self.rows_per_pixel;
        let pixels = self.sampled_pixels() as usize;
        let mut ordered = Sums::zeros(rows * pixels, matches!(sums, Sums::Block(_)));
        for index in 0..self.pixel_count() {
            if let Some([x, y]) = self.pixel_at(index) {
                let to = (y - self.y) as usize * self.width as usize + (x - self.x) as usize;
                ordered.add(rows * to, sums, rows * index, rows);
            }
        }
        Piece {
            region: [self.x, self.y, self.width, self.height],
            samples,
            sums: ordered,
        }
    }
}

/// All windows of a picture, row by row, and the samples that they are to get.
#[derive(Clone, Debug)]
pub struct Windows {
    pub list: Vec<Window>,
    adaptive: Option<Adaptive>,
    /// In film rows, of all rounds.
    largest: usize,
}

impl Windows {
    /// Cuts the region into windows of at most so many pixels a side and plans the first round.
    pub fn new(settings: &RenderSettings, window_side: u32) -> Self {
        let adaptive = (settings.is_adaptive()).then(|| Adaptive::new(settings, window_side));
        let region = (adaptive.as_ref()).map_or(settings.region(), Adaptive::region);
        // Of adaptive sampling only the mean is laid out in rectangles, to be developed.
        let rows = match adaptive {
            Some(_) => 1,
            None => layers::rows(layers::of_sampling(settings)),
        };
        let side = window_side / (rows as u32).isqrt();
        let mut windows = Self {
            list: rectangles(region, side, settings.samples_to_render(), rows),
            adaptive,
            largest: 0,
        };
        windows.largest = windows.largest_row_count();
        if let Some(adaptive) = &windows.adaptive {
            // In the order of tiles, so that what lies together stays together.
            let rectangles = windows.list.iter();
            let pixels = rectangles.flat_map(|window| {
                (0..window.pixel_count()).filter_map(|index| window.pixel_at(index))
            });
            windows.list = adaptive.first_round(pixels.collect());
            windows.largest = windows.largest.max(windows.largest_row_count());
        }
        windows
    }

    /// How far the sampling is in all when `share` of the windows of this round are done, in 0..=1.
    pub fn progress(&self, share: f64) -> f64 {
        match &self.adaptive {
            None => share,
            Some(adaptive) => adaptive.progress(share),
        }
    }

    /// Ends the round. If there is another, the windows are what goes on.
    pub fn next_round(&mut self) -> bool {
        let Some(adaptive) = &mut self.adaptive else {
            return false;
        };
        adaptive.take(std::mem::take(&mut self.list));
        self.list = adaptive.next_round();
        !self.list.is_empty()
    }

    /// The windows to develop: rectangles with what has been gathered so far.
    pub fn developable(&self, window_side: u32) -> Vec<(Window, Vec<[f32; 4]>)> {
        let Some(adaptive) = &self.adaptive else {
            let windows = self.list.iter();
            return windows
                .map(|window| (window.blank(), window.developable()))
                .collect();
        };
        let means = |window: Window| {
            let mean = |index| {
                window
                    .pixel_at(index)
                    .map_or([0.0; 4], |at| adaptive.mean(at))
            };
            let rows = (0..window.pixel_count()).map(mean).collect();
            (window, rows)
        };
        rectangles(adaptive.crop(), window_side, 0..0, 1)
            .into_iter()
            .map(means)
            .collect()
    }

    /// The film of what has been gathered so far: all samples of the first `done` windows, and of the
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
        for (index, window) in self.list.iter().enumerate() {
            let Range { start, end } = window.samples;
            let (samples, sums) = match index < done {
                true => (start..end, window.all()),
                false => (start..sample - sample % SAMPLE_BLOCK, window.closed.clone()),
            };
            if let (Some(sums), true) = (sums, index <= done) {
                pieces.push(window.piece(samples, &sums));
            }
        }
        Film::new(header, pieces)
    }

    /// Whether some pixels are to get more samples than a block has.
    pub fn has_totals(&self) -> bool {
        let is_more = |window: &Window| window.samples.len() > SAMPLE_BLOCK as usize;
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
            None => self.list.first().map_or(0, |window| window.samples.end),
            Some(adaptive) => adaptive.samples_at(pixel),
        }
    }

    /// The most rows that a window has.
    pub fn largest(&self) -> usize {
        self.largest
    }

    fn largest_row_count(&self) -> usize {
        let counts = self.list.iter().map(Window::row_count);
        counts.max().unwrap_or(0)
    }
}

/// A region (x, y, width, height) of the picture cut into rectangles of at most this longest side, which are
/// to get these samples.
pub fn rectangles(
    [x, y, width, height]: [u32; 4],
    side: u32,
    samples: Range<u32>,
    rows_per_pixel: usize,
) -> Vec<Window> {
    let cuts = |start: u32, length: u32| {
        (0..length.div_ceil(side)).map(move |i| {
            let offset = i * side;
            (start + offset, side.min(length - offset))
        })
    };
    let row = |(wy, wh)| {
        let samples = samples.clone();
        let window = move |(wx, ww)| Window::new([wx, wy, ww, wh], samples.clone(), rows_per_pixel);
        cuts(x, width).map(window)
    };
    cuts(y, height).flat_map(row).collect()
}

fn gcd(a: u32, b: u32) -> u32 {
    if b == 0 { a } else { gcd(b, a % b) }
}
