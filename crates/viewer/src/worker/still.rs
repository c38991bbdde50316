//! Pictures for files: what the window shows, or one that is rendered beside it.

use crate::worker::classical::ShownScenes;
use crate::worker::job::JobControl;
use crate::worker::progressive_image::{ImageError, packing, policy};
use crate::worker::request::RenderRequest;
use glimray_app::layers::beside_raw;
use glimray_io::output::{self, LayeredImage, OutputError, SaveOptions};
use glimray_render::gpu::Gpu;
use glimray_render::pack;
use glimray_render::{RenderError, Renderer, Tone};
use glimray_scene::image::Image;
use std::path::Path;
use std::sync::Arc;

/// A picture for a file.
#[derive(Clone, Debug)]
pub struct Still {
    /// The picture, denoised if its tone asks for that.
    pub image: Image,
    /// The raw picture beside a denoised one, if it is kept.
    pub raw: Option<Image>,
}

impl Still {
    /// Develops the samples so far.
    ///
    /// # Errors
    /// The device failed.
    pub fn developed(
        renderer: &mut Renderer,
        tone: &Tone,
        keeps_raw: bool,
    ) -> Result<Self, RenderError> {
        let image = renderer.develop(tone)?;
        let has_raw = keeps_raw && renderer.denoises(tone);
        let tone = Tone {
            denoise: false,
            ..*tone
        };
        let raw = has_raw.then(|| renderer.develop(&tone)).transpose()?;
        Ok(Self { image, raw })
    }

    /// Writes the picture to a file. A raw picture is a layer beside the denoised one.
    ///
    /// # Errors
    /// The file cannot be written.
    pub fn save(&self, path: &Path, options: &SaveOptions) -> Result<(), OutputError> {
        let Some(raw) = &self.raw else {
            return output::save_with(path, &self.image, options);
        };
        let layers = LayeredImage {
            width: raw.width,
            height: raw.height,
            layers: beside_raw(&self.image, raw, options.opacity),
            in_parts: false,
        };
        output::save_layers(path, &layers, options)
    }
}

/// Renders all samples of a request in slices that keep the window responsive. Returns `None` once `control` is cancelled.
///
/// # Errors
/// The scene cannot be rendered with these settings, or the device failed.
pub fn render(
    gpu: Gpu,
    request: &RenderRequest,
    tone: &Tone,
    keeps_raw: bool,
    control: &JobControl,
) -> Result<Option<Still>, ImageError> {
    let scene = ShownScenes::default().of(request);
    let packed = Arc::new(pack::scene(&scene)?);
    let (open, close) = request.shutter_interval;
    let frames = scene.motion_samples(open, close);
    let view = packing::view(&packed, None, &frames, request)?;
    let policy = policy(&gpu, request.policy);
    let mut renderer = Renderer::new(gpu, packed, &view, request.settings.clone(), policy)?;
    while !renderer.is_done() {
        if control.is_cancelled() {
            return Ok(None);
        }
        control.report(renderer.progress());
        renderer.step()?;
    }
    Ok(Some(Still::developed(&mut renderer, tone, keeps_raw)?))
}
