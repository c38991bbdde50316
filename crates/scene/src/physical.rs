//! The classical material that stands for a metallic-roughness one, with its textures and vertex colours.

use super::{LayerTextures, Material, MetallicRoughness};
use glam::Vec3;
use std::sync::Arc;

impl Material {
    /// The material of `model`, without a name. Its classical colours get the texture of the base colour; textures of
    /// other parameters are for paths only.
    pub fn physical(model: Arc<MetallicRoughness>, layers: LayerTextures) -> Self {
        let mut material = model.classical(String::new());
        if layers.metallic.is_some() && !model.unlit {
            // Parts may be no metal, and let light pass.
            material.transmit = model.transmission * model.base_color;
        }
        let shown = |color: Vec3| layers.base_color.filter(|_| color != Vec3::ZERO);
        let textures = &mut material.textures;
        textures.diffuse = shown(material.diffuse);
        textures.ambient = textures.diffuse;
        textures.transmit = shown(material.transmit);
        if model.metallic == 1.0 {
            // All colours of a metal are multiples of the base colour.
            textures.specular = shown(material.specular);
            textures.reflect = shown(material.reflect);
        }
        if model.unlit {
            textures.emission = layers.base_color;
        }
        material.layer_textures = (layers != LayerTextures::default()).then(|| Box::new(layers));
        material.metallic_roughness = Some(model);
        material
    }
}
