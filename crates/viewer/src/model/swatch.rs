//! How a material looks in a small patch of colour.

use glam::Vec3;
use glimray_scene::{Fresnel, Material, Phong};

/// The thickness of glass that its absorption tints, in scene units.
const THICKNESS: f32 = 0.5;
/// Least reflectance that counts as a mirror or as glass, 0 to 1.
const LEAST: f32 = 0.15;

/// The colour of a material under white light, and how its surface looks.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Swatch {
    /// Linear RGB, 0 to 1.
    pub color: Vec3,
    /// Whether a highlight or a reflection is seen on it.
    pub is_glossy: bool,
    /// Whether light passes through it.
    pub is_clear: bool,
}

impl Swatch {
    /// The swatch of a material, seen at normal incidence. Metals reflect most of the light in their colour,
    /// so reflection and transmission count as much as the diffuse colour.
    pub fn of(material: &Material) -> Self {
        let phong = material.classical();
        let Phong {
            diffuse,
            specular,
            reflect,
            transmit,
            absorption,
            fresnel,
            ior,
            ..
        } = *phong;
        let (emission, _) = material.radiance();
        let reflect = match fresnel {
            Fresnel::None | Fresnel::Schlick => reflect,
            Fresnel::Exact => reflect * ((ior - 1.0) / (ior + 1.0)).powi(2),
        };
        let mut color = emission + diffuse + reflect + transmit * (-absorption * THICKNESS).exp();
        if color.max_element() < LEAST {
            color += specular;
        }
        Self {
            // Scaled as a whole: clamping each channel would change the hue.
            color: color / color.max_element().max(1.0),
            is_glossy: phong.reflect.max(specular).max_element() >= LEAST,
            is_clear: transmit.max_element() >= LEAST,
        }
    }
}
