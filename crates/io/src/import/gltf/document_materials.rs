//! The JSON of glTF's materials, with the `KHR_materials_*` extensions. Defaults are the specifications'.

use serde::Deserialize;

/// In place of an index that is required, but not there.
pub const ABSENT: usize = u32::MAX as usize;

pub fn absent() -> usize {
    ABSENT
}

#[derive(Debug, Default, Deserialize)]
#[serde(default, rename_all = "camelCase")]
pub struct Material {
    pub name: Option<String>,
    pub pbr_metallic_roughness: Option<Box<MetallicRoughness>>,
    pub normal_texture: Option<Box<TextureInfo>>,
    pub occlusion_texture: Option<Box<TextureInfo>>,
    pub emissive_texture: Option<Box<TextureInfo>>,
    pub emissive_factor: Option<[f64; 3]>,
    pub alpha_mode: AlphaMode,
    pub alpha_cutoff: Option<f64>,
    pub double_sided: Option<bool>,
    pub extensions: Option<Box<Extensions>>,
}

#[derive(Clone, Copy, Debug, Default, Deserialize, PartialEq, Eq)]
#[serde(rename_all = "UPPERCASE")]
pub enum AlphaMode {
    #[default]
    Opaque,
    Mask,
    Blend,
}

#[derive(Debug, Default, Deserialize)]
#[serde(default, rename_all = "camelCase")]
pub struct MetallicRoughness {
    pub base_color_factor: Option<[f64; 4]>,
    pub base_color_texture: Option<Box<TextureInfo>>,
    pub metallic_factor: Option<f64>,
    pub roughness_factor: Option<f64>,
    pub metallic_roughness_texture: Option<Box<TextureInfo>>,
}

#[derive(Debug, Deserialize)]
#[serde(rename_all = "camelCase")]
pub struct TextureInfo {
    #[serde(default = "absent")]
    pub index: usize,
    #[serde(default)]
    pub tex_coord: Option<u32>,
    /// Scale of normal textures.
    #[serde(default)]
    pub scale: Option<f64>,
    /// Strength of occlusion textures.
    #[serde(default)]
    pub strength: Option<f64>,
    #[serde(default)]
    pub extensions: TextureInfoExtensions,
}

#[derive(Debug, Default, Deserialize)]
#[serde(default)]
pub struct TextureInfoExtensions {
    #[serde(rename = "KHR_texture_transform")]
    pub transform: Option<Box<TextureTransform>>,
}

#[derive(Debug, Default, Deserialize)]
#[serde(default, rename_all = "camelCase")]
pub struct TextureTransform {
    pub offset: [f64; 2],
    pub rotation: f64,
    pub scale: Option<[f64; 2]>,
    pub tex_coord: Option<u32>,
}

macro_rules! extension {
    ($($(#[$note:meta])* $name:ident { $($field:ident: $type:ty,)* })*) => {
        $(
            $(#[$note])*
            #[derive(Debug, Default, Deserialize)]
            #[serde(default, rename_all = "camelCase")]
            pub struct $name { $(pub $field: Option<$type>,)* }
        )*
    };
}

type Map = Box<TextureInfo>;

extension! {
    EmissiveStrength { emissive_strength: f64, }
    Ior { ior: f64, }
    Transmission { transmission_factor: f64, transmission_texture: Map, }
    Volume {
        thickness_factor: f64,
        attenuation_distance: f64,
        attenuation_color: [f64; 3],
    }
    Specular {
        specular_factor: f64,
        specular_texture: Map,
        specular_color_factor: [f64; 3],
        specular_color_texture: Map,
    }
    Clearcoat {
        clearcoat_factor: f64,
        clearcoat_texture: Map,
        clearcoat_roughness_factor: f64,
        clearcoat_roughness_texture: Map,
        clearcoat_normal_texture: Map,
    }
    Sheen {
        sheen_color_factor: [f64; 3],
        sheen_color_texture: Map,
        sheen_roughness_factor: f64,
        sheen_roughness_texture: Map,
    }
    Anisotropy {
        anisotropy_strength: f64,
        anisotropy_rotation: f64,
        anisotropy_texture: Map,
    }
    Iridescence {
        iridescence_factor: f64,
        iridescence_texture: Map,
        iridescence_ior: f64,
        iridescence_thickness_minimum: f64,
        iridescence_thickness_maximum: f64,
        iridescence_thickness_texture: Map,
    }
    Dispersion { dispersion: f64, }
    DiffuseTransmission {
        diffuse_transmission_factor: f64,
        diffuse_transmission_texture: Map,
        diffuse_transmission_color_factor: [f64; 3],
        diffuse_transmission_color_texture: Map,
    }
    SpecularGlossiness {
        diffuse_factor: [f64; 4],
        diffuse_texture: Map,
        specular_factor: [f64; 3],
        glossiness_factor: f64,
        specular_glossiness_texture: Map,
    }
    Unlit {}
}

#[derive(Debug, Default, Deserialize)]
#[serde(default)]
pub struct Extensions {
    #[serde(rename = "KHR_materials_emissive_strength")]
    pub emissive_strength: Option<EmissiveStrength>,
    #[serde(rename = "KHR_materials_ior")]
    pub ior: Option<Ior>,
    #[serde(rename = "KHR_materials_transmission")]
    pub transmission: Option<Transmission>,
    #[serde(rename = "KHR_materials_volume")]
    pub volume: Option<Volume>,
    #[serde(rename = "KHR_materials_specular")]
    pub specular: Option<Specular>,
    #[serde(rename = "KHR_materials_clearcoat")]
    pub clearcoat: Option<Clearcoat>,
    #[serde(rename = "KHR_materials_sheen")]
    pub sheen: Option<Sheen>,
    #[serde(rename = "KHR_materials_anisotropy")]
    pub anisotropy: Option<Anisotropy>,
    #[serde(rename = "KHR_materials_iridescence")]
    pub iridescence: Option<Iridescence>,
    #[serde(rename = "KHR_materials_dispersion")]
    pub dispersion: Option<Dispersion>,
    #[serde(rename = "KHR_materials_diffuse_transmission")]
    pub diffuse_transmission: Option<DiffuseTransmission>,
    #[serde(rename = "KHR_materials_pbrSpecularGlossiness")]
    pub specular_glossiness: Option<Box<SpecularGlossiness>>,
    #[serde(rename = "KHR_materials_unlit")]
    pub unlit: Option<Unlit>,
}
