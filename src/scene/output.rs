//! How a scene wants its picture.

/// How a scene wants its picture, where no flag says otherwise.
#[derive(Clone, Debug, PartialEq)]
pub struct OutputDefaults {
    /// Width and height in pixels.
    pub size: (u32, u32),
    /// Samples per pixel, at least 1.
    pub samples: u32,
    /// Where they lie; `None`: at the centre if it is one, else stratified.
    pub antialias: Option<Antialias>,
    /// What they are weighted by.
    pub filter: Filter,
    /// In pixels; `None`: the filter's own.
    pub filter_radius: Option<f32>,
    /// The noise that adaptive sampling stops at; see [`Antialias::Adaptive`].
    pub noise: f32,
    /// Factor on the samples of every area light, above 0.
    pub light_samples: f32,
    /// Bounces after the first hit; 0 is local shading only.
    pub max_depth: u32,
    /// Stops; each doubles the brightness.
    pub exposure_ev: f32,
    /// Applied after the exposure.
    pub tone: ToneCurve,
    /// Applied last.
    pub transfer: Transfer,
    /// Frames per second of an animation, above 0.
    pub fps: f64,
    /// Seconds that an animation lasts, above 0; `None`: see [`super::Scene::duration`].
    pub duration: Option<f64>,
    /// When the shutter is open.
    pub shutter: Shutter,
}

/// When the shutter is open, counted from a frame's own time, in frames: `open` ≤ `close`. Equal
/// ones freeze all movement.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Shutter {
    /// When it opens.
    pub open: f64,
    /// When it closes.
    pub close: f64,
}

impl Default for OutputDefaults {
    fn default() -> Self {
        Self {
            size: (640, 480),
            samples: 1,
            antialias: None,
            filter: Filter::Box,
            filter_radius: None,
            noise: 0.01,
            light_samples: 1.0,
            max_depth: 5,
            exposure_ev: 0.0,
            tone: ToneCurve::None,
            transfer: Transfer::Srgb,
            fps: 24.0,
            duration: None,
            shutter: Shutter::default(),
        }
    }
}

/// From scene-linear radiance to display-linear [0, 1].
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum ToneCurve {
    /// Clamp.
    #[default]
    None,
    /// Narkowicz' fit of the ACES filmic curve (2015).
    Aces,
    /// Sobotka's AgX, Wrensch's polynomial fit (2023).
    Agx,
    /// x / (1 + x) on luminance (Reinhard et al. 2002).
    Reinhard,
}

/// From display-linear [0, 1] to stored values.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Transfer {
    /// IEC 61966-2-1.
    #[default]
    Srgb,
    /// As is, which the course's format wants.
    Linear,
}

/// Where in a pixel its samples lie.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Antialias {
    /// All at the centre, as the course's pictures want it.
    #[default]
    None,
    /// Well spread over the filter's support.
    Stratified,
    /// The same, but only as many as the pixel needs: after a few, pixels go on whose estimated
    /// error or whose difference from a neighbour exceeds the noise that is allowed, both measured
    /// on the square root of luminance, on which 1 is white.
    Adaptive,
}

/// The reconstruction filter: what samples round a pixel's centre are weighted by. Separable, and
/// zero beyond its radius.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Filter {
    /// All alike.
    #[default]
    Box,
    /// Linearly down to 0.
    Tent,
    /// A normal distribution of standard deviation 0.5 pixels, cut at the radius.
    Gaussian,
    /// The four-term window of Blackman and Harris.
    BlackmanHarris,
    /// Mitchell and Netravali's cubic with B = C = 1/3, which sharpens: it is negative in places.
    Mitchell,
}

impl Filter {
    /// The radius in pixels that it is used with unless told otherwise.
    pub fn default_radius(self) -> f32 {
        match self {
            Self::Box => 0.5,
            Self::Tent => 1.0,
            Self::Gaussian | Self::BlackmanHarris => 1.5,
            Self::Mitchell => 2.0,
        }
    }
}
