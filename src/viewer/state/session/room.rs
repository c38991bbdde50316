//! Room for the picture: taken up when the picture begins, so that what was gathered outlasts a window of
//! another size or scale.

use crate::viewer::state::session::Session;
use crate::viewer::worker::request::RenderRequest;

/// Seconds of tracing that are not thrown away because there is other room now.
const WORTH_KEEPING: f64 = 2.0;

/// How much room there is, and how much of it the picture has.
#[derive(Default)]
pub(super) struct Room {
    /// Taken by the picture that is under way, in pixels.
    pub taken: (u32, u32),
    /// In the window now, in pixels.
    available: (u32, u32),
    /// What was ordered for it last.
    ordered: Option<RenderRequest>,
    /// Seconds of tracing in that picture so far.
    spent: f64,
}

impl Session {
    /// The seconds of tracing in the picture so far; 0 while it is coarse.
    pub fn set_spent(&mut self, seconds: f64) {
        self.room.spent = seconds;
    }

    /// Room for pictures, in pixels. A picture that fits the window takes it when it begins, or if little is
    /// lost by beginning again; until then it is scaled.
    pub fn set_space(&mut self, pixels: (u32, u32)) {
        self.room.available = pixels;
        if self.room.taken != pixels && !self.is_worth_keeping() {
            self.room.taken = pixels;
        }
        self.room.ordered = self.order(self.view.settings.integrator);
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
        let order = self.order(self.view.settings.integrator);
        let goes_on = (self.room.ordered.as_ref().zip(order.as_ref()))
            .is_some_and(|(last, now)| last.shows_same(now) && last.settings == now.settings);
        goes_on && self.view.fits && self.room.spent >= WORTH_KEEPING
    }
}
