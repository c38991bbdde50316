//! Materials: from the file to [`MetallicRoughness`], and from there with their pictures to the
//! classical materials of the scene.

use super::Reader;
use super::document::{Material as Source, Primitive};
use super::document_materials::{AlphaMode, Extensions};
use super::map_kinds::{ShownBy, all_maps};
use super::values::{Checked, MOST};
use crate::import::error::ImportError;
use crate::import::{budget, range};
use glam::{DVec3, Vec3};
use glimray_scene::{Coverage, Material, MetallicRoughness};

/// Least and most of the factor on the slopes of normal maps.
pub(super) const NORMAL_SCALE: [f64; 2] = [0.0, 1e3];

/// The material of a primitive: its number in the file, `None` for glTF's default material.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(super) struct MaterialKey(pub Option<usize>);

/// A material with its pictures.
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
        let mut index = self.material_index(primitive);
        if let Some(number) = index {
            let found = self
                .blame
                .get(&self.document.materials, number, "materials", here);
            if self.spared(found.map(|_| ()))?.is_none() {
                index = None;
            }
        }
        let key = MaterialKey(index);
        if !self.surfaces.contains_key(&key) {
            let surface = match index {
                None => Surface {
                    material: MetallicRoughness::default().into(),
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

    /// Whether alpha counts for a material, which [`Self::material_of`] returned.
    pub(super) fn has_alpha(&self, key: &MaterialKey) -> bool {
        let material = self.surfaces.get(key).map(|surface| &surface.material);
        material.is_some_and(|material| material.coverage != Coverage::Opaque)
    }

    /// The index in the scene of a material, which [`Self::material_of`] returned.
    pub(super) fn scene_material(&mut self, key: MaterialKey) -> Result<u32, ImportError> {
        if let Some(&known) = self.materials.get(&key) {
            return Ok(known);
        }
        let Some(surface) = self.surfaces.get(&key) else {
            return Ok(0);
        };
        let material = surface.material.clone();
        let size = budget::size::<(Material, [u64; 4])>(1) + material.name.len() as u64;
        self.ledger.take(size, 0, "materials")?;
        let index = self.scene.materials.len() as u32;
        self.scene.materials.push(material);
        self.materials.insert(key, index);
        Ok(index)
    }

    /// `materials[index]`, which is `source`, with its pictures.
    fn surface(&mut self, source: &Source, index: usize) -> Result<Surface, ImportError> {
        let here = format!("materials[{index}]");
        let mut values = Checked::new(&mut self.notes, &here, source.name.as_deref());
        let (model, mut material) = parameters(source, &mut values);
        self.note_maps(source, &here)?;
        let is_anisotropic = model.anisotropy > 0.0;
        let can_emit = !model.unlit && self.can_emit(index, &material);
        let sets = self.sets_of(source, index, &model, can_emit)?;
        self.textured(source, index, (model, can_emit), &sets, &mut material)?;
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
            let mut place = format!("{here}.{}", kind.name());
            if self.map(info, &place)?.is_none() {
                continue;
            }
            let what = match kind.shown_by() {
                ShownBy::All => continue,
                ShownBy::Paths if self.traces_paths => continue,
                ShownBy::Paths => "is shown by path tracing only",
                ShownBy::None => {
                    place = format!("{here}.{}", kind.path());
                    "is not shown"
                }
            };
            self.notes
                .add("maps that are not shown", || format!("{place} {what}"));
        }
        Ok(())
    }
}

/// The parameters of a material: those of its BSDF, and a material with the others.
fn parameters(source: &Source, values: &mut Checked) -> (MetallicRoughness, Material) {
    let none = Extensions::default();
    let extensions = source.extensions.as_deref().unwrap_or(&none);
    let mut material = Material::default();
    let mut model = MetallicRoughness::default();
    if let Some(pbr) = &source.pbr_metallic_roughness {
        let color = pbr.base_color_factor.unwrap_or([1.0; 4]);
        let [r, g, b, a] = values.numbers("baseColorFactor", color, [0.0, 1.0]);
        model.base_color = DVec3::new(r, g, b).as_vec3();
        material.alpha = a as f32;
        model.metallic = values.unit("metallicFactor", pbr.metallic_factor, 1.0);
        model.roughness = values.unit("roughnessFactor", pbr.roughness_factor, 1.0);
    }
    if let Some(older) = &extensions.specular_glossiness {
        let color = older.diffuse_factor.unwrap_or([1.0; 4]);
        let [r, g, b, a] = values.numbers("diffuseFactor", color, [0.0, 1.0]);
        model.base_color = DVec3::new(r, g, b).as_vec3();
        material.alpha = a as f32;
        model.metallic = 0.0;
        model.roughness = 1.0 - values.unit("glossinessFactor", older.glossiness_factor, 1.0);
        // F₀ of the default index of refraction is 0.04.
        let specular = values.unit_color("specularFactor", older.specular_factor, Vec3::ONE);
        model.specular_color = specular / 0.04;
    }
    material.coverage = match source.alpha_mode {
        AlphaMode::Opaque => Coverage::Opaque,
        AlphaMode::Mask => Coverage::Mask(values.unit("alphaCutoff", source.alpha_cutoff, 0.5)),
        AlphaMode::Blend => Coverage::Blend,
    };
    if material.coverage == Coverage::Opaque {
        material.alpha = 1.0;
    }
    model.unlit = extensions.unlit.is_some();
    if !model.unlit {
        let strength = extensions.emissive_strength.as_ref();
        let strength = strength.and_then(|it| it.emissive_strength);
        let strength = values.amount("emissiveStrength", strength, 1.0, 0.0);
        let color = values.unit_color("emissiveFactor", source.emissive_factor, Vec3::ZERO);
        material.emission = strength * color;
    }
    if let Some(it) = &extensions.ior {
        let most = f64::from(range::IOR.1);
        // 0 means that reflection is total, for materials converted from others.
        model.ior = match it.ior {
            Some(0.0) => range::IOR.1,
            value => values.number("ior", value, 1.5, [1.0, most]) as f32,
        };
    }
    if let Some(it) = &extensions.specular {
        model.specular = values.unit("specularFactor", it.specular_factor, 1.0);
        let color = it.specular_color_factor.unwrap_or([1.0; 3]);
        let color = values.numbers("specularColorFactor", color, [0.0, MOST]);
        model.specular_color = DVec3::from(color).as_vec3();
    }
    if let Some(it) = &extensions.transmission {
        model.transmission = values.unit("transmissionFactor", it.transmission_factor, 0.0);
    }
    if let Some(it) = &extensions.volume {
        model.thickness = values.amount("thicknessFactor", it.thickness_factor, 0.0, 0.0);
        let color = it.attenuation_color;
        model.attenuation_color = values.unit_color("attenuationColor", color, Vec3::ONE);
        model.attenuation_distance = attenuation_distance(it.attenuation_distance, values);
    }
    if let Some(it) = &extensions.clearcoat {
        model.clearcoat = values.unit("clearcoatFactor", it.clearcoat_factor, 0.0);
        let roughness = it.clearcoat_roughness_factor;
        model.clearcoat_roughness = values.unit("clearcoatRoughnessFactor", roughness, 0.0);
        let map = it.clearcoat_normal_texture.as_ref();
        let scale = map.and_then(|map| map.scale);
        model.clearcoat_normal_scale =
            values.number("clearcoatNormalTexture.scale", scale, 1.0, NORMAL_SCALE) as f32;
    }
    if let Some(it) = &extensions.sheen {
        model.sheen_color =
            values.unit_color("sheenColorFactor", it.sheen_color_factor, Vec3::ZERO);
        let roughness = it.sheen_roughness_factor;
        model.sheen_roughness = values.unit("sheenRoughnessFactor", roughness, 0.0);
    }
    if let Some(it) = &extensions.anisotropy {
        model.anisotropy = values.unit("anisotropyStrength", it.anisotropy_strength, 0.0);
        let rotation = it.anisotropy_rotation;
        model.anisotropy_rotation = values.amount("anisotropyRotation", rotation, 0.0, -MOST);
    }
    if let Some(it) = &extensions.iridescence {
        model.iridescence = values.unit("iridescenceFactor", it.iridescence_factor, 0.0);
        let indices = [1.0, f64::from(range::FILM_IOR)];
        model.iridescence_ior =
            values.number("iridescenceIor", it.iridescence_ior, 1.3, indices) as f32;
        let nanometres = [0.0, f64::from(range::FILM_THICKNESS)];
        let mut thickness =
            |key, value, default| values.number(key, value, default, nanometres) as f32;
        let (least, most) = (
            it.iridescence_thickness_minimum,
            it.iridescence_thickness_maximum,
        );
        let least = thickness("iridescenceThicknessMinimum", least, 100.0);
        let most = thickness("iridescenceThicknessMaximum", most, 400.0);
        model.iridescence_thickness = match it.iridescence_thickness_texture {
            Some(_) => [least, most],
            // Only the latter counts.
            None => [least.min(most), most],
        };
    }
    if let Some(it) = &extensions.dispersion {
        let most = f64::from(range::DISPERSION);
        model.dispersion = values.number("dispersion", it.dispersion, 0.0, [0.0, most]) as f32;
    }
    if let Some(it) = &extensions.diffuse_transmission {
        let factor = it.diffuse_transmission_factor;
        model.diffuse_transmission = values.unit("diffuseTransmissionFactor", factor, 0.0);
        let color = it.diffuse_transmission_color_factor;
        model.diffuse_transmission_color =
            values.unit_color("diffuseTransmissionColorFactor", color, Vec3::ONE);
    }
    (model, material)
}

/// The distance after which light in a volume has its attenuation colour.
fn attenuation_distance(value: Option<f64>, values: &mut Checked) -> f32 {
    const KEY: &str = "attenuationDistance";
    match value {
        None => f32::INFINITY,
        Some(distance) if distance > 0.0 => values.amount(KEY, value, distance, 1e-9),
        Some(distance) => {
            values.repaired(KEY, &[distance], "it must be above 0", "no attenuation");
            f32::INFINITY
        }
    }
}
