//! The pixel under the cursor and what it shows.

use crate::worker::request::RenderRequest;

/// Seconds that the cursor must rest on a pixel before the renderer is asked about it: long enough that a drag
/// that begins there does not wait for the answer.
pub const REST: f64 = 0.6;

/// Colour and surface at a pixel of the main picture.
#[derive(Clone, Debug, PartialEq)]
pub struct Probe {
    /// Column and row from the upper left corner.
    pub pixel: [u32; 2],
    /// The displayed colour: red, green and blue, encoded; `None` where nothing is shown.
    pub rgb: Option<[u8; 3]>,
    /// The nearest surface; `None` if the camera ray hits the background.
    pub surface: Option<Surface>,
}

/// The nearest surface in a pixel.
#[derive(Clone, Debug, PartialEq)]
pub struct Surface {
    /// The name of its object, as in the outline.
    pub object: String,
    /// From the camera along the ray, in scene units.
    pub distance: f64,
}

/// The inputs of an answer.
#[derive(Clone, Debug, PartialEq)]
pub struct Subject {
    pub(crate) pixel: [u32; 2],
    pub(crate) request: RenderRequest,
    /// Whether the picture is done, and how often it was shown; before, how often its samples have doubled.
    pub(crate) stage: (bool, u64),
}

/// The pixel under the cursor.
#[derive(Debug, Default)]
pub struct Cursor {
    /// Column and row in the picture that the cursor is in.
    pub pixel: Option<[u32; 2]>,
    /// Whether that is the main picture, and not what it is compared with.
    pub is_in_main: bool,
    /// When the cursor came there, in egui's time.
    pub(crate) since: f64,
    /// The last answer.
    pub probe: Option<Probe>,
    pub(crate) asked: Option<Subject>,
}

impl Cursor {
    /// Moves the cursor; returns whether the pixel changed.
    pub fn hover(&mut self, pixel: Option<[u32; 2]>, is_in_main: bool, now: f64) -> bool {
        let is_other = (self.pixel, self.is_in_main) != (pixel, is_in_main);
        if is_other {
            (self.pixel, self.is_in_main, self.since) = (pixel, is_in_main, now);
            self.asked = None;
        }
        is_other
    }

    /// The answer about the pixel where the cursor is.
    pub fn current(&self) -> Option<&Probe> {
        let probe = self.probe.as_ref()?;
        (self.is_in_main && self.pixel == Some(probe.pixel)).then_some(probe)
    }
}
