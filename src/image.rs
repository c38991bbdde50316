//! A finished picture in memory.

/// A rectangle of pixels, as [`crate::output`] writes it.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Image {
    /// In pixels.
    pub width: u32,
    /// In pixels.
    pub height: u32,
    /// Red, green, blue and opacity (1 is opaque), row by row from the top-left; `width * height`
    /// of them. Scene-linear Rec. 709 radiance, or what exposure, tone curve and transfer made of
    /// it: whoever developed the picture knows which.
    pub pixels: Vec<[f32; 4]>,
}

impl Image {
    /// A black, fully opaque picture.
    pub fn new(width: u32, height: u32) -> Self {
        let pixels = vec![[0.0, 0.0, 0.0, 1.0]; width as usize * height as usize];
        Self {
            width,
            height,
            pixels,
        }
    }

    /// The pixel in column `x` of row `y`, both from the top-left; `None` outside the picture.
    pub fn pixel(&self, x: u32, y: u32) -> Option<[f32; 4]> {
        if x >= self.width || y >= self.height {
            return None;
        }
        let index = y as usize * self.width as usize + x as usize;
        self.pixels.get(index).copied()
    }

    /// Whether no pixel lets anything shine through.
    pub fn is_opaque(&self) -> bool {
        self.pixels.iter().all(|pixel| pixel[3] >= 1.0)
    }
}
