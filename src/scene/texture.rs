//! Colours that vary over a surface.

use glam::{DAffine3, Vec3};

/// A colour for every point of a surface. It multiplies a colour of a [`super::Material`].
#[derive(Clone, Debug, PartialEq)]
pub struct Texture {
    /// In its own space.
    pub pattern: Pattern,
    /// What is taken there.
    pub space: Space,
    /// From `space` to the pattern's.
    pub pattern_from_space: DAffine3,
}

/// What a [`Texture`] is looked up by.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Space {
    /// The point in world space.
    #[default]
    World,
    /// (u, v, 0) of the surface.
    Uv,
}

/// Colours over a space.
#[derive(Clone, Debug, PartialEq)]
pub enum Pattern {
    /// Unit cubes of two colours by turns, `a` from (0, 0, 0) to (1, 1, 1).
    Checker {
        /// One colour, 0 or more.
        a: Vec3,
        /// The other.
        b: Vec3,
    },
    /// Layers of two colours along x: `a` over the first half of every unit, `b` over the other.
    Stripes {
        /// One colour, 0 or more.
        a: Vec3,
        /// The other.
        b: Vec3,
    },
    /// From `a` at x = 0 and below linearly to `b` at x = 1 and beyond.
    Gradient {
        /// One colour, 0 or more.
        a: Vec3,
        /// The other.
        b: Vec3,
    },
    /// Clouds: from `a` to `b` by gradient noise n of unit wavelength (Perlin 2002), each octave
    /// half as large and half as strong. The weight of `b` is (1 + Σ n(2ᵏ p) / 2ᵏ) / 2, clamped.
    Noise {
        /// One colour, 0 or more.
        a: Vec3,
        /// The other.
        b: Vec3,
        /// 1 to 16.
        octaves: u32,
    },
    /// A picture over [0, 1]², repeated, v upwards.
    Picture {
        /// Index into [`super::Scene::pictures`].
        picture: usize,
        /// Whether texels have hard edges instead of blending.
        nearest: bool,
    },
}

/// The inverse of the sRGB transfer function, IEC 61966-2-1.
pub fn linear_from_srgb(value: f64) -> f64 {
    if value <= 0.04045 {
        value / 12.92
    } else {
        ((value + 0.055) / 1.055).powf(2.4)
    }
}

/// Texels in memory: linear Rec. 709, row by row from the top left.
#[derive(Clone, Debug, PartialEq)]
pub struct Picture {
    /// In texels, at least 1.
    pub width: u32,
    /// In texels, at least 1.
    pub height: u32,
    /// `width` × `height` of them, 0 or more.
    pub texels: Vec<Vec3>,
}
