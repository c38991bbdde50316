//! Handles the answers of the render thread.

use crate::viewer::actions::files::pictures;
use crate::viewer::actions::inspector;
use crate::viewer::actions::tools;
use crate::viewer::state::answer::Answer;
use crate::viewer::state::session::Session;

impl Session {
    /// Handles an answer of the render thread.
    pub fn take(&mut self, answer: Answer) {
        match answer {
            Answer::Picked { purpose, hit } => tools::picked(self, purpose, hit),
            Answer::Probed(probe) => self.cursor.probe = Some(probe),
            Answer::Rays(outcome) => inspector::take(self, outcome),
            Answer::Hidden(parts) => self.inspector.hidden.take(parts),
            Answer::Nothing => {}
            Answer::Picture(taken) => pictures::taken(self, *taken),
            Answer::Failed(why) => self.messages.warn(why),
        }
    }
}
