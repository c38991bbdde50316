//! What has been gathered so far: sums of radiance and counts of samples, on the host.
//!
//! The GPU adds samples one after the other to f32 sums; after each slice they are copied here, so
//! a lost device costs one slice. Every [`CHUNK`] samples the sums go into f64 totals and start
//! again from zero, which keeps their rounding error small.

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
    /// Radiance sums and in the fourth component sample counts of the current chunk.
    pub sums: Vec<[f32; 4]>,
    /// The same of all finished chunks; empty before the first is.
    totals: Vec<[f64; 4]>,
}

impl Window {
    fn new(x: u32, y: u32, width: u32, height: u32) -> Self {
        Self {
            x,
            y,
            width,
            height,
            sums: Vec::new(),
            totals: Vec::new(),
        }
    }

    pub fn tile_columns(&self) -> u32 {
        self.width.div_ceil(TILE_SIDE)
    }

    pub fn tile_count(&self) -> u32 {
        self.tile_columns() * self.height.div_ceil(TILE_SIDE)
    }

    /// A stride coprime to the tile count that steps to the next tile down and right: neighbours
    /// share what is in the caches, and any run of tiles longer than the window is high samples all
    /// of its height.
    pub fn tile_stride(&self) -> u32 {
        let count = self.tile_count();
        (self.tile_columns() + 1..count)
            .find(|&stride| gcd(stride, count) == 1)
            .unwrap_or(1)
    }

    /// Number of pixels in film order, padding included.
    pub fn pixel_count(&self) -> usize {
        self.tile_count() as usize * TILE_PIXELS
    }

    /// Makes room for the sums, all zero.
    pub fn begin(&mut self) {
        self.sums.clear();
        self.sums.resize(self.pixel_count(), [0.0; 4]);
    }

    /// Closes a chunk: its sums become part of the totals.
    pub fn close_chunk(&mut self) {
        self.totals.resize(self.sums.len(), [0.0; 4]);
        for (total, sum) in self.totals.iter_mut().zip(&mut self.sums) {
            for (t, s) in total.iter_mut().zip(sum.iter_mut()) {
                *t += f64::from(std::mem::take(s));
            }
        }
    }

    /// What `develop` reads: sums and counts where one chunk holds them all, else means and ones.
    pub fn developable(&self) -> Vec<[f32; 4]> {
        if self.totals.is_empty() {
            return if self.sums.is_empty() {
                vec![[0.0; 4]; self.pixel_count()]
            } else {
                self.sums.clone()
            };
        }
        let mean = |(total, sum): (&[f64; 4], &[f32; 4])| {
            let [r, g, b, count] = std::array::from_fn(|i| total[i] + f64::from(sum[i]));
            let share = 1.0 / count.max(1.0);
            [r * share, g * share, b * share, 1.0].map(|c| c as f32)
        };
        self.totals.iter().zip(&self.sums).map(mean).collect()
    }
}

/// All windows of a picture, row by row.
#[derive(Clone, Debug)]
pub struct Film {
    pub windows: Vec<Window>,
}

impl Film {
    /// Cuts the region x, y, width, height into windows of at most `side` pixels.
    pub fn new([x, y, width, height]: [u32; 4], side: u32) -> Self {
        let cuts = |start: u32, length: u32| {
            (0..length.div_ceil(side)).map(move |i| {
                let offset = i * side;
                (start + offset, side.min(length - offset))
            })
        };
        let windows = cuts(y, height)
            .flat_map(|(wy, wh)| cuts(x, width).map(move |(wx, ww)| Window::new(wx, wy, ww, wh)));
        Self {
            windows: windows.collect(),
        }
    }

    /// The most pixels, in film order, that a window has.
    pub fn largest_window(&self) -> usize {
        self.windows
            .iter()
            .map(Window::pixel_count)
            .max()
            .unwrap_or(0)
    }
}

fn gcd(a: u32, b: u32) -> u32 {
    if b == 0 { a } else { gcd(b, a % b) }
}
