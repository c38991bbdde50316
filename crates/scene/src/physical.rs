//! The classical look of a metallic-roughness BSDF, with its textures and the tint of its material.

use super::{Bsdf, Material, MetallicRoughness, Phong};
use glam::Vec3;
use std::borrow::Cow;
use std::sync::Arc;

impl MetallicRoughness {
    /// Phong's coefficients that the classical integrators show for these parameters, under a factor on the base colour. The
    /// colours get the texture of the base colour; textures of other parameters are for paths only.
    pub fn derived_phong(&self, tint: Vec3) -> Phong {
        let mut phong = self.phong_without_maps();
        let layers = &self.textures;
        if layers.metallic.is_some() && !self.unlit {
            // Parts may be no metal, and let light pass.
            phong.transmit = self.transmission * self.base_color;
        }
        let shown = |color: Vec3| layers.base_color.filter(|_| color != Vec3::ZERO);
        let textures = &mut phong.textures;
        textures.diffuse = shown(phong.diffuse);
        textures.ambient = textures.diffuse;
        textures.transmit = shown(phong.transmit);
        if self.metallic == 1.0 {
            // All colours of a metal are multiples of the base colour.
            textures.specular = shown(phong.specular);
            textures.reflect = shown(phong.reflect);
        }
        self.paint(&mut phong, tint);
        phong
    }

    /// Multiplies the multiples of the base colour among classical coefficients.
    pub(super) fn paint(&self, phong: &mut Phong, tint: Vec3) {
        let parts = self.colored_parts();
        phong.diffuse *= tint;
        phong.ambient *= tint;
        if parts.mirror {
            phong.specular *= tint;
            phong.reflect *= tint;
        }
        if parts.glass {
            phong.transmit *= tint;
        }
    }
}

impl Material {
    /// Phong's coefficients that the classical integrators show: those of a Phong BSDF, and for another one those that a file
    /// gives or that are derived from its parameters.
    pub fn classical(&self) -> Cow<'_, Phong> {
        match &self.bsdf {
            Bsdf::Phong(phong) => Cow::Borrowed(phong),
            Bsdf::MetallicRoughness(model) => match &model.phong {
                Some(own) => Cow::Borrowed(own),
                None => Cow::Owned(model.derived_phong(self.tint)),
            },
        }
    }

    /// Access to the coefficients of [`Self::classical`], which are not derived from other parameters afterwards.
    pub fn classical_mut(&mut self) -> &mut Phong {
        match &mut self.bsdf {
            Bsdf::Phong(phong) => phong,
            Bsdf::MetallicRoughness(model) => {
                let derived = match model.phong {
                    Some(_) => None,
                    None => Some(Box::new(model.derived_phong(self.tint))),
                };
                let model = Arc::make_mut(model);
                model
                    .phong
                    .get_or_insert_with(|| derived.unwrap_or_default())
            }
        }
    }

    /// Makes `phong` the result of [`Self::classical`], which stays derived if that is the same.
    pub fn set_classical(&mut self, phong: Phong) {
        match &mut self.bsdf {
            Bsdf::Phong(own) => *own = phong,
            Bsdf::MetallicRoughness(model) => {
                let differs = phong != model.derived_phong(self.tint);
                Arc::make_mut(model).phong = differs.then(|| Box::new(phong));
            }
        }
    }
}
