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
    ($($kind:ident $name:literal $shown_by:ident $role:ident,)*) => {
        /// A map of a material.
        #[derive(Clone, Copy, Debug, PartialEq, Eq)]
        pub(super) enum MapKind { $($kind,)* }

        impl MapKind {
            const ALL: &[Self] = &[$(Self::$kind,)*];

            /// The property of the material that has it.
            pub const fn name(self) -> &'static str {
                match self { $(Self::$kind => $name,)* }
            }

            pub const fn shown_by(self) -> ShownBy {
                match self { $(Self::$kind => ShownBy::$shown_by,)* }
            }

            /// What its picture holds.
            pub const fn role(self) -> Role {
                match self { $(Self::$kind => Role::$role,)* }
            }
        }
    };
}

map_kinds! {
    BaseColor "baseColorTexture" All Color,
    MetallicRoughness "metallicRoughnessTexture" All Data,
    Normal "normalTexture" All Data,
    Occlusion "occlusionTexture" All Data,
    Emissive "emissiveTexture" All Color,
    Transmission "transmissionTexture" All Data,
    // A volume has one thickness, whatever its map.
    Thickness "thicknessTexture" All Data,
    Specular "specularTexture" Paths Data,
    SpecularColor "specularColorTexture" Paths Color,
    Clearcoat "clearcoatTexture" Paths Data,
    ClearcoatRoughness "clearcoatRoughnessTexture" Paths Data,
    ClearcoatNormal "clearcoatNormalTexture" Paths Data,
    SheenColor "sheenColorTexture" Paths Color,
    SheenRoughness "sheenRoughnessTexture" Paths Data,
    Anisotropy "anisotropyTexture" Paths Data,
    Iridescence "iridescenceTexture" Paths Data,
    IridescenceThickness "iridescenceThicknessTexture" Paths Data,
    DiffuseTransmission "diffuseTransmissionTexture" Paths Data,
    DiffuseTransmissionColor "diffuseTransmissionColorTexture" Paths Color,
    Diffuse "diffuseTexture" All Color,
    SpecularGlossiness "specularGlossinessTexture" None Data,
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
    list!(extensions.volume.as_ref(), Thickness thickness_texture);
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
