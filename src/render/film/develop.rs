//! Develops a film to a picture, without its scene.

use super::Film;
use crate::{
    gpu::{Gpu, Ledger, MEMORY_LIMIT_BYTES},
    image::Image,
    layout::{PackedDispatch, PackedFrame, PackedLight},
    render::{
        Fetch, Levels, Quantity, RenderError, RenderSettings, Slicing, Tone,
        develop::{Context, Developer, copy_tile, sample_count_image},
        film_tile::{FilmTile, rectangles},
        layers::{self, LayerKind},
        layouts::{Layouts, group},
        levels,
    },
};
use bytemuck::bytes_of;
use wgpu::BufferUsages;

/// Bytes per pixel of the picture, its film, and their copies for upload and readback.
const PIXEL_BYTES: u64 = 64;

impl Film {
    /// Develops the bounding rectangle of all pixels, with the same result as the renderer that made the film.
    /// Pixels without samples are black.
    ///
    /// # Errors
    /// The device failed, or the picture exceeds [`MEMORY_LIMIT_BYTES`].
    pub fn develop(&self, gpu: &Gpu, tone: &Tone) -> Result<Image, RenderError> {
        let region = self.region();
        let [x, y, width, height] = region;
        let pixels = u64::from(width).saturating_mul(height.into());
        let mut ledger = Ledger::default();
        ledger.plan("picture and film", pixels.saturating_mul(PIXEL_BYTES));
        ledger.check(MEMORY_LIMIT_BYTES)?;
        let range = self.range_of(tone);
        if self.header.integrator.quantity() == Some(Quantity::Samples) {
            let counts: Vec<_> = (self.layer(LayerKind::Count).iter())
                .map(|row| row[0])
                .collect();
            return Ok(sample_count_image(
                region,
                &counts,
                self.header.samples,
                range,
            ));
        }
        let mut image = Image::new(width, height);
        let tiles = rectangles(region, Slicing::default().tile_side, 0..0, 1);
        let Some(most) = tiles.iter().map(FilmTile::pixel_count).max() else {
            return Ok(image);
        };
        let layouts = Layouts::new(gpu, Fetch::Buffer);
        let written = BufferUsages::STORAGE | BufferUsages::COPY_DST;
        let film = gpu.allocate("film", most as u64 * 16, written)?;
        let read = BufferUsages::MAP_READ | BufferUsages::COPY_DST;
        let staging = gpu.allocate("staging", most as u64 * 16, read)?;
        let dispatch = gpu.allocate("dispatch", size_of::<PackedDispatch>() as u64, written)?;
        // The layout requires a frame, which is not used.
        let frame = (PackedFrame::default(), PackedLight::default());
        let frame = gpu.upload("frame", &[bytes_of(&frame.0), bytes_of(&frame.1)].concat())?;
        let shared = [frame.as_entire_binding(), dispatch.as_entire_binding()];
        let context = Context {
            gpu,
            layouts: &layouts,
            frame_group: &group(gpu, &layouts.frame, &shared),
            film_group: &group(gpu, &layouts.film, &[film.as_entire_binding()]),
            dispatch: &dispatch,
            film: &film,
            staging: &staging,
        };
        let developer = Developer::new(context, most)?;
        let settings = RenderSettings {
            size: self.header.size,
            ..RenderSettings::default()
        };
        let tone = tone.packed(self.header.integrator, range, 1);
        let means = self.layer(LayerKind::Weighted);
        let mean =
            |[px, py]: [u32; 2]| means[(py - y) as usize * width as usize + (px - x) as usize];
        for tile in tiles {
            let pixels = (0..tile.pixel_count()).map(|index| tile.pixel_at(index));
            let rows: Vec<_> = pixels.map(|pixel| pixel.map_or([0.0; 4], mean)).collect();
            let pixels = developer.develop(context, &tile, &rows, &settings, &tone)?;
            copy_tile(&mut image, &pixels, &tile, [x, y]);
        }
        Ok(image)
    }

    /// The minimum and maximum, without [`Quantity::outliers`]; see [`crate::render::Renderer::range`].
    pub fn range(&self) -> Option<[f32; 2]> {
        let quantity = self.header.integrator.quantity()?;
        let values = match quantity {
            Quantity::Samples => {
                let patches = self.patches(LayerKind::Count);
                patches
                    .flat_map(|(_, rows)| rows)
                    .map(|row| row[0])
                    .collect()
            }
            Quantity::Distance | Quantity::Work => {
                let patches = self.patches(LayerKind::Weighted);
                let rows: Vec<_> = patches.flat_map(|(_, rows)| rows).collect();
                levels::values(quantity, rows.iter())
            }
        };
        levels::extent(values, quantity)
    }

    fn range_of(&self, tone: &Tone) -> Option<[f32; 2]> {
        match tone.levels {
            Levels::Raw => None,
            Levels::Found => self.range(),
            Levels::Fixed(range) => self.header.integrator.quantity().map(|_| range),
        }
    }

    /// The developable values of a layer, for each pixel of [`Film::region`] row by row; zeros without samples.
    fn layer(&self, kind: LayerKind) -> Vec<[f32; 4]> {
        let [left, top, full, height] = self.region();
        let full = full as usize;
        let mut found = vec![[0.0; 4]; full * height as usize];
        for ([x, y, width, _], rows) in self.patches(kind) {
            let start = (y - top) as usize * full + (x - left) as usize;
            for (index, line) in rows.chunks_exact(width as usize).enumerate() {
                let start = start + index * full;
                found[start..start + line.len()].copy_from_slice(line);
            }
        }
        found
    }

    /// The developable values of a layer for the pixels with samples, by rectangle (x, y, width, height).
    fn patches(&self, kind: LayerKind) -> impl Iterator<Item = ([u32; 4], Vec<[f32; 4]>)> {
        let layers = self.header.layers;
        let layer = layers.iter().find(|layer| layer.kind == kind);
        let first = layer.and_then(|layer| layers::row_of(layers, layer));
        let patches = self.coverage.patches().zip(&self.sums);
        patches.map(move |((region, samples), sums)| {
            let pixels = sums.developable();
            let pixels = pixels.chunks_exact(self.rows());
            let rows = match first {
                Some(first) => pixels.map(|pixel| pixel[first]).collect(),
                // All pixels have the same number of samples if no layer counts them.
                None => pixels
                    .map(|_| [samples.len() as f32, 0.0, 0.0, 0.0])
                    .collect(),
            };
            (region, rows)
        })
    }
}
