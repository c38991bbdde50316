//! The interface of a progressive image: its slot, access for questions, and its errors.

use crate::worker::request::RenderRequest;
use glimray_app::advice;
use glimray_render::{RenderError, RenderSettings, Renderer, Screen, Tone};
use glimray_scene::image::{Image, ScreenImage};

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
    pub request: &'a RenderRequest,
    /// The main picture as displayed; `None` before it has samples.
    pub screen: Option<&'a Screen>,
    /// Renderer and request of the ray view, if it is rendered in full.
    pub outside: Option<(&'a mut Renderer, &'a RenderRequest)>,
}

impl FrameRenderer<'_> {
    /// The picture so far and its number of samples.
    ///
    /// # Errors
    /// The device failed.
    pub fn image(&mut self, tone: &Tone) -> Result<(Image, u32), RenderError> {
        let samples = self.renderer.samples_done();
        Ok((self.renderer.develop(tone)?, samples))
    }

    /// A pixel as the window shows it: red, green and blue, encoded. `None` where nothing is shown.
    ///
    /// # Errors
    /// The device failed.
    pub fn displayed(&self, [x, y]: [u32; 2]) -> Result<Option<[u8; 3]>, RenderError> {
        let [left, top, width, height] = self.renderer.region();
        let (Some(screen), Some(x), Some(y)) =
            (self.screen, x.checked_sub(left), y.checked_sub(top))
        else {
            return Ok(None);
        };
        if x >= width || y >= height || screen.size() != (width, height) {
            return Ok(None);
        }
        let [red, green, blue, alpha] = self.renderer.read_pixel(screen, [x, y])?;
        Ok((alpha > 0).then_some([red, green, blue]))
    }

    /// All that the window shows of the main picture. `None` before it has samples.
    ///
    /// # Errors
    /// The device failed.
    pub fn screen_image(&self) -> Result<Option<ScreenImage>, RenderError> {
        let gpu = self.renderer.gpu();
        self.screen.map(|screen| screen.read(gpu)).transpose()
    }

    /// The settings of the picture in full.
    pub fn settings(&self) -> &RenderSettings {
        &self.request.settings
    }
}

/// Why a request fails.
#[derive(Debug, thiserror::Error)]
pub enum ImageError {
    /// The scene cannot be packed.
    #[error(transparent)]
    Pack(#[from] glimray_render::pack::PackError),
    /// The scene cannot be rendered.
    #[error("{}", advice::render(.0))]
    Render(#[from] RenderError),
}
