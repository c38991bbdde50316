//! Converts the state of a renderer to a film.

use super::{
    Film, FilmHeader, FilmOutline,
    coverage::{Coverage, SampleSet},
};
use crate::pack::{PackedScene, PackedView};
use crate::{
    Fingerprint, RenderError, RenderSettings, Renderer, Tone,
    features::{in_world, number_of},
    layers,
    sums::Sums,
};
use glimray_scene::threads;

impl Renderer {
    /// The film of all finished blocks of samples so far ([`crate::SAMPLE_BLOCK`]); of all samples once
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
            let rows = layers::rows(layers);
            film.sums
                .iter_mut()
                .for_each(|sums| detach((&self.scene, &self.view), sums, rows, first));
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

/// A renderer itself stays on its thread in browsers.
type Packed<'a> = (&'a PackedScene, &'a PackedView);

/// Makes the first surfaces of pixels independent of the packed scene: see [`detached`].
fn detach(packed: Packed, sums: &mut Sums, rows: usize, first: usize) {
    match sums {
        Sums::Block(block) => for_pixels(block, rows, |pixel| {
            let surface = &mut pixel[first..first + layers::FIRST.rows];
            surface.copy_from_slice(&detached(packed, [surface[0], surface[1], surface[2]]));
        }),
        Sums::Totals(totals) => {
            let float = |bits: i128| f32::from_bits(bits as u32);
            let bits = |number: f32| i128::from(number.to_bits());
            for_pixels(totals, rows, |pixel| {
                let surface = &mut pixel[first..first + layers::FIRST.rows];
                let own = [surface[0], surface[1], surface[2]].map(|row| row.map(float));
                surface.copy_from_slice(&detached(packed, own).map(|row| row.map(bits)));
            });
        }
    }
}

/// The rows of a first surface with the number of the object in place of the instance and the primitive, and the
/// position in world space.
fn detached(
    (scene, view): Packed,
    [mut found, mut place, mut surface]: [[f32; 4]; 3],
) -> [[f32; 4]; 3] {
    let [.., material, instance] = found;
    let [.., low, high] = surface;
    found[3] = 0.0;
    surface[2..].fill(0.0);
    if material != 0.0 {
        let primitive = low as u32 | (high as u32) << 16;
        found[3] = number_of(scene, view, primitive, instance as u32) as f32;
        let [x, y, z, depth] = place.map(f64::from);
        let [x, y, z] = in_world(scene, [x, y, z]);
        place = [x, y, z, depth].map(|number| number as f32);
    }
    [found, place, surface]
}

/// Calls `change` with the rows of each pixel, on all cores.
fn for_pixels<R: Send>(sums: &mut [R], rows: usize, change: impl Fn(&mut [R]) + Sync) {
    let len = threads::chunk_len(sums.len() / rows);
    threads::for_each(sums.chunks_mut(rows * len), |chunk| {
        chunk.chunks_exact_mut(rows).for_each(&change);
    });
}
