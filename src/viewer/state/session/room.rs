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
    /// What was ordered for it last.
    ordered: Option<RenderRequest>,
    /// Seconds of tracing in that picture so far.
    spent: f64,
    is_told: bool,
}

impl Session {
    /// The seconds of tracing in the picture so far; 0 while it is coarse.
    pub fn set_spent(&mut self, seconds: f64) {
        self.room.spent = seconds;
    }

    /// Room for pictures, in pixels. One that fits the window takes it when it begins, or if little is lost
    /// by beginning again.
    pub fn set_space(&mut self, pixels: (u32, u32)) {
        if self.room.taken != pixels && !self.is_worth_keeping() {
            self.room.taken = pixels;
        }
        let is_kept = self.room.taken != pixels;
        if is_kept && !self.room.is_told {
            let (width, height) = self.room.taken;
            self.messages.tell(format!(
                "The picture keeps its {width}×{height} pixels and its samples. Started again, it takes \
                 the room that there is now."
            ));
        }
        self.room.is_told = is_kept;
        self.room.ordered = self.order(self.view.settings.integrator);
    }

    fn is_worth_keeping(&self) -> bool {
        let order = self.order(self.view.settings.integrator);
        let goes_on = (self.room.ordered.as_ref().zip(order.as_ref()))
            .is_some_and(|(last, now)| last.shows_same(now) && last.settings == now.settings);
        goes_on && self.view.fits && self.room.spent >= WORTH_KEEPING
    }
}
