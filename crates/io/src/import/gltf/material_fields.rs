//! The properties of glTF's materials, with the `KHR_materials_*` extensions.

use super::field_forms::Form::*;
use super::field_forms::Use::{Read, Unused};
use super::field_forms::{Form, Object, objects};

const ALPHA_MODES: Form = Word(&["OPAQUE", "MASK", "BLEND"]);

objects! {
    extensions NO_EXTENSIONS {}
    object MATERIAL {
        name: Text;
        pbrMetallicRoughness: One(&METALLIC_ROUGHNESS);
        normalTexture: One(&NORMAL_MAP);
        occlusionTexture: One(&OCCLUSION_MAP);
        emissiveTexture: One(&MAP);
        emissiveFactor: Numbers(3);
        alphaMode: ALPHA_MODES;
        alphaCutoff: Number;
        doubleSided: Flag;
        extensions: One(&MATERIAL_EXTENSIONS);
    }
    object METALLIC_ROUGHNESS {
        baseColorFactor: Numbers(4);
        baseColorTexture: One(&MAP);
        metallicFactor: Number;
        roughnessFactor: Number;
        metallicRoughnessTexture: One(&MAP);
        extensions: One(&NO_EXTENSIONS);
    }
    object MAP {
        index: Whole;
        texCoord: Whole;
        extensions: One(&MAP_EXTENSIONS);
    }
    object NORMAL_MAP {
        index: Whole;
        texCoord: Whole;
        scale: Number;
        extensions: One(&MAP_EXTENSIONS);
    }
    object OCCLUSION_MAP {
        index: Whole;
        texCoord: Whole;
        strength: Number;
        extensions: One(&MAP_EXTENSIONS);
    }
    extensions MAP_EXTENSIONS {
        KHR_texture_transform: One(&TRANSFORM);
    }
    object TRANSFORM {
        offset: Numbers(2);
        rotation: Number;
        scale: Numbers(2);
        texCoord: Whole;
    }
    extensions MATERIAL_EXTENSIONS {
        KHR_materials_emissive_strength: One(&EMISSIVE_STRENGTH);
        KHR_materials_ior: One(&IOR);
        KHR_materials_transmission: One(&TRANSMISSION);
        KHR_materials_volume: One(&VOLUME);
        KHR_materials_specular: One(&SPECULAR);
        KHR_materials_clearcoat: One(&CLEARCOAT);
        KHR_materials_sheen: One(&SHEEN);
        KHR_materials_anisotropy: One(&ANISOTROPY);
        KHR_materials_iridescence: One(&IRIDESCENCE);
        KHR_materials_dispersion: One(&DISPERSION);
        KHR_materials_diffuse_transmission: One(&DIFFUSE_TRANSMISSION);
        KHR_materials_pbrSpecularGlossiness: One(&SPECULAR_GLOSSINESS);
        KHR_materials_unlit: One(&UNLIT);
    }
    object EMISSIVE_STRENGTH { emissiveStrength: Number; }
    object IOR { ior: Number; }
    object TRANSMISSION { transmissionFactor: Number; transmissionTexture: One(&MAP); }
    object VOLUME {
        thicknessFactor: Number;
        thicknessTexture: One(&MAP), Unused("a volume is as thick as its mesh");
        attenuationDistance: Number;
        attenuationColor: Numbers(3);
    }
    object SPECULAR {
        specularFactor: Number;
        specularTexture: One(&MAP);
        specularColorFactor: Numbers(3);
        specularColorTexture: One(&MAP);
    }
    object CLEARCOAT {
        clearcoatFactor: Number;
        clearcoatTexture: One(&MAP);
        clearcoatRoughnessFactor: Number;
        clearcoatRoughnessTexture: One(&MAP);
        clearcoatNormalTexture: One(&NORMAL_MAP);
    }
    object SHEEN {
        sheenColorFactor: Numbers(3);
        sheenColorTexture: One(&MAP);
        sheenRoughnessFactor: Number;
        sheenRoughnessTexture: One(&MAP);
    }
    object ANISOTROPY {
        anisotropyStrength: Number;
        anisotropyRotation: Number;
        anisotropyTexture: One(&MAP);
    }
    object IRIDESCENCE {
        iridescenceFactor: Number;
        iridescenceTexture: One(&MAP);
        iridescenceIor: Number;
        iridescenceThicknessMinimum: Number;
        iridescenceThicknessMaximum: Number;
        iridescenceThicknessTexture: One(&MAP);
    }
    object DISPERSION { dispersion: Number; }
    object DIFFUSE_TRANSMISSION {
        diffuseTransmissionFactor: Number;
        diffuseTransmissionTexture: One(&MAP);
        diffuseTransmissionColorFactor: Numbers(3);
        diffuseTransmissionColorTexture: One(&MAP);
    }
    object SPECULAR_GLOSSINESS {
        diffuseFactor: Numbers(4);
        diffuseTexture: One(&MAP);
        specularFactor: Numbers(3);
        glossinessFactor: Number;
        specularGlossinessTexture: One(&MAP);
    }
    object UNLIT {}
}
