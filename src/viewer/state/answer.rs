//! Answers of the render thread.

use crate::scene::ObjectRef;
use crate::viewer::model::tool::Purpose;
use crate::viewer::state::cursor::Probe;
use crate::viewer::state::files::Taken;
use crate::viewer::state::inspector::{Inspected, Parts};
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
    /// What the pixel under the cursor shows.
    Probed(Probe),
    /// The rays of a pixel, or why there are none.
    Rays(Result<Box<Inspected>, String>),
    /// Which parts of lines are behind something, seen from outside; `None` if that picture is not there.
    Hidden(Option<Parts>),
    /// What was to be done is done.
    Nothing,
    /// The picture so far, for a file.
    Picture(Box<Taken>),
    /// It cannot be told.
    Failed(String),
}
