//! Images in memory.

use super::BuiltIn;
use glam::{DVec3, Vec3, Vec4};
use std::sync::Arc;

/// Most bytes that the texels of all pictures take together: 44 pictures of 4096 × 4096 texels of 8 bits per channel.
/// With smaller copies for minification they fit into the array that WebGPU guarantees.
pub const MAX_PICTURE_BYTES: usize = 11 << 28;

/// The luminance of a linear Rec. 709 colour is the dot product with this; `LUMINANCE_REC709` in `lib/tone.wesl`.
pub const LUMINANCE: DVec3 = DVec3::new(0.2126, 0.7152, 0.0722);

/// The largest value of a texel of a texture: the GPU has half floats. Pictures in the background may have larger ones.
pub const LARGEST_TEXEL: f32 = 65504.0;

/// Half of the smallest half float above 0: values up to it become 0.
pub const SMALLEST_TEXEL: f32 = 1.0 / (1 << 25) as f32;

/// An image in memory.
#[derive(Clone, Debug, PartialEq)]
pub struct Picture {
    /// In texels, at least 1.
    pub width: u32,
    /// In texels, at least 1.
    pub height: u32,
    /// `width` × `height` of them, row by row from the top left.
    pub texels: Texels,
    /// Source that the texels were computed from.
    pub origin: Origin,
}

/// Source that the texels of a [`Picture`] were computed from, which scene files have in their place.
#[derive(Clone, Debug, Default, PartialEq)]
pub enum Origin {
    /// Nothing: they were read.
    #[default]
    Texels,
    /// The normal map of a surface of these heights, in red.
    Heights {
        /// From 0 to 1.
        heights: Arc<Picture>,
        /// Whether white is below black.
        are_depths: bool,
    },
    /// [`super::sky::picture`], with these arguments. In the background it has a sun too, see [`super::sky::sun_of`].
    Sky {
        /// Angle of the sun above the horizon in radians.
        elevation: f64,
        /// Angle of the sun from −Z towards +X in radians.
        azimuth: f64,
    },
    /// [`BuiltIn::picture`] of an environment without a sun.
    BuiltIn(BuiltIn),
}

impl Origin {
    /// Whether the picture is an environment that is computed from this alone.
    pub fn is_generated(&self) -> bool {
        matches!(self, Self::Sky { .. } | Self::BuiltIn(_))
    }
}

/// The texels of a [`Picture`]: red, green, blue and alpha, each as precise as its file.
#[derive(Clone, Debug, PartialEq)]
pub enum Texels {
    /// Colours with the transfer function of sRGB (IEC 61966-2-1) in 8 bits per channel; alpha is linear.
    Srgb8(Vec<[u8; 4]>),
    /// Linear values in 8 bits per channel.
    Linear8(Vec<[u8; 4]>),
    /// Linear values, Rec. 709 for colours; 0 or more, alpha at most 1.
    Float(Vec<Vec4>),
}

impl Picture {
    /// An opaque picture of linear colours, 0 or more, row by row from the top left.
    pub fn opaque(width: u32, height: u32, colors: impl IntoIterator<Item = Vec3>) -> Self {
        let texels = colors.into_iter().map(|color| color.extend(1.0)).collect();
        Self {
            width,
            height,
            texels: Texels::Float(texels),
            origin: Origin::Texels,
        }
    }

    /// The picture halved until neither side is longer than `most` texels, which is at least 1.
    pub fn limited(self, most: u32) -> Self {
        let mut picture = self;
        while picture.width.max(picture.height) > most.max(1) {
            picture = picture.halved();
        }
        picture
    }

    /// All texels as linear values, row by row from the top left.
    pub fn linear(&self) -> impl Iterator<Item = Vec4> {
        let curve = SrgbCurve::default();
        (0..self.texels.len()).map(move |index| self.texels.linear(&curve, index))
    }
}

/// Halves the largest pictures until all fit into [`MAX_PICTURE_BYTES`]. Returns how many times that was.
pub fn fit<'p>(pictures: impl IntoIterator<Item = &'p mut Arc<Picture>>) -> usize {
    let size = |picture: &Arc<Picture>| picture.texels.byte_len();
    let mut pictures: Vec<_> = pictures.into_iter().collect();
    let mut bytes: usize = pictures.iter().map(|picture| size(picture)).sum();
    let mut count = 0;
    while bytes > MAX_PICTURE_BYTES {
        let largest = pictures.iter_mut().max_by_key(|picture| size(picture));
        let Some(largest) = largest.filter(|picture| picture.texels.len() > 1) else {
            break;
        };
        let before = size(largest);
        **largest = largest.halved().into();
        bytes -= before - size(largest);
        count += 1;
    }
    count
}

impl Texels {
    /// Number of texels.
    pub fn len(&self) -> usize {
        match self {
            Self::Srgb8(texels) | Self::Linear8(texels) => texels.len(),
            Self::Float(texels) => texels.len(),
        }
    }

    /// The power of two by which colours are divided so that the brightest is at most [`LARGEST_TEXEL`]; 1 if it is.
    pub fn scale(&self) -> f32 {
        match self {
            Self::Srgb8(_) | Self::Linear8(_) => 1.0,
            Self::Float(texels) => {
                scale_of(texels.iter().map(|texel| texel.truncate().max_element()))
            }
        }
    }

    /// Whether no texel has light that is left as half float.
    pub fn is_black(&self) -> bool {
        match self {
            Self::Srgb8(texels) | Self::Linear8(texels) => {
                texels.iter().all(|texel| texel[..3] == [0; 3])
            }
            Self::Float(texels) => {
                let is_black = |texel: &Vec4| texel.truncate().max_element() <= SMALLEST_TEXEL;
                texels.iter().all(is_black)
            }
        }
    }

    /// Whether there is no texel.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// Size in bytes.
    pub fn byte_len(&self) -> usize {
        match self {
            Self::Srgb8(texels) | Self::Linear8(texels) => size_of_val(&texels[..]),
            Self::Float(texels) => size_of_val(&texels[..]),
        }
    }

    /// The linear values of the texel at `index`, which must exist.
    pub fn linear(&self, curve: &SrgbCurve, index: usize) -> Vec4 {
        let value = |code: u8| (f64::from(code) / 255.0) as f32;
        match self {
            Self::Srgb8(texels) => {
                let [r, g, b, a] = texels[index];
                let color = [r, g, b].map(|code| curve.value(code));
                Vec3::from(color).extend(value(a))
            }
            Self::Linear8(texels) => Vec4::from(texels[index].map(value)),
            Self::Float(texels) => texels[index],
        }
    }
}

/// The scale of texels whose brightest channels have these values: [`Texels::scale`].
pub fn scale_of(values: impl Iterator<Item = f32>) -> f32 {
    let largest = values.fold(0.0, f32::max);
    let mut scale = 1.0;
    while largest / scale > LARGEST_TEXEL {
        scale *= 2.0;
    }
    scale
}

/// The transfer function of sRGB (IEC 61966-2-1) between 8-bit codes and linear values.
#[derive(Clone, Debug)]
pub struct SrgbCurve {
    /// The linear value of each code.
    values: [f32; 256],
    /// For each number of [`SrgbCurve::STEPS`]ths the first code of at least that value.
    codes: [u8; Self::STEPS],
}

impl Default for SrgbCurve {
    fn default() -> Self {
        let value = |code: usize| linear_from_srgb(code as f64 / 255.0) as f32;
        let values = std::array::from_fn(value);
        let mut codes = [0; Self::STEPS];
        let mut code = 0;
        for (step, first) in codes.iter_mut().enumerate() {
            code = first_from(&values, code, step as f32 / Self::STEPS as f32);
            *first = code;
        }
        Self { values, codes }
    }
}

/// The first code from `start` on whose linear value is not below `value`, or the last one.
fn first_from(values: &[f32; 256], start: u8, value: f32) -> u8 {
    let mut code = start;
    while code < u8::MAX && values[usize::from(code)] < value {
        code += 1;
    }
    code
}

impl SrgbCurve {
    /// So fine that only a few codes are between one step and the next.
    const STEPS: usize = 4096;

    /// The linear value of a code.
    pub fn value(&self, code: u8) -> f32 {
        self.values[usize::from(code)]
    }

    /// The code whose linear value is nearest to `value`.
    pub fn code(&self, value: f32) -> u8 {
        let step = ((value * Self::STEPS as f32) as usize).min(Self::STEPS - 1);
        let above = first_from(&self.values, self.codes[step], value);
        let below = above.saturating_sub(1);
        match value - self.value(below) < self.value(above) - value {
            true => below,
            false => above,
        }
    }
}

/// The sRGB transfer function, IEC 61966-2-1.
pub fn srgb_from_linear(linear: f32) -> f32 {
    if linear <= 0.003_130_8 {
        linear * 12.92
    } else {
        1.055 * linear.powf(1.0 / 2.4) - 0.055
    }
}

/// The inverse of the sRGB transfer function, IEC 61966-2-1.
pub fn linear_from_srgb(value: f64) -> f64 {
    if value <= 0.04045 {
        value / 12.92
    } else {
        ((value + 0.055) / 1.055).powf(2.4)
    }
}
