//! Layers of pictures on the command line, and denoised pictures.

use crate::app::error::AppError;
use crate::app::layers::{LAYERS, PictureLayer, color};
use crate::cli::args::LayerFlags;
use crate::gpu::Gpu;
use crate::image::Image;
use crate::output::{self, LayeredImage, OutputError, SaveOptions};
use crate::render::{Film, Integrator, Shows, Tone};
use std::path::Path;

/// A finished picture.
pub enum Finished {
    /// One layer.
    Plain(Image),
    /// Several layers, and the picture for videos.
    Layered(LayeredImage, Image),
}

impl Finished {
    /// The picture.
    pub fn image(&self) -> &Image {
        let (Self::Plain(image) | Self::Layered(_, image)) = self;
        image
    }

    /// Writes the picture to a file.
    pub fn save(&self, path: &Path, options: &SaveOptions) -> Result<(), OutputError> {
        match self {
            Self::Plain(image) => output::save_with(path, image, options),
            Self::Layered(image, _) => output::save_layers(path, image, options),
        }
    }
}

impl LayerFlags {
    /// Whether the film must keep features.
    pub fn wants_features(&self) -> bool {
        !self.layers.is_empty()
    }

    /// Refuses layers that cannot be rendered, or not be written to `path`.
    pub fn check(
        &self,
        integrator: Integrator,
        path: &Path,
        takes_layers: bool,
    ) -> Result<(), AppError> {
        if !self.wants_features() {
            return Ok(());
        }
        let refused = |why: String| Err(AppError::Usage(why));
        if integrator.entry().shows != Shows::Radiance {
            return refused(format!(
                "cannot render layers (--integrator {}): a debug view has none. Choose whitted or path.",
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

    /// The picture of a film, with the layers that the flags name.
    ///
    /// # Errors
    /// The film has no features, or the device failed.
    pub fn finish(&self, film: &Film, gpu: &Gpu, tone: &Tone) -> Result<Finished, AppError> {
        let beauty = film.develop(gpu, tone)?;
        if !self.wants_features() {
            return Ok(Finished::Plain(beauty));
        }
        let Some(features) = film.features() else {
            return Err(AppError::Usage(
                "cannot write layers: the film has none. Render it with --layers.".into(),
            ));
        };
        // In the order of the table, each once.
        let known = LAYERS.0.iter().map(|(.., layer)| layer);
        let wanted = known.filter(|layer| self.layers.contains(layer));
        let mut layers: Vec<_> = wanted.map(|layer| layer.of(&beauty, &features)).collect();
        let _ = color;
        let _ = PictureLayer::Beauty;
        layers.retain(|layer| !layer.channels.is_empty());
        let layered = LayeredImage {
            width: beauty.width,
            height: beauty.height,
            layers,
            in_parts: self.layers_parts,
        };
        Ok(Finished::Layered(layered, beauty))
    }
}
