//! Enumerations of a native scene.

use glimray_scene::{
    Antialias, Attenuation, Filter, Fresnel, LightTransport, Mixing, Shadows, ToneCurve, Transfer,
};

/// Defines the words for the variants of a type; `= OTHER` is a variant of another name.
macro_rules! words {
    (
        $(#[$doc:meta])* $name:ident for $type:ident
        { $($(#[$meaning:meta])* $word:ident $(= $other:ident)?,)* }
    ) => {
        $(#[$doc])*
        #[derive(
            Clone, Copy, Debug, PartialEq, Eq, serde::Deserialize, serde::Serialize, schemars::JsonSchema,
        )]
        #[serde(rename_all = "kebab-case")]
        pub(crate) enum $name {
            $($(#[$meaning])* $word,)*
        }

        impl From<$name> for $type {
            fn from(name: $name) -> Self {
                match name {
                    $($name::$word => words!(@ $type $word $($other)?),)*
                }
            }
        }

        impl From<$type> for $name {
            fn from(value: $type) -> Self {
                match value {
                    $(words!(@ $type $word $($other)?) => Self::$word,)*
                }
            }
        }
    };
    (@ $type:ident $word:ident) => { $type::$word };
    (@ $type:ident $word:ident $other:ident) => { $type::$other };
}

pub(crate) use words;

words! {
    /// How local, reflected and transmitted light are combined.
    MixingName for Mixing {
        /// Reflected and transmitted light are subtracted from the layers below.
        Layer,
        /// All are added, as in Haines' NFF.
        Sum,
        /// Reflected light is subtracted from local light, as in the course's format.
        Blend,
    }
}

words! {
    /// The transfer function from display-linear to stored values.
    TransferName for Transfer {
        /// The sRGB curve, IEC 61966-2-1.
        Srgb,
        /// Linear.
        Linear,
    }
}

words! {
    /// How light is computed.
    IntegratorName for LightTransport {
        /// The classical ray tracer.
        Whitted,
        /// The path tracer.
        Path,
    }
}

words! {
    /// The tone curve from scene-linear to display-linear values.
    ToneName for ToneCurve {
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
}

words! {
    /// How reflection depends on the angle.
    FresnelName for Fresnel {
        /// Constant.
        None,
        /// Fresnel's equations.
        Exact,
        /// Schlick's approximation of them.
        Schlick,
    }
}

words! {
    /// How transparent surfaces affect shadow rays.
    ShadowsName for Shadows {
        /// They cast full shadows.
        Opaque,
        /// Light passes straight through, coloured and attenuated.
        Filtered,
    }
}

words! {
    /// Where samples lie within a pixel.
    AntialiasName for Antialias {
        /// All at the centre.
        None,
        /// Stratified.
        Stratified,
        /// Stratified, with as many samples as each pixel needs.
        Adaptive,
    }
}

words! {
    /// The reconstruction filter.
    FilterName for Filter {
        /// Equal weights.
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
}

words! {
    /// How a light fades with the distance r.
    AttenuationName for Attenuation {
        /// No attenuation.
        None,
        /// 1/r², the physical law.
        InverseSquare,
    }
}
