//! Packs what the path tracer sees of a material.

use crate::layout::{
    NO_TEXTURE, NONE, PackedLayers, SLOT_ANISOTROPY, SLOT_BASE, SLOT_COAT, SLOT_COAT_NORMAL,
    SLOT_COAT_ROUGHNESS, SLOT_DIFFUSE_TRANSMISSION, SLOT_DIFFUSE_TRANSMISSION_COLOR, SLOT_EMISSION,
    SLOT_F0, SLOT_F90, SLOT_FILM_THICKNESS, SLOT_IRIDESCENCE, SLOT_METALLIC,
    SLOT_METALLIC_ROUGHNESS, SLOT_REFLECT, SLOT_ROUGHNESS, SLOT_SHEEN, SLOT_SHEEN_ROUGHNESS,
    SLOT_TRANSMISSION,
};
use glam::Vec3;
use glimray_scene::{Bsdf, Material, MetallicRoughness, Phong};

/// The layers of a material. `light` is the index of the light whose surface it is.
pub fn packed(material: &Material, light: Option<usize>) -> PackedLayers {
    let layers = match &material.bsdf {
        Bsdf::MetallicRoughness(model) => of_metallic_roughness(material, model),
        Bsdf::Phong(phong) => of_phong(phong),
    };
    let slots = slots(material);
    let index = |slot: usize| slots[slot].map_or(NO_TEXTURE, |index| index as u32);
    let pair = |k: usize| index(2 * k) | index(2 * k + 1) << 16;
    let is_factor = |slot: usize| slots[slot].is_some() && slot != SLOT_COAT_NORMAL as usize;
    let used = |mask, slot: usize| mask | u32::from(is_factor(slot)) << slot;
    PackedLayers {
        light: light.map_or(NONE, |index| index as u32),
        glow: 1.0,
        slots: (0..slots.len()).fold(0, used),
        textures: [0, 1, 2, 3].map(pair),
        more_textures: [4, 5, 6, 7].map(pair),
        last_textures: [8, 9, 10, 11].map(pair),
        ..layers
    }
}

fn of_metallic_roughness(material: &Material, model: &MetallicRoughness) -> PackedLayers {
    let f0 = ((model.ior - 1.0) / (model.ior + 1.0)).powi(2);
    // An index of 0 stands for full reflection in the specular-glossiness model.
    let f0 = if model.ior == 0.0 { 1.0 } else { f0 };
    let colored = (f0 * model.specular_color).min(Vec3::ONE) * model.specular;
    PackedLayers {
        base: if model.unlit {
            Vec3::ZERO
        } else {
            material.tint * model.base_color
        }
        .into(),
        metallic: if model.unlit { 0.0 } else { model.metallic },
        f0: if model.unlit { Vec3::ZERO } else { colored }.into(),
        f90: if model.unlit { 0.0 } else { model.specular },
        roughness: model.roughness,
        // A surface that reflects everything transmits nothing.
        transmission: if model.unlit || f0 > 0.999 {
            0.0
        } else {
            model.transmission
        },
        coat: if model.unlit { 0.0 } else { model.clearcoat },
        coat_roughness: model.clearcoat_roughness,
        coat_normal_scale: model.clearcoat_normal_scale,
        sheen: model.sheen_color.into(),
        sheen_roughness: model.sheen_roughness,
        anisotropy: model.anisotropy,
        anisotropy_rotation: model.anisotropy_rotation,
        iridescence: model.iridescence,
        iridescence_ior: model.iridescence_ior,
        film_thinnest: model.iridescence_thickness[0],
        film_thickest: model.iridescence_thickness[1],
        dispersion: model.dispersion,
        diffuse_transmission: model.diffuse_transmission,
        diffuse_transmission_color: model.diffuse_transmission_color.into(),
        ior: model.ior,
        ..Default::default()
    }
}

/// Phong's lobe as microfacets. Near the mirrored direction (r·v)^s equals (n·h)^(4s), the Blinn–Phong lobe of
/// microfacets of the width 1/√(2s + 1). Seen along the normal, k_s (r·v)^s for light of irradiance π L reflects
/// 2 k_s/(s + 1) of it, so that is the reflectance of the microfacets, from all directions.
fn of_phong(phong: &Phong) -> PackedLayers {
    let width = (2.0 * phong.shininess + 1.0).sqrt().recip();
    let reflectance = 2.0 * phong.specular / (phong.shininess + 1.0);
    PackedLayers {
        base: phong.diffuse.into(),
        f0: reflectance.min(Vec3::ONE).into(),
        roughness: width.sqrt(),
        ior: phong.ior,
        ..Default::default()
    }
}

/// The textures of a material, by their slots.
fn slots(material: &Material) -> [Option<usize>; 24] {
    let mut slots = [None; 24];
    let mut set = |slot: u32, texture| slots[slot as usize] = texture;
    set(SLOT_EMISSION, material.radiance().1);
    match &material.bsdf {
        Bsdf::Phong(phong) => {
            let textures = &phong.textures;
            set(SLOT_BASE, textures.diffuse);
            set(SLOT_F0, textures.specular);
            set(SLOT_TRANSMISSION, textures.transmit);
            set(SLOT_REFLECT, textures.reflect);
        }
        Bsdf::MetallicRoughness(model) => {
            let layers = &model.textures;
            set(SLOT_BASE, layers.base_color);
            // Both are looked up at once where they have the same texture.
            if layers.metallic == layers.roughness {
                set(SLOT_METALLIC_ROUGHNESS, layers.roughness);
            } else {
                set(SLOT_METALLIC, layers.metallic);
                set(SLOT_ROUGHNESS, layers.roughness);
            }
            set(SLOT_TRANSMISSION, layers.transmission);
            set(SLOT_F0, layers.specular_color);
            set(SLOT_F90, layers.specular);
            set(SLOT_COAT, layers.clearcoat);
            set(SLOT_COAT_ROUGHNESS, layers.clearcoat_roughness);
            set(SLOT_COAT_NORMAL, layers.clearcoat_normal);
            set(SLOT_SHEEN, layers.sheen_color);
            set(SLOT_SHEEN_ROUGHNESS, layers.sheen_roughness);
            set(SLOT_ANISOTROPY, layers.anisotropy);
            set(SLOT_IRIDESCENCE, layers.iridescence);
            set(SLOT_FILM_THICKNESS, layers.iridescence_thickness);
            set(SLOT_DIFFUSE_TRANSMISSION, layers.diffuse_transmission);
            set(
                SLOT_DIFFUSE_TRANSMISSION_COLOR,
                layers.diffuse_transmission_color,
            );
        }
    }
    slots
}
