//! The animations of a scene.

use super::materials::has_same_ambient;
use super::text::{Table, list, number, quaternion, string, vector};
use super::{Writer, exact};
use glam::{DVec3, Vec3};
use glimray_scene::{
    Beyond, CameraProperty, Curve, Easing, Interpolation, LayerProperty, LightProperty,
    MaterialProperty, NodeProperty, Target, Track, Values,
};

/// Longer lists of keys have one key per line.
const MOST_IN_A_LINE: usize = 2;

impl Writer<'_> {
    pub fn animations(&mut self) {
        if !self.scene.tracks.is_empty() {
            self.text.section("Animations");
        }
        for track in &self.scene.tracks {
            for targets in self.parts(track) {
                self.text.gap();
                self.animation(&targets, &track.curve);
            }
            for (target, factor) in self.diffuse_of_base_colors(track) {
                self.text.gap();
                self.animation(&[target], &scaled(&track.curve, factor));
            }
        }
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

    fn animation(&mut self, targets: &[Target], curve: &Curve) {
        let names = &self.names;
        let mut table = Table::default();
        let property = match targets[0] {
            Target::Node(index, property) => {
                if targets.len() == 1 {
                    table.put("object", string(&names.nodes[index]));
                } else {
                    let all = targets.iter().filter_map(|target| match *target {
                        Target::Node(index, _) => Some(string(&names.nodes[index])),
                        _ => None,
                    });
                    table.put("objects", list(all));
                }
                of_node(property, curve)
            }
            Target::Camera(index, property) => {
                table.put("camera", string(&names.cameras[index]));
                of_camera(property, curve)
            }
            Target::Light(index, property) => {
                table.put("light", string(&names.lights[index]));
                of_light(property)
            }
            Target::Material(index, property) => {
                table.put("material", string(&names.materials[index]));
                of_material(property)
            }
            // Deforming meshes and textures are written at rest, and materials with their diffuse colours.
            Target::Weight(..) | Target::Layer(..) | Target::Texture(..) => return,
        };
        table.put("property", string(property));
        let is_switch = matches!(property, "visible" | "on");
        match curve.interpolation {
            Interpolation::Step => table.put_if(!is_switch, "interpolation", string("step")),
            Interpolation::Linear => {}
            Interpolation::CatmullRom => table.put("interpolation", string("cubic")),
            Interpolation::Hermite => table.put("interpolation", string("hermite")),
        }
        match curve.easing {
            // Easing applies to linear interpolation only, and is an error with others.
            Easing::Bezier(points) if curve.interpolation == Interpolation::Linear => {
                table.put("easing", easing(curve.easing, points));
            }
            _ => {}
        }
        match curve.beyond {
            Beyond::Hold => {}
            Beyond::Repeat => table.put("beyond", string("repeat")),
            Beyond::PingPong => table.put("beyond", string("ping-pong")),
        }
        table.put("keys", keys(curve, property));
        self.text.head("[[animation]]");
        self.text.lines(&table);
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

fn easing(easing: Easing, points: [f64; 4]) -> String {
    match easing {
        easing if easing == Easing::IN => string("in"),
        easing if easing == Easing::OUT => string("out"),
        easing if easing == Easing::IN_OUT => string("in-out"),
        _ => list(points.map(number)),
    }
}

fn of_node(property: NodeProperty, curve: &Curve) -> &'static str {
    match property {
        NodeProperty::Translation => "translate",
        NodeProperty::Rotation => "rotation",
        NodeProperty::Angles if in_degrees(curve) => "rotate_deg",
        NodeProperty::Angles => "angles",
        NodeProperty::Scale => "scale",
        NodeProperty::Visible => "visible",
    }
}

fn of_camera(property: CameraProperty, curve: &Curve) -> &'static str {
    match property {
        CameraProperty::LookFrom => "look_from",
        CameraProperty::LookAt => "look_at",
        CameraProperty::Up => "up",
        CameraProperty::FovY if in_degrees(curve) => "fov_y_deg",
        CameraProperty::FovY => "fov_y",
        CameraProperty::OrthographicHeight => "orthographic",
        CameraProperty::FocusDistance => "focus_distance",
        CameraProperty::LensRadius => "lens_radius",
    }
}

fn of_light(property: LightProperty) -> &'static str {
    match property {
        LightProperty::Position => "position",
        LightProperty::Direction => "direction",
        LightProperty::Color => "color",
        LightProperty::Intensity => "intensity",
        LightProperty::On => "on",
    }
}

fn of_material(property: MaterialProperty) -> &'static str {
    match property {
        MaterialProperty::Diffuse => "diffuse",
        MaterialProperty::Specular => "specular",
        MaterialProperty::Shininess => "shininess",
        MaterialProperty::Ambient => "ambient",
        MaterialProperty::Emission => "emission",
        MaterialProperty::Reflect => "reflect",
        MaterialProperty::Transmit => "transmit",
        MaterialProperty::Opacity => "opacity",
        MaterialProperty::Ior => "ior",
        MaterialProperty::Absorption => "absorption",
    }
}

/// Whether all values are exactly representable in degrees.
fn in_degrees(curve: &Curve) -> bool {
    let is_told = |radians: &f64| exact::degrees(*radians).is_some();
    match &curve.values {
        Values::Scalar(values) => values.iter().all(|radians| {
            let degrees = exact::degrees(*radians);
            degrees.is_some_and(|degrees| (1e-3..=179.999).contains(&degrees))
                || curve.interpolation == Interpolation::Hermite && degrees.is_some()
        }),
        Values::Vector(values) => values.iter().all(|v| v.to_array().iter().all(is_told)),
        Values::Rotation(_) => false,
    }
}

fn keys(curve: &Curve, property: &str) -> String {
    let in_degrees = property.ends_with("_deg");
    let degrees = |radians: f64| exact::degrees(radians).unwrap_or(radians.to_degrees());
    let is_switch = matches!(property, "visible" | "on");
    let value = |index: usize| match &curve.values {
        Values::Scalar(values) if is_switch => (values[index] >= 0.5).to_string(),
        Values::Scalar(values) if in_degrees => number(degrees(values[index])),
        Values::Scalar(values) => number(values[index]),
        Values::Vector(values) if in_degrees => {
            vector(DVec3::from(values[index].to_array().map(degrees)))
        }
        Values::Vector(values) => vector(values[index]),
        Values::Rotation(values) => quaternion(values[index]),
    };
    let is_zero = |index: usize| match &curve.values {
        Values::Scalar(values) => values[index].to_bits() == 0,
        Values::Vector(values) => values[index].to_array().iter().all(|x| x.to_bits() == 0),
        Values::Rotation(values) => values[index].to_array().iter().all(|x| x.to_bits() == 0),
    };
    let keys: Vec<String> = (curve.times.iter().enumerate())
        .map(|(index, &time)| {
            if curve.interpolation != Interpolation::Hermite {
                return list([number(time), value(index)]);
            }
            let mut table = Table::default();
            table.put("time", number(time));
            table.put("value", value(3 * index + 1));
            let (reach, leave) = (3 * index, 3 * index + 2);
            table.put_if(!is_zero(reach), "in_tangent", value(reach));
            table.put_if(!is_zero(leave), "out_tangent", value(leave));
            table.inline()
        })
        .collect();
    if keys.len() <= MOST_IN_A_LINE {
        return list(keys);
    }
    let lines: String = keys.iter().map(|key| format!("    {key},\n")).collect();
    format!("[\n{lines}]")
}
