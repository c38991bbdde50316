//! Layers of pictures on the command line, and denoised pictures.

use crate::args::LayerFlags;
use glimray_app::error::AppError;
use glimray_app::layers::{LAYERS, beside_raw};
use glimray_io::output::{self, ImageLayer, LayeredImage, OutputError, Place, SaveOptions};
use glimray_render::gpu::Gpu;
use glimray_render::{Features, Film, Integrator, Tone};
use glimray_scene::image::Image;
use std::path::Path;
use std::time::Instant;

/// A finished picture.
pub struct Finished {
    /// The picture, denoised if that was requested.
    pub image: Image,
    /// All layers of a file that has several.
    layers: Option<LayeredImage>,
    denoise_seconds: Option<f64>,
    place: Option<Place>,
    /// Whether its file has opacity, whatever its pixels are.
    opacity: bool,
}

impl Finished {
    /// A picture of one layer. `opacity` tells whether the settings that it was rendered with give it opacity.
    pub fn plain(image: Image, opacity: bool) -> Self {
        Self {
            image,
            layers: None,
            denoise_seconds: None,
            place: None,
            opacity,
        }
    }

    /// Time for denoising, in seconds; `None` if it was not denoised.
    pub fn denoise_seconds(&self) -> Option<f64> {
        self.denoise_seconds
    }

    /// The picture as a region (x, y, width, height) of a larger one, if it is not all of it.
    pub fn placed(self, [x, y, width, height]: [u32; 4], whole: (u32, u32)) -> Self {
        let is_all = [x, y, width, height] == [0, 0, whole.0, whole.1];
        let corner = (x, y);
        let place = (!is_all).then_some(Place { corner, whole });
        Self { place, ..self }
    }

    /// Writes the picture to a file.
    pub fn save(&self, path: &Path, options: &SaveOptions) -> Result<(), OutputError> {
        let options = &self.options(options);
        match &self.layers {
            None => output::save_with(path, &self.image, options),
            Some(layers) => output::save_layers(path, layers, options),
        }
    }

    /// The bytes of a file of one layer.
    ///
    /// # Errors
    /// The picture is too large for the format.
    pub fn encoded(&self, options: &SaveOptions) -> Result<Vec<u8>, OutputError> {
        output::encoded(&self.image, &self.options(options))
    }

    /// Writes the picture to standard output.
    pub fn save_to_stdout(&self, options: &SaveOptions) -> Result<(), OutputError> {
        let options = &self.options(options);
        match &self.layers {
            None => output::save_to_stdout(&self.image, options),
            Some(layers) => output::save_layers_to_stdout(layers, options),
        }
    }

    fn options(&self, options: &SaveOptions) -> SaveOptions {
        SaveOptions {
            place: self.place,
            opacity: self.opacity,
            ..options.clone()
        }
    }
}

impl LayerFlags {
    /// Refuses layers that cannot be rendered, or not be written to `path`.
    pub fn check(
        &self,
        denoise: bool,
        integrator: Integrator,
        path: &Path,
        takes_layers: bool,
    ) -> Result<(), AppError> {
        if !denoise && self.layers.is_empty() {
            return Ok(());
        }
        let refused = |why: String| Err(AppError::Usage(why));
        if !integrator.entry().has_layers {
            return refused(format!(
                "cannot render layers (--integrator {}): it has none. Choose whitted or path.",
                integrator.entry().name
            ));
        }
        if !self.layers.is_empty() && !takes_layers {
            return refused(format!(
                "cannot write layers ({}): only OpenEXR files and films have them. Choose a name that ends in \
                 .exr or .film.",
                path.display()
            ));
        }
        Ok(())
    }

    /// The picture of a film, with the layers that the flags name. A file that `takes_layers` keeps the raw picture
    /// beside a denoised one.
    ///
    /// # Errors
    /// The film has no features, or the device failed.
    pub fn finish(
        &self,
        film: &Film,
        gpu: &Gpu,
        tone: &Tone,
        takes_layers: bool,
    ) -> Result<Finished, AppError> {
        let opacity = film.header().has_opacity();
        if !tone.denoise && self.layers.is_empty() {
            return Ok(Finished::plain(film.develop(gpu, tone)?, opacity));
        }
        let Some(features) = film.features() else {
            return Err(AppError::Usage(
                "cannot write layers or denoise: the film has no features. Render it with --layers or --denoise."
                    .into(),
            ));
        };
        // Beside a denoised picture the raw one is only seen among the layers.
        let needs_raw = takes_layers || !tone.denoise;
        let raw = needs_raw.then(|| film.develop(gpu, tone)).transpose()?;
        let mut denoised = None;
        let mut denoise_seconds = None;
        if tone.denoise {
            let started = Instant::now();
            let picture = glimray_render::denoise(&features.picture(), gpu, &features)?.image;
            denoise_seconds = Some(started.elapsed().as_secs_f64());
            denoised = Some(tone.develop(gpu, &picture)?);
        }
        let layers = raw.as_ref().filter(|_| takes_layers);
        let layers = layers.map(|raw| LayeredImage {
            width: features.width,
            height: features.height,
            layers: self.of(raw, denoised.as_ref(), opacity, &features),
            in_parts: self.layers_parts,
        });
        Ok(Finished {
            layers,
            denoise_seconds,
            ..Finished::plain(denoised.or(raw).unwrap_or(Image::new(0, 0)), opacity)
        })
    }

    /// The layers of a file: those that the flags name in the order of the table, each once.
    fn of(
        &self,
        raw: &Image,
        denoised: Option<&Image>,
        opacity: bool,
        features: &Features,
    ) -> Vec<ImageLayer> {
        if let (Some(denoised), true) = (denoised, self.layers.is_empty()) {
            return beside_raw(denoised, raw, opacity);
        }
        let known = LAYERS.0.iter().map(|(.., layer)| layer);
        let wanted = known.filter(|layer| self.layers.contains(layer));
        let denoised = denoised.map(|image| ImageLayer::color("denoised", image, opacity, true));
        (wanted.map(|layer| layer.of(raw, opacity, features)))
            .chain(denoised)
            .collect()
    }
}
