//! How radiance becomes a picture: exposure, curve and transfer function.

use super::{Fingerprint, Integrator, Levels, fingerprint::Encoder};
use glimray_scene::{LightTransport, OutputDefaults, ToneCurve, Transfer};
use std::fmt;

/// The bits of [`Tone::auto_exposure`] and [`Tone::denoise`] in the number of [`Tone::levels`].
const AUTO_EXPOSURE_BIT: u32 = 8;
const DENOISE_BIT: u32 = 9;

/// How linear radiance is developed to a picture.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Tone {
    /// Exposure in stops; each doubles the brightness.
    pub exposure_ev: f32,
    /// Whether the exposure adds to one that makes the picture's average a medium grey: [`super::Renderer::exposure`].
    pub auto_exposure: bool,
    /// Tone curve, applied after the exposure.
    pub curve: ToneCurve,
    /// Transfer function, applied last.
    pub transfer: Transfer,
    /// The range for views that show a quantity, such as distances.
    pub levels: Levels,
    /// Whether a renderer denoises the radiance first, where its film has features.
    pub denoise: bool,
}

/// Human-readable summary stored in films.
impl fmt::Display for Tone {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        let Self {
            exposure_ev,
            auto_exposure,
            curve,
            transfer,
            levels,
            denoise,
        } = self;
        let auto = if *auto_exposure { "automatic " } else { "" };
        let names = format!("curve {curve:?}, transfer {transfer:?}").to_lowercase();
        let denoised = if *denoise { ", denoised" } else { "" };
        write!(f, "{auto}exposure {exposure_ev} EV, {names}{denoised}")?;
        match levels {
            Levels::Raw => Ok(()),
            Levels::Found => write!(f, ", levels of the picture"),
            Levels::Fixed([least, most]) => write!(f, ", levels {least} to {most}"),
        }
    }
}

impl From<&OutputDefaults> for Tone {
    /// The tone of a scene for pictures by its own integrator.
    fn from(output: &OutputDefaults) -> Self {
        Self::of_scene(output, output.integrator.into())
    }
}

impl Tone {
    /// Keeps radiance unchanged.
    pub const LINEAR: Self = Self {
        exposure_ev: 0.0,
        auto_exposure: false,
        curve: ToneCurve::None,
        transfer: Transfer::Linear,
        levels: Levels::Raw,
        denoise: false,
    };

    /// The tone of a scene for pictures of radiance by an integrator.
    pub fn of_scene(output: &OutputDefaults, integrator: Integrator) -> Self {
        let transport = LightTransport::from(integrator);
        Self {
            exposure_ev: output.exposure_ev,
            auto_exposure: output.auto_exposure,
            curve: output.tone.unwrap_or(output.tone_of(transport)),
            // Curves of paths are made for sRGB. A scene for the classical integrator that names no curve has its transfer
            // function for pictures without one, as in the course's format.
            transfer: match (output.tone, output.integrator, transport) {
                (None, LightTransport::Whitted, LightTransport::Path) => Transfer::Srgb,
                _ => output.transfer,
            },
            denoise: output.denoise && integrator == output.integrator.into(),
            ..Self::LINEAR
        }
    }

    /// A fingerprint of all members: see [`super::RenderSettings::fingerprint`].
    pub fn fingerprint(&self) -> Fingerprint {
        let mut encoder = Encoder::new("tone", 1);
        for number in self.numbers() {
            encoder.number(number);
        }
        encoder.finish()
    }

    /// The numbers of the tone in films, stable across builds.
    pub(super) fn numbers(&self) -> [u32; 6] {
        let Self {
            exposure_ev,
            auto_exposure,
            curve,
            transfer,
            levels,
            denoise,
        } = *self;
        let curve = match curve {
            ToneCurve::None => 0,
            ToneCurve::Aces => 1,
            ToneCurve::Agx => 2,
            ToneCurve::Reinhard => 3,
            ToneCurve::Neutral => 4,
        };
        let transfer = match transfer {
            Transfer::Srgb => 0,
            Transfer::Linear => 1,
        };
        let (kind, [least, most]) = match levels {
            Levels::Raw => (0, [0.0; 2]),
            Levels::Found => (1, [0.0; 2]),
            Levels::Fixed(range) => (2, range),
        };
        let exposure = exposure_ev.to_bits();
        [
            exposure,
            curve,
            transfer,
            kind | u32::from(auto_exposure) << AUTO_EXPOSURE_BIT
                | u32::from(denoise) << DENOISE_BIT,
            least.to_bits(),
            most.to_bits(),
        ]
    }

    /// The tone with these numbers; `None` if [`Self::numbers`] gives them for no tone.
    pub(super) fn from_numbers(numbers: [u32; 6]) -> Option<Self> {
        let [exposure, curve, transfer, kinds, least, most] = numbers;
        let kind = kinds & !(1 << AUTO_EXPOSURE_BIT | 1 << DENOISE_BIT);
        let tone = Self {
            exposure_ev: f32::from_bits(exposure),
            auto_exposure: kinds & 1 << AUTO_EXPOSURE_BIT != 0,
            curve: match curve {
                0 => ToneCurve::None,
                1 => ToneCurve::Aces,
                2 => ToneCurve::Agx,
                3 => ToneCurve::Reinhard,
                4 => ToneCurve::Neutral,
                _ => return None,
            },
            transfer: match transfer {
                0 => Transfer::Srgb,
                1 => Transfer::Linear,
                _ => return None,
            },
            levels: match kind {
                0 => Levels::Raw,
                1 => Levels::Found,
                2 => Levels::Fixed([least, most].map(f32::from_bits)),
                _ => return None,
            },
            denoise: kinds & 1 << DENOISE_BIT != 0,
        };
        // A tone with a NaN would differ from itself.
        let numbers_are = [exposure, least, most].map(|bits| !f32::from_bits(bits).is_nan());
        (tone.numbers() == numbers && numbers_are == [true; 3]).then_some(tone)
    }
}
