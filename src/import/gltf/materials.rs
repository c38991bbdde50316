//! Materials: from the file to [`MetallicRoughness`], and from there with their pictures to the
//! classical materials of the scene.

use super::Reader;
use super::document::{Material as Source, Primitive};
use super::document_materials::{AlphaMode, Extensions};
use super::map_kinds::{ShownBy, all_maps};
use crate::import::budget;
use crate::import::error::ImportError;
use crate::scene::{Coverage, LayerTextures, Material, MetallicRoughness};
use glam::{Vec3, Vec4};
use std::collections::HashSet;
use std::sync::Arc;

/// Number of different vertex colours of a primitive from which they are rounded to 32 levels per channel.
const MANY_COLORS: usize = 8192;

/// The material of a primitive: its number in the file, `None` for glTF's default material.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(super) struct MaterialKey(pub Option<usize>);

/// A material with its pictures, before vertex colours.
pub(super) struct Surface {
    pub material: Material,
    /// The sets of texture coordinates that its pictures use, at most two.
    pub uv_sets: Vec<u32>,
}

impl Reader<'_> {
    /// The material of a primitive, in the chosen variant.
    pub(super) fn material_of(
        &mut self,
        primitive: &Primitive,
        here: &str,
    ) -> Result<MaterialKey, ImportError> {
        let index = self.material_index(primitive);
        let key = MaterialKey(index);
        if !self.surfaces.contains_key(&key) {
            let surface = match index {
                None => Surface {
                    material: Material::physical(Arc::default(), LayerTextures::default()),
                    uv_sets: Vec::new(),
                },
                Some(index) => {
                    let materials = &self.document.materials;
                    let source = self.blame.get(materials, index, "materials", here)?;
                    self.surface(source, index)?
                }
            };
            self.surfaces.insert(key, surface);
        }
        Ok(key)
    }

    /// The number of a primitive's material in the chosen variant.
    pub(super) fn material_index(&self, primitive: &Primitive) -> Option<usize> {
        let variants = (primitive.extensions.as_ref()).and_then(|e| e.variants.as_ref());
        if let (Some(variants), Some(variant)) = (variants, self.variant) {
            let mut mappings = variants.mappings.iter();
            if let Some(mapping) = mappings.find(|mapping| mapping.variants.contains(&variant)) {
                return Some(mapping.material);
            }
        }
        primitive.material
    }

    /// The sets of texture coordinates that a material needs, which [`Self::material_of`] returned: those of the mesh's
    /// first and second set.
    pub(super) fn uv_sets(&self, key: &MaterialKey) -> Vec<u32> {
        (self.surfaces.get(key)).map_or_else(Vec::new, |surface| surface.uv_sets.clone())
    }

    /// Whether surfaces of a material, which [`Self::material_of`] returned, show their tangents.
    pub(super) fn has_tangents(&self, key: &MaterialKey) -> bool {
        let material = self.surfaces.get(key).map(|surface| &surface.material);
        material.is_some_and(Material::has_tangents)
    }

    /// Adds a material for each of `count` vertices to `materials`: those of `key`, multiplied with
    /// `colors` if there are any.
    pub(super) fn paint(
        &mut self,
        materials: &mut Vec<u32>,
        count: usize,
        colors: &[Vec4],
        key: MaterialKey,
    ) -> Result<(), ImportError> {
        if colors.is_empty() {
            let index = self.painted(key, None)?;
            materials.extend(std::iter::repeat_n(index, count));
            return Ok(());
        }
        let fine: HashSet<u32> = colors
            .iter()
            .map(|c| code(*c, 255.0))
            .take(100 * MANY_COLORS)
            .collect();
        let levels = if fine.len() > MANY_COLORS {
            31.0
        } else {
            255.0
        };
        // Neighbours often have the same colour.
        let mut last = None;
        for color in colors {
            let code = code(*color, levels);
            let index = match last {
                Some((known, index)) if known == code => index,
                _ => self.painted(key, Some((code, levels)))?,
            };
            last = Some((code, index));
            materials.push(index);
        }
        Ok(())
    }

    /// The index in the scene of a material, multiplied with a colour if one is given by its code.
    fn painted(&mut self, key: MaterialKey, color: Option<(u32, f32)>) -> Result<u32, ImportError> {
        let place = (key, color.map(|(code, levels)| (code, levels as u32)));
        if let Some(&known) = self.materials.get(&place) {
            return Ok(known);
        }
        let Some(surface) = self.surfaces.get(&key) else {
            return Ok(0);
        };
        let mut material = surface.material.clone();
        if let Some((code, levels)) = color {
            let [r, g, b, _] = code.to_le_bytes().map(|c| (f32::from(c) / levels).powi(2));
            material.paint(Vec3::new(r, g, b));
        }
        let size = budget::size::<(Material, [u64; 4])>(1) + material.name.len() as u64;
        self.ledger.take(size, 0, "materials")?;
        let index = self.scene.materials.len() as u32;
        self.scene.materials.push(material);
        self.materials.insert(place, index);
        Ok(index)
    }

    /// `materials[index]`, which is `source`, with its pictures.
    fn surface(&mut self, source: &Source, index: usize) -> Result<Surface, ImportError> {
        let model = model(source);
        let here = format!("materials[{index}]");
        self.note_maps(source, &here)?;
        let is_anisotropic = model.anisotropy > 0.0;
        let sets = self.sets_of(source, index, &model)?;
        let mut material = self.textured(source, index, model, &sets)?;
        material.name = source.name.clone().unwrap_or_default();
        let mut uv_sets = sets.into_slots();
        if is_anisotropic && uv_sets.is_empty() {
            // They give the direction of tangents.
            uv_sets.push(0);
        }
        let size = budget::size::<(Surface, MetallicRoughness)>(1);
        self.ledger.take(size, 0, &here)?;
        Ok(Surface { material, uv_sets })
    }

    /// Notes the maps of a material that are not shown.
    fn note_maps(&mut self, source: &Source, here: &str) -> Result<(), ImportError> {
        for (kind, info) in all_maps(source) {
            let place = format!("{here}.{}", kind.name());
            if self.map(info, &place)?.is_none() {
                continue;
            }
            let what = match kind.shown_by() {
                ShownBy::All => continue,
                ShownBy::Paths if self.traces_paths => continue,
                ShownBy::Paths => "is shown by path tracing only",
                ShownBy::None => "is not shown",
            };
            self.notes
                .add("maps that are not shown", || format!("{place} {what}"));
        }
        Ok(())
    }
}

/// The code of a vertex colour with `levels` + 1 levels per channel. They are spaced like squares, which is
/// near to how differences are seen.
fn code(color: Vec4, levels: f32) -> u32 {
    let channel = |x: f32| {
        let x = if x > 0.0 { x.min(1.0) } else { 0.0 };
        (x.sqrt() * levels).round() as u8
    };
    u32::from_le_bytes([channel(color.x), channel(color.y), channel(color.z), 0])
}

/// A number in 0..=1.
fn unit(value: Option<f64>, default: f64) -> f32 {
    value.unwrap_or(default).clamp(0.0, 1.0) as f32
}

/// A number in `least`..=1e12.
fn amount(value: Option<f64>, default: f64, least: f64) -> f32 {
    value.unwrap_or(default).clamp(least, 1e12) as f32
}

/// A colour in 0..=1.
fn unit_color(value: Option<[f64; 3]>, default: Vec3) -> Vec3 {
    value.map_or(default, |c| Vec3::from(c.map(|x| unit(Some(x), 0.0))))
}

/// The parameters of a material.
fn model(source: &Source) -> MetallicRoughness {
    let none = Extensions::default();
    let extensions = source.extensions.as_deref().unwrap_or(&none);
    let mut model = MetallicRoughness::default();
    if let Some(pbr) = &source.pbr_metallic_roughness {
        let [r, g, b, a] = pbr.base_color_factor.unwrap_or([1.0; 4]);
        model.base_color = unit_color(Some([r, g, b]), Vec3::ONE);
        model.alpha = unit(Some(a), 1.0);
        model.metallic = unit(pbr.metallic_factor, 1.0);
        model.roughness = unit(pbr.roughness_factor, 1.0);
    }
    if let Some(older) = &extensions.specular_glossiness {
        let [r, g, b, a] = older.diffuse_factor.unwrap_or([1.0; 4]);
        model.base_color = unit_color(Some([r, g, b]), Vec3::ONE);
        model.alpha = unit(Some(a), 1.0);
        model.metallic = 0.0;
        model.roughness = 1.0 - unit(older.glossiness_factor, 1.0);
        // F₀ of the default index of refraction is 0.04.
        model.specular_color = unit_color(older.specular_factor, Vec3::ONE) / 0.04;
    }
    model.coverage = match source.alpha_mode {
        AlphaMode::Opaque => Coverage::Opaque,
        AlphaMode::Mask => Coverage::Mask(unit(source.alpha_cutoff, 0.5)),
        AlphaMode::Blend => Coverage::Blend,
    };
    if model.coverage == Coverage::Opaque {
        model.alpha = 1.0;
    }
    model.unlit = extensions.unlit.is_some();
    let strength = extensions.emissive_strength.as_ref();
    let strength = amount(strength.and_then(|it| it.emissive_strength), 1.0, 0.0);
    if !model.unlit {
        model.emission = strength * unit_color(source.emissive_factor, Vec3::ZERO);
    }
    if let Some(it) = &extensions.ior {
        // 0 means that reflection is total, for materials converted from others.
        model.ior = match it.ior {
            Some(0.0) => 1e6,
            value => amount(value, 1.5, 1.0),
        };
    }
    if let Some(it) = &extensions.specular {
        model.specular = unit(it.specular_factor, 1.0);
        let color = it.specular_color_factor.unwrap_or([1.0; 3]);
        model.specular_color = Vec3::from(color.map(|x| amount(Some(x), 1.0, 0.0)));
    }
    if let Some(it) = &extensions.transmission {
        model.transmission = unit(it.transmission_factor, 0.0);
    }
    if let Some(it) = &extensions.volume {
        model.thickness = amount(it.thickness_factor, 0.0, 0.0);
        model.attenuation_color = unit_color(it.attenuation_color, Vec3::ONE);
        let distance = it.attenuation_distance.filter(|distance| *distance > 0.0);
        model.attenuation_distance = distance.map_or(f32::INFINITY, |d| amount(Some(d), d, 1e-9));
    }
    if let Some(it) = &extensions.clearcoat {
        model.clearcoat = unit(it.clearcoat_factor, 0.0);
        model.clearcoat_roughness = unit(it.clearcoat_roughness_factor, 0.0);
        let scale = it
            .clearcoat_normal_texture
            .as_ref()
            .and_then(|map| map.scale);
        model.clearcoat_normal_scale = scale.unwrap_or(1.0).clamp(0.0, 1e3) as f32;
    }
    if let Some(it) = &extensions.sheen {
        model.sheen_color = unit_color(it.sheen_color_factor, Vec3::ZERO);
        model.sheen_roughness = unit(it.sheen_roughness_factor, 0.0);
    }
    if let Some(it) = &extensions.anisotropy {
        model.anisotropy = unit(it.anisotropy_strength, 0.0);
        model.anisotropy_rotation = amount(it.anisotropy_rotation, 0.0, -1e12);
    }
    if let Some(it) = &extensions.iridescence {
        model.iridescence = unit(it.iridescence_factor, 0.0);
        model.iridescence_ior = amount(it.iridescence_ior, 1.3, 1.0);
        model.iridescence_thickness = [
            amount(it.iridescence_thickness_minimum, 100.0, 0.0),
            amount(it.iridescence_thickness_maximum, 400.0, 0.0),
        ];
    }
    if let Some(it) = &extensions.dispersion {
        model.dispersion = amount(it.dispersion, 0.0, 0.0);
    }
    if let Some(it) = &extensions.diffuse_transmission {
        model.diffuse_transmission = unit(it.diffuse_transmission_factor, 0.0);
        model.diffuse_transmission_color =
            unit_color(it.diffuse_transmission_color_factor, Vec3::ONE);
    }
    model
}
