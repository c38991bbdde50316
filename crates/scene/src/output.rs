//! A scene's output settings.

use glam::Vec3;

/// The output settings in a scene file. Command-line flags override them.
#[derive(Clone, Debug, PartialEq)]
pub struct OutputDefaults {
    /// Width and height in pixels.
    pub size: (u32, u32),
    /// The integrator that the scene is made for. Samples and bounces are meant for it.
    pub integrator: LightTransport,
    /// Samples per pixel, at least 1.
    pub samples: u32,
    /// Sample placement; `None`: at the pixel's centre for one sample, otherwise stratified.
    pub antialias: Option<Antialias>,
    /// Reconstruction filter.
    pub filter: Filter,
    /// Filter radius in pixels; `None`: the filter's default.
    pub filter_radius: Option<f32>,
    /// Noise threshold of adaptive sampling; see [`Antialias::Adaptive`].
    pub noise: f32,
    /// Factor on the number of shadow rays of every area light, above 0.
    pub light_samples: f32,
    /// Bounces after the first hit; 0 is local shading only.
    pub max_depth: u32,
    /// Exposure in stops; each doubles the brightness.
    pub exposure_ev: f32,
    /// Whether the exposure adds to one that makes the picture's average a medium grey.
    pub auto_exposure: bool,
    /// Tone curve, applied after the exposure; `None`: that of [`Self::tone_of`].
    pub tone: Option<ToneCurve>,
    /// The tone curve of paths without [`Self::tone`]: AgX, and for models Khronos PBR Neutral.
    pub path_tone: ToneCurve,
    /// Transfer function, applied last. Without [`Self::tone`] it belongs to the tone curve of [`Self::integrator`]: paths
    /// that are traced in place of classical rays are shown with [`Self::path_tone`] and sRGB.
    pub transfer: Transfer,
    /// Frames per second of an animation, above 0.
    pub fps: f64,
    /// Duration of an animation in seconds, above 0; `None`: see [`super::Scene::duration`].
    pub duration: Option<f64>,
    /// When the shutter is open.
    pub shutter: Shutter,
    /// The backdrop that paths from the camera see where there is nothing.
    pub backdrop: Backdrop,
    /// Whether pictures by [`Self::integrator`] are denoised.
    pub denoise: bool,
}

/// The backdrop that paths from the camera see where there is nothing, directly and straight or refracted through smooth
/// transparent surfaces. Everything else sees [`super::Scene::background`], which lights the scene and shows in mirrors.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum Backdrop {
    /// The background.
    #[default]
    Background,
    /// A linear radiance, 0 or more per channel.
    Color(Vec3),
    /// Nothing: the picture is transparent there, and shadow catchers are transparent but for the shadows on them.
    Transparent,
}

/// The shutter interval in frames, relative to the frame's own time: `open` ≤ `close`. Equal times freeze
/// all motion.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Shutter {
    /// When it opens.
    pub open: f64,
    /// When it closes.
    pub close: f64,
}

impl Shutter {
    /// When it opens and closes for a picture at `time`, in seconds, at this many frames per second.
    pub fn interval(self, time: f64, fps: f64) -> (f64, f64) {
        (time + self.open / fps, time + self.close / fps)
    }
}

impl Default for OutputDefaults {
    fn default() -> Self {
        Self {
            size: (640, 480),
            integrator: LightTransport::Whitted,
            samples: 1,
            antialias: None,
            filter: Filter::Box,
            filter_radius: None,
            noise: 0.01,
            light_samples: 1.0,
            max_depth: LightTransport::Whitted.max_depth(),
            exposure_ev: 0.0,
            auto_exposure: false,
            tone: None,
            path_tone: ToneCurve::Agx,
            transfer: Transfer::Srgb,
            fps: 24.0,
            duration: None,
            shutter: Shutter::default(),
            backdrop: Backdrop::Background,
            denoise: false,
        }
    }
}

impl OutputDefaults {
    /// The tone curve of pictures by `transport` where [`Self::tone`] gives none: clamping for the classical integrator, as in
    /// the course; [`Self::path_tone`] for paths, whose light has a much wider range.
    pub fn tone_of(&self, transport: LightTransport) -> ToneCurve {
        match transport {
            LightTransport::Whitted => ToneCurve::None,
            LightTransport::Path => self.path_tone,
        }
    }
}

/// How light is computed.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum LightTransport {
    /// Phong's illumination with shadow rays, and recursive reflection and refraction (Whitted 1980).
    #[default]
    Whitted,
    /// Path tracing (Kajiya 1986).
    Path,
}

/// Most bounces of a classical picture of a scene that is made for path tracing: trees of rays double with each, and a
/// glass wall takes two.
const MOST_BOUNCES: u32 = 8;

impl LightTransport {
    /// Default samples per pixel, of scenes whose single samples are noisy.
    pub const fn samples(self) -> u32 {
        match self {
            Self::Whitted => 16,
            Self::Path => 64,
        }
    }

    /// Default number of bounces after the first hit.
    pub const fn max_depth(self) -> u32 {
        match self {
            Self::Whitted => 5,
            Self::Path => 16,
        }
    }

    /// Samples per pixel and bounces for a scene that says these for `self`, if it is rendered with `other`. Samples of
    /// pictures that are denoised are too few for others.
    pub fn converted(
        self,
        other: Self,
        (samples, max_depth): (u32, u32),
        is_denoised: bool,
    ) -> (u32, u32) {
        match (self, other) {
            (Self::Whitted, Self::Path) => (samples.max(other.samples()), other.max_depth()),
            (Self::Path, Self::Whitted) => {
                let enough = match is_denoised {
                    true => other.samples(),
                    false => samples.min(other.samples()),
                };
                (enough, max_depth.min(MOST_BOUNCES))
            }
            _ => (samples, max_depth),
        }
    }
}

/// From scene-linear radiance to display-linear [0, 1].
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum ToneCurve {
    /// Clamp only.
    #[default]
    None,
    /// Narkowicz' fit of the ACES filmic curve (2015).
    Aces,
    /// Sobotka's AgX in Wrensch's polynomial fit (2023).
    Agx,
    /// x / (1 + x) on luminance (Reinhard et al. 2002).
    Reinhard,
    /// Khronos PBR Neutral (2024), which shows base colours under white light as they are.
    Neutral,
}

/// From display-linear [0, 1] to stored values.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Transfer {
    /// IEC 61966-2-1.
    #[default]
    Srgb,
    /// Linear, as in the course's format.
    Linear,
}

/// Where samples lie within a pixel.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Antialias {
    /// All at the centre, as in the course's pictures.
    #[default]
    None,
    /// Stratified over the filter's support.
    Stratified,
    /// Stratified, with as many samples as each pixel needs: after the first few, sampling continues in
    /// pixels whose estimated error or difference from a neighbour exceeds the noise threshold. Both are
    /// measured on the square root of luminance, where 1 is white.
    Adaptive,
}

/// The reconstruction filter. Separable, and zero beyond its radius.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Filter {
    /// Equal weights.
    #[default]
    Box,
    /// Linear falloff to 0.
    Tent,
    /// A normal distribution of standard deviation 0.5 pixels, cut at the radius.
    Gaussian,
    /// The four-term Blackman–Harris window.
    BlackmanHarris,
    /// Mitchell and Netravali's cubic with B = C = 1/3, which sharpens: it has negative lobes.
    Mitchell,
}

impl Filter {
    /// Default radius in pixels.
    pub fn default_radius(self) -> f32 {
        match self {
            Self::Box => 0.5,
            Self::Tent => 1.0,
            Self::Gaussian | Self::BlackmanHarris => 1.5,
            Self::Mitchell => 2.0,
        }
    }
}
