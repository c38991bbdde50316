//! A film tile: the part of the picture that is on the GPU at a time.
//!
//! The GPU adds samples one after the other to f32 sums. After each slice the sums are copied here, so a lost
//! device costs at most one slice. After every [`super::SAMPLE_BLOCK`] samples the sums are added to exact
//! totals and restart from zero.

use super::{
    layers::{self, Layer, SQUARES},
    sums::{PixelRows, SAMPLE_BLOCK, Sums, Totals},
};
use crate::gpu::Gpu;
use glimray_scene::threads;
use std::{borrow::Cow, ops::Range};

/// Pixels of a workgroup.
pub const GROUP_PIXELS: usize = 64;
const GROUP_SIDE: u32 = 8;

/// The order in which workgroups visit a film tile.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum GroupOrder {
    /// Down a diagonal, then down the next: those that run at the same time are neighbours, and share cached data.
    Diagonal,
    /// Down a row and over a part of the width, by the golden section: all ranges take about as long. Software adapters give
    /// each thread one range.
    Spread,
}

/// The smaller part of a length that is divided by it.
const GOLDEN_SECTION: f64 = 0.381_966;

impl GroupOrder {
    /// The faster one on an adapter.
    pub fn of(gpu: &Gpu) -> Self {
        match gpu.is_cpu() {
            true => Self::Spread,
            false => Self::Diagonal,
        }
    }
}

/// A rectangle or a list of pixels of the picture that is on the GPU at a time. Its pixels are in film order:
/// workgroup by workgroup in dispatch order, 64 lanes each, with padding at the edges.
#[derive(Clone, Debug)]
pub struct FilmTile {
    pub x: u32,
    pub y: u32,
    pub width: u32,
    pub height: u32,
    /// The samples to render.
    pub samples: Range<u32>,
    order: GroupOrder,
    /// The pixels of a list, in film order; empty for a rectangle.
    places: Vec<[u32; 2]>,
    /// Rows of a pixel, and the row that holds the pixel position in a list.
    rows: PixelRows,
    place_row: usize,
    /// Film rows of the current block, layer by layer for each pixel. Empty before the block starts, and in a rectangle
    /// until rows are read back.
    pub sums: Vec<[f32; 4]>,
    /// The sums of all finished blocks.
    pub closed: Option<Sums>,
}

impl FilmTile {
    /// A rectangle of the picture.
    pub fn new(
        [x, y, width, height]: [u32; 4],
        samples: Range<u32>,
        rows: PixelRows,
        order: GroupOrder,
    ) -> Self {
        Self {
            x,
            y,
            width,
            height,
            samples,
            order,
            places: Vec::new(),
            rows,
            place_row: 0,
            sums: Vec::new(),
            closed: None,
        }
    }

    /// A list of pixels of the picture, not empty.
    pub fn list(
        places: Vec<[u32; 2]>,
        samples: Range<u32>,
        layers: &[&Layer],
        order: GroupOrder,
    ) -> Self {
        let side = GROUP_SIDE;
        let rows = layers::pixel_rows(layers);
        let mut tile = Self::new([0, 0, side, side], samples, rows, order);
        tile.place_row = layers::row_of(layers, &SQUARES).unwrap_or_default();
        tile.places = places;
        tile
    }

    /// A tile of this rectangle without sums.
    pub fn blank(&self) -> Self {
        Self::new(self.region(), self.samples.clone(), self.rows, self.order)
    }

    /// x, y, width, height.
    pub fn region(&self) -> [u32; 4] {
        [self.x, self.y, self.width, self.height]
    }

    /// Number of pixels without padding.
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

    /// Film rows per pixel.
    pub fn rows_per_pixel(&self) -> usize {
        self.rows.count
    }

    fn group_columns(&self) -> u32 {
        self.width.div_ceil(GROUP_SIDE)
    }

    pub fn group_count(&self) -> u32 {
        if self.places.is_empty() {
            self.group_columns() * self.height.div_ceil(GROUP_SIDE)
        } else {
            self.places.len().div_ceil(GROUP_PIXELS) as u32
        }
    }

    /// The stride in which workgroups visit the tile, coprime to their number: one down, and some to the right.
    pub fn group_stride(&self) -> u32 {
        let count = self.group_count();
        let columns = match self.places.len() {
            0 => self.group_columns(),
            _ => count.isqrt(),
        };
        let right = match self.order {
            GroupOrder::Diagonal => 1,
            GroupOrder::Spread => 1 + (f64::from(columns) * GOLDEN_SECTION) as u32,
        };
        coprime_stride(columns + right, count)
    }

    /// Number of pixels in film order, padding included.
    pub fn pixel_count(&self) -> usize {
        self.group_count() as usize * GROUP_PIXELS
    }

    /// Number of film rows.
    pub fn row_count(&self) -> usize {
        self.pixel_count() * self.rows_per_pixel()
    }

    /// Allocates the rows, if there are none, and writes to them.
    pub fn touch_memory(&mut self) {
        if self.sums.capacity() == 0 {
            // Zeros would not be written.
            self.sums = vec![[1.0; 4]; self.row_count()];
            self.sums.clear();
        }
    }

    /// Begins a block. The rows of a list hold the positions of its pixels; those of a rectangle are zeros, which need
    /// no memory before they are replaced.
    pub fn begin_block(&mut self) {
        self.sums.clear();
        if self.places.is_empty() {
            return;
        }
        self.fill_with_zeros();
        let len = threads::chunk_len(self.places.len());
        let sums = self.sums.chunks_mut(self.rows.count * len);
        threads::for_each(sums.zip(self.places.chunks(len)), |(sums, places)| {
            for (rows, [x, y]) in sums.chunks_exact_mut(self.rows.count).zip(places) {
                rows[self.place_row] = [0.0, *x as f32, *y as f32, 1.0];
            }
        });
    }

    /// Replaces rows of the current block, from `first` on.
    pub fn replace_rows(&mut self, first: usize, rows: &[[f32; 4]]) {
        if rows.is_empty() {
            return;
        }
        if rows.len() == self.row_count() {
            self.sums.clear();
            self.sums.extend_from_slice(rows);
            return;
        }
        if self.sums.is_empty() {
            self.fill_with_zeros();
        }
        self.sums[first..first + rows.len()].copy_from_slice(rows);
    }

    fn fill_with_zeros(&mut self) {
        match self.sums.capacity() {
            // Zeros from the system, which are in no memory before they are replaced.
            0 => self.sums = vec![[0.0; 4]; self.row_count()],
            _ => self.sums.resize(self.row_count(), [0.0; 4]),
        }
    }

    /// The positions in the picture of the pixels of a rectangle, in film order; `None` for padding. The order is that
    /// of the shader (scene/block.wesl).
    pub fn pixels(&self) -> impl Iterator<Item = Option<[u32; 2]>> {
        self.pixels_from(0)
    }

    /// The pixels from a workgroup on, as in [`Self::pixels`].
    fn pixels_from(&self, group: usize) -> impl Iterator<Item = Option<[u32; 2]>> {
        let (count, columns) = (self.group_count(), self.group_columns());
        let stride = u64::from(self.group_stride());
        (group as u64..u64::from(count)).flat_map(move |index| {
            let group = (index * stride % u64::from(count)) as u32;
            let corner = [group % columns, group / columns].map(|at| at * GROUP_SIDE);
            (0..GROUP_PIXELS as u32).map(move |lane| self.pixel_of(corner, lane))
        })
    }

    /// The pixel of a lane in the workgroup with this corner, unless it is padding.
    fn pixel_of(&self, corner: [u32; 2], lane: u32) -> Option<[u32; 2]> {
        let bit = |shift: u32, to: u32| ((lane >> shift) & 1) << to;
        let x = corner[0] + (bit(0, 0) | bit(2, 1) | bit(4, 2));
        let y = corner[1] + (bit(1, 0) | bit(3, 1) | bit(5, 2));
        (x < self.width && y < self.height).then_some([self.x + x, self.y + y])
    }

    /// A row for each pixel of a rectangle, in film order; zeros for padding.
    pub fn rows_of(&self, row: impl Fn([u32; 2]) -> [f32; 4] + Sync) -> Vec<[f32; 4]> {
        let mut rows = vec![[0.0; 4]; self.pixel_count()];
        let groups = threads::chunk_len(rows.len()).div_ceil(GROUP_PIXELS);
        let chunks = rows.chunks_mut(groups * GROUP_PIXELS).enumerate();
        threads::for_each(chunks, |(index, rows)| {
            for (own, pixel) in rows.iter_mut().zip(self.pixels_from(index * groups)) {
                *own = pixel.map_or([0.0; 4], &row);
            }
        });
        rows
    }

    /// The number of blocks that are in [`Self::closed`] before `sample` is taken, a sample after the first: the last
    /// block of the tile stays open.
    pub fn closed_blocks(&self, sample: u32) -> u32 {
        let last = sample.min(self.samples.end - 1);
        last / SAMPLE_BLOCK - self.samples.start / SAMPLE_BLOCK
    }

    /// Finishes a block: adds its sums to the totals.
    pub fn close_block(&mut self) {
        self.closed = Some(Sums::with_block(self.closed.take(), &self.sums, self.rows));
        self.sums.clear();
    }

    /// The sums of all samples, `None` before the first.
    pub fn all_sums(&self) -> Option<Sums> {
        match self.sums.is_empty() {
            true => self.closed.clone(),
            false => Some(Sums::with_block(self.closed.clone(), &self.sums, self.rows)),
        }
    }

    /// The film rows of all blocks together, `None` before the first sample. For a list, the rows with positions are
    /// summed as well and therefore meaningless.
    pub fn totals(&self) -> Option<Totals<'_>> {
        match &self.closed {
            None if self.sums.is_empty() => None,
            None => Some(Totals::Block(&self.sums)),
            Some(closed) if self.sums.is_empty() => Some(Totals::Blocks(Cow::Borrowed(closed))),
            Some(_) => self.all_sums().map(|sums| Totals::Blocks(Cow::Owned(sums))),
        }
    }

    /// The rows of the pixels of a rectangle, row by row instead of in film order.
    pub fn by_rows(&self, totals: &Totals) -> Sums {
        match totals {
            Totals::Block(block) => Sums::Block(self.gathered(block, [0.0; 4])),
            Totals::Blocks(sums) => match &**sums {
                Sums::Block(block) => Sums::Block(self.gathered(block, [0.0; 4])),
                Sums::Totals(totals) => Sums::Totals(self.gathered(totals, [0; 4])),
            },
        }
    }

    fn gathered<R: Copy + Send + Sync>(&self, from: &[R], zero: R) -> Vec<R> {
        let mut indices = vec![0; self.sampled_pixels() as usize];
        for (index, pixel) in self.pixels().enumerate() {
            if let Some([x, y]) = pixel {
                indices[((y - self.y) * self.width + x - self.x) as usize] = index as u32;
            }
        }
        let count = self.rows.count;
        let mut rows = vec![zero; count * indices.len()];
        let len = threads::chunk_len(indices.len());
        threads::for_each(
            rows.chunks_mut(count * len).zip(indices.chunks(len)),
            |(rows, indices)| {
                for (own, index) in rows.chunks_exact_mut(count).zip(indices) {
                    own.copy_from_slice(&from[count * *index as usize..][..count]);
                }
            },
        );
        rows
    }

    /// The rows for `develop`: sums and weights of a single block, otherwise means with a weight of 1.
    pub fn developable(&self) -> Vec<[f32; 4]> {
        match self.totals() {
            None => vec![[0.0; 4]; self.row_count()],
            Some(Totals::Block(block)) => block.to_vec(),
            Some(Totals::Blocks(sums)) => sums.developable(),
        }
    }
}

/// Splits a region (x, y, width, height) of the picture into rectangles of at most `side` pixels a side.
pub fn rectangles(
    [x, y, width, height]: [u32; 4],
    side: u32,
    samples: Range<u32>,
    rows: PixelRows,
    order: GroupOrder,
) -> Vec<FilmTile> {
    let cuts = |start: u32, length: u32| {
        (0..length.div_ceil(side)).map(move |i| {
            let offset = i * side;
            (start + offset, side.min(length - offset))
        })
    };
    let row = |(wy, wh)| {
        let samples = samples.clone();
        let tile = move |(wx, ww)| FilmTile::new([wx, wy, ww, wh], samples.clone(), rows, order);
        cuts(x, width).map(tile)
    };
    cuts(y, height).flat_map(row).collect()
}

/// The smallest number of at least `least` that is coprime to `count` and below it, or else 1.
pub fn coprime_stride(least: u32, count: u32) -> u32 {
    let is_coprime = |stride: &u32| gcd(*stride, count) == 1;
    (least..count).find(is_coprime).unwrap_or(1)
}

fn gcd(a: u32, b: u32) -> u32 {
    if b == 0 { a } else { gcd(b, a % b) }
}

#[cfg(test)]
mod tests {
    use super::{FilmTile, GROUP_PIXELS, GroupOrder};
    use crate::sums::PixelRows;

    /// Any quarter of the workgroups, one after the other, has about as many in each quarter of the picture: lavapipe gives
    /// each thread such a range.
    #[test]
    fn ranges_of_workgroups_are_spread_over_the_picture() {
        for [width, height] in [[512, 512], [640, 480], [1920, 1080], [300, 1000]] {
            let region = [0, 0, width, height];
            let tile = FilmTile::new(region, 0..1, PixelRows::ONE, GroupOrder::Spread);
            let corners: Vec<_> = (tile.pixels().step_by(GROUP_PIXELS).flatten()).collect();
            let quarter = corners.len() / 4;
            for range in corners.chunks_exact(quarter) {
                let mut counts = [0; 4];
                for [x, y] in range {
                    counts[usize::from(2 * x >= width) + 2 * usize::from(2 * y >= height)] += 1;
                }
                let even = quarter as f64 / 4.0;
                let off = counts.map(|count| (f64::from(count) / even - 1.0).abs());
                assert!(
                    off.iter().all(|off| *off < 0.1),
                    "{width}×{height}: {counts:?}"
                );
            }
        }
    }
}
