//! Handles the answers of the render thread.

use crate::actions::box_select;
use crate::actions::comparing;
use crate::actions::files::pictures;
use crate::actions::inspector;
use crate::actions::pixel_values;
use crate::actions::sight;
use crate::actions::tools;
use crate::state::answer::Answer;
use crate::state::session::Session;

impl Session {
    /// Handles an answer of the render thread.
    pub fn handle_answer(&mut self, answer: Answer) {
        match answer {
            Answer::Picked { purpose, hit } => tools::picked(self, purpose, hit),
            Answer::Probed(probe) => self.cursor.probe = Some(probe),
            Answer::Rays(outcome) => inspector::handle_rays(self, outcome),
            Answer::Hidden(parts) => self.inspector.hidden.set(parts),
            Answer::Histogram(histogram) => self.histogram.set(histogram),
            Answer::PixelValues(pixels) => pixel_values::read(self, pixels),
            Answer::Snapshot(snapshot) => comparing::kept(self, *snapshot),
            Answer::Bookmarked(scene, saved) => self.preferences.picture_camera(&scene, &saved),
            Answer::Seen(seen) => {
                sight::take(self, seen);
                box_select::go_on(self);
            }
            Answer::Nothing => {}
            Answer::Copied(image) => self.files.copied = Some(image),
            Answer::Picture(picture) => pictures::captured(self, *picture),
            Answer::Failed(why) => self.messages.warn(why),
        }
    }
}
