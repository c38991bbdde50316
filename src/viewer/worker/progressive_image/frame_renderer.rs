//! The interface of a progressive image: its slot, access for questions, and its errors.

use crate::app::advice;
use crate::image::Image;
use crate::render::{RenderError, RenderSettings, Renderer, Tone};
use crate::viewer::worker::request::RenderRequest;

/// The slot of a picture in the window.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum PictureSlot {
    /// The main picture.
    Main,
    /// The second picture of a comparison.
    Beside,
    /// The scene behind the rays in the ray view.
    Outside,
}

impl PictureSlot {
    /// All slots in rendering order.
    pub const ALL: [Self; 3] = [Self::Outside, Self::Beside, Self::Main];
}

/// The renderers that a question can use.
pub struct FrameRenderer<'a> {
    /// The renderer of the main picture, idle between two steps.
    pub renderer: &'a mut Renderer,
    /// The request of the main picture.
    pub order: &'a RenderRequest,
    /// The renderer and request of the ray view, if it is at full resolution.
    pub outside: Option<(&'a mut Renderer, &'a RenderRequest)>,
}

impl FrameRenderer<'_> {
    /// The picture so far and its number of samples.
    pub fn image(&mut self, tone: &Tone) -> Result<(Image, u32), RenderError> {
        let samples = self.renderer.samples_done();
        Ok((self.renderer.develop(tone)?, samples))
    }

    /// The full-resolution settings of the picture.
    pub fn settings(&self) -> &RenderSettings {
        &self.order.settings
    }
}

/// Why a request fails.
#[derive(Debug, thiserror::Error)]
pub enum ImageError {
    /// The scene cannot be packed.
    #[error(transparent)]
    Pack(#[from] crate::pack::PackError),
    /// It cannot be rendered.
    #[error("{}", advice::render(.0))]
    Render(#[from] RenderError),
}
