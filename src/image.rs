//! A finished image in memory.

/// A rectangle of pixels, as [`crate::output`] writes it.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Image {
    /// In pixels.
    pub width: u32,
    /// In pixels.
    pub height: u32,
    /// Red, green, blue and opacity (1 is opaque), row by row from the top left; `width * height` of
    /// them. Either scene-linear Rec. 709 radiance or display values after exposure, tone curve and
    /// transfer function, depending on how the image was developed.
    pub pixels: Vec<[f32; 4]>,
}

impl Image {
    /// A black, fully opaque image.
    pub fn new(width: u32, height: u32) -> Self {
        let pixels = vec![[0.0, 0.0, 0.0, 1.0]; width as usize * height as usize];
        Self {
            width,
            height,
            pixels,
        }
    }

    /// The pixel in column `x` of row `y`, counted from the top left; `None` outside the image.
    pub fn pixel(&self, x: u32, y: u32) -> Option<[f32; 4]> {
        if x >= self.width || y >= self.height {
            return None;
        }
        let index = y as usize * self.width as usize + x as usize;
        self.pixels.get(index).copied()
    }

    /// Whether every pixel is opaque.
    pub fn is_opaque(&self) -> bool {
        self.pixels.iter().all(|pixel| pixel[3] >= 1.0)
    }
}
