//! The features of a film.

use super::Film;
use crate::render::{
    features::{Features, PixelFeatures, Places},
    layers,
};

impl Film {
    /// The features of the pixels of [`Film::region`]; `None` if the film was rendered without
    /// [`crate::render::RenderSettings::features`].
    pub fn features(&self) -> Option<Features> {
        let places = Places::new(self.header.layers)?;
        let rows = layers::pixel_rows(self.header.layers);
        let [left, top, full, height] = self.region();
        let mut pixels = vec![PixelFeatures::default(); full as usize * height as usize];
        for (([x, y, width, _], samples), sums) in self.coverage.patches().zip(&self.sums) {
            let start = (y - top) as usize * full as usize + (x - left) as usize;
            let samples = f64::from(samples.len());
            let sums = sums.rounded(rows);
            for (index, pixel) in sums.chunks_exact(rows.count).enumerate() {
                let (row, column) = (index / width as usize, index % width as usize);
                pixels[start + row * full as usize + column] = places.pixel(pixel, samples);
            }
        }
        Some(Features {
            width: full,
            height,
            pixels,
        })
    }
}
