//! Materials at one moment.

use super::color;
use crate::scene::{Material, MaterialProperty, Scene, Target, Value};

/// Smallest index of refraction that an overshooting curve may give.
const MIN_IOR: f64 = 1e-3;

impl Scene {
    /// All materials if a track animates any; otherwise none.
    pub(super) fn materials_at(&self, time: f64) -> Vec<Material> {
        let mut materials = Vec::new();
        for track in &self.tracks {
            for target in &track.targets {
                if let Target::Material(index, property) = *target {
                    if materials.is_empty() {
                        materials.clone_from(&self.materials);
                    }
                    change(&mut materials[index], property, track.curve.at(time));
                }
            }
        }
        materials
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
