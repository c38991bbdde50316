//! The context of panels and dialogs.

use super::textures::Textures;
use crate::viewer::state::answer::Answer;
use crate::viewer::state::session::Session;
use crate::viewer::worker::progressive_image::{PictureSlot, Shown};
use crate::viewer::worker::render_thread::RenderThread;

/// The context of panels and dialogs.
pub struct PanelContext<'a> {
    /// The session.
    pub session: &'a mut Session,
    /// The render thread.
    pub render: &'a RenderThread<Answer>,
    /// Textures for egui.
    pub textures: &'a mut Textures,
}

impl PanelContext<'_> {
    /// The published picture of a slot.
    pub fn shown(&self, place: PictureSlot) -> Option<Shown> {
        self.render.shown(place)
    }
}
