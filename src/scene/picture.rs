//! Images in memory.

use glam::{Vec3, Vec4};

/// An image in memory.
#[derive(Clone, Debug, PartialEq)]
pub struct Picture {
    /// In texels, at least 1.
    pub width: u32,
    /// In texels, at least 1.
    pub height: u32,
    /// `width` × `height` of them, row by row from the top left.
    pub texels: Texels,
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
        }
    }

    /// All texels as linear values, row by row from the top left.
    pub fn linear(&self) -> impl Iterator<Item = Vec4> {
        (0..self.texels.len()).map(|index| self.texels.linear(index))
    }
}

impl Texels {
    /// Number of texels.
    pub fn len(&self) -> usize {
        match self {
            Self::Srgb8(texels) | Self::Linear8(texels) => texels.len(),
            Self::Float(texels) => texels.len(),
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
    fn linear(&self, index: usize) -> Vec4 {
        let value = |code: u8| f64::from(code) / 255.0;
        match self {
            Self::Srgb8(texels) => {
                let [r, g, b, a] = texels[index];
                let color = [r, g, b].map(|code| linear_from_srgb(value(code)) as f32);
                Vec3::from(color).extend(value(a) as f32)
            }
            Self::Linear8(texels) => Vec4::from(texels[index].map(|code| value(code) as f32)),
            Self::Float(texels) => texels[index],
        }
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
