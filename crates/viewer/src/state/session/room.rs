//! The size of the picture panel. A picture in progress keeps its size, so that its samples outlast a resize
//! of the window.

use crate::state::session::Session;
use crate::worker::request::RenderRequest;

/// Seconds of tracing beyond which a resize does not restart the picture.
const WORTH_KEEPING: f64 = 2.0;

/// The size of the panel, and the size that the picture uses.
#[derive(Default)]
pub(super) struct Room {
    /// The size of the current picture, in pixels.
    pub taken: (u32, u32),
    /// The size of the panel, in pixels.
    available: (u32, u32),
    /// The picture's last request.
    requested: Option<RenderRequest>,
    /// The picture's seconds of tracing so far.
    spent: f64,
}

impl Session {
    /// Sets the seconds of tracing so far; 0 for a preview.
    pub fn set_spent(&mut self, seconds: f64) {
        self.room.spent = seconds;
    }

    /// Sets the size of the panel, in pixels. A picture that fits the panel adopts it when it starts, or if
    /// restarting loses little; until then it is scaled.
    pub fn set_space(&mut self, pixels: (u32, u32)) {
        self.room.available = pixels;
        if self.room.taken != pixels && !self.is_worth_keeping() {
            self.room.taken = pixels;
        }
        self.room.requested = self.render_request(self.view.settings.integrator);
    }

    /// Whether the picture keeps its samples and is scaled to the room that there is now.
    pub fn is_scaled_to_room(&self) -> bool {
        self.view.fits && self.room.taken != self.room.available
    }

    /// Begins the picture again, as large as there is room for now.
    pub fn take_room(&mut self) {
        self.room.taken = self.room.available;
    }

    fn is_worth_keeping(&self) -> bool {
        let request = self.render_request(self.view.settings.integrator);
        let goes_on = (self.room.requested.as_ref().zip(request.as_ref()))
            .is_some_and(|(last, now)| last.shows_same(now) && last.settings == now.settings);
        goes_on && self.view.fits && self.room.spent >= WORTH_KEEPING
    }
}
