//! Error maps: how the difference of two pictures is measured and painted.

use glimray_app::flip::{self, Flip};
use glimray_app::legend;
use glimray_scene::image::{Errors, Image, Placed, ScreenImage, pairs};
use glimray_scene::linear_from_srgb;

/// A measure of the difference of two pictures.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Measure {
    /// The absolute difference of the displayed colours, by channel.
    Absolute,
    /// The relative error of linear values.
    Relative,
    /// The squared relative error of linear values.
    RelativeSquared,
    /// FLIP of the displayed colours.
    Flip,
}

/// A measure, and the factor on it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ErrorMap {
    /// The measure.
    pub measure: Measure,
    /// The factor, 1 or more: the scale of colours ends at an error of 1 / `gain`.
    pub gain: f32,
}

impl Measure {
    /// All, in the order of lists.
    pub const ALL: [Self; 4] = [
        Self::Absolute,
        Self::Relative,
        Self::RelativeSquared,
        Self::Flip,
    ];

    /// The name in lists.
    pub fn title(self) -> &'static str {
        match self {
            Self::Absolute => "Difference",
            Self::Relative => "Relative error",
            Self::RelativeSquared => "Squared relative error",
            Self::Flip => "FLIP",
        }
    }

    /// How it is computed, in one sentence without a full stop.
    pub fn help(self) -> &'static str {
        match self {
            Self::Absolute => "Absolute difference of the displayed colours",
            Self::Relative => {
                "|a − b| / (|b| + 0.01) of linear values, the mean of the colour channels; b is the second picture"
            }
            Self::RelativeSquared => {
                "(a − b)² / (b² + 0.01) of linear values, the mean of the colour channels; b is the second picture"
            }
            Self::Flip => {
                "The difference that a person sees who flips between the displayed pictures, 0 to 1"
            }
        }
    }

    /// The name of the mean.
    pub fn mean(self) -> &'static str {
        match self {
            Self::Absolute | Self::Relative => "mean",
            Self::RelativeSquared => "relMSE",
            Self::Flip => "mean FLIP",
        }
    }

    /// Whether the program can compute it.
    pub fn is_built(self) -> bool {
        self != Self::Flip || flip::IS_BUILT
    }

    /// Whether it needs linear values in place of the displayed ones.
    pub(super) fn is_of_linear_values(self) -> bool {
        matches!(self, Self::Relative | Self::RelativeSquared)
    }
}

impl ErrorMap {
    /// A map with the usual gain of its measure.
    pub fn new(measure: Measure) -> Self {
        let gain = match measure {
            Measure::Absolute => 4.0,
            Measure::Relative | Measure::RelativeSquared | Measure::Flip => 1.0,
        };
        Self { measure, gain }
    }

    /// The absolute difference with this gain.
    pub fn absolute(gain: f32) -> Self {
        let measure = Measure::Absolute;
        Self { measure, gain }
    }

    /// Errors in the colours of the legend.
    pub(super) fn painted(&self, errors: &Errors) -> ScreenImage {
        errors.painted(|error| legend::color_at(legend::ERRORS, error * self.gain))
    }

    /// The relative errors of two linear pictures.
    pub(super) fn relative(&self, first: Placed<Image>, second: Placed<Image>) -> Errors {
        match self.measure {
            Measure::RelativeSquared => Errors::relative_squared(first, second),
            _ => Errors::relative(first, second),
        }
    }
}

/// Display values as linear ones.
pub(super) fn linear(displayed: &Image) -> Image {
    let decode = |value: f32| linear_from_srgb(value.into()) as f32;
    let pixels = displayed.pixels.iter();
    Image {
        pixels: pixels
            .map(|&[r, g, b, opacity]| [decode(r), decode(g), decode(b), opacity])
            .collect(),
        ..*displayed
    }
}

/// FLIP of two displayed pictures. Where one of them has no opaque pixel, both count as black there and the error is left
/// out. `None` for pictures that are too large.
pub(super) fn flip(first: Placed<ScreenImage>, second: Placed<ScreenImage>) -> Option<Errors> {
    let (width, height) = (first.image.width, first.image.height);
    let pairs = pairs(first, second);
    let levels = |side: usize| {
        let colors = pairs
            .iter()
            .map(|pair| pair.map_or([0.0; 3], |pair| pair[side]));
        colors.flatten().map(|level| level.round() as u8).collect()
    };
    let Flip { errors, .. } = Flip::new([width, height], [levels(0), levels(1)])?;
    let errors = errors.into_iter().zip(&pairs);
    Some(Errors {
        width,
        height,
        errors: errors.map(|(error, pair)| pair.map(|_| error)).collect(),
    })
}
