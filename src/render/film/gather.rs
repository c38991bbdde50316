//! Converts the state of a renderer to a film.

use super::{
    Film, FilmHeader, FilmOutline,
    coverage::{Coverage, SampleSet},
};
use crate::render::{
    Fingerprint, RenderError, RenderSettings, Renderer, Tone, features::number_of, layers,
    sums::Sums,
};

impl Renderer {
    /// The film of all finished blocks of samples so far ([`crate::render::SAMPLE_BLOCK`]); of all samples once
    /// the render is done.
    ///
    /// # Errors
    /// The sample range of the settings does not consist of whole blocks, or the picture is adaptive and not
    /// finished.
    pub fn film(&self) -> Result<Film, RenderError> {
        let header = self.header(&self.settings);
        let (done, sample) = (self.cursor.tile, self.cursor.sample);
        let layers = header.layers;
        let mut film = self.tiles.film(header, done, sample)?;
        if let Some(first) = layers::row_of(layers, &layers::FIRST) {
            let number =
                |primitive, instance| number_of(&self.scene, &self.view, primitive, instance);
            let rows = layers::rows(layers);
            film.sums
                .iter_mut()
                .for_each(|sums| name_objects(sums, rows, first, number));
        }
        Ok(film)
    }

    /// The outline of the film of the whole picture with other settings, of the same scene and view.
    pub fn outline_of(&self, settings: &RenderSettings) -> FilmOutline {
        let header = self.header(settings);
        let all = SampleSet::new(0..header.samples);
        FilmOutline {
            coverage: Coverage::rectangle(header.whole(), all),
            header,
        }
    }

    fn header(&self, settings: &RenderSettings) -> FilmHeader {
        FilmHeader {
            program: env!("CARGO_PKG_VERSION").to_owned(),
            scene: Fingerprint::of_scene(&self.scene),
            view: Fingerprint::of_view(&self.view),
            settings: settings.of_whole().fingerprint(),
            integrator: settings.integrator,
            size: settings.size,
            samples: settings.samples,
            layers: layers::of_pictures(settings),
            tone: Tone::LINEAR,
            adapters: [self.adapter().identity()].into(),
        }
    }
}

/// Replaces the instance and the primitive of the first surface by the number of its object.
fn name_objects(sums: &mut Sums, rows: usize, first: usize, number: impl Fn(u32, u32) -> u32) {
    let named = |material: f32, [instance, low, high]: [f32; 3]| match material == 0.0 {
        true => 0.0,
        false => number(low as u32 | (high as u32) << 16, instance as u32) as f32,
    };
    match sums {
        Sums::Block(block) => {
            for pixel in block.chunks_exact_mut(rows) {
                let [.., low, high] = pixel[first + 2];
                let [.., material, instance] = pixel[first];
                pixel[first][3] = named(material, [instance, low, high]);
                pixel[first + 2][2..].fill(0.0);
            }
        }
        Sums::Totals(totals) => {
            let float = |bits: i128| f32::from_bits(bits as u32);
            for pixel in totals.chunks_exact_mut(rows) {
                let [.., low, high] = pixel[first + 2].map(float);
                let [.., material, instance] = pixel[first].map(float);
                pixel[first][3] = named(material, [instance, low, high]).to_bits().into();
                pixel[first + 2][2..].fill(0);
            }
        }
    }
}
