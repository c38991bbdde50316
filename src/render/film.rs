//! What has been gathered so far: sums of radiance and counts of samples, on the host.
//!
//! The GPU adds samples one after the other to f32 sums; after each slice they are copied here, so
//! a lost device costs one slice. Every [`CHUNK`] samples the sums go into f64 totals and start
//! again from zero, which keeps their rounding error small.
//!
//! Without adaptive sampling there is one round: all samples, window by window. With it
//! (adaptive.rs) there are several, and a window is a list of the pixels that go on.

use super::{adaptive::Adaptive, layers, settings::Settings};
use std::ops::Range;

/// Most samples that are summed in f32.
pub const CHUNK: u32 = 256;

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
    /// Rows of the film for each pixel.
    rows_per_pixel: usize,
    /// Rows of the film in the current chunk: for each pixel its radiance sum and in the fourth
    /// component its weights, then those of the other layers.
    pub sums: Vec<[f32; 4]>,
    /// The same of all finished chunks; empty before the first is.
    totals: Vec<[f64; 4]>,
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
            sums: Vec::new(),
            totals: Vec::new(),
        }
    }

    /// A list of pixels of the picture, at least one.
    pub fn list(places: Vec<[u32; 2]>, samples: Range<u32>) -> Self {
        let mut window = Self::new([0, 0, TILE_SIDE, TILE_SIDE], samples, 2);
        window.places = places;
        window
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
        for (rows, [x, y]) in self.sums.chunks_exact_mut(2).zip(&self.places) {
            rows[1] = [0.0, *x as f32, *y as f32, 1.0];
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

    /// Closes a chunk: its sums become part of the totals.
    pub fn close_chunk(&mut self) {
        self.totals.resize(self.sums.len(), [0.0; 4]);
        for (total, sum) in self.totals.iter_mut().zip(&self.sums) {
            for (t, s) in total.iter_mut().zip(sum) {
                *t += f64::from(*s);
            }
        }
        self.begin();
    }

    /// The rows of all chunks together; those of a list hold its places as often as there were
    /// chunks, and are of no use there.
    pub fn totals(mut self) -> Vec<[f64; 4]> {
        self.close_chunk();
        self.totals
    }

    /// What `develop` reads: sums and counts where one chunk holds them all, else means and ones.
    pub fn developable(&self) -> Vec<[f32; 4]> {
        if self.totals.is_empty() {
            return if self.sums.is_empty() {
                vec![[0.0; 4]; self.row_count()]
            } else {
                self.sums.clone()
            };
        }
        let mean = |(total, sum): (&[f64; 4], &[f32; 4])| {
            let [r, g, b, count] = std::array::from_fn(|i| total[i] + f64::from(sum[i]));
            // More than a chunk of samples: their weights do not cancel.
            let share = 1.0 / count.max(1.0);
            [r * share, g * share, b * share, 1.0].map(|c| c as f32)
        };
        self.totals.iter().zip(&self.sums).map(mean).collect()
    }
}

/// All windows of a picture, row by row, and the samples that they are to get.
#[derive(Clone, Debug)]
pub struct Film {
    pub windows: Vec<Window>,
    adaptive: Option<Adaptive>,
    /// In film rows, of all rounds.
    largest_window: usize,
}

impl Film {
    /// Cuts the region into windows and plans the first round.
    pub fn new(settings: &Settings) -> Self {
        let adaptive = settings.is_adaptive().then(|| Adaptive::new(settings));
        let region = (adaptive.as_ref()).map_or(settings.region(), Adaptive::region);
        let mut film = Self {
            windows: rectangles(settings, region),
            adaptive,
            largest_window: 0,
        };
        film.largest_window = film.largest_row_count();
        if let Some(adaptive) = &film.adaptive {
            // In the order of tiles, so that what lies together stays together.
            let rectangles = film.windows.iter();
            let pixels = rectangles.flat_map(|window| {
                (0..window.pixel_count()).filter_map(|index| window.pixel_at(index))
            });
            film.windows = adaptive.first_round(pixels.collect());
            film.largest_window = film.largest_window.max(film.largest_row_count());
        }
        film
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
        adaptive.take(std::mem::take(&mut self.windows));
        self.windows = adaptive.next_round();
        !self.windows.is_empty()
    }

    /// The windows to develop: rectangles with what has been gathered so far.
    pub fn developable(&self, settings: &Settings) -> Vec<(Window, Vec<[f32; 4]>)> {
        let rectangles = rectangles(settings, settings.region());
        match &self.adaptive {
            None => (rectangles.into_iter().zip(&self.windows))
                .map(|(rectangle, window)| (rectangle, window.developable()))
                .collect(),
            Some(adaptive) => (rectangles.into_iter())
                .map(|window| {
                    let means = (0..window.pixel_count())
                        .map(|index| {
                            window
                                .pixel_at(index)
                                .map_or([0.0; 4], |p| adaptive.mean(p))
                        })
                        .collect();
                    (window, means)
                })
                .collect(),
        }
    }

    /// Whether the whole picture is sampled at once, every pixel in its turn.
    pub fn is_one_rectangle(&self) -> bool {
        self.adaptive.is_none() && self.windows.len() == 1
    }

    /// Whether moreover all samples so far are in one sum.
    pub fn is_one_sum(&self) -> bool {
        self.is_one_rectangle() && self.windows[0].totals.is_empty()
    }

    /// The samples that a pixel of the picture has got.
    pub fn samples_at(&self, pixel: [u32; 2]) -> u32 {
        match &self.adaptive {
            None => self.windows.first().map_or(0, |window| window.samples.end),
            Some(adaptive) => adaptive.samples_at(pixel),
        }
    }

    /// The most rows that a window has.
    pub fn largest_window(&self) -> usize {
        self.largest_window
    }

    fn largest_row_count(&self) -> usize {
        let counts = self.windows.iter().map(Window::row_count);
        counts.max().unwrap_or(0)
    }
}

/// A region of the picture cut into rectangles of at most the longest side of a window.
fn rectangles(settings: &Settings, [x, y, width, height]: [u32; 4]) -> Vec<Window> {
    // Of adaptive sampling only the mean is laid out in rectangles, to be developed.
    let rows = match settings.is_adaptive() {
        true => 1,
        false => layers::rows(layers::of_sampling(settings)),
    };
    // A window of as many bytes, whatever a pixel takes.
    let side = settings.slicing.window_side / (rows as u32).isqrt();
    let cuts = |start: u32, length: u32| {
        (0..length.div_ceil(side)).map(move |i| {
            let offset = i * side;
            (start + offset, side.min(length - offset))
        })
    };
    let row = |(wy, wh)| {
        cuts(x, width).map(move |(wx, ww)| Window::new([wx, wy, ww, wh], 0..settings.samples, rows))
    };
    cuts(y, height).flat_map(row).collect()
}

fn gcd(a: u32, b: u32) -> u32 {
    if b == 0 { a } else { gcd(b, a % b) }
}
