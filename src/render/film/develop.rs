//! From a film to a picture, without the scene that it is of.

use super::Film;
use crate::{
    gpu::Gpu,
    image::Image,
    layout::{PackedFrame, PackedLight, PackedSlice},
    render::{
        Fetch, Levels, Quantity, RenderError, RenderSettings, Slicing, Tone,
        develop::{Bench, Developer, counted, put},
        layers::{self, LayerKind},
        layouts::{Layouts, group},
        levels,
        windows::{Window, rectangles},
    },
};
use bytemuck::bytes_of;
use wgpu::BufferUsages;

impl Film {
    /// The picture of the rectangle round all its pixels, the same as that of the renderer which they are
    /// from. Pixels without samples are black.
    ///
    /// # Errors
    /// The device failed.
    pub fn develop(&self, gpu: &Gpu, tone: &Tone) -> Result<Image, RenderError> {
        let region = self.region();
        let range = self.range_of(tone);
        if self.header.integrator.quantity() == Some(Quantity::Samples) {
            return Ok(counted(region, &self.counts(), self.header.samples, range));
        }
        let [x, y, width, height] = region;
        let mut image = Image::new(width, height);
        let windows = rectangles(region, Slicing::default().window_side, 0..0, 1);
        let Some(most) = windows.iter().map(Window::pixel_count).max() else {
            return Ok(image);
        };
        let layouts = Layouts::new(gpu, Fetch::Buffer);
        let written = BufferUsages::STORAGE | BufferUsages::COPY_DST;
        let film = gpu.allocate("film", most as u64 * 16, written)?;
        let read = BufferUsages::MAP_READ | BufferUsages::COPY_DST;
        let staging = gpu.allocate("staging", most as u64 * 16, read)?;
        let slice = gpu.allocate("slice", size_of::<PackedSlice>() as u64, written)?;
        // The layout has a frame, which is not looked at.
        let frame = (PackedFrame::default(), PackedLight::default());
        let frame = gpu.upload("frame", &[bytes_of(&frame.0), bytes_of(&frame.1)].concat())?;
        let shared = [frame.as_entire_binding(), slice.as_entire_binding()];
        let bench = Bench {
            gpu,
            layouts: &layouts,
            frame_group: &group(gpu, &layouts.frame, &shared),
            film_group: &group(gpu, &layouts.film, &[film.as_entire_binding()]),
            slice: &slice,
            film: &film,
            staging: &staging,
        };
        let developer = Developer::new(bench, most)?;
        let settings = RenderSettings {
            size: self.header.size,
            ..RenderSettings::default()
        };
        let tone = tone.packed(self.header.integrator, range, 1);
        let means = self.layer(LayerKind::Weighted);
        let mean =
            |[px, py]: [u32; 2]| means[(py - y) as usize * width as usize + (px - x) as usize];
        for window in windows {
            let pixels = (0..window.pixel_count()).map(|index| window.pixel_at(index));
            let rows: Vec<_> = pixels.map(|pixel| pixel.map_or([0.0; 4], mean)).collect();
            let pixels = developer.develop(bench, &window, &rows, &settings, &tone)?;
            put(&mut image, &pixels, &window, [x, y]);
        }
        Ok(image)
    }

    /// The least and the greatest value in it, less [`Quantity::outliers`]; see
    /// [`crate::render::Renderer::range`].
    pub fn range(&self) -> Option<[f32; 2]> {
        let quantity = self.header.integrator.quantity()?;
        let values = match quantity {
            Quantity::Samples => self.counts(),
            _ => levels::values(quantity, self.layer(LayerKind::Weighted).iter()),
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

    /// The samples of each pixel of [`Film::region`], row by row.
    fn counts(&self) -> Vec<f32> {
        match self.header.is_adaptive() {
            true => self
                .layer(LayerKind::Count)
                .iter()
                .map(|row| row[0])
                .collect(),
            false => {
                let [.., width, height] = self.region();
                vec![self.header.samples as f32; width as usize * height as usize]
            }
        }
    }

    /// The first rows of a layer to be developed, of each pixel of [`Film::region`] row by row.
    fn layer(&self, kind: LayerKind) -> Vec<[f32; 4]> {
        let [left, top, full, height] = self.region();
        let mut found = vec![[0.0; 4]; full as usize * height as usize];
        let layers = self.header.layers;
        let Some(layer) = layers.iter().find(|layer| layer.kind == kind) else {
            return found;
        };
        let (rows, first) = (
            self.rows(),
            layers::row_of(layers, layer).unwrap_or_default(),
        );
        for (([x, y, width, _], _), sums) in self.coverage.patches().zip(&self.sums) {
            let (width, full) = (width as usize, full as usize);
            let start = (y - top) as usize * full + (x - left) as usize;
            for (index, pixel) in sums.developable().chunks_exact(rows).enumerate() {
                found[start + index / width * full + index % width] = pixel[first];
            }
        }
        found
    }
}
