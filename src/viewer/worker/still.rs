//! A picture that is rendered for a file, beside the one in the window.

use crate::gpu::Gpu;
use crate::image::Image;
use crate::pack;
use crate::render::{Renderer, Tone};
use crate::viewer::worker::classical::ShownScenes;
use crate::viewer::worker::progressive_image::{ImageError, packing, policy};
use crate::viewer::worker::request::RenderRequest;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

/// Renders all samples of a request in slices that keep the window responsive. Returns `None` once `is_cancelled` is set.
///
/// # Errors
/// The scene cannot be rendered with these settings, or the device failed.
pub fn render(
    gpu: Gpu,
    request: &RenderRequest,
    tone: &Tone,
    is_cancelled: &AtomicBool,
) -> Result<Option<Image>, ImageError> {
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
    Ok(Some(renderer.develop(tone)?))
}
