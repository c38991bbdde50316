//! A material of a library as the renderer's: what `illum`, `d`, `Ni` and the physically based keys mean.
//!
//! Sources: Wavefront, Object Files and MTL, version 4.2, 1995; Exocortex, Physically Based Extensions of
//! MTL, 2012.

use crate::scene::{Coverage, Fresnel, Material, MetallicRoughness};
use glam::Vec3;
use std::f32::consts::TAU;

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
    /// Sheen, clear coat and its roughness, anisotropy and its direction in turns.
    pub ps: f32,
    pub pc: f32,
    pub pcr: f32,
    pub aniso: f32,
    pub anisor: f32,
}

/// MTL has no number for it.
const SHEEN_ROUGHNESS: f32 = 0.5;

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
        if self.is_physical() {
            self.physical(&mut material);
        } else if self.illum >= 3 {
            self.optical(&mut material);
        }
        // Models 6 and 7 refract; others are seen straight through.
        match matches!(self.illum, 6 | 7) {
            true if self.ni > 0.0 => material.ior = self.ni,
            true => {}
            false => material.thin = material.transmit != Vec3::ZERO,
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

    /// Whether it is a metallic-roughness material: exporters write zeros for what a material lacks.
    fn is_physical(&self) -> bool {
        let has_layers = self.ps > 0.0 || self.pc > 0.0 || self.aniso > 0.0;
        self.pr.is_some() || self.pm.is_some() || has_layers
    }

    /// The mirror of models 3 and above. Models 5 and 7 have Fresnel's equations.
    fn optical(&self, material: &mut Material) {
        material.reflect = self.ks.min(Vec3::ONE);
        if matches!(self.illum, 5 | 7) {
            material.fresnel = Fresnel::Exact;
            material.ior = if self.ni > 1.0 { self.ni } else { 1.5 };
        }
    }

    /// A metallic-roughness material. What `d` leaves out is a hole: the body of a metal does not refract.
    fn physical(&self, material: &mut Material) {
        let model = MetallicRoughness {
            base_color: self.kd,
            metallic: self.pm.unwrap_or(0.0).clamp(0.0, 1.0),
            roughness: self.pr.unwrap_or(0.5).clamp(0.0, 1.0),
            clearcoat: self.pc.clamp(0.0, 1.0),
            clearcoat_roughness: self.pcr.clamp(0.0, 1.0),
            sheen_color: Vec3::splat(self.ps.clamp(0.0, 1.0)),
            sheen_roughness: SHEEN_ROUGHNESS,
            anisotropy: self.aniso.clamp(0.0, 1.0),
            anisotropy_rotation: TAU * self.anisor.fract(),
            emission: self.ke,
            alpha: material.opacity,
            coverage: match material.opacity < 1.0 {
                true => Coverage::Blend,
                false => Coverage::Opaque,
            },
            ..MetallicRoughness::default()
        };
        *material = Material {
            metallic_roughness: Some(model.clone().into()),
            ..model.classical(String::new())
        };
    }
}
