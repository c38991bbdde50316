//! Materials at one moment.

use super::color;
use crate::{Bsdf, LayerProperty, Material, MaterialProperty, Scene, Target, Value};
use glam::Vec3;
use std::sync::Arc;

/// Smallest index of refraction that an overshooting curve may give.
const MIN_IOR: f64 = 1e-3;

impl Scene {
    /// All materials if a track animates any; otherwise none.
    pub(super) fn materials_at(&self, time: f64) -> Vec<Material> {
        let mut changes = Vec::new();
        for track in &self.tracks {
            let targets = track.targets.iter().copied();
            let of_materials =
                targets.filter(|it| matches!(it, Target::Material(..) | Target::Layer(..)));
            changes.extend(of_materials.map(|target| (target, &track.curve)));
        }
        if changes.is_empty() {
            return Vec::new();
        }
        let mut materials = self.materials.clone();
        // Classical coefficients that are animated replace those that follow from the parameters at this time.
        for (target, curve) in &changes {
            if let Target::Layer(index, property) = *target {
                change_layer(&mut materials[index], property, curve.at(time));
            }
        }
        for (target, curve) in &changes {
            if let Target::Material(index, property) = *target {
                change(&mut materials[index], property, curve.at(time));
            }
        }
        for (target, curve) in &changes {
            if let (
                Target::Layer(index, LayerProperty::EmissionStrength),
                Value::Scalar(strength),
            ) = (*target, curve.at(time))
            {
                let emission = &mut materials[index].emission;
                *emission = color(emission.as_dvec3() * strength.max(0.0));
            }
        }
        materials
    }
}

fn change_layer(material: &mut Material, property: LayerProperty, value: Value) {
    let alpha = &mut material.alpha;
    let Bsdf::MetallicRoughness(model) = &mut material.bsdf else {
        return;
    };
    match (property, value) {
        (LayerProperty::BaseColor, Value::Vector(value)) => {
            Arc::make_mut(model).base_color = color(value).min(Vec3::ONE);
        }
        (_, Value::Scalar(value)) => {
            let unit = value.clamp(0.0, 1.0) as f32;
            match property {
                LayerProperty::Alpha => *alpha = unit,
                LayerProperty::Metallic => Arc::make_mut(model).metallic = unit,
                LayerProperty::Roughness => Arc::make_mut(model).roughness = unit,
                LayerProperty::Transmission => Arc::make_mut(model).transmission = unit,
                LayerProperty::Ior => Arc::make_mut(model).ior = value.clamp(1.0, 1e6) as f32,
                LayerProperty::BaseColor | LayerProperty::EmissionStrength => {}
            }
        }
        _ => {}
    }
}

/// Gives an emission, or to what shines with its base colour another one.
fn shine(material: &mut Material, value: Vec3) {
    let is_plain = (material.emission, material.textures.emission) == (Vec3::ZERO, None);
    match &mut material.bsdf {
        Bsdf::MetallicRoughness(model) if model.unlit => {
            let model = Arc::make_mut(model);
            if is_plain {
                material.tint = Vec3::ONE;
                model.base_color = value;
            } else {
                material.emission = value;
                // Where that is black, the base colour does not show instead.
                model.base_color = Vec3::ZERO;
            }
        }
        _ => material.emission = value,
    }
}

fn change(material: &mut Material, property: MaterialProperty, value: Value) {
    match value {
        Value::Scalar(value) => {
            let within = |low: f64, high: f64| value.clamp(low, high) as f32;
            let most = f64::from(f32::MAX);
            match property {
                MaterialProperty::Shininess => {
                    material.classical_mut().shininess = within(0.0, most)
                }
                MaterialProperty::Opacity => material.classical_mut().opacity = within(0.0, 1.0),
                MaterialProperty::Ior => material.classical_mut().ior = within(MIN_IOR, most),
                _ => {}
            }
        }
        Value::Vector(value) => {
            let value = color(value);
            match property {
                MaterialProperty::Diffuse => material.classical_mut().diffuse = value,
                MaterialProperty::Specular => material.classical_mut().specular = value,
                MaterialProperty::Ambient => material.classical_mut().ambient = value,
                MaterialProperty::Emission => shine(material, value),
                MaterialProperty::Reflect => material.classical_mut().reflect = value,
                MaterialProperty::Transmit => material.classical_mut().transmit = value,
                MaterialProperty::Absorption => material.classical_mut().absorption = value,
                _ => {}
            }
        }
        Value::Rotation(_) => {}
    }
}
