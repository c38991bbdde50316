//! What the window asks of the renderer, and what comes back.

use super::canvas::Studio;
use super::files::pictures::{self, Taken};
use super::inspector::{self, Inspected, hidden};
use super::objects::Id;
use super::session::Session;
use super::tools::Purpose;
use crate::app::advice;
use crate::scene::ObjectRef;
use glam::DVec3;

/// What a question to the render thread brought back.
#[derive(Debug)]
pub enum Answer {
    /// What is under a pixel.
    Picked {
        /// What it was asked for.
        purpose: Purpose,
        /// The point on the nearest surface, in the world, and what it belongs to; `None` where there is
        /// nothing.
        hit: Option<(DVec3, Option<ObjectRef>)>,
    },
    /// The rays of a pixel, or why there are none.
    Rays(Result<Box<Inspected>, String>),
    /// Which parts of lines are behind something, seen from outside; `None` if that picture is not there.
    Hidden(Option<hidden::Parts>),
    /// What was to be done is done.
    Nothing,
    /// The picture so far, for a file.
    Picture(Box<Taken>),
    /// It cannot be told.
    Failed(String),
}

/// What is under a pixel of the picture.
pub fn pick(studio: &mut Studio, pixel: [u32; 2], purpose: Purpose) -> Answer {
    match studio.renderer.explain(pixel, 0..1) {
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
    /// Asks the render thread for something as soon as there is a picture.
    pub fn ask(&mut self, question: impl FnOnce(&mut Studio) -> Answer + Send + 'static) {
        self.questions.push(Box::new(question));
    }

    /// Takes up what the render thread answered.
    pub fn take(&mut self, answer: Answer) {
        match answer {
            Answer::Picked { purpose, hit } => self.picked(purpose, hit),
            Answer::Rays(outcome) => inspector::take(self, outcome),
            Answer::Hidden(parts) => self.inspector.hidden.take(parts),
            Answer::Nothing => {}
            Answer::Picture(taken) => pictures::taken(self, *taken),
            Answer::Failed(why) => self.notices.warn(why),
        }
    }

    fn picked(&mut self, purpose: Purpose, hit: Option<(DVec3, Option<ObjectRef>)>) {
        match (purpose, hit) {
            (Purpose::Pivot, Some((point, _))) => {
                if let Some(rig) = &mut self.rig {
                    rig.recentre(point);
                }
            }
            (Purpose::Focus, Some((point, _))) => {
                if let Some(rig) = &mut self.rig {
                    rig.focus_on(point);
                }
            }
            (Purpose::Select, hit) => {
                self.selection = hit.and_then(|(_, object)| object).map(Id::Object);
            }
            (_, None) => self.notices.tell("there is nothing under the cursor"),
        }
    }
}
