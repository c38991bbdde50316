//! Packs a request for the renderer.

use crate::worker::request::RenderRequest;
use glimray_render::pack::{self, PackedScene, PackedView};
use glimray_scene::Frame;

/// The frames with the request's camera and background. `previous` is the view before it.
pub fn view(
    packed: &PackedScene,
    previous: Option<&PackedView>,
    frames: &[Frame],
    request: &RenderRequest,
) -> Result<PackedView, pack::PackError> {
    if request.camera.is_none() && request.background.is_none() {
        return packed.view_from(previous, frames);
    }
    let mut frames = frames.to_vec();
    for frame in &mut frames {
        if let Some(camera) = &request.camera {
            frame.camera = camera.clone();
        }
        if let Some(background) = &request.background {
            frame.background = background.clone();
        }
    }
    packed.view_from(previous, &frames)
}
