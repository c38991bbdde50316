//! The context of panels and dialogs.

use super::textures::Textures;
use crate::state::answer::Answer;
use crate::state::session::Session;
use crate::worker::progressive_image::{PictureSlot, Shown};
use crate::worker::render_thread::RenderThread;
use crate::worker::stage::Activity;
use std::time::Duration;

/// Shorter work is not announced over a picture.
const NOTICEABLE: Duration = Duration::from_millis(300);

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

    /// Whether anything is drawn of the main picture, be it coarse or of the last scene.
    pub fn has_picture(&self) -> bool {
        let shown = self.shown(PictureSlot::Main);
        shown.is_some_and(|it| it.screen.is_some() || it.under.is_some() || it.whole.is_some())
    }

    /// The stage of loading a scene or of preparing its first picture.
    pub fn activity(&self) -> Option<Activity> {
        match &self.session.loader {
            Some(loader) => Some(loader.activity.clone()),
            None => self.render.activity(),
        }
    }

    /// [`Self::activity`] once it takes long enough to be worth showing; at once if there is no picture yet.
    pub fn noticeable_activity(&self) -> Option<Activity> {
        let is_empty = self.shown(PictureSlot::Main).is_none();
        (self.activity()).filter(|it| is_empty || it.since.elapsed() >= NOTICEABLE)
    }
}
