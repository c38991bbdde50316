//! The menu of the point under the cursor in the picture.

use eframe::egui::Pos2;
use glam::DVec3;

/// The open menu.
#[derive(Clone, Debug, PartialEq)]
pub struct PictureMenu {
    /// Where it opens, in points.
    pub at: Pos2,
    /// The pixel of the picture.
    pub pixel: [u32; 2],
    /// The point on the nearest surface, in world space; `None` before the renderer has answered, and over the background.
    pub point: Option<DVec3>,
    /// Whether it has not been drawn yet.
    pub(crate) is_new: bool,
}

impl PictureMenu {
    /// A menu at a point of the screen, of a pixel of the picture.
    pub fn new(at: Pos2, pixel: [u32; 2]) -> Self {
        Self {
            at,
            pixel,
            point: None,
            is_new: true,
        }
    }
}
