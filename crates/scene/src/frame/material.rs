//! Materials at one moment.

use super::color;
use crate::{LayerProperty, Material, MaterialProperty, Scene, Target, Value};
use glam::Vec3;
use std::sync::Arc;

/// Smallest index of refraction that an overshooting curve may give.
const MIN_IOR: f64 = 1e-3;

impl Scene {
    /// All materials if a track animates any; otherwise none.
    pub(super) fn materials_at(&self, time: f64) -> Vec<Material> {
        let mut materials = Vec::new();
        let mut strengths = Vec::new();
        for track in &self.tracks {
            for target in &track.targets {
                if !matches!(target, Target::Material(..) | Target::Layer(..)) {
                    continue;
                }
                if materials.is_empty() {
                    materials.clone_from(&self.materials);
                }
                let value = track.curve.at(time);
                match (*target, value) {
                    (Target::Material(index, property), value) => {
                        change(&mut materials[index], property, value);
                    }
                    (
                        Target::Layer(index, LayerProperty::EmissionStrength),
                        Value::Scalar(strength),
                    ) => strengths.push((index, strength)),
                    (Target::Layer(index, property), value) => {
                        change_layer(&mut materials[index], property, value);
                    }
                    _ => {}
                }
            }
        }
        for (index, strength) in strengths {
            let emission = &mut materials[index].emission;
            *emission = color(emission.as_dvec3() * strength.max(0.0));
        }
        materials
    }
}

fn change_layer(material: &mut Material, property: LayerProperty, value: Value) {
    let Some(model) = &mut material.metallic_roughness else {
        return;
    };
    let model = Arc::make_mut(model);
    match (property, value) {
        (LayerProperty::BaseColor, Value::Vector(value)) => {
            model.base_color = color(value).min(Vec3::ONE);
        }
        (_, Value::Scalar(value)) => {
            let unit = value.clamp(0.0, 1.0) as f32;
            match property {
                LayerProperty::Alpha => material.alpha = unit,
                LayerProperty::Metallic => model.metallic = unit,
                LayerProperty::Roughness => model.roughness = unit,
                LayerProperty::Transmission => model.transmission = unit,
                LayerProperty::Ior => model.ior = value.clamp(1.0, 1e6) as f32,
                LayerProperty::BaseColor | LayerProperty::EmissionStrength => {}
            }
        }
        _ => {}
    }
    if property != LayerProperty::Alpha {
        material.follow_layers();
    }
}

fn change(material: &mut Material, property: MaterialProperty, value: Value) {
    match value {
        Value::Scalar(value) => {
            let within = |low: f64, high: f64| value.clamp(low, high) as f32;
            let most = f64::from(f32::MAX);
            match property {
                MaterialProperty::Shininess => material.shininess = within(0.0, most),
                MaterialProperty::Opacity => material.opacity = within(0.0, 1.0),
                MaterialProperty::Ior => material.ior = within(MIN_IOR, most),
                _ => {}
            }
        }
        Value::Vector(value) => {
            let value = color(value);
            match property {
                MaterialProperty::Diffuse => material.diffuse = value,
                MaterialProperty::Specular => material.specular = value,
                MaterialProperty::Ambient => material.ambient = value,
                MaterialProperty::Emission => material.emission = value,
                MaterialProperty::Reflect => material.reflect = value,
                MaterialProperty::Transmit => material.transmit = value,
                MaterialProperty::Absorption => material.absorption = value,
                _ => {}
            }
        }
        Value::Rotation(_) => {}
    }
}
