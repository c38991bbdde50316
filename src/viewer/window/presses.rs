//! Gives egui one press or release of a mouse button in a frame. In each frame egui looks once for the widget
//! under the pointer, where the pointer is at the end of that frame. If a frame held a press and the start
//! of a quick drag, the press would land on whatever lies where the drag has got to.

use eframe::egui::{Event, RawInput};

/// Events that wait for the next frame.
#[derive(Default)]
pub struct Presses {
    waiting: Vec<Event>,
}

impl Presses {
    /// Whether every event has had its frame.
    pub fn is_empty(&self) -> bool {
        self.waiting.is_empty()
    }

    /// Leaves in `raw` the events of one frame and keeps the others. Whether there are any.
    pub fn pass(&mut self, raw: &mut RawInput) -> bool {
        let mut events = std::mem::take(&mut self.waiting);
        events.append(&mut raw.events);
        self.waiting = events.split_off(one_frame(&events));
        raw.events = events;
        !self.waiting.is_empty()
    }
}

/// How many of the events are for one frame: no movement after a press or release, and no release after a
/// movement, so that the drag is seen before it ends.
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
