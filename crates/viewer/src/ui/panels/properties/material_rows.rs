//! Rows of parts of a material.

use crate::ui::panels::properties::fields::{Fields, Limits};
use glam::Vec3;
use glimray_scene::{Bsdf, Material, MetallicRoughness, Phong, Scene, Target};

/// A part of a material that rows edit.
pub trait Part: Clone {
    /// The part; `None` if the material is of another kind.
    fn of(material: &mut Material) -> Option<&mut Self>;

    /// The part, to be read.
    fn of_shared(material: &Material) -> Option<&Self>;
}

impl Part for Material {
    fn of(material: &mut Material) -> Option<&mut Self> {
        Some(material)
    }

    fn of_shared(material: &Material) -> Option<&Self> {
        Some(material)
    }
}

impl Part for Phong {
    fn of(material: &mut Material) -> Option<&mut Self> {
        match &mut material.bsdf {
            Bsdf::Phong(phong) => Some(phong),
            Bsdf::MetallicRoughness(_) => None,
        }
    }

    fn of_shared(material: &Material) -> Option<&Self> {
        match &material.bsdf {
            Bsdf::Phong(phong) => Some(phong),
            Bsdf::MetallicRoughness(_) => None,
        }
    }
}

impl Part for MetallicRoughness {
    fn of(material: &mut Material) -> Option<&mut Self> {
        material.metallic_roughness_mut()
    }

    fn of_shared(material: &Material) -> Option<&Self> {
        material.metallic_roughness()
    }
}

/// A change of a part of a material.
pub fn with<P: Part, T>(index: usize, change: fn(&mut P, T)) -> impl FnOnce(&mut Scene, T) {
    edit(index, change)
}

/// A change of a part of a material, after which surfaces have the tangents that they need.
pub fn edit<P: Part, T>(
    index: usize,
    change: impl FnOnce(&mut P, T),
) -> impl FnOnce(&mut Scene, T) {
    move |scene, to| {
        let material = &mut scene.materials[index];
        let had_tangents = material.has_tangents();
        if let Some(part) = P::of(material) {
            change(part, to);
        }
        if !had_tangents && material.has_tangents() {
            scene.complete_tangents();
        }
    }
}

/// A row with a colour of a part of a material, which a track of `target` may animate.
pub fn color<P: Part + 'static>(
    fields: &mut Fields,
    index: usize,
    label: (&'static str, &str),
    target: Option<Target>,
    slot: fn(&mut P) -> &mut Vec3,
) {
    color_up_to(fields, Vec3::INFINITY, index, label, target, slot);
}

/// As [`color`], of channels up to those of `most`.
pub fn color_up_to<P: Part + 'static>(
    fields: &mut Fields,
    most: Vec3,
    index: usize,
    label: (&'static str, &str),
    target: Option<Target>,
    slot: fn(&mut P) -> &mut Vec3,
) {
    if let Some(part) = &mut P::of_shared(&fields.scene.materials[index]).cloned() {
        let set = edit(index, move |part, to: Vec3| *slot(part) = to.min(most));
        fields
            .may_be_driven_by(target)
            .color(label, *slot(part), set);
    }
}

/// A row with a number of a part of a material, which a track of `target` may animate.
pub fn number<P: Part + 'static>(
    fields: &mut Fields,
    index: usize,
    label: (&'static str, &str),
    limits: Limits,
    target: Option<Target>,
    slot: fn(&mut P) -> &mut f32,
) {
    if let Some(part) = &mut P::of_shared(&fields.scene.materials[index]).cloned() {
        let value = f64::from(*slot(part));
        let set = edit(index, move |part, to: f64| *slot(part) = to as f32);
        fields
            .may_be_driven_by(target)
            .number(label, value, limits, set);
    }
}
