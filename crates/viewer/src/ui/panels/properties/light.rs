//! The properties of a light.

use crate::ui::panels::properties::fields::{Fields, Limits};
use glam::DVec3;
use glimray_scene::{Attenuation, Light, LightKind, LightProperty, Scene, Target};
use std::f64::consts::FRAC_PI_2;

/// Draws all properties of a light except its transform.
pub fn show(fields: &mut Fields, index: usize) {
    let light = fields.scene.lights[index].clone();
    fields.heading("Light");
    let tip = "Light colour in the Phong sum; at distance 1 if the light falls off.";
    fields
        .driven_by(Target::Light(index, LightProperty::Color))
        .color(
            ("Colour", tip),
            light.color,
            with(index, |light, to| {
                light.color = to;
            }),
        );
    let intensity = f64::from(light.color.max_element());
    if intensity > 0.0 {
        let tip = "Scales the colour; its largest component, 0 or more.";
        let set = with(index, |light, to: f64| {
            light.color *= (to / f64::from(light.color.max_element()).max(1e-12)) as f32;
        });
        fields
            .driven_by(Target::Light(index, LightProperty::Intensity))
            .number(
                ("Intensity", tip),
                intensity,
                Limits::between(1e-6, 1e9),
                set,
            );
    }
    extent(fields, index, light.kind);
    if !matches!(light.kind, LightKind::Directional { .. }) {
        let options = [
            (Attenuation::None, "None"),
            (Attenuation::InverseSquare, "Inverse square (1/r²)"),
        ];
        let tip = "Falloff with the distance r.";
        let set = with(index, |light, to| light.attenuation = to);
        fields.choice(("Falloff", tip), light.attenuation, &options, set);
    }
    if light.kind.radiance().is_some() {
        let tip =
            "Shadow rays per shading point, at least 1. More rays reduce noise in soft shadows.";
        let limits = Limits::between(1.0, 1024.0).with_speed(0.1);
        let set = with(index, |light, to: f64| light.samples = to.round() as u32);
        fields.number(("Samples", tip), f64::from(light.samples), limits, set);
        let tip = "Show the light's surface to camera, reflection and refraction rays.";
        let set = with(index, |light, to| light.visible = to);
        fields.toggle(("Visible", tip), light.visible, set);
    }
}

/// A change of a light.
fn with<T>(index: usize, change: fn(&mut Light, T)) -> impl FnOnce(&mut Scene, T) {
    move |scene, to| change(&mut scene.lights[index], to)
}

fn extent(fields: &mut Fields, index: usize, kind: LightKind) {
    let direction = match kind {
        LightKind::Directional { direction } | LightKind::Spot { direction, .. } => {
            Some(("Direction", direction))
        }
        LightKind::Disc { normal, .. } => Some(("Normal", normal)),
        _ => None,
    };
    if let Some((label, value)) = direction {
        let tip = "Direction of the light in its parent's space; any length except 0.";
        let set = with(index, |light, to: DVec3| match &mut light.kind {
            LightKind::Directional { direction }
            | LightKind::Spot { direction, .. }
            | LightKind::Disc {
                normal: direction, ..
            } => *direction = to.normalize_or(*direction),
            _ => {}
        });
        fields
            .driven_by(Target::Light(index, LightProperty::Direction))
            .vector((label, tip), value, Limits::LENGTH, set);
    }
    match kind {
        LightKind::Spot { inner, outer, .. } => {
            let limits = Limits {
                least: 0.0,
                most: 90.0,
                ..Limits::ANGLE
            };
            let tip =
                "Half-angle of the cone of full intensity in degrees; at most the outer angle.";
            let set = with(index, |light, to: f64| {
                if let LightKind::Spot { inner, outer, .. } = &mut light.kind {
                    *inner = to.to_radians().min(*outer);
                }
            });
            fields.number(("Inner angle", tip), inner.to_degrees(), limits, set);
            let tip =
                "Half-angle of the cone beyond which there is no light, in degrees, 0.1 to 90.";
            let set = with(index, |light, to: f64| {
                if let LightKind::Spot { inner, outer, .. } = &mut light.kind {
                    *outer = to.to_radians().min(FRAC_PI_2);
                    *inner = inner.min(*outer);
                }
            });
            // Scene files refuse a cone without width.
            let limits = Limits {
                least: 0.1,
                ..limits
            };
            fields.number(("Outer angle", tip), outer.to_degrees(), limits, set);
        }
        LightKind::Disc { radius, .. } | LightKind::Sphere { radius, .. } => {
            let tip = "In scene units, above 0.";
            let set = with(index, |light, to| {
                if let LightKind::Disc { radius, .. } | LightKind::Sphere { radius, .. } =
                    &mut light.kind
                {
                    *radius = to;
                }
            });
            fields.number(("Radius", tip), radius, Limits::SIZE, set);
        }
        _ => {}
    }
}
