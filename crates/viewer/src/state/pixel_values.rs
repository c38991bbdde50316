//! The values of magnified pixels.

use crate::state::asked::Asked;
use glimray_scene::image::ScreenImage;

/// The displayed values of a part of the picture.
#[derive(Debug)]
pub struct ReadPixels {
    /// The values.
    pub image: ScreenImage,
    /// The part: x, y, width and height in the picture's pixels.
    pub region: [u32; 4],
}

impl ReadPixels {
    /// Red, green and blue of a pixel of the picture, encoded; `None` where nothing is shown.
    pub fn rgb(&self, [x, y]: [u32; 2]) -> Option<[u8; 3]> {
        let [left, top, width, height] = self.region;
        let (x, y) = (x.checked_sub(left)?, y.checked_sub(top)?);
        let is_inside = x < width && y < height && self.image.width == width;
        let index = (y as usize) * (width as usize) + x as usize;
        let [red, green, blue, opacity] = *self.image.pixels.get(index).filter(|_| is_inside)?;
        (opacity > 0).then_some([red, green, blue])
    }
}

/// The values that are written into magnified pixels.
#[derive(Debug, Default)]
pub struct PixelValues {
    /// The last answer.
    pub latest: Option<Box<ReadPixels>>,
    pub(crate) asked: Asked,
}
