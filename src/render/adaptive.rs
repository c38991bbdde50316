//! Adaptive sampling: which pixels go on after a round.

use super::{film::Window, settings::Settings};
use std::ops::Range;

/// Samples of the first round; later rounds double them.
const FIRST_SAMPLES: u32 = 4;

/// What all rounds have gathered, pixel by pixel of the region.
#[derive(Clone, Debug)]
pub struct Adaptive {
    region: [u32; 4],
    noise: f64,
    samples: u32,
    /// Most pixels of a window.
    window_pixels: usize,
    pixels: Vec<Account>,
}

/// What is known of a pixel.
#[derive(Clone, Copy, Debug, Default)]
struct Account {
    sum: [f64; 3],
    weight: f64,
    /// Of the samples' luminance.
    squares: f64,
    count: u32,
}

impl Adaptive {
    pub fn new(settings: &Settings) -> Self {
        let region = settings.region();
        let [.., width, height] = region;
        let side = settings.slicing.window_side as usize;
        Self {
            region,
            noise: f64::from(settings.noise),
            samples: settings.samples,
            window_pixels: side * side,
            pixels: vec![Account::default(); width as usize * height as usize],
        }
    }

    /// The samples of the first round, and windows over all the pixels.
    pub fn first_round(&self, pixels: Vec<[u32; 2]>) -> (Range<u32>, Vec<Window>) {
        (0..FIRST_SAMPLES.min(self.samples), self.windows(pixels))
    }

    /// The samples of the round after `last`, and windows over the pixels that need them, in the
    /// order of before; `None` when all are done.
    pub fn next_round(&self, last: &Range<u32>) -> Option<(Range<u32>, Vec<Window>)> {
        let round = last.end..(2 * last.end).min(self.samples);
        let [x0, y0, width, height] = self.region;
        let tiles = |length: u32| 0..length.div_ceil(8);
        let mut going_on = Vec::new();
        for (ty, tx) in tiles(height).flat_map(|y| tiles(width).map(move |x| (y, x))) {
            for (y, x) in (0..8).flat_map(|y| (0..8).map(move |x| (8 * ty + y, 8 * tx + x))) {
                if x < width && y < height && self.goes_on(x, y, last.end) {
                    going_on.push([x0 + x, y0 + y]);
                }
            }
        }
        (!round.is_empty() && !going_on.is_empty()).then(|| (round, self.windows(going_on)))
    }

    fn windows(&self, pixels: Vec<[u32; 2]>) -> Vec<Window> {
        let lists = pixels.chunks(self.window_pixels);
        lists.map(|list| Window::list(list.to_vec())).collect()
    }

    /// Adds what a round has gathered.
    pub fn take(&mut self, windows: Vec<Window>, round: &Range<u32>) {
        for window in windows {
            let places = window.places().to_vec();
            let rows = window.totals();
            for (place, rows) in places.into_iter().zip(rows.chunks_exact(2)) {
                let index = self.index(place);
                let account = &mut self.pixels[index];
                for (sum, row) in account.sum.iter_mut().zip(rows[0]) {
                    *sum += row;
                }
                account.weight += rows[0][3];
                account.squares += rows[1][0];
                account.count += round.end - round.start;
            }
        }
    }

    /// The pixel's mean, as the film has it for one sample.
    pub fn mean(&self, pixel: [u32; 2]) -> [f32; 4] {
        let account = &self.pixels[self.index(pixel)];
        let share = account.share();
        let [r, g, b] = account.sum.map(|c| (c * share) as f32);
        [r, g, b, 1.0]
    }

    pub fn samples_at(&self, pixel: [u32; 2]) -> u32 {
        self.pixels[self.index(pixel)].count
    }

    fn index(&self, [x, y]: [u32; 2]) -> usize {
        let [x0, y0, width, _] = self.region;
        (y - y0) as usize * width as usize + (x - x0) as usize
    }

    /// Whether a pixel that had part in the round that ended at sample `end` needs another. After
    /// the first round a difference from a neighbour is enough: few samples may all have missed what
    /// is there, and then agree.
    fn goes_on(&self, x: u32, y: u32, end: u32) -> bool {
        let account = self.account(x, y);
        if account.count != end {
            return false;
        }
        account.error() > self.noise || (end <= FIRST_SAMPLES && self.differs(x, y))
    }

    fn differs(&self, x: u32, y: u32) -> bool {
        let [.., width, height] = self.region;
        let own = self.account(x, y).brightness();
        let around =
            |center: u32, length: u32| center.saturating_sub(1)..=(center + 1).min(length - 1);
        around(y, height).any(|ny| {
            around(x, width).any(|nx| (self.account(nx, ny).brightness() - own).abs() > self.noise)
        })
    }

    fn account(&self, x: u32, y: u32) -> &Account {
        &self.pixels[y as usize * self.region[2] as usize + x as usize]
    }
}

impl Account {
    /// What its sum is multiplied by for the mean. Weights of both signs may cancel; what is left
    /// then says nothing, as in the shader that develops (lib/filter.wesl).
    fn share(&self) -> f64 {
        if self.weight.abs() > 0.5 {
            1.0 / self.weight
        } else {
            0.0
        }
    }

    fn luminance(&self) -> f64 {
        let [r, g, b] = self.sum;
        let sum = 0.2126 * r + 0.7152 * g + 0.0722 * b;
        (sum * self.share()).max(0.0)
    }

    /// The square root of luminance, which is nearer to what the eye sees.
    fn brightness(&self) -> f64 {
        self.luminance().sqrt()
    }

    /// By how much one standard error changes the brightness.
    fn error(&self) -> f64 {
        let count = f64::from(self.count);
        let mean = self.luminance();
        let variance = (self.squares / count - mean * mean).max(0.0) / (count - 1.0).max(1.0);
        (mean + variance.sqrt()).sqrt() - mean.sqrt()
    }
}
