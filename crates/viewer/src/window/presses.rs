//! Passes at most one press or release of a mouse button per frame to egui. egui hit-tests once per frame,
//! at the pointer position at the end of the frame: with a press and the start of a quick drag in one frame,
//! the press would hit the wrong widget.

use eframe::egui::{Event, RawInput};

/// Events deferred to the next frame.
#[derive(Default)]
pub struct Presses {
    waiting: Vec<Event>,
}

impl Presses {
    /// Whether all events have been passed on.
    pub fn is_empty(&self) -> bool {
        self.waiting.is_empty()
    }

    /// Keeps the events of one frame in `raw` and defers the others. Returns whether there are any.
    pub fn pass(&mut self, raw: &mut RawInput) -> bool {
        let mut events = std::mem::take(&mut self.waiting);
        events.append(&mut raw.events);
        self.waiting = events.split_off(one_frame(&events));
        raw.events = events;
        !self.waiting.is_empty()
    }
}

/// Number of events for one frame: no motion after a press or release, and no release after motion, so that
/// the drag is seen before it ends.
fn one_frame(events: &[Event]) -> usize {
    let (mut has_button, mut has_moved) = (false, false);
    for (index, event) in events.iter().enumerate() {
        match event {
            Event::PointerMoved(_) | Event::PointerGone if has_button => return index,
            Event::PointerMoved(_) => has_moved = true,
            Event::PointerButton { pressed: false, .. } if has_moved => return index,
            Event::PointerButton { .. } => has_button = true,
            _ => {}
        }
    }
    events.len()
}
