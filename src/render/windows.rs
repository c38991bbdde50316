//! What has been gathered so far, window by window as the GPU works on it.
//!
//! Without adaptive sampling there is one round: all samples, window by window. With it
//! (adaptive.rs) there are several, and a window is a list of the pixels that go on.

use super::{
    adaptive::Adaptive,
    film::{Film, FilmError, FilmHeader, Piece},
    layers,
    settings::RenderSettings,
    sums::{SAMPLE_BLOCK, Sums},
    window::{Window, rectangles},
};
use std::ops::Range;

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

    /// How far the sampling is in all when `fraction` of the windows of this round are done, in 0..=1.
    pub fn progress(&self, fraction: f64) -> f64 {
        match &self.adaptive {
            None => fraction,
            Some(adaptive) => adaptive.progress(fraction),
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
                pieces.push(piece(window, samples, &sums));
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

/// The sums of a window, its pixels row by row.
fn piece(window: &Window, samples: Range<u32>, sums: &Sums) -> Piece {
    let rows = window.rows_per_pixel();
    let pixels = window.sampled_pixels() as usize;
    let mut ordered = Sums::zeros(rows * pixels, matches!(sums, Sums::Block(_)));
    for index in 0..window.pixel_count() {
        if let Some([x, y]) = window.pixel_at(index) {
            let to = (y - window.y) as usize * window.width as usize + (x - window.x) as usize;
            ordered.add(rows * to, sums, rows * index, rows);
        }
    }
    Piece {
        region: [window.x, window.y, window.width, window.height],
        samples,
        sums: ordered,
    }
}
