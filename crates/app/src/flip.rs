//! FLIP: how much two pictures differ to a person who flips between them.
//!
//! Andersson et al., "FLIP: A Difference Evaluator for Alternating Images" (2020), at the viewing distance that its
//! authors take for the usual one.

/// Whether the program was built with the feature `flip`.
pub const IS_BUILT: bool = cfg!(feature = "flip");

/// Largest picture, in pixels; larger ones would need gigabytes of memory.
pub const MAX_PIXELS: usize = 1 << 24;

/// The error of two pictures.
pub struct Flip {
    /// The error of each pixel, 0 (equal) to 1, row by row from the top left.
    pub errors: Vec<f32>,
    /// The mean of all pixels.
    pub mean: f32,
}

impl Flip {
    /// Compares two pictures of this width and height in pixels: red, green and blue in 8 bits, sRGB. `None` for more than
    /// [`MAX_PIXELS`], and without the feature `flip`.
    #[cfg(feature = "flip")]
    pub fn new([width, height]: [u32; 2], pictures: [Vec<u8>; 2]) -> Option<Self> {
        if width as usize * height as usize > MAX_PIXELS {
            return None;
        }
        let [a, b] =
            pictures.map(|levels| nv_flip::FlipImageRgb8::with_data(width, height, &levels));
        let error = nv_flip::flip(a, b, nv_flip::DEFAULT_PIXELS_PER_DEGREE);
        Some(Self {
            mean: nv_flip::FlipPool::from_image(&error).mean(),
            errors: error.to_vec(),
        })
    }

    /// Compares nothing: the feature `flip` is missing.
    #[cfg(not(feature = "flip"))]
    pub fn new(_: [u32; 2], _: [Vec<u8>; 2]) -> Option<Self> {
        None
    }
}
