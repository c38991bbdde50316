//! Answers of the render thread.

use crate::model::gallery::Snapshot;
use crate::model::histogram::Histogram;
use crate::model::preferences::SavedCamera;
use crate::model::tool::Purpose;
use crate::state::cursor::Probe;
use crate::state::files::Captured;
use crate::state::inspector::{Inspected, Parts};
use crate::state::pixel_values::ReadPixels;
use crate::state::sight::Seen;
use glam::DVec3;
use glimray_scene::ObjectRef;
use glimray_scene::image::ScreenImage;
use std::path::PathBuf;

/// The result of a question to the render thread.
#[derive(Debug)]
pub enum Answer {
    /// The object under a pixel.
    Picked {
        /// The purpose of the pick.
        purpose: Purpose,
        /// The point on the nearest surface, in world space, and its object; `None` for the background.
        hit: Option<(DVec3, Option<ObjectRef>)>,
    },
    /// Colour and surface under the cursor.
    Probed(Probe),
    /// The rays of a pixel, or why there are none.
    Rays(Result<Box<Inspected>, String>),
    /// The hidden parts of rays in the ray view; `None` if another view is shown.
    Hidden(Option<Parts>),
    /// The histogram of the picture; `None` if there is no picture.
    Histogram(Option<Box<Histogram>>),
    /// The displayed values of the picture; `None` if there is no picture.
    PixelValues(Option<Box<ReadPixels>>),
    /// A snapshot of the picture.
    Snapshot(Box<Snapshot>),
    /// A bookmark of the scene with this key, with its small picture.
    Bookmarked(PathBuf, Box<SavedCamera>),
    /// The objects and distances of the pixels of the picture; `None` if the picture is another one by now.
    Seen(Option<Box<Seen>>),
    /// No result.
    Nothing,
    /// The picture as the window shows it, for the clipboard.
    Copied(Box<ScreenImage>),
    /// The picture so far, for a file.
    Picture(Box<Captured>),
    /// An error message.
    Failed(String),
}
