//! The features of a film.

use super::Film;
use crate::{
    features::{Features, PixelFeatures, Places},
    layers,
    sums::fill_rectangle,
};

impl Film {
    /// The features of the pixels of [`Film::region`]; `None` if the film was rendered without
    /// [`crate::RenderSettings::features`].
    pub fn features(&self) -> Option<Features> {
        let places = Places::new(self.header.layers)?;
        let rows = layers::pixel_rows(self.header.layers);
        let region = self.region();
        let [.., width, height] = region;
        let mut pixels = vec![PixelFeatures::default(); width as usize * height as usize];
        for ((patch, samples), sums) in self.coverage.patches().zip(&self.sums) {
            let samples = f64::from(samples.len());
            fill_rectangle(&mut pixels, region, patch, (sums, rows), |pixel| {
                places.pixel(pixel, samples)
            });
        }
        Some(Features {
            width,
            height,
            pixels,
        })
    }
}
