//! Measures the histogram of the picture on the render thread.

use crate::model::histogram::Histogram;
use crate::state::answer::Answer;
use crate::state::session::Session;
use crate::worker::progressive_image::{FrameRenderer, Progress};

/// Asks for the histogram if the picture was presented anew. Previews are not measured. Returns whether a frame is
/// needed to send the question.
pub fn ask(session: &mut Session, progress: &Progress) -> bool {
    let is_due = !progress.is_coarse
        && progress.samples > 0
        && session.histogram.is_due(progress.frames_shown);
    if is_due {
        session.ask(measure);
    }
    is_due
}

fn measure(frame: &mut FrameRenderer) -> Answer {
    // A device that fails is reported where the picture itself fails.
    let image = frame.screen_image().unwrap_or(None);
    Answer::Histogram(image.map(|image| Box::new(Histogram::new(&image.pixels))))
}
