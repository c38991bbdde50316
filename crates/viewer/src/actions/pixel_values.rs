//! Reads the values of magnified pixels on the render thread.

use crate::state::answer::Answer;
use crate::state::pixel_values::ReadPixels;
use crate::state::session::Session;
use crate::worker::progressive_image::Progress;

/// Asks for the values if the picture was presented anew. Previews are not read. Returns whether a frame is needed to
/// send the question.
pub fn ask(session: &mut Session, progress: &Progress) -> bool {
    let is_due = !progress.is_coarse
        && progress.samples > 0
        && session.pixel_values.asked.is_due(progress.frames_shown);
    if is_due {
        session.ask(|frame| {
            // A device that fails is reported where the picture itself fails.
            let image = frame.screen_image().unwrap_or(None);
            let region = frame.renderer.region();
            Answer::PixelValues(image.map(|image| Box::new(ReadPixels { image, region })))
        });
    }
    is_due
}

/// Takes the answer.
pub fn read(session: &mut Session, pixels: Option<Box<ReadPixels>>) {
    session.pixel_values.asked.answered();
    if pixels.is_some() {
        session.pixel_values.latest = pixels;
    }
}
