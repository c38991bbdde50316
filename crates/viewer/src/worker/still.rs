//! Pictures for files: what the window shows, or one that is rendered beside it.

use crate::worker::classical::ShownScenes;
use crate::worker::progressive_image::{ImageError, packing, policy};
use crate::worker::request::RenderRequest;
use glimray_render::gpu::Gpu;
use glimray_render::pack;
use glimray_render::{RenderError, Renderer, Tone};
use glimray_scene::image::Image;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

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
}

/// Renders all samples of a request in slices that keep the window responsive. Returns `None` once `is_cancelled` is set.
///
/// # Errors
/// The scene cannot be rendered with these settings, or the device failed.
pub fn render(
    gpu: Gpu,
    request: &RenderRequest,
    tone: &Tone,
    keeps_raw: bool,
    is_cancelled: &AtomicBool,
) -> Result<Option<Still>, ImageError> {
    let scene = ShownScenes::default().of(request);
    let packed = Arc::new(pack::scene(&scene)?);
    let (open, close) = request.shutter_interval;
    let frames = scene.motion_samples(open, close);
    let view = packing::view(&packed, None, &frames, request)?;
    let policy = policy(&gpu, request.policy);
    let mut renderer = Renderer::new(gpu, packed, &view, request.settings.clone(), policy)?;
    while !renderer.is_done() {
        if is_cancelled.load(Ordering::Relaxed) {
            return Ok(None);
        }
        renderer.step()?;
    }
    Ok(Some(Still::developed(&mut renderer, tone, keeps_raw)?))
}
