//! How surfaces scatter light.

use super::material::texture_indices;
use super::{Fresnel, LayerTextures, MetallicRoughness, Mixing};
use glam::Vec3;
use std::sync::Arc;

/// How a surface scatters light.
#[derive(Clone, Debug, PartialEq)]
pub enum Bsdf {
    /// The classical model, which all integrators show as it is.
    Phong(Phong),
    /// The physically based model. The classical integrators show [`super::Material::classical`] of it. Materials that
    /// differ in [`super::Material::tint`] share it.
    MetallicRoughness(Arc<MetallicRoughness>),
}

/// Phong coefficients per colour channel (Phong 1975), mirror reflection and transmission (Whitted 1980).
#[derive(Clone, Debug, PartialEq)]
pub struct Phong {
    /// k_d, 0 or more.
    pub diffuse: Vec3,
    /// k_s, 0 or more.
    pub specular: Vec3,
    /// The exponent α, 0 or more.
    pub shininess: f32,
    /// Factor on [`super::Scene::ambient`]. 1 in the course's format, by default the diffuse colour in
    /// others.
    pub ambient: Vec3,
    /// Fraction of the light that is reflected, 0 or more; with `fresnel` its value at grazing angles.
    pub reflect: Vec3,
    /// Fraction of the light that is transmitted, 0 or more; with `fresnel` before reflection is
    /// subtracted.
    pub transmit: Vec3,
    /// Weight of the local shading if `mixing` is [`Mixing::Layer`], in 0..=1.
    pub opacity: f32,
    /// Index of refraction on the inside, which is the side that the normal points away from; above 0.
    pub ior: f32,
    /// Absorption coefficient of the inside per unit length: exp(−absorption · length) is transmitted
    /// (Beer and Lambert). 0 or more.
    pub absorption: Vec3,
    /// How reflection depends on the angle.
    pub fresnel: Fresnel,
    /// How local, reflected and transmitted light are combined.
    pub mixing: Mixing,
    /// Textures that multiply the colours.
    pub textures: PhongTextures,
}

texture_indices! {
    /// For each colour of a [`Phong`] BSDF the index in [`super::Scene::textures`] of the texture that multiplies it.
    PhongTextures {
        /// Texture of [`Phong::diffuse`].
        diffuse,
        /// Texture of [`Phong::specular`].
        specular,
        /// Texture of [`Phong::ambient`].
        ambient,
        /// Texture of [`Phong::reflect`].
        reflect,
        /// Texture of [`Phong::transmit`].
        transmit,
    }
}

impl Default for Phong {
    /// A matte light grey.
    fn default() -> Self {
        Self {
            diffuse: Vec3::splat(0.8),
            specular: Vec3::ZERO,
            shininess: 1.0,
            ambient: Vec3::splat(0.8),
            reflect: Vec3::ZERO,
            transmit: Vec3::ZERO,
            opacity: 1.0,
            ior: 1.0,
            absorption: Vec3::ZERO,
            fresnel: Fresnel::None,
            mixing: Mixing::Layer,
            textures: PhongTextures::default(),
        }
    }
}

impl Bsdf {
    /// The indices of all its textures in [`super::Scene::textures`], some of them repeatedly.
    pub fn texture_indices(&self) -> impl Iterator<Item = usize> {
        let (layers, phong) = match self {
            Self::Phong(phong) => (None, Some(&phong.textures)),
            Self::MetallicRoughness(model) => {
                let own = model.phong.as_deref();
                (Some(&model.textures), own.map(|own| &own.textures))
            }
        };
        let layers = layers.into_iter().flat_map(LayerTextures::all);
        let phong = phong.into_iter().flat_map(PhongTextures::all);
        phong.chain(layers).flatten()
    }

    /// Adds `first` to every index of a texture, for textures that are appended to others.
    pub(super) fn shift_textures(&mut self, first: usize) {
        match self {
            Self::Phong(phong) => phong.textures.shift(first),
            Self::MetallicRoughness(model) => {
                let model = Arc::make_mut(model);
                model.textures.shift(first);
                if let Some(own) = &mut model.phong {
                    own.textures.shift(first);
                }
            }
        }
    }
}

impl Default for Bsdf {
    fn default() -> Self {
        Self::Phong(Phong::default())
    }
}

impl From<Phong> for Bsdf {
    fn from(phong: Phong) -> Self {
        Self::Phong(phong)
    }
}

impl From<MetallicRoughness> for Bsdf {
    fn from(model: MetallicRoughness) -> Self {
        Self::MetallicRoughness(Arc::new(model))
    }
}
