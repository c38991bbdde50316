//! Converts the state of a renderer to a film.

use super::{Film, FilmHeader};
use crate::render::{Fingerprint, RenderError, Renderer, Tone, layers};

impl Renderer {
    /// The film of all finished blocks of samples so far ([`crate::render::SAMPLE_BLOCK`]); of all samples once
    /// the render is done.
    ///
    /// # Errors
    /// The sample range of the settings does not consist of whole blocks, or the picture is adaptive and not
    /// finished.
    pub fn film(&self) -> Result<Film, RenderError> {
        let header = FilmHeader {
            scene: Fingerprint::of_scene(&self.scene),
            view: Fingerprint::of_view(&self.view),
            settings: self.settings.of_whole().fingerprint(),
            integrator: self.settings.integrator,
            size: self.settings.size,
            samples: self.settings.samples,
            layers: layers::of_pictures(&self.settings),
            tone: Tone::LINEAR,
            adapters: [self.adapter().name.clone()].into(),
        };
        let (done, sample) = (self.cursor.tile, self.cursor.sample);
        Ok(self.tiles.film(header, done, sample)?)
    }
}
