//! From the maps of a material to its textures.

use super::Reader;
use super::aim::Aim;
use super::document::{Material as Source, TextureInfo};
use super::maps::FoundMap;
use super::materials::NORMAL_SCALE;
use super::uv_sets::Sets;
use super::values::Checked;
use crate::import::error::ImportError;
use crate::import::picture::Role;
use glam::Vec3;
use glimray_scene::{
    Coverage, LayerProperty, LayerTextures, Material, MetallicRoughness, Pattern, Space, Texture,
};

impl Reader<'_> {
    /// Whether `materials[index]`, which is `material` at rest, emits light at some time: a clip may begin with none.
    pub(super) fn can_emit(&self, index: usize, material: &Material) -> bool {
        let is_own = |aim| matches!(aim, Aim::Emission(it) | Aim::Layer(it, LayerProperty::EmissionStrength) if it == index);
        let clips = self.document.animations.iter();
        let mut channels = clips.flat_map(|clip| &clip.channels);
        material.emission != Vec3::ZERO
            || channels.any(|channel| Aim::of(&channel.target).is_some_and(is_own))
    }

    /// Gives `material`, which is `materials[index]` of the file, its maps and its BSDF, whose parameters are `model`. It emits
    /// light at some time if it `can_emit`. `sets` are its sets of texture coordinates: [`Self::sets_of`].
    pub(super) fn textured(
        &mut self,
        source: &Source,
        index: usize,
        (mut model, can_emit): (MetallicRoughness, bool),
        sets: &Sets,
        material: &mut Material,
    ) -> Result<(), ImportError> {
        let here = &format!("materials[{index}]");
        let pbr = source.pbr_metallic_roughness.as_deref();
        let extensions = source.extensions.as_deref();
        let older = extensions.and_then(|e| e.specular_glossiness.as_deref());
        let infos = [
            match older {
                Some(older) => older.diffuse_texture.as_deref(),
                None => pbr.and_then(|pbr| pbr.base_color_texture.as_deref()),
            },
            match older {
                Some(_) => None,
                None => pbr.and_then(|pbr| pbr.metallic_roughness_texture.as_deref()),
            },
            extensions
                .and_then(|e| e.transmission.as_ref())
                .and_then(|it| it.transmission_texture.as_deref()),
        ];
        let is_lit = !model.unlit;
        let layers = if is_lit {
            self.layer_textures(source, infos, sets, here)?
        } else {
            // An unlit surface shines with its colour, and has no layers.
            LayerTextures {
                base_color: match infos[0] {
                    Some(info) => self.other(info, false, sets, here)?,
                    None => None,
                },
                ..LayerTextures::default()
            }
        };
        model.textures = layers;
        material.bsdf = model.into();
        // Unlit surfaces are seen from both sides.
        material.two_sided_emission = source.double_sided == Some(true) || !can_emit;
        if source.double_sided == Some(false) && !can_emit {
            let why = "surfaces are seen from both sides";
            self.unused.of("materials", index, "doubleSided", why);
        }
        if material.has_classical_maps() && !self.traces_paths {
            self.note_means(&layers, here);
        }
        if material.coverage != Coverage::Opaque
            && let Some(info) = infos[0]
        {
            material.textures.alpha = self.other(info, false, sets, here)?;
        }
        if let Some(info) = source.emissive_texture.as_deref()
            && can_emit
        {
            material.textures.emission = self.other(info, false, sets, here)?;
        }
        if let Some(info) = source.normal_texture.as_deref()
            && is_lit
        {
            material.textures.normal = self.other(info, true, sets, here)?;
            let mut values = Checked::new(&mut self.notes, here, source.name.as_deref());
            material.normal_scale =
                values.number("normalTexture.scale", info.scale, 1.0, NORMAL_SCALE) as f32;
        }
        if let Some(info) = source.occlusion_texture.as_deref()
            && is_lit
        {
            material.textures.occlusion = self.other(info, true, sets, here)?;
            let mut values = Checked::new(&mut self.notes, here, source.name.as_deref());
            material.occlusion_strength =
                values.unit("occlusionTexture.strength", info.strength, 1.0);
        }
        Ok(())
    }

    /// Notes the maps of which classical colours have the mean, for each texel of theirs may lie elsewhere.
    fn note_means(&mut self, layers: &LayerTextures, here: &str) {
        let maps = [layers.base_color, layers.roughness, layers.transmission];
        let textures = &self.scene.textures;
        let mut maps = maps.iter().flatten().map(|index| &textures[*index]);
        let Some(lead) = maps.next() else { return };
        for _ in maps.filter(|map| !map.is_aligned(lead)) {
            self.notes.add("maps that are not shown", || {
                format!("{here}: a map with other texture coordinates than the first is shown by its mean")
            });
        }
    }

    /// The textures of the layers of a material, the first three of which are `main`.
    fn layer_textures(
        &mut self,
        source: &Source,
        main: [Option<&TextureInfo>; 3],
        sets: &Sets,
        here: &str,
    ) -> Result<LayerTextures, ImportError> {
        let mut of = |info: Option<&TextureInfo>, has_values| match info {
            Some(info) => self.other(info, has_values, sets, here),
            None => Ok(None),
        };
        macro_rules! map {
            ($extension:ident $texture:ident) => {
                (source.extensions.as_deref())
                    .and_then(|it| it.$extension.as_ref())
                    .and_then(|it| it.$texture.as_deref())
            };
        }
        let base_color = of(main[0], false)?;
        let metallic_roughness = of(main[1], true)?;
        Ok(LayerTextures {
            base_color,
            metallic: metallic_roughness,
            roughness: metallic_roughness,
            transmission: of(main[2], true)?,
            specular: of(map!(specular specular_texture), true)?,
            specular_color: of(map!(specular specular_color_texture), false)?,
            clearcoat: of(map!(clearcoat clearcoat_texture), true)?,
            clearcoat_roughness: of(map!(clearcoat clearcoat_roughness_texture), true)?,
            clearcoat_normal: of(map!(clearcoat clearcoat_normal_texture), true)?,
            sheen_color: of(map!(sheen sheen_color_texture), false)?,
            sheen_roughness: of(map!(sheen sheen_roughness_texture), true)?,
            anisotropy: of(map!(anisotropy anisotropy_texture), true)?,
            iridescence: of(map!(iridescence iridescence_texture), true)?,
            iridescence_thickness: of(map!(iridescence iridescence_thickness_texture), true)?,
            diffuse_transmission: of(
                map!(diffuse_transmission diffuse_transmission_texture),
                true,
            )?,
            diffuse_transmission_color: of(
                map!(diffuse_transmission diffuse_transmission_color_texture),
                false,
            )?,
        })
    }

    /// The texture of a map that is shown as it is, with values or colours; `None` if it cannot be, with a note by
    /// [`Self::sets_of`] if its set is a third one.
    fn other(
        &mut self,
        info: &TextureInfo,
        has_values: bool,
        sets: &Sets,
        here: &str,
    ) -> Result<Option<usize>, ImportError> {
        if let Some(Some(known)) = self.moved_maps.get(&std::ptr::from_ref(info)) {
            return Ok(Some(*known));
        }
        let Some(map) = self.map(info, here)? else {
            return Ok(None);
        };
        let role = if has_values { Role::Data } else { Role::Color };
        let Some(picture) = self.shown(map.image, role)? else {
            return Ok(None);
        };
        let Some(space) = sets.space(map.uv_set) else {
            return Ok(None);
        };
        let texture = lying(picture, &map, space);
        match self.moved_maps.get_mut(&std::ptr::from_ref(info)) {
            None => Ok(Some(self.shared(texture))),
            Some(moved) => {
                self.scene.textures.push(texture);
                *moved = Some(self.scene.textures.len() - 1);
                Ok(*moved)
            }
        }
    }

    /// Adds a texture that does not move, unless there is the same one already, and returns its index.
    fn shared(&mut self, texture: Texture) -> usize {
        let textures = &mut self.scene.textures;
        let moved = &self.moved_maps;
        // Materials of one file often share a texture; only the last few are compared.
        let recent = textures.len().saturating_sub(64);
        let is_it = |index: &usize| {
            textures[*index] == texture && !moved.values().any(|own| *own == Some(*index))
        };
        if let Some(known) = (recent..textures.len()).find(is_it) {
            return known;
        }
        textures.push(texture);
        textures.len() - 1
    }
}

/// A texture with `picture`, placed as `map` says.
fn lying(picture: usize, map: &FoundMap, space: Space) -> Texture {
    Texture {
        pattern: Pattern::Picture {
            picture,
            nearest: map.nearest,
            minify: map.minify,
            wrap: map.wrap,
        },
        space,
        pattern_from_space: map.transform.pattern_from_uv(),
    }
}
