//! The animations of a scene.

use super::materials::has_same_ambient;
use super::{Writer, exact};
use crate::import::native::file::{
    AnimationTable, InterpolationName, Key, KeyTable, KeyValue, PropertyName as P, Spanned,
    of_camera, of_light, of_material, of_node,
};
use crate::import::native::values::{Pace, Time, ViewAngle, differing};
use glam::{DVec3, Vec3};
use glimray_scene::{
    Beyond, Curve, Easing, Interpolation, LayerProperty, MaterialProperty, Target, Track, Values,
};

impl Writer<'_> {
    pub fn animations(&self) -> Vec<Spanned<AnimationTable>> {
        let mut tables = Vec::new();
        for track in &self.scene.tracks {
            let parts = self.parts(track);
            tables.extend(
                parts
                    .iter()
                    .filter_map(|part| self.animation(part, &track.curve)),
            );
            for (target, factor) in self.diffuse_of_base_colors(track) {
                tables.extend(self.animation(&[target], &scaled(&track.curve, factor)));
            }
        }
        tables.into_iter().map(Spanned::from).collect()
    }

    /// The diffuse colours that follow the base colours of `track`, and their ratios to them.
    fn diffuse_of_base_colors(&self, track: &Track) -> Vec<(Target, DVec3)> {
        let diffuse = |target: &Target| {
            let Target::Layer(index, LayerProperty::BaseColor) = *target else {
                return None;
            };
            let material = &self.scene.materials[index];
            let model = material.metallic_roughness()?;
            if model.unlit || model.phong.is_some() || material.has_classical_maps() {
                return None;
            }
            let mut white = model.point();
            white.base_color = Vec3::ONE;
            let factor = material.tint * model.lobes(&white, model.roughness).diffuse;
            let target = Target::Material(index, MaterialProperty::Diffuse);
            Some((target, factor.as_dvec3()))
        };
        track.targets.iter().filter_map(diffuse).collect()
    }

    /// The targets of a track, grouped so that one animation can name each group.
    fn parts(&self, track: &Track) -> Vec<Vec<Target>> {
        let mut parts: Vec<Vec<Target>> = Vec::new();
        for &target in &track.targets {
            let joins = parts
                .last()
                .and_then(|part| part.last())
                .is_some_and(|last| {
                    match (*last, target) {
                        (Target::Node(_, a), Target::Node(_, b)) => a == b,
                        // The ambient colour follows the diffuse one unless the material gives its own.
                        (
                            Target::Material(a, MaterialProperty::Diffuse),
                            Target::Material(b, MaterialProperty::Ambient),
                        ) => a == b && has_same_ambient(&self.scene.materials[a].classical()),
                        _ => false,
                    }
                });
            match parts.last_mut() {
                Some(part) if joins => {
                    if matches!(target, Target::Node(..)) {
                        part.push(target);
                    }
                }
                _ => parts.push(vec![target]),
            }
        }
        parts
    }

    fn animation(&self, targets: &[Target], curve: &Curve) -> Option<AnimationTable> {
        let names = &self.names;
        let named = |name: &String| Some(name.clone().into());
        let (mut object, mut objects, mut camera, mut light, mut material) = Default::default();
        let words = match targets[0] {
            Target::Node(index, property) => {
                let all = targets.iter().filter_map(|target| match *target {
                    Target::Node(index, _) => named(&names.nodes[index]),
                    _ => None,
                });
                match targets.len() {
                    1 => object = named(&names.nodes[index]),
                    _ => objects = Some(all.collect()),
                }
                of_node(property)
            }
            Target::Camera(index, property) => {
                camera = named(&names.cameras[index]);
                of_camera(property)
            }
            Target::Light(index, property) => {
                light = named(&names.lights[index]);
                of_light(property)
            }
            Target::Material(index, property) => {
                material = named(&names.materials[index]);
                of_material(property)
            }
            // Deforming meshes and textures are written at rest, and materials with their diffuse colours.
            Target::Weight(..) | Target::Layer(..) | Target::Texture(..) => return None,
        };
        let property = match *words {
            [_, radians] if !in_degrees(curve) => radians,
            _ => words[0],
        };
        let plain = match property {
            P::Visible | P::On => Interpolation::Step,
            _ => Interpolation::Linear,
        };
        // Easing applies to linear interpolation only, and is an error with others.
        let easing = match curve.interpolation {
            Interpolation::Linear => differing::<_, Pace>(curve.easing, Easing::None),
            _ => None,
        };
        Some(AnimationTable {
            object,
            objects,
            camera,
            light,
            material,
            property: property.into(),
            interpolation: differing::<_, InterpolationName>(curve.interpolation, plain)
                .map(Into::into),
            easing: easing.map(Into::into),
            beyond: differing(curve.beyond, Beyond::Hold),
            keys: keys(curve, property).into(),
        })
    }
}

/// A curve of vectors, multiplied by `factor`.
fn scaled(curve: &Curve, factor: DVec3) -> Curve {
    let mut scaled = curve.clone();
    if let Values::Vector(values) = &mut scaled.values {
        values.iter_mut().for_each(|value| *value *= factor);
    }
    scaled
}

/// Whether all values are exactly representable in degrees.
fn in_degrees(curve: &Curve) -> bool {
    let is_told = |radians: &f64| exact::degrees(*radians).is_some();
    match &curve.values {
        Values::Scalar(values) => values.iter().all(|radians| {
            let degrees = exact::degrees(*radians);
            degrees.is_some_and(|degrees| ViewAngle::range().contains(&degrees))
                || curve.interpolation == Interpolation::Hermite && degrees.is_some()
        }),
        Values::Vector(values) => values.iter().all(|v| v.to_array().iter().all(is_told)),
        Values::Rotation(_) => false,
    }
}

fn keys(curve: &Curve, property: P) -> Vec<Key> {
    let in_degrees = matches!(property, P::RotateDeg | P::FovYDeg);
    let given = |x: f64| match in_degrees {
        true => exact::degrees(x).unwrap_or(x.to_degrees()),
        false => x,
    };
    let value = |index: usize| match &curve.values {
        Values::Scalar(values) if matches!(property, P::Visible | P::On) => {
            KeyValue::Switch(values[index] >= 0.5)
        }
        Values::Scalar(values) => KeyValue::Number(given(values[index])),
        Values::Vector(values) => DVec3::from(values[index].to_array().map(given)).into(),
        Values::Rotation(values) => values[index].into(),
    };
    let is_zero = |index: usize| match &curve.values {
        Values::Scalar(values) => values[index].to_bits() == 0,
        Values::Vector(values) => values[index].to_array().iter().all(|x| x.to_bits() == 0),
        Values::Rotation(values) => values[index].to_array().iter().all(|x| x.to_bits() == 0),
    };
    let is_hermite = curve.interpolation == Interpolation::Hermite;
    let tangent = |index: usize| {
        let is_given = is_hermite && !is_zero(index);
        is_given.then(|| value(index).into())
    };
    let key = |(index, &time): (usize, &f64)| {
        let (reach, at, leave) = match is_hermite {
            true => (3 * index, 3 * index + 1, 3 * index + 2),
            false => (index, index, index),
        };
        Key(KeyTable {
            time: Time(time).into(),
            value: value(at).into(),
            in_tangent: tangent(reach),
            out_tangent: tangent(leave),
        })
    };
    curve.times.iter().enumerate().map(key).collect()
}
