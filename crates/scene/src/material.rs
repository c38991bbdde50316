//! Materials.

use super::{Bsdf, MetallicRoughness, Phong};
use glam::Vec3;
use std::sync::Arc;

/// A surface: how it scatters light, its emission, and how much of it is there.
#[derive(Clone, Debug, PartialEq)]
pub struct Material {
    /// Empty if the file gives none.
    pub name: String,
    /// How the surface scatters light.
    pub bsdf: Bsdf,
    /// Factor on the base colour of [`Bsdf::MetallicRoughness`], 0 or more: the colour of one of many points. No effect on
    /// others.
    pub tint: Vec3,
    /// Whether the shading normal is flipped to face the ray. Off in the course's format: a surface lit
    /// from behind gets the ambient term only.
    pub two_sided: bool,
    /// Radiance that the surface emits, 0 or more; from its back only if `two_sided` and
    /// `two_sided_emission`. See [`Self::radiance`].
    pub emission: Vec3,
    /// Whether the back emits too if the surface is `two_sided`. Off where back faces are not rendered, as those of
    /// single-sided materials in glTF: they stay visible here, and send no light.
    pub two_sided_emission: bool,
    /// Whether transmitted light goes straight on, as through a window pane: the surface encloses no medium, and
    /// its index of refraction, absorption and `priority` have no effect on it. Passing it is not a bounce. See
    /// [`Self::is_thin`].
    pub thin: bool,
    /// Among overlapping dielectric volumes the one of the highest priority counts; among equals the one
    /// entered last (Schmidt and Budge 2002).
    pub priority: i32,
    /// Textures of its emission and alpha, the normal map and the occlusion map.
    pub textures: Textures,
    /// Factor on the tilt of normals in the normal map: on their x and y, 0 or more.
    pub normal_scale: f32,
    /// The weight of the occlusion map, in 0..=1: a value v of it leaves 1 + weight · (v − 1) of the ambient light.
    pub occlusion_strength: f32,
    /// How much of the surface is there.
    pub coverage: Coverage,
    /// The number that `coverage` is about, in 0..=1, multiplied by the alpha of [`Textures::alpha`].
    pub alpha: f32,
    /// Whether paths from the camera see only the shadows on it, where the picture is transparent:
    /// [`super::Backdrop::Transparent`]. All other light sees the material.
    pub shadow_catcher: bool,
}

impl Material {
    /// The coefficients besides the diffuse and the ambient colour that a colour of vertices multiplies: all that are
    /// multiples of the base colour, and the emission of a Phong material that shows nothing else.
    pub fn colored_parts(&self) -> ColoredParts {
        match &self.bsdf {
            Bsdf::MetallicRoughness(model) => model.colored_parts(),
            Bsdf::Phong(phong) => ColoredParts {
                emission: phong.diffuse == Vec3::ZERO,
                ..ColoredParts::default()
            },
        }
    }

    /// Whether its surfaces depend on tangents: they or their coat have a normal map, or they have anisotropy.
    pub fn has_tangents(&self) -> bool {
        let is_stretched = |model: &MetallicRoughness| {
            model.textures.clearcoat_normal.is_some() || model.anisotropy > 0.0
        };
        self.textures.normal.is_some() || self.metallic_roughness().is_some_and(is_stretched)
    }

    /// The parameters of [`Bsdf::MetallicRoughness`]; `None` for other materials.
    pub fn metallic_roughness(&self) -> Option<&MetallicRoughness> {
        match &self.bsdf {
            Bsdf::MetallicRoughness(model) => Some(model),
            Bsdf::Phong(_) => None,
        }
    }

    /// The parameters of [`Bsdf::MetallicRoughness`], copied if other materials share them; `None` for other materials.
    pub fn metallic_roughness_mut(&mut self) -> Option<&mut MetallicRoughness> {
        match &mut self.bsdf {
            Bsdf::MetallicRoughness(model) => Some(Arc::make_mut(model)),
            Bsdf::Phong(_) => None,
        }
    }

    /// The radiance that the surface emits, and the index of the texture that multiplies it: of an unlit BSDF its base
    /// colour unless the material has an `emission`.
    pub fn radiance(&self) -> (Vec3, Option<usize>) {
        let own = (self.emission, self.textures.emission);
        match self.metallic_roughness() {
            Some(model) if model.unlit && own == (Vec3::ZERO, None) => {
                (model.base_color * self.tint, model.textures.base_color)
            }
            _ => own,
        }
    }

    /// Whether transmitted light goes straight on: if it is `thin`, or its BSDF transmits light and has no thickness.
    pub fn is_thin(&self) -> bool {
        let is_wall =
            |model: &MetallicRoughness| model.transmission > 0.0 && !model.is_refractive();
        self.thin || self.metallic_roughness().is_some_and(is_wall)
    }

    /// The indices of all its textures in [`super::Scene::textures`], some of them repeatedly.
    pub fn texture_indices(&self) -> impl Iterator<Item = usize> {
        let own = self.textures.all().flatten();
        own.chain(self.bsdf.texture_indices())
    }

    /// Adds `first` to every index of a texture, for textures that are appended to others.
    pub fn shift_textures(&mut self, first: usize) {
        self.textures.shift(first);
        self.bsdf.shift_textures(first);
    }
}

/// See [`Material::colored_parts`].
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct ColoredParts {
    /// [`Phong::specular`] and [`Phong::reflect`].
    pub mirror: bool,
    /// [`Phong::transmit`].
    pub glass: bool,
    /// [`Material::emission`].
    pub emission: bool,
}

/// Defines indices of textures from one list of their names.
macro_rules! texture_indices {
    ($(#[$doc:meta])* $type:ident { $($(#[$of:meta])* $name:ident,)* }) => {
        $(#[$doc])*
        #[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
        pub struct $type {
            $($(#[$of])* pub $name: Option<usize>,)*
        }

        impl $type {
            /// All of them.
            pub fn all(&self) -> impl Iterator<Item = Option<usize>> + use<> {
                [$(self.$name,)*].into_iter()
            }

            /// Adds `first` to every index, for textures that are appended to others.
            pub fn shift(&mut self, first: usize) {
                $(self.$name = self.$name.map(|index| index + first);)*
            }
        }
    };
}
pub(super) use texture_indices;

texture_indices! {
    /// For parameters of a [`MetallicRoughness`] the index in [`super::Scene::textures`] of the texture that
    /// multiplies them.
    LayerTextures {
        /// Texture of [`MetallicRoughness::base_color`].
        base_color,
        /// Texture of [`MetallicRoughness::metallic`], in blue.
        metallic,
        /// Texture of [`MetallicRoughness::roughness`], in green.
        roughness,
        /// Texture of [`MetallicRoughness::transmission`], in red.
        transmission,
        /// Texture of [`MetallicRoughness::specular`], in alpha.
        specular,
        /// Texture of [`MetallicRoughness::specular_color`].
        specular_color,
        /// Texture of [`MetallicRoughness::clearcoat`], in red.
        clearcoat,
        /// Texture of [`MetallicRoughness::clearcoat_roughness`], in green.
        clearcoat_roughness,
        /// The normal map of the clear coat, which does not follow that of the surface.
        clearcoat_normal,
        /// Texture of [`MetallicRoughness::sheen_color`].
        sheen_color,
        /// Texture of [`MetallicRoughness::sheen_roughness`], in alpha.
        sheen_roughness,
        /// Texture of [`MetallicRoughness::anisotropy`], in blue; its red and green are a direction, from -1 to 1 for 0 to 1, that is
        /// turned by [`MetallicRoughness::anisotropy_rotation`].
        anisotropy,
        /// Texture of [`MetallicRoughness::iridescence`], in red.
        iridescence,
        /// The place in [`MetallicRoughness::iridescence_thickness`], in green.
        iridescence_thickness,
        /// Texture of [`MetallicRoughness::diffuse_transmission`], in alpha.
        diffuse_transmission,
        /// Texture of [`MetallicRoughness::diffuse_transmission_color`].
        diffuse_transmission_color,
    }
}

/// How much of a surface is there. The rest is a hole: rays pass it in a straight line, shadow rays too. They
/// do not count as bounces.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum Coverage {
    /// All of it, whatever alpha is.
    #[default]
    Opaque,
    /// All of it where alpha is at least this number, in 0..=1, and nothing elsewhere.
    Mask(f32),
    /// The fraction alpha.
    Blend,
}

/// How reflection depends on the angle.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Fresnel {
    /// Independent of the angle.
    #[default]
    None,
    /// Fresnel's equations for unpolarised light, with total reflection beyond the critical angle.
    Exact,
    /// Schlick's approximation of them (1994).
    Schlick,
}

/// How local, reflected and transmitted light are combined, with R and T for `reflect` and `transmit`
/// after Fresnel's split.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Mixing {
    /// highlight + (1 − R) · opacity · (ambient + diffuse) + R · reflected + T · transmitted. Conserves
    /// energy.
    #[default]
    Layer,
    /// local + R · reflected + T · transmitted, as in Haines' NFF.
    Sum,
    /// (1 − R) · local + R · reflected, as in the course; where no reflection ray is sent, local alone.
    Blend,
}

texture_indices! {
    /// The indices in [`super::Scene::textures`] of the textures of a [`Material`] besides those of its BSDF.
    Textures {
        /// The texture that multiplies [`Material::emission`].
        emission,
        /// The normal map: a picture of shading normals on triangles with u and v. Values from 0 to 1 stand for −1
        /// to 1; x points along u of the picture, y along v, z along the interpolated normal. Other surfaces
        /// have none.
        normal,
        /// The occlusion map: the fraction of ambient light that reaches the surface, in red.
        occlusion,
        /// The texture whose alpha multiplies [`Material::alpha`]. Only pictures have an alpha other than 1.
        alpha,
    }
}

impl Default for Material {
    /// A matte light grey, two-sided.
    fn default() -> Self {
        Self {
            name: String::new(),
            bsdf: Bsdf::default(),
            tint: Vec3::ONE,
            two_sided: true,
            emission: Vec3::ZERO,
            two_sided_emission: true,
            thin: false,
            priority: 0,
            textures: Textures::default(),
            normal_scale: 1.0,
            occlusion_strength: 1.0,
            coverage: Coverage::Opaque,
            alpha: 1.0,
            shadow_catcher: false,
        }
    }
}

impl From<Phong> for Material {
    fn from(phong: Phong) -> Self {
        Self {
            bsdf: phong.into(),
            ..Self::default()
        }
    }
}

impl From<MetallicRoughness> for Material {
    fn from(model: MetallicRoughness) -> Self {
        Self {
            bsdf: model.into(),
            ..Self::default()
        }
    }
}
