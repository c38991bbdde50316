//! The maps of glTF's materials: one table of their names, of what shows them and of what their pictures hold.

use super::document::{Material as Source, TextureInfo};
use crate::import::picture::Role;

/// Which pictures show a map.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum ShownBy {
    All,
    /// Path-traced ones.
    Paths,
    None,
}

macro_rules! map_kinds {
    ($($kind:ident $owner:literal $name:literal $shown_by:ident $role:ident,)*) => {
        /// A map of a material.
        #[derive(Clone, Copy, Debug, PartialEq, Eq)]
        pub(super) enum MapKind { $($kind,)* }

        impl MapKind {
            const ALL: &[Self] = &[$(Self::$kind,)*];

            /// The property of the material that has it.
            pub const fn name(self) -> &'static str {
                match self { $(Self::$kind => $name,)* }
            }

            /// Where in the material it is.
            pub const fn path(self) -> &'static str {
                match self { $(Self::$kind => concat!($owner, $name),)* }
            }

            pub const fn shown_by(self) -> ShownBy {
                match self { $(Self::$kind => ShownBy::$shown_by,)* }
            }

            /// Role of the map's picture.
            pub const fn role(self) -> Role {
                match self { $(Self::$kind => Role::$role,)* }
            }
        }
    };
}

map_kinds! {
    BaseColor "pbrMetallicRoughness." "baseColorTexture" All Color,
    MetallicRoughness "pbrMetallicRoughness." "metallicRoughnessTexture" All Data,
    Normal "" "normalTexture" All Data,
    Occlusion "" "occlusionTexture" All Data,
    Emissive "" "emissiveTexture" All Color,
    Transmission "extensions.KHR_materials_transmission." "transmissionTexture" All Data,
    Specular "extensions.KHR_materials_specular." "specularTexture" Paths Data,
    SpecularColor "extensions.KHR_materials_specular." "specularColorTexture" Paths Color,
    Clearcoat "extensions.KHR_materials_clearcoat." "clearcoatTexture" Paths Data,
    ClearcoatRoughness "extensions.KHR_materials_clearcoat." "clearcoatRoughnessTexture" Paths Data,
    ClearcoatNormal "extensions.KHR_materials_clearcoat." "clearcoatNormalTexture" Paths Data,
    SheenColor "extensions.KHR_materials_sheen." "sheenColorTexture" Paths Color,
    SheenRoughness "extensions.KHR_materials_sheen." "sheenRoughnessTexture" Paths Data,
    Anisotropy "extensions.KHR_materials_anisotropy." "anisotropyTexture" Paths Data,
    Iridescence "extensions.KHR_materials_iridescence." "iridescenceTexture" Paths Data,
    IridescenceThickness "extensions.KHR_materials_iridescence." "iridescenceThicknessTexture" Paths Data,
    DiffuseTransmission "extensions.KHR_materials_diffuse_transmission." "diffuseTransmissionTexture" Paths Data,
    DiffuseTransmissionColor "extensions.KHR_materials_diffuse_transmission." "diffuseTransmissionColorTexture" Paths Color,
    Diffuse "extensions.KHR_materials_pbrSpecularGlossiness." "diffuseTexture" All Color,
    SpecularGlossiness "extensions.KHR_materials_pbrSpecularGlossiness." "specularGlossinessTexture" None Data,
}

impl MapKind {
    /// The map with this name, if some picture shows it.
    pub fn shown(name: &str) -> Option<Self> {
        let mut all = Self::ALL.iter().copied();
        all.find(|kind| kind.name() == name && kind.shown_by() != ShownBy::None)
    }
}

/// All maps of a material.
pub(super) fn all_maps(source: &Source) -> Vec<(MapKind, &TextureInfo)> {
    let mut maps = Vec::new();
    macro_rules! list {
        ($from:expr, $($kind:ident $field:ident),*) => {
            if let Some(from) = $from {
                $(if let Some(map) = &from.$field { maps.push((MapKind::$kind, &**map)); })*
            }
        };
    }
    list!(
        source.pbr_metallic_roughness.as_ref(),
        BaseColor base_color_texture,
        MetallicRoughness metallic_roughness_texture
    );
    list!(
        Some(source),
        Normal normal_texture,
        Occlusion occlusion_texture,
        Emissive emissive_texture
    );
    let Some(extensions) = &source.extensions else {
        return maps;
    };
    list!(extensions.transmission.as_ref(), Transmission transmission_texture);
    list!(
        extensions.specular.as_ref(),
        Specular specular_texture,
        SpecularColor specular_color_texture
    );
    list!(
        extensions.clearcoat.as_ref(),
        Clearcoat clearcoat_texture,
        ClearcoatRoughness clearcoat_roughness_texture,
        ClearcoatNormal clearcoat_normal_texture
    );
    list!(
        extensions.sheen.as_ref(),
        SheenColor sheen_color_texture,
        SheenRoughness sheen_roughness_texture
    );
    list!(extensions.anisotropy.as_ref(), Anisotropy anisotropy_texture);
    list!(
        extensions.iridescence.as_ref(),
        Iridescence iridescence_texture,
        IridescenceThickness iridescence_thickness_texture
    );
    list!(
        extensions.diffuse_transmission.as_ref(),
        DiffuseTransmission diffuse_transmission_texture,
        DiffuseTransmissionColor diffuse_transmission_color_texture
    );
    list!(
        extensions.specular_glossiness.as_ref(),
        Diffuse diffuse_texture,
        SpecularGlossiness specular_glossiness_texture
    );
    maps
}
