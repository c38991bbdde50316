//! What others know of a picture that follows its order: where it is shown, what a question gets to see
//! of it, and what can go wrong.

use crate::app::advice;
use crate::image::Image;
use crate::render::{RenderError, RenderSettings, Renderer, Screen, Tone};
use crate::viewer::worker::request::RenderRequest;

/// Where a picture is shown.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum PictureSlot {
    /// The picture itself.
    Main,
    /// What it is compared with.
    Beside,
    /// The scene from outside, behind drawn rays.
    Outside,
}

impl PictureSlot {
    /// All of them; those that are rendered first come first.
    pub const ALL: [Self; 3] = [Self::Outside, Self::Beside, Self::Main];
}

/// What a question gets to see.
pub struct FrameRenderer<'a> {
    /// The renderer of the main picture, which is at rest between two steps.
    pub renderer: &'a mut Renderer,
    /// What it was last asked for.
    pub order: &'a RenderRequest,
    /// What the window shows of the main picture; `None` before it has samples.
    pub screen: Option<&'a Screen>,
    /// The same of the picture from outside, where there is one in full.
    pub outside: Option<(&'a mut Renderer, &'a RenderRequest)>,
}

impl FrameRenderer<'_> {
    /// The picture so far and the samples in it.
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

    /// The settings of the picture in full.
    pub fn settings(&self) -> &RenderSettings {
        &self.order.settings
    }
}

/// Why an order cannot be followed.
#[derive(Debug, thiserror::Error)]
pub enum ImageError {
    /// The scene cannot be laid out.
    #[error(transparent)]
    Pack(#[from] crate::pack::PackError),
    /// It cannot be rendered.
    #[error("{}", advice::render(.0))]
    Render(#[from] RenderError),
}
