//! Develops a film to a picture, without its scene.

use super::Film;
use crate::{
    Levels, Quantity, RenderError, Tone,
    develop::{develop_sums, sample_count_image},
    film_pass::{PIXEL_BYTES, check_memory},
    gpu::Gpu,
    layers::{self, LayerKind},
    levels, opacity,
};
use glimray_scene::{image::Image, threads};

impl Film {
    /// Develops the bounding rectangle of all pixels, with the same result as the renderer that made the film, except
    /// that it is never denoised: see [`Film::features`] and [`crate::denoise()`].
    /// Pixels without samples are black.
    ///
    /// # Errors
    /// The device failed, or the picture exceeds [`crate::gpu::MEMORY_LIMIT_BYTES`].
    pub async fn develop_async(&self, gpu: &Gpu, tone: &Tone) -> Result<Image, RenderError> {
        let region = self.region();
        check_memory(region[2], region[3], PIXEL_BYTES)?;
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
        let layers = self.header.layers;
        let patches = self.coverage.patches().zip(&self.sums);
        let patches = patches.map(|((region, _), sums)| (region, sums));
        if let Some(image) = opacity::picture(region, layers, patches) {
            return tone.develop_async(gpu, &image).await;
        }
        let sums = self.layer(LayerKind::Weighted);
        let tone = tone.exposed(|| sums.iter());
        develop_sums(
            gpu,
            region,
            &sums,
            &tone.packed(self.header.integrator, range, 1),
        )
        .await
    }

    /// The minimum and maximum, without [`Quantity::outliers`]; see [`crate::Renderer::range`].
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
        let rows_per_pixel = self.rows();
        let layer = layers.iter().find(|layer| layer.kind == kind);
        let first = layer.and_then(|layer| layers::row_of(layers, layer));
        let patches = self.coverage.patches().zip(&self.sums);
        patches.map(move |((region, samples), sums)| {
            let pixels = region[2] as usize * region[3] as usize;
            let rows = match first {
                Some(first) => threads::collect(pixels, |pixel| {
                    sums.developable_row(pixel * rows_per_pixel + first)
                }),
                // All pixels have the same number of samples if no layer counts them.
                None => vec![[samples.len() as f32, 0.0, 0.0, 0.0]; pixels],
            };
            (region, rows)
        })
    }
}
