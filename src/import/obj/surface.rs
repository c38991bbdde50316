//! A material of a library as the renderer's: what `illum`, `d`, `Ni` and the physically based keys mean.
//!
//! Sources: Wavefront, Object Files and MTL, version 4.2, 1995; Exocortex, Physically Based Extensions of
//! MTL, 2012.

use crate::scene::{Fresnel, Material};
use glam::Vec3;

/// Reflectance of a dielectric at normal incidence, for an index of refraction of 1.5.
const DIELECTRIC: f32 = 0.04;

/// How much of a rough metal's reflection is shown as its diffuse colour: the blurred image of its
/// surroundings is not traced.
const METAL_DIFFUSE: f32 = 0.6;

/// Mirrors weaker than this are left out: each costs a ray.
const WEAKEST_MIRROR: f32 = 0.01;

/// The smallest roughness, whose highlight is still wider than a pixel.
const LEAST_ROUGHNESS: f32 = 0.05;

/// The values of a material, by their keys.
#[derive(Clone, Copy)]
pub(super) struct Values {
    pub kd: Vec3,
    pub ks: Vec3,
    pub ka: Option<Vec3>,
    pub ke: Vec3,
    pub tf: Vec3,
    pub ns: f32,
    pub ni: f32,
    /// 1 is opaque.
    pub d: f32,
    pub illum: u32,
    pub pr: Option<f32>,
    pub pm: Option<f32>,
}

impl Values {
    /// The material, without name and textures.
    pub fn material(&self) -> Material {
        let opacity = self.d.clamp(0.0, 1.0);
        let mut material = Material {
            diffuse: self.kd,
            specular: if self.illum == 1 { Vec3::ZERO } else { self.ks },
            ambient: self.ka.unwrap_or(self.kd),
            shininess: self.ns,
            emission: self.ke,
            opacity,
            transmit: (1.0 - opacity) * self.tf,
            ..Material::default()
        };
        if self.pr.is_some() || self.pm.is_some() {
            self.physical(&mut material);
        } else if self.illum >= 3 {
            self.optical(&mut material);
        }
        // Models 6 and 7 refract; others are seen straight through.
        if matches!(self.illum, 6 | 7) && self.ni > 0.0 {
            material.ior = self.ni;
        }
        if self.illum == 0 {
            // A constant colour.
            material.emission += self.kd;
            material.diffuse = Vec3::ZERO;
            material.ambient = Vec3::ZERO;
            material.specular = Vec3::ZERO;
        }
        material
    }

    /// The mirror of models 3 and above. Models 5 and 7 have Fresnel's equations.
    fn optical(&self, material: &mut Material) {
        material.reflect = self.ks.min(Vec3::ONE);
        if matches!(self.illum, 5 | 7) {
            material.fresnel = Fresnel::Exact;
            material.ior = if self.ni > 1.0 { self.ni } else { 1.5 };
        }
    }

    /// A metallic-roughness material by Phong's model: a highlight of the width and height of the
    /// Blinn–Phong lobe of α = roughness², and a mirror that fades with roughness.
    fn physical(&self, material: &mut Material) {
        let metallic = self.pm.unwrap_or(0.0).clamp(0.0, 1.0);
        let roughness = self.pr.unwrap_or(0.5).clamp(LEAST_ROUGHNESS, 1.0);
        let base = self.kd;
        let reflectance = Vec3::splat(DIELECTRIC).lerp(base, metallic);
        let exponent = 2.0 / roughness.powi(4) - 2.0;
        let sharpness = (1.0 - roughness).powi(4);
        material.shininess = exponent / 4.0;
        material.specular = (reflectance * (exponent + 8.0) / 8.0).min(Vec3::ONE);
        material.reflect = reflectance * sharpness;
        if material.reflect.max_element() < WEAKEST_MIRROR {
            material.reflect = Vec3::ZERO;
        }
        material.diffuse = base * (1.0 - metallic + metallic * METAL_DIFFUSE * (1.0 - sharpness));
        material.ambient = material.diffuse;
    }
}
