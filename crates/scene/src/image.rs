//! Finished images in memory, and their differences.

mod difference;
mod errors;

pub use difference::{Difference, Pixels, Placed, pairs};
pub use errors::{Errors, RELATIVE_EPSILON};

/// A rectangle of pixels, as `glimray_io::output` writes it.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Image {
    /// In pixels.
    pub width: u32,
    /// In pixels.
    pub height: u32,
    /// Red, green, blue and opacity (1 is opaque), row by row from the top left; `width * height` of
    /// them. Colours are not multiplied by the opacity. Either scene-linear Rec. 709 radiance or display values after exposure, tone curve and
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

    /// Copies `pixels`, in rows of `width`, to the place whose upper left corner is `[x, y]`.
    ///
    /// # Panics
    /// If they reach beyond the image.
    pub fn put(&mut self, pixels: &[[f32; 4]], width: u32, [x, y]: [u32; 2]) {
        for (row, line) in pixels.chunks_exact((width as usize).max(1)).enumerate() {
            let start = (y as usize + row) * self.width as usize + x as usize;
            self.pixels[start..start + line.len()].copy_from_slice(line);
        }
    }

    /// Pictures of one size in rows of `columns`, or fewer if there are not so many; what is left of the last row is
    /// black.
    ///
    /// # Panics
    /// If one is larger than the first, or `columns` is 0.
    pub fn sheet(pictures: &[Self], columns: usize) -> Self {
        let Some(first) = pictures.first() else {
            return Self::default();
        };
        let columns = columns.min(pictures.len());
        let rows = pictures.len().div_ceil(columns);
        let mut sheet = Self::new(columns as u32 * first.width, rows as u32 * first.height);
        for (index, picture) in pictures.iter().enumerate() {
            let (column, row) = ((index % columns) as u32, (index / columns) as u32);
            let place = [column * first.width, row * first.height];
            sheet.put(&picture.pixels, picture.width, place);
        }
        sheet
    }

    /// The pixels with colours multiplied by the opacity, as OpenEXR stores them.
    pub fn premultiplied(&self) -> impl Iterator<Item = [f32; 4]> {
        let pixels = self.pixels.iter();
        pixels.map(|&[r, g, b, opacity]| [r * opacity, g * opacity, b * opacity, opacity])
    }

    /// Whether every pixel is opaque.
    pub fn is_opaque(&self) -> bool {
        self.pixels.iter().all(|pixel| pixel[3] >= 1.0)
    }
}

/// An image as a screen shows it.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct ScreenImage {
    /// In pixels.
    pub width: u32,
    /// In pixels.
    pub height: u32,
    /// Red, green, blue and opacity in 8 bits, encoded with the transfer function, colours multiplied by the
    /// opacity; row by row from the top left.
    pub pixels: Vec<[u8; 4]>,
}

impl From<&Image> for ScreenImage {
    /// Rounds display values, clamped to 0..=1. NaN becomes 0.
    fn from(image: &Image) -> Self {
        let quantized = |value: f32| (value.clamp(0.0, 1.0) * 255.0).round() as u8;
        let pixel = |&[r, g, b, opacity]: &[f32; 4]| {
            let color = |value: f32| quantized(value.clamp(0.0, 1.0) * opacity);
            [color(r), color(g), color(b), quantized(opacity)]
        };
        Self {
            width: image.width,
            height: image.height,
            pixels: image.pixels.iter().map(pixel).collect(),
        }
    }
}
