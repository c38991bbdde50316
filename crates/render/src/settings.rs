//! Render settings.

use super::{
    Fingerprint, Integrator,
    fingerprint::{Encode, Encoder},
};
use glimray_scene::{Antialias, Backdrop, Filter, LightTransport, OutputDefaults};
use std::{fmt, ops::Range, str::FromStr};

/// Largest width and height of a picture in pixels.
pub const MAX_SIDE: u32 = 1_000_000;

/// The default minimum throughput of rays: half of the smallest 8-bit step.
pub const MIN_THROUGHPUT: f32 = 1.0 / 512.0;

/// The most samples of a pixel for which pixels share their random numbers. With more of them noise is seldom seen, and
/// with 64 a sequence lasts for 8192 × 8192 pixels.
const MAX_SHARED_SAMPLES: u32 = 64;

/// Declares [`RenderSettings`], its defaults and its fingerprint from one row per setting:
/// `name: type = default`.
///
/// The fingerprint has the values in the order of the rows. A row that ends in `, { pattern => "tag" [numbers], … }` adds only
/// the tag and the numbers of the pattern that the value matches: without a match nothing, so that films from before that
/// setting keep their fingerprint. The patterns know the settings by the name between bars.
macro_rules! settings {
    (|$settings:ident| $(
        $(#[$doc:meta])*
        $name:ident: $type:ty = $default:expr
        $(, { $($pattern:pat $(if $condition:expr)? => $tag:literal $([$($number:expr),+])?),+ })?;
    )+) => {
        /// Settings of one picture. Together with scene and frame they determine every pixel.
        #[derive(Clone, Debug, PartialEq)]
        pub struct RenderSettings {
            $($(#[$doc])* pub $name: $type,)+
        }

        impl Default for RenderSettings {
            fn default() -> Self {
                Self { $($name: $default,)+ }
            }
        }

        impl RenderSettings {
            /// The names of all settings.
            pub const NAMES: &[&str] = &[$(stringify!($name)),+];

            /// A fingerprint of all settings. It is stable across builds and versions unless the encoding changes.
            pub fn fingerprint(&self) -> Fingerprint {
                let $settings = self;
                let mut encoder = Encoder::new("render settings", 1);
                $(settings!(@encode encoder, $settings.$name
                    $(, { $($pattern $(if $condition)? => $tag $([$($number),+])?),+ })?);)+
                encoder.finish()
            }
        }
    };
    (@encode $encoder:ident, $value:expr) => {
        $value.encode(&mut $encoder)
    };
    (@encode $encoder:ident, $value:expr, { $($pattern:pat $(if $condition:expr)? => $tag:literal $([$($number:expr),+])?),+ }) => {
        match $value {
            $($pattern $(if $condition)? => {
                $encoder.bytes($tag.as_bytes());
                $($($encoder.float($number);)+)?
            })+
            _ => {}
        }
    };
}

settings! { |settings|
    /// Width and height of the whole picture in pixels, 1 to [`MAX_SIDE`].
    size: (u32, u32) = (640, 480);
    /// Part of the picture to render: x0, y0, x1, y1 in pixels, the last two exclusive.
    crop: Option<[u32; 4]> = None;
    /// Samples per pixel, at least 1.
    samples: u32 = 1;
    /// The range of samples to render, or all of them: within 0 to `samples`, not empty, and not with adaptive
    /// sampling. For a film both ends must be multiples of [`super::SAMPLE_BLOCK`], or the end must be
    /// `samples`.
    sample_range: Option<Range<u32>> = None;
    /// How samples are distributed over a pixel.
    antialias: Antialias = Antialias::None;
    /// The noise at which adaptive sampling stops; see [`Antialias::Adaptive`]. Above 0.
    noise: f32 = 0.01;
    /// Reconstruction filter; without effect if all samples are at the centre.
    filter: Filter = Filter::Box;
    /// Filter radius in pixels, above 0.
    filter_radius: f32 = Filter::Box.default_radius();
    /// Factor on the sample count of every area light, above 0; each keeps at least one sample.
    light_samples: f32 = 1.0;
    /// The integrator.
    integrator: Integrator = Integrator::Whitted;
    /// Ray–triangle intersection algorithm.
    triangle_test: TriangleTest = TriangleTest::Watertight;
    /// Tests every primitive for every ray instead of traversing the BVH, to verify it.
    brute_force: bool = false;
    /// Seed of the random numbers.
    seed: u32 = 0;
    /// Maximum number of bounces after the first hit; 0 means local shading only.
    max_depth: u32 = LightTransport::Whitted.max_depth();
    /// Minimum throughput of reflected and refracted rays, averaged over the channels, 0 to 1. Rays below it
    /// are not traced.
    min_throughput: f32 = MIN_THROUGHPUT;
    /// How origins of secondary rays are moved off surfaces.
    offset: RayOffset = RayOffset::Bound, { RayOffset::Fixed(distance) => "fixed offset" [distance] };
    /// Path tracing: whether all transparent surfaces filter shadow rays, in straight lines. Without it only smooth
    /// thin walls do, and the light behind other glass is found by paths; with it caustics are lost.
    transparent_shadows: bool = false, { true => "transparent shadows" };
    /// Path tracing: how metallic-roughness materials scatter.
    bsdf: BsdfModel = BsdfModel::Full, { BsdfModel::Spec => "BSDF of the glTF specification" };
    /// Path tracing: the most radiance per channel, above 0, that a sample may gain at once from light that was
    /// scattered twice or more; `None` for no limit. It removes fireflies, and light: [`super::Stats::energy_cut`]
    /// says how much.
    clamp_indirect: Option<f32> = None, { Some(limit) => "clamp indirect" [limit] };
    /// Whether the film keeps features besides the radiance: for [`super::Film::features`], and to denoise.
    features: bool = false, { true if settings.has_features() => "features" };
    /// Path tracing: what paths from the camera see where there is nothing.
    backdrop: Backdrop = Backdrop::Background, {
        Backdrop::Color(color) => "backdrop" [color.x, color.y, color.z],
        Backdrop::Transparent => "transparent"
    };
}

impl From<&OutputDefaults> for RenderSettings {
    /// The output defaults of the scene, and defaults for everything else.
    fn from(output: &OutputDefaults) -> Self {
        let antialias = if output.samples > 1 {
            Antialias::Stratified
        } else {
            Antialias::None
        };
        Self {
            size: output.size,
            samples: output.samples,
            antialias: output.antialias.unwrap_or(antialias),
            noise: output.noise,
            filter: output.filter,
            filter_radius: (output.filter_radius).unwrap_or(output.filter.default_radius()),
            light_samples: output.light_samples,
            integrator: output.integrator.into(),
            max_depth: output.max_depth,
            features: output.denoise,
            backdrop: output.backdrop,
            ..Self::default()
        }
    }
}

impl RenderSettings {
    /// Whether sampling is adaptive: pixels stop once they have converged.
    pub fn is_adaptive(&self) -> bool {
        self.antialias == Antialias::Adaptive && self.integrator.entry().is_lit
    }

    /// Whether the film keeps features.
    pub fn has_features(&self) -> bool {
        self.features && self.integrator.entry().has_layers
    }

    /// Whether the film keeps opacity: what paths from the camera see is transparent where there is nothing.
    pub fn has_opacity(&self) -> bool {
        self.backdrop == Backdrop::Transparent && self.integrator == Integrator::Path
    }

    /// The radiance of a backdrop that is a colour.
    pub(super) fn backdrop_color(&self) -> [f32; 3] {
        match self.backdrop {
            Backdrop::Color(color) => color.to_array(),
            Backdrop::Background | Backdrop::Transparent => [0.0; 3],
        }
    }

    /// The width of the part of a pixel that each sample stands for, in pixels: N samples have an N-th of its area each,
    /// unless all go through its centre.
    pub fn footprint(&self) -> f32 {
        match self.antialias {
            Antialias::None => 1.0,
            Antialias::Stratified | Antialias::Adaptive => (self.samples as f32).sqrt().recip(),
        }
    }

    /// The samples of each pixel in the sequences that all pixels share, as the next power of two; 0 if each pixel has its
    /// own sequences.
    pub(super) fn shared_samples(&self) -> u32 {
        match self.samples.next_power_of_two() {
            samples if samples <= MAX_SHARED_SAMPLES && !self.is_adaptive() => samples,
            _ => 0,
        }
    }

    /// The rectangle to render: x, y, width, height.
    pub fn region(&self) -> [u32; 4] {
        let [x0, y0, x1, y1] = self.crop.unwrap_or([0, 0, self.size.0, self.size.1]);
        [x0, y0, x1 - x0, y1 - y0]
    }

    /// The samples to render.
    pub fn samples_to_render(&self) -> Range<u32> {
        self.sample_range.clone().unwrap_or(0..self.samples)
    }

    /// The settings of the whole picture that these settings render a part of.
    pub fn of_whole(&self) -> Self {
        Self {
            crop: None,
            sample_range: None,
            ..self.clone()
        }
    }
}

/// How metallic-roughness materials scatter light in path-traced pictures.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum BsdfModel {
    /// Height-correlated shadowing, with the light that microfacets scatter several times; layers get what those above
    /// leave, by tables of albedos.
    #[default]
    Full,
    /// The formulas of the glTF 2.0 specification (appendix B) to the letter: separable shadowing, Schlick's factor, no
    /// compensation, so that rough surfaces are darker.
    Spec,
}

/// Ray–triangle intersection algorithm.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum TriangleTest {
    /// Intersects the plane, then tests whether the point is inside.
    Plane,
    /// Möller and Trumbore 1997.
    MollerTrumbore,
    /// Woop, Benthin and Wald 2013: no ray slips between neighbouring triangles.
    #[default]
    Watertight,
}

/// Where a reflected, refracted or shadow ray starts, so that it does not hit the surface it leaves. Its text form
/// is `bound` or `fixed:DISTANCE`.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum RayOffset {
    /// As far from the surface as the hit point may be wrong: Pharr, Jakob, Humphreys, Physically Based
    /// Rendering, 4th ed., 6.8.
    #[default]
    Bound,
    /// This far along the geometric normal, in the scene's units, above 0. It is there to show the failures of
    /// a fixed distance: shadow acne where it is below the rounding error, and light leaks and missing
    /// contact shadows where it is longer than details of the scene.
    Fixed(f32),
}

impl fmt::Display for RayOffset {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        match self {
            Self::Bound => f.write_str("bound"),
            Self::Fixed(distance) => write!(f, "fixed:{distance}"),
        }
    }
}

impl FromStr for RayOffset {
    type Err = String;

    /// # Errors
    /// The text is neither `bound` nor `fixed:` and a finite number above 0.
    fn from_str(text: &str) -> Result<Self, String> {
        if text == "bound" {
            return Ok(Self::Bound);
        }
        let distance = (text.strip_prefix("fixed:")).ok_or_else(|| {
            format!("it must be bound or fixed:DISTANCE, such as fixed:1e-4, not `{text}`")
        })?;
        match distance.trim().parse() {
            Ok(number) if number > 0.0 && f32::is_finite(number) => Ok(Self::Fixed(number)),
            _ => Err(format!(
                "the distance must be a finite number above 0, not `{distance}`"
            )),
        }
    }
}
