//! Enumerations of a native scene.

use glimray_scene::{
    Antialias, Attenuation, Filter, Fresnel, LightTransport, Mixing, Shadows, ToneCurve, Transfer,
};
use schemars::JsonSchema;

/// How local, reflected and transmitted light are combined.
#[derive(Clone, Copy, Debug, serde::Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub(in crate::import::native) enum MixingName {
    /// Reflected and transmitted light are subtracted from the layers below.
    Layer,
    /// All are added, as in Haines' NFF.
    Sum,
    /// Reflected light is subtracted from local light, as in the course's format.
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

/// The transfer function from display-linear to stored values.
#[derive(Clone, Copy, Debug, serde::Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub(in crate::import::native) enum TransferName {
    /// The sRGB curve, IEC 61966-2-1.
    Srgb,
    /// Linear.
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

/// How light is computed.
#[derive(Clone, Copy, Debug, serde::Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub(in crate::import::native) enum IntegratorName {
    /// The classical ray tracer.
    Whitted,
    /// The path tracer.
    Path,
}

impl From<IntegratorName> for LightTransport {
    fn from(name: IntegratorName) -> Self {
        match name {
            IntegratorName::Whitted => Self::Whitted,
            IntegratorName::Path => Self::Path,
        }
    }
}

/// The tone curve from scene-linear to display-linear values.
#[derive(Clone, Copy, Debug, serde::Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub(in crate::import::native) enum ToneName {
    /// Clamps only.
    None,
    /// Filmic, high contrast: a fit of ACES.
    Aces,
    /// Filmic, soft, preserves hues: AgX.
    Agx,
    /// x / (1 + x) on luminance.
    Reinhard,
    /// Keeps base colours under white light, compresses highlights alone: Khronos PBR Neutral.
    Neutral,
}

impl From<ToneName> for ToneCurve {
    fn from(name: ToneName) -> Self {
        match name {
            ToneName::None => Self::None,
            ToneName::Aces => Self::Aces,
            ToneName::Agx => Self::Agx,
            ToneName::Reinhard => Self::Reinhard,
            ToneName::Neutral => Self::Neutral,
        }
    }
}

/// How reflection depends on the angle.
#[derive(Clone, Copy, Debug, serde::Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub(in crate::import::native) enum FresnelName {
    /// Constant.
    None,
    /// Fresnel's equations.
    Exact,
    /// Schlick's approximation of them.
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

/// How transparent surfaces affect shadow rays.
#[derive(Clone, Copy, Debug, Default, serde::Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub(in crate::import::native) enum ShadowsName {
    /// They cast full shadows.
    #[default]
    Opaque,
    /// Light passes straight through, coloured and attenuated.
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

/// Where samples lie within a pixel.
#[derive(Clone, Copy, Debug, serde::Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub(in crate::import::native) enum AntialiasName {
    /// All at the centre.
    None,
    /// Stratified.
    Stratified,
    /// Stratified, with as many samples as each pixel needs.
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

/// The reconstruction filter.
#[derive(Clone, Copy, Debug, Default, serde::Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub(in crate::import::native) enum FilterName {
    /// Equal weights.
    #[default]
    Box,
    /// Linear falloff to zero.
    Tent,
    /// A Gaussian with a standard deviation of half a pixel, truncated.
    Gaussian,
    /// The Blackman–Harris window: similar to a Gaussian, but reaches zero.
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

/// How a light fades with the distance r.
#[derive(Clone, Copy, Debug, Default, serde::Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub(in crate::import::native) enum AttenuationName {
    /// No attenuation.
    None,
    /// 1/r², the physical law.
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
