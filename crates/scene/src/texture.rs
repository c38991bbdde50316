//! Spatially varying colours.

use glam::{DAffine3, DVec2, DVec3, Vec3};

/// A colour for every point of a surface, multiplied with a colour of a [`super::Material`].
#[derive(Clone, Debug, PartialEq)]
pub struct Texture {
    /// The pattern, in its own space.
    pub pattern: Pattern,
    /// The coordinates that the pattern is evaluated at.
    pub space: Space,
    /// Transform from `space` to the pattern's space.
    pub pattern_from_space: DAffine3,
}

impl Texture {
    /// Whether both are pictures whose texels at the same place belong to the same points of a surface.
    pub fn is_aligned(&self, other: &Self) -> bool {
        let wrap = |it: &Self| match it.pattern {
            Pattern::Picture { wrap, .. } => Some(wrap),
            _ => None,
        };
        self.space == other.space
            && self.pattern_from_space == other.pattern_from_space
            && wrap(self).is_some_and(|own| Some(own) == wrap(other))
    }
}

/// Where a picture lies on a surface: coordinates are scaled, then turned, then moved. It is the transform of
/// `KHR_texture_transform`, whose coordinates have v downwards.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct UvTransform {
    /// In widths and heights of the picture.
    pub offset: DVec2,
    /// Rotation of the coordinates, counter-clockwise seen on the picture, in radians.
    pub rotation: f64,
    /// How many times the picture is repeated along u and v.
    pub scale: DVec2,
}

impl Default for UvTransform {
    fn default() -> Self {
        Self {
            offset: DVec2::ZERO,
            rotation: 0.0,
            scale: DVec2::ONE,
        }
    }
}

impl UvTransform {
    /// The transform that [`Self::pattern_from_uv`] gives; `None` if it has shear or is no transform of u and v.
    pub fn of(pattern_from_uv: DAffine3) -> Option<Self> {
        let flip = DAffine3 {
            translation: DVec3::Y,
            ..DAffine3::from_scale(DVec3::new(1.0, -1.0, 1.0))
        };
        let placed = flip * pattern_from_uv * flip;
        let [x, y] = [placed.matrix3.x_axis, placed.matrix3.y_axis];
        let turned = DVec2::new(x.x, -x.y);
        let scale = DVec2::new(turned.length(), y.length());
        let is_mirrored = x.x * y.y - x.y * y.x < 0.0;
        let found = Self {
            offset: placed.translation.truncate(),
            rotation: turned.y.atan2(turned.x),
            scale: DVec2::new(scale.x, if is_mirrored { -scale.y } else { scale.y }),
        };
        let least = 1e-9 * (1.0 + scale.max_element() + found.offset.abs().max_element());
        let is_it = found.pattern_from_uv().abs_diff_eq(pattern_from_uv, least);
        is_it.then_some(found)
    }

    /// From (u, v, 0) of a surface to those of the picture, both with v upwards. Numbers beyond ±10⁹ are clamped.
    pub fn pattern_from_uv(&self) -> DAffine3 {
        let limit = DVec2::splat(1e9);
        let (sin, cos) = self.rotation.sin_cos();
        let scale = self.scale.clamp(-limit, limit);
        let offset = self.offset.clamp(-limit, limit);
        let flip = DAffine3 {
            translation: DVec3::Y,
            ..DAffine3::from_scale(DVec3::new(1.0, -1.0, 1.0))
        };
        let mut placed = DAffine3::from_translation(offset.extend(0.0));
        placed.matrix3.x_axis = scale.x * DVec3::new(cos, -sin, 0.0);
        placed.matrix3.y_axis = scale.y * DVec3::new(sin, cos, 0.0);
        flip * placed * flip
    }
}

/// The coordinates that a [`Texture`] is evaluated at.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Space {
    /// The point in world space.
    #[default]
    World,
    /// (u, v, 0) of the surface.
    Uv,
    /// (u, v, 0) of the second set of u and v, of meshes that have one.
    SecondUv,
}

/// A function from points to colours.
#[derive(Clone, Debug, PartialEq)]
pub enum Pattern {
    /// Checkerboard of unit cubes; `a` from (0, 0, 0) to (1, 1, 1).
    Checker {
        /// One colour, 0 or more.
        a: Vec3,
        /// The other.
        b: Vec3,
    },
    /// Stripes along x: `a` over the first half of every unit, `b` over the second half.
    Stripes {
        /// One colour, 0 or more.
        a: Vec3,
        /// The other.
        b: Vec3,
    },
    /// Linear from `a` at x ≤ 0 to `b` at x ≥ 1.
    Gradient {
        /// One colour, 0 or more.
        a: Vec3,
        /// The other.
        b: Vec3,
    },
    /// Gradient noise n of unit wavelength (Perlin 2002) between `a` and `b`; each octave has half the
    /// wavelength and half the amplitude of the one before. The weight of `b` is (1 + Σ n(2ᵏ p) / 2ᵏ) /
    /// 2, clamped.
    Noise {
        /// One colour, 0 or more.
        a: Vec3,
        /// The other.
        b: Vec3,
        /// Number of octaves, 1 to 16.
        octaves: u32,
    },
    /// An image over [0, 1]², v upwards.
    Picture {
        /// Index into [`super::Scene::pictures`].
        picture: usize,
        /// Whether texels that look larger than a pixel are not interpolated.
        nearest: bool,
        /// How texels that look smaller than a pixel are filtered.
        minify: Minify,
        /// How the image continues beyond [0, 1] along u and v.
        wrap: [Wrap; 2],
    },
}

/// How the texels of an image are filtered where they look smaller than a pixel: in the image itself or in its mipmap
/// (Williams, Pyramidal Parametrics, 1983), whose levels each have half the width and height of the one before. The
/// modes are those of samplers in OpenGL and glTF.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Minify {
    /// The nearest texel of the image.
    Nearest,
    /// Interpolated between texels of the image.
    Linear,
    /// The nearest texel of the level whose texels are nearest to a pixel in size.
    NearestMipmapNearest,
    /// Interpolated between texels of that level.
    LinearMipmapNearest,
    /// Interpolated between two levels, with the nearest texel of each.
    NearestMipmapLinear,
    /// Interpolated between texels and between levels.
    #[default]
    LinearMipmapLinear,
}

impl Minify {
    /// All modes.
    pub const ALL: [Self; 6] = [
        Self::Nearest,
        Self::Linear,
        Self::NearestMipmapNearest,
        Self::LinearMipmapNearest,
        Self::NearestMipmapLinear,
        Self::LinearMipmapLinear,
    ];

    /// Name of the mode in native scenes.
    pub fn name(self) -> &'static str {
        match self {
            Self::Nearest => "nearest",
            Self::Linear => "linear",
            Self::NearestMipmapNearest => "nearest-mipmap-nearest",
            Self::LinearMipmapNearest => "linear-mipmap-nearest",
            Self::NearestMipmapLinear => "nearest-mipmap-linear",
            Self::LinearMipmapLinear => "linear-mipmap-linear",
        }
    }

    /// Whether texels of one level are not interpolated.
    pub fn is_nearest(self) -> bool {
        matches!(
            self,
            Self::Nearest | Self::NearestMipmapNearest | Self::NearestMipmapLinear
        )
    }

    /// Whether it uses the levels of a mipmap.
    pub fn has_levels(self) -> bool {
        !matches!(self, Self::Nearest | Self::Linear)
    }

    /// Whether it interpolates between levels.
    pub fn blends_levels(self) -> bool {
        matches!(self, Self::NearestMipmapLinear | Self::LinearMipmapLinear)
    }
}

/// How an image continues beyond [0, 1] along one axis.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Wrap {
    /// The image is repeated.
    #[default]
    Repeat,
    /// The image's edge goes on.
    Clamp,
    /// The image is repeated, and every second copy is mirrored.
    Mirror,
}

impl Wrap {
    /// Name of the mode in native scenes.
    pub fn name(self) -> &'static str {
        match self {
            Self::Repeat => "repeat",
            Self::Clamp => "clamp",
            Self::Mirror => "mirror",
        }
    }
}
