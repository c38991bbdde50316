//! What a light shines with.

use crate::scene::{Attenuation, LightKind, LightProperty, Target};
use crate::viewer::ui::panels::properties::fields::{Fields, Limits};
use glam::DVec3;
use std::f64::consts::FRAC_PI_2;

/// All fields of a light but its place.
pub fn show(fields: &mut Fields, index: usize) {
    let light = fields.scene.lights[index].clone();
    fields.heading("Light");
    let target = |property| Some(Target::Light(index, property));
    let tip = "Radiance in the sum of Phong, at distance 1 where it fades.";
    let color = target(LightProperty::Color);
    fields.color("Colour", tip, light.color, color, move |scene, to| {
        scene.lights[index].color = to;
    });
    let intensity = f64::from(light.color.max_element());
    if intensity > 0.0 {
        let tip = "The brightest part of the colour; all of it goes with it. 0 or more.";
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
    let tip = "How it fades with the distance r.";
    let options = [
        (Attenuation::None, "not at all".to_owned()),
        (Attenuation::InverseSquare, "with 1/r²".to_owned()),
    ];
    if !matches!(light.kind, LightKind::Directional { .. }) {
        fields.choice(
            "Fading",
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
        let tip = "Shadow rays for each shaded point, at least 1: more make soft shadows smoother.";
        let limits = Limits {
            speed: 0.1,
            ..Limits::between(1.0, 1024.0)
        };
        let samples = f64::from(light.samples);
        fields.number("Samples", tip, samples, limits, None, move |scene, to| {
            scene.lights[index].samples = to.round() as u32;
        });
        let tip = "Whether rays see the light itself.";
        fields.toggle("Visible itself", tip, light.visible, move |scene, to| {
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
        let tip =
            "The way the light travels, in the space of what carries it; of any length but 0.";
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
                "Degrees off the axis up to which it has its full strength; at most the outer one.";
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
            let tip = "Degrees off the axis from which on it gives nothing, up to 90.";
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
