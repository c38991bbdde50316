//! What panels and dialogs draw with.

use super::textures::Textures;
use crate::viewer::state::answer::Answer;
use crate::viewer::state::session::Session;
use crate::viewer::worker::progressive_image::{PictureSlot, Shown};
use crate::viewer::worker::render_thread::RenderThread;

/// What panels work with.
pub struct PanelContext<'a> {
    /// What the person works on.
    pub session: &'a mut Session,
    /// What renders it.
    pub render: &'a RenderThread<Answer>,
    /// Pictures for egui.
    pub textures: &'a mut Textures,
}

impl PanelContext<'_> {
    /// What there is to see at a place.
    pub fn shown(&self, place: PictureSlot) -> Option<Shown> {
        self.render.shown(place)
    }
}
