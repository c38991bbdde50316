//! A material of a library as the renderer's: what `illum`, `d`, `Ni` and the physically based keys mean.
//!
//! Sources: Wavefront, Object Files and MTL, version 4.2, 1995; Exocortex, Physically Based Extensions of
//! MTL, 2012.

use glam::Vec3;
use glimray_scene::{Coverage, Fresnel, Material, MetallicRoughness};
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
        let default = Material::default();
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
        let opacity = self.opacity();
        let mut material = Material {
            diffuse: self.kd,
            specular: if self.illum == 1 { Vec3::ZERO } else { self.ks },
            ambient: self.ka.unwrap_or(self.kd),
            shininess: self.ns,
            emission: self.ke,
            opacity,
            transmit: self.transmit(),
            shadow_catcher: self.illum == 10,
            ..Material::default()
        };
        if self.is_physical() {
            self.physical(&mut material);
        } else if matches!(self.illum, 3..=7) {
            self.optical(&mut material);
        }
        // Models 6 and 7 refract; others are seen straight through.
        match self.refracts() {
            true => material.ior = self.ni,
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
    fn optical(&self, material: &mut Material) {
        material.reflect = self.ks.min(Vec3::ONE);
        if matches!(self.illum, 5 | 7) {
            material.fresnel = Fresnel::Exact;
            material.ior = if self.ni > 1.0 { self.ni } else { 1.5 };
        }
    }

    /// A metallic-roughness material. What `d` leaves out is a hole: the body of a metal does not refract.
    fn physical(&self, material: &mut Material) {
        let opacity = material.opacity;
        let usual = MetallicRoughness::default();
        let model = MetallicRoughness {
            base_color: self.kd,
            metallic: self.pm.unwrap_or(0.0),
            roughness: self.pr.unwrap_or(0.5),
            clearcoat: self.pc.unwrap_or(0.0),
            clearcoat_roughness: self.pcr.unwrap_or(0.0),
            sheen_color: Vec3::splat(self.ps.unwrap_or(0.0)),
            sheen_roughness: SHEEN_ROUGHNESS,
            anisotropy: self.aniso,
            anisotropy_rotation: TAU * self.anisor.fract(),
            emission: self.ke,
            ior: if self.ni > 1.0 { self.ni } else { usual.ior },
            alpha: opacity,
            coverage: match opacity < 1.0 {
                true => Coverage::Blend,
                false => Coverage::Opaque,
            },
            ..usual
        };
        *material = Material {
            metallic_roughness: Some(model.clone().into()),
            shadow_catcher: material.shadow_catcher,
            ..model.classical(String::new())
        };
    }
}
