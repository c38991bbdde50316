//! The properties of a light.

use crate::scene::{Attenuation, LightKind, LightProperty, Target};
use crate::viewer::ui::panels::properties::fields::{Fields, Limits};
use glam::DVec3;
use std::f64::consts::FRAC_PI_2;

/// Draws all properties of a light except its transform.
pub fn show(fields: &mut Fields, index: usize) {
    let light = fields.scene.lights[index].clone();
    fields.heading("Light");
    let target = |property| Some(Target::Light(index, property));
    let tip = "Light colour in the Phong sum; at distance 1 if the light falls off.";
    let color = target(LightProperty::Color);
    fields.color("Colour", tip, light.color, color, move |scene, to| {
        scene.lights[index].color = to;
    });
    let intensity = f64::from(light.color.max_element());
    if intensity > 0.0 {
        let tip = "Scales the colour; its largest component, 0 or more.";
        let limits = Limits::between(1e-6, 1e9);
        let driven = target(LightProperty::Intensity);
        fields.number(
            "Intensity",
            tip,
            intensity,
            limits,
            driven,
            move |scene, to| {
                let color = &mut scene.lights[index].color;
                *color *= (to / f64::from(color.max_element()).max(1e-12)) as f32;
            },
        );
    }
    extent(fields, index, light.kind);
    let tip = "Falloff with the distance r.";
    let options = [
        (Attenuation::None, "None".to_owned()),
        (
            Attenuation::InverseSquare,
            "Inverse square (1/r²)".to_owned(),
        ),
    ];
    if !matches!(light.kind, LightKind::Directional { .. }) {
        fields.choice(
            "Falloff",
            tip,
            light.attenuation,
            &options,
            move |scene, to| {
                scene.lights[index].attenuation = to;
                Ok(())
            },
        );
    }
    if light.kind.radiance().is_some() {
        let tip =
            "Shadow rays per shading point, at least 1. More rays reduce noise in soft shadows.";
        let limits = Limits {
            speed: 0.1,
            ..Limits::between(1.0, 1024.0)
        };
        let samples = f64::from(light.samples);
        fields.number("Samples", tip, samples, limits, None, move |scene, to| {
            scene.lights[index].samples = to.round() as u32;
        });
        let tip = "Show the light's surface to camera, reflection and refraction rays.";
        fields.toggle("Visible", tip, light.visible, move |scene, to| {
            scene.lights[index].visible = to;
        });
    }
}

fn extent(fields: &mut Fields, index: usize, kind: LightKind) {
    let aim = Some(Target::Light(index, LightProperty::Direction));
    let direction = match kind {
        LightKind::Directional { direction } | LightKind::Spot { direction, .. } => {
            Some(("Direction", direction))
        }
        LightKind::Disc { normal, .. } => Some(("Normal", normal)),
        _ => None,
    };
    if let Some((label, value)) = direction {
        let tip = "Direction of the light in its parent's space; any length except 0.";
        fields.vector(
            label,
            tip,
            value,
            Limits::LENGTH,
            aim,
            move |scene, to: DVec3| match &mut scene.lights[index].kind {
                LightKind::Directional { direction }
                | LightKind::Spot { direction, .. }
                | LightKind::Disc {
                    normal: direction, ..
                } => *direction = to.normalize_or(*direction),
                _ => {}
            },
        );
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
            let degrees = inner.to_degrees();
            fields.number(
                "Inner angle",
                tip,
                degrees,
                limits,
                None,
                move |scene, to| {
                    if let LightKind::Spot { inner, outer, .. } = &mut scene.lights[index].kind {
                        *inner = to.to_radians().min(*outer);
                    }
                },
            );
            let tip =
                "Half-angle of the cone beyond which there is no light, in degrees, up to 90.";
            let degrees = outer.to_degrees();
            fields.number(
                "Outer angle",
                tip,
                degrees,
                limits,
                None,
                move |scene, to| {
                    if let LightKind::Spot { inner, outer, .. } = &mut scene.lights[index].kind {
                        *outer = to.to_radians().min(FRAC_PI_2);
                        *inner = inner.min(*outer);
                    }
                },
            );
        }
        LightKind::Disc { radius, .. } | LightKind::Sphere { radius, .. } => {
            let tip = "In scene units, above 0.";
            fields.number(
                "Radius",
                tip,
                radius,
                Limits::SIZE,
                None,
                move |scene, to| {
                    if let LightKind::Disc { radius, .. } | LightKind::Sphere { radius, .. } =
                        &mut scene.lights[index].kind
                    {
                        *radius = to;
                    }
                },
            );
        }
        _ => {}
    }
}
