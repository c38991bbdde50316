//! Lights (`KHR_lights_punctual`).
//!
//! Its intensities are photometric: candela for points and spots, lux for directions. As in other viewers
//! they are used as numbers: light of 1 lux gives a white diffuse surface that faces it the radiance 1/π.

use super::Reader;
use crate::import::error::ImportError;
use crate::scene::{Attenuation, Light, LightKind};
use glam::{DVec3, Vec3};
use std::f64::consts::{FRAC_PI_2, FRAC_PI_4, PI};

impl Reader<'_> {
    /// Adds the light `index` at node `node` of the scene.
    pub(super) fn light(
        &mut self,
        index: usize,
        node: usize,
        here: &str,
    ) -> Result<(), ImportError> {
        let lights = self.document.extensions.lights.as_ref();
        let lights = lights.map_or(&[][..], |it| &it.lights);
        let light = self.blame.get(lights, index, "lights", here)?;
        let place = format!("lights[{index}]");
        // Lights are at the origin of their node and shine along −Z.
        let (position, direction) = (DVec3::ZERO, DVec3::NEG_Z);
        let kind = match light.kind.as_str() {
            "point" => LightKind::Point { position },
            "directional" => LightKind::Directional { direction },
            "spot" => {
                let cone = light.spot.as_ref();
                let outer = cone
                    .and_then(|cone| cone.outer_cone_angle)
                    .unwrap_or(FRAC_PI_4);
                let outer = outer.clamp(1e-6, FRAC_PI_2);
                let inner = cone.map_or(0.0, |cone| cone.inner_cone_angle);
                LightKind::Spot {
                    position,
                    direction,
                    inner: inner.clamp(0.0, outer),
                    outer,
                }
            }
            kind => {
                let name = crate::import::source::quote(kind.as_bytes());
                return Err(self
                    .blame
                    .bad(place, format_args!("the type {name} is unknown")));
            }
        };
        let amount = |x: f64| x.clamp(0.0, 1e30);
        let intensity = amount(light.intensity.unwrap_or(1.0)) / PI;
        let color = light
            .color
            .unwrap_or([1.0; 3])
            .map(|c| amount(c) * intensity);
        self.scene.lights.push(Light {
            kind,
            color: Vec3::from(color.map(|c| c.min(1e30) as f32)),
            attenuation: match kind {
                LightKind::Directional { .. } => Attenuation::None,
                _ => Attenuation::InverseSquare,
            },
            node: Some(node),
            ..Light::default()
        });
        self.lights.push(index);
        Ok(())
    }
}
