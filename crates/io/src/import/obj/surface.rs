//! A material of a library as the renderer's: what `illum`, `d`, `Ni` and the physically based keys mean.
//!
//! Sources: Wavefront, Object Files and MTL, version 4.2, 1995; Exocortex, Physically Based Extensions of
//! MTL, 2012.

use glam::Vec3;
use glimray_scene::{Coverage, Fresnel, Material, MetallicRoughness, Phong};
use std::f32::consts::TAU;

/// The values of a material, by their keys.
#[derive(Clone, Copy)]
pub(super) struct Values {
    pub kd: Vec3,
    pub ks: Vec3,
    pub ka: Option<Vec3>,
    pub ke: Vec3,
    pub tf: Option<Vec3>,
    pub ns: f32,
    pub ni: f32,
    /// 1 is opaque.
    pub d: Option<f32>,
    /// 1 - d, unless `tr_is_d`. Not in the specification, so `d` counts before it.
    pub tr: Option<f32>,
    pub tr_is_d: bool,
    pub illum: u32,
    pub pr: Option<f32>,
    pub pm: Option<f32>,
    /// Sheen, clear coat and its roughness, anisotropy and its direction in turns.
    pub ps: Option<f32>,
    pub pc: Option<f32>,
    pub pcr: Option<f32>,
    pub aniso: f32,
    pub anisor: f32,
}

/// MTL has no number for it.
const SHEEN_ROUGHNESS: f32 = 0.5;

impl Default for Values {
    fn default() -> Self {
        let default = Phong::default();
        Self {
            kd: default.diffuse,
            ks: default.specular,
            ka: None,
            ke: Vec3::ZERO,
            tf: None,
            ns: default.shininess,
            ni: 1.0,
            d: None,
            tr: None,
            tr_is_d: false,
            illum: 2,
            pr: None,
            pm: None,
            ps: None,
            pc: None,
            pcr: None,
            aniso: 0.0,
            anisor: 0.0,
        }
    }
}

impl Values {
    /// The material, without name and textures.
    pub fn material(&self) -> Material {
        let mut material = Material {
            emission: self.ke,
            shadow_catcher: self.illum == 10,
            ..Material::default()
        };
        let mut phong = if self.is_physical() {
            material.bsdf = self.physical().into();
            self.cover(&mut material);
            material.classical().into_owned()
        } else {
            self.phong()
        };
        // Models 6 and 7 refract; others are seen straight through.
        if self.refracts() {
            phong.ior = self.ni;
        } else {
            material.thin = phong.transmit != Vec3::ZERO;
        }
        if self.illum == 0 {
            // A constant colour.
            material.emission += self.kd;
            phong.diffuse = Vec3::ZERO;
            phong.ambient = Vec3::ZERO;
            phong.specular = Vec3::ZERO;
        }
        material.set_classical(phong);
        material
    }

    /// The coefficients of the models of the specification.
    fn phong(&self) -> Phong {
        let mut phong = Phong {
            diffuse: self.kd,
            specular: if self.illum == 1 { Vec3::ZERO } else { self.ks },
            ambient: self.ka.unwrap_or(self.kd),
            shininess: self.ns,
            opacity: self.opacity(),
            transmit: self.transmit(),
            ..Phong::default()
        };
        if matches!(self.illum, 3..=7) {
            self.optical(&mut phong);
        }
        phong
    }

    fn opacity(&self) -> f32 {
        let of_tr = |tr| if self.tr_is_d { tr } else { 1.0 - tr };
        self.d.or(self.tr.map(of_tr)).unwrap_or(1.0)
    }

    fn refracts(&self) -> bool {
        matches!(self.illum, 6 | 7)
    }

    /// Whether nothing dissolves a material of models 4 and 9, glass, that has no colour of its own and a filter: by the
    /// specification its `d` is 1, which shows black.
    pub fn is_clear_pane(&self) -> bool {
        let is_dissolved = self.d.is_some() || self.tr.is_some();
        let is_glass = matches!(self.illum, 4 | 9) && self.kd == Vec3::ZERO;
        is_glass && !is_dissolved && self.tf.is_some_and(|tf| tf != Vec3::ZERO)
    }

    /// The light that passes: by models 6 and 7 what `Tf` lets through, whatever `d` is; otherwise what `d` leaves out,
    /// filtered by `Tf`. More than the colour of the surface leaves does not pass, so that no light is gained.
    fn transmit(&self) -> Vec3 {
        let opacity = self.opacity();
        let filter = self.tf.unwrap_or(Vec3::ONE);
        let is_dissolved = self.d.is_some() || self.tr.is_some();
        let by_filter = self.refracts() && (self.tf.is_some() || !is_dissolved);
        if !by_filter && !self.is_clear_pane() {
            return (1.0 - opacity) * filter;
        }
        let left = (Vec3::ONE - opacity * self.kd).max(Vec3::ZERO);
        let unreflected = match self.illum {
            // Fresnel's equations subtract what is reflected.
            7 => Vec3::ONE,
            _ => (Vec3::ONE - self.ks).max(Vec3::ZERO),
        };
        (unreflected * filter).min(left)
    }

    /// Whether it is a metallic-roughness material: exporters write zeros for what a material lacks.
    fn is_physical(&self) -> bool {
        let has = |layer: Option<f32>| layer.is_some_and(|weight| weight > 0.0);
        let has_layers = has(self.ps) || has(self.pc) || self.aniso > 0.0;
        self.pr.is_some() || self.pm.is_some() || has_layers
    }

    /// The mirror of models 3 to 7: 8 and 9 do not trace rays. Models 5 and 7 have Fresnel's equations.
    fn optical(&self, phong: &mut Phong) {
        phong.reflect = self.ks.min(Vec3::ONE);
        if matches!(self.illum, 5 | 7) {
            phong.fresnel = Fresnel::Exact;
            phong.ior = if self.ni > 1.0 { self.ni } else { 1.5 };
        }
    }

    /// Makes what `d` leaves out of a metallic-roughness material a hole: the body of a metal does not refract.
    fn cover(&self, material: &mut Material) {
        material.alpha = self.opacity();
        if material.alpha < 1.0 {
            material.coverage = Coverage::Blend;
        }
    }

    /// The parameters of a metallic-roughness material.
    fn physical(&self) -> MetallicRoughness {
        let usual = MetallicRoughness::default();
        MetallicRoughness {
            base_color: self.kd,
            metallic: self.pm.unwrap_or(0.0),
            roughness: self.pr.unwrap_or(0.5),
            clearcoat: self.pc.unwrap_or(0.0),
            clearcoat_roughness: self.pcr.unwrap_or(0.0),
            sheen_color: Vec3::splat(self.ps.unwrap_or(0.0)),
            sheen_roughness: SHEEN_ROUGHNESS,
            anisotropy: self.aniso,
            anisotropy_rotation: TAU * self.anisor.fract(),
            ior: if self.ni > 1.0 { self.ni } else { usual.ior },
            ..usual
        }
    }
}
