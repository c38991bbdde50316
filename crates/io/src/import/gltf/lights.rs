//! Lights (`KHR_lights_punctual`).
//!
//! Intensities are photometric: candela for points and spots, lux for directions. As in other viewers they are used as
//! numbers: light of 1 lux gives a white diffuse surface that faces it the radiance 1/π.

use super::Reader;
use super::document::Spot;
use super::values::Checked;
use crate::import::error::ImportError;
use glam::DVec3;
use glimray_scene::{Attenuation, Light, LightKind};
use std::f64::consts::{FRAC_PI_2, FRAC_PI_4, PI};

/// The range of the intensity of a light: `import/range.rs` limits what it sends into the scene.
const INTENSITY: [f64; 2] = [0.0, f64::MAX];

/// The narrowest cone in radians whose cosine as f32 is not 1.
const NARROWEST: f64 = 1e-3;

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
        let mut values = Checked::new(&mut self.notes, &place, light.name.as_deref());
        // Lights are at the origin of their node and shine along −Z.
        let (position, direction) = (DVec3::ZERO, DVec3::NEG_Z);
        let kind = match light.kind.as_str() {
            "point" => LightKind::Point { position },
            "directional" => LightKind::Directional { direction },
            "spot" => {
                let [inner, outer] = cone(light.spot.as_ref(), &mut values);
                LightKind::Spot {
                    position,
                    direction,
                    inner,
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
        let intensity = values.number("intensity", light.intensity, 1.0, INTENSITY);
        let color = values.numbers("color", light.color.unwrap_or([1.0; 3]), INTENSITY);
        let color = color.map(|channel| (channel * intensity / PI).min(f32::MAX.into()));
        self.scene.lights.push(Light {
            kind,
            color: DVec3::from(color).as_vec3(),
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

/// The angles from the axis of a spot up to which it has its full intensity, and beyond which it is dark.
fn cone(cone: Option<&Spot>, values: &mut Checked) -> [f64; 2] {
    const OUTER: &str = "spot.outerConeAngle";
    let outer = match cone.and_then(|cone| cone.outer_cone_angle) {
        None => FRAC_PI_4,
        Some(angle) if angle > 0.0 => {
            values.number(OUTER, Some(angle), angle, [NARROWEST, FRAC_PI_2])
        }
        Some(angle) => {
            values.repaired(OUTER, &[angle], "it must be above 0", "the default of π/4");
            FRAC_PI_4
        }
    };
    let inner = cone.map_or(0.0, |cone| cone.inner_cone_angle);
    let inner = values.number("spot.innerConeAngle", Some(inner), inner, [0.0, outer]);
    [inner, outer]
}
