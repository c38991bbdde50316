//! Words that a native scene chooses from.

use crate::scene::{Antialias, Attenuation, Filter, Fresnel, Mixing, Shadows, ToneCurve, Transfer};
use schemars::JsonSchema;

/// How local, mirrored and transmitted light are put together.
#[derive(Clone, Copy, Debug, serde::Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub(in crate::import::native) enum MixingName {
    /// What is mirrored or let through is taken from what is under it.
    Layer,
    /// All are added, as in Haines' NFF.
    Sum,
    /// What is mirrored is taken from local light, as in the course's format.
    Blend,
}

impl From<MixingName> for Mixing {
    fn from(name: MixingName) -> Self {
        match name {
            MixingName::Layer => Self::Layer,
            MixingName::Sum => Self::Sum,
            MixingName::Blend => Self::Blend,
        }
    }
}

/// How display-linear values become stored ones.
#[derive(Clone, Copy, Debug, serde::Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub(in crate::import::native) enum TransferName {
    /// The sRGB curve, IEC 61966-2-1.
    Srgb,
    /// As they are.
    Linear,
}

impl From<TransferName> for Transfer {
    fn from(name: TransferName) -> Self {
        match name {
            TransferName::Srgb => Self::Srgb,
            TransferName::Linear => Self::Linear,
        }
    }
}

/// How scene-linear radiance becomes display-linear.
#[derive(Clone, Copy, Debug, serde::Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub(in crate::import::native) enum ToneName {
    /// Clamp.
    None,
    /// Filmic, contrasty: a fit of ACES.
    Aces,
    /// Filmic, soft, keeps hues: AgX.
    Agx,
    /// x / (1 + x) on luminance.
    Reinhard,
}

impl From<ToneName> for ToneCurve {
    fn from(name: ToneName) -> Self {
        match name {
            ToneName::None => Self::None,
            ToneName::Aces => Self::Aces,
            ToneName::Agx => Self::Agx,
            ToneName::Reinhard => Self::Reinhard,
        }
    }
}

/// How much is mirrored at which angle.
#[derive(Clone, Copy, Debug, serde::Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub(in crate::import::native) enum FresnelName {
    /// The same at every angle.
    None,
    /// By Fresnel's equations.
    Exact,
    /// By Schlick's approximation of them.
    Schlick,
}

impl From<FresnelName> for Fresnel {
    fn from(name: FresnelName) -> Self {
        match name {
            FresnelName::None => Self::None,
            FresnelName::Exact => Self::Exact,
            FresnelName::Schlick => Self::Schlick,
        }
    }
}

/// How shadow rays meet what is transparent.
#[derive(Clone, Copy, Debug, Default, serde::Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub(in crate::import::native) enum ShadowsName {
    /// It throws a full shadow.
    #[default]
    Opaque,
    /// Light goes straight through, coloured and weakened.
    Filtered,
}

impl From<ShadowsName> for Shadows {
    fn from(name: ShadowsName) -> Self {
        match name {
            ShadowsName::Opaque => Self::Opaque,
            ShadowsName::Filtered => Self::Filtered,
        }
    }
}

/// Where in a pixel its samples lie.
#[derive(Clone, Copy, Debug, serde::Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub(in crate::import::native) enum AntialiasName {
    /// All at the centre.
    None,
    /// Well spread.
    Stratified,
    /// Well spread, and only as many as the pixel needs.
    Adaptive,
}

impl From<AntialiasName> for Antialias {
    fn from(name: AntialiasName) -> Self {
        match name {
            AntialiasName::None => Self::None,
            AntialiasName::Stratified => Self::Stratified,
            AntialiasName::Adaptive => Self::Adaptive,
        }
    }
}

/// What samples round a pixel's centre are weighted by.
#[derive(Clone, Copy, Debug, Default, serde::Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub(in crate::import::native) enum FilterName {
    /// All alike.
    #[default]
    Box,
    /// Linearly down to nothing.
    Tent,
    /// A normal distribution with a standard deviation of half a pixel, cut.
    Gaussian,
    /// The window of Blackman and Harris: much like it, but ends in nothing.
    BlackmanHarris,
    /// The cubic of Mitchell and Netravali, which sharpens.
    Mitchell,
}

impl From<FilterName> for Filter {
    fn from(name: FilterName) -> Self {
        match name {
            FilterName::Box => Self::Box,
            FilterName::Tent => Self::Tent,
            FilterName::Gaussian => Self::Gaussian,
            FilterName::BlackmanHarris => Self::BlackmanHarris,
            FilterName::Mitchell => Self::Mitchell,
        }
    }
}

/// How a light fades with the distance r to it.
#[derive(Clone, Copy, Debug, Default, serde::Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub(in crate::import::native) enum AttenuationName {
    /// Not at all.
    None,
    /// 1/r², as light does.
    #[default]
    InverseSquare,
}

impl From<AttenuationName> for Attenuation {
    fn from(name: AttenuationName) -> Self {
        match name {
            AttenuationName::None => Self::None,
            AttenuationName::InverseSquare => Self::InverseSquare,
        }
    }
}
