//! Questions to the render thread and their answers.

use crate::app::advice;
use crate::scene::ObjectRef;
use crate::viewer::actions::comparing;
use crate::viewer::actions::files::pictures;
use crate::viewer::actions::inspector;
use crate::viewer::model::objects::Id;
use crate::viewer::model::tool::Purpose;
use crate::viewer::state::answer::Answer;
use crate::viewer::state::session::Session;
use crate::viewer::worker::progressive_image::FrameRenderer;
use glam::DVec3;

/// Picks the object under a pixel of the picture.
pub fn pick(frame: &mut FrameRenderer, pixel: [u32; 2], purpose: Purpose) -> Answer {
    match frame.renderer.explain(pixel, 0..1) {
        Ok(tree) => {
            let first = tree.samples.first().and_then(|sample| sample.rays.first());
            let hit = first.and_then(|ray| ray.hit.as_ref());
            Answer::Picked {
                purpose,
                hit: hit.map(|hit| (DVec3::from(hit.position), hit.object)),
            }
        }
        Err(error) => Answer::Failed(advice::render(&error)),
    }
}

impl Session {
    /// Handles an answer of the render thread.
    pub fn take(&mut self, answer: Answer) {
        match answer {
            Answer::Picked { purpose, hit } => self.picked(purpose, hit),
            Answer::Probed(probe) => self.cursor.probe = Some(probe),
            Answer::Rays(outcome) => inspector::take(self, outcome),
            Answer::Hidden(parts) => self.inspector.hidden.take(parts),
            Answer::Histogram(histogram) => self.histogram.take(histogram),
            Answer::Snapshot(snapshot) => comparing::kept(self, *snapshot),
            Answer::Nothing => {}
            Answer::Picture(taken) => pictures::taken(self, *taken),
            Answer::Failed(why) => self.messages.warn(why),
        }
    }

    fn picked(&mut self, purpose: Purpose, hit: Option<(DVec3, Option<ObjectRef>)>) {
        match (purpose, hit) {
            (Purpose::Pivot, Some((point, _))) => {
                if let Some(controller) = &mut self.controller {
                    controller.recentre(point);
                }
            }
            (Purpose::Focus, Some((point, _))) => {
                if let Some(controller) = &mut self.controller {
                    controller.focus_on(point);
                }
            }
            (Purpose::Select, hit) => {
                self.selection = hit.and_then(|(_, object)| object).map(Id::Object);
            }
            (_, None) => self.messages.tell("Nothing is under the cursor"),
        }
    }
}
