//! The materials of a scene in `glimray inspect`: physical ones with their own parameters.

use super::color;
use glam::Vec3;
use glimray_app::console::quoted;
use glimray_scene::{Bsdf, Coverage, Material, MetallicRoughness};
use schemars::JsonSchema;
use serde::Serialize;
use std::fmt::{self, Write};

/// A material.
#[derive(Serialize, JsonSchema)]
pub struct MaterialEntry {
    name: String,
    diffuse: [f32; 3],
    specular: [f32; 3],
    shininess: f32,
    ambient: [f32; 3],
    two_sided: bool,
    emission: [f32; 3],
    two_sided_emission: bool,
    reflect: [f32; 3],
    transmit: [f32; 3],
    ior: f32,
    thin: bool,
    absorption: [f32; 3],
    priority: i32,
    /// The model of physically based materials, from which the other coefficients are made.
    #[serde(skip_serializing_if = "Option::is_none")]
    physical: Option<PhysicalEntry>,
}

/// The parameters of a physically based material, as in glTF.
#[derive(Serialize, JsonSchema)]
struct PhysicalEntry {
    base_color: [f32; 3],
    alpha: f32,
    /// `opaque`, `mask` or `blend`.
    coverage: &'static str,
    metallic: f32,
    roughness: f32,
    emission: [f32; 3],
    unlit: bool,
    ior: f32,
    specular: f32,
    specular_color: [f32; 3],
    transmission: f32,
    thickness: f32,
    attenuation_color: [f32; 3],
    /// Null if it is infinite: the volume is clear.
    attenuation_distance: Option<f32>,
    clearcoat: f32,
    clearcoat_roughness: f32,
    sheen_color: [f32; 3],
    sheen_roughness: f32,
    anisotropy: f32,
    /// In radians.
    anisotropy_rotation: f32,
    iridescence: f32,
    iridescence_ior: f32,
    /// Least and largest, in nanometres.
    iridescence_thickness: [f32; 2],
    dispersion: f32,
    diffuse_transmission: f32,
    diffuse_transmission_color: [f32; 3],
}

impl From<&Material> for MaterialEntry {
    fn from(material: &Material) -> Self {
        let physical = material.metallic_roughness();
        let phong = material.classical();
        Self {
            name: material.name.clone(),
            diffuse: phong.diffuse.into(),
            specular: phong.specular.into(),
            shininess: phong.shininess,
            ambient: phong.ambient.into(),
            two_sided: material.two_sided,
            emission: material.radiance().0.into(),
            two_sided_emission: material.two_sided_emission,
            reflect: phong.reflect.into(),
            transmit: phong.transmit.into(),
            ior: phong.ior,
            thin: material.is_thin(),
            absorption: phong.absorption.into(),
            priority: material.priority,
            physical: physical.map(|model| PhysicalEntry::new(material, model)),
        }
    }
}

impl PhysicalEntry {
    fn new(material: &Material, model: &MetallicRoughness) -> Self {
        let distance = model.attenuation_distance;
        Self {
            base_color: (model.base_color * material.tint).into(),
            alpha: material.alpha,
            coverage: coverage(material.coverage),
            metallic: model.metallic,
            roughness: model.roughness,
            emission: material.emission.into(),
            unlit: model.unlit,
            ior: model.ior,
            specular: model.specular,
            specular_color: model.specular_color.into(),
            transmission: model.transmission,
            thickness: model.thickness,
            attenuation_color: model.attenuation_color.into(),
            attenuation_distance: distance.is_finite().then_some(distance),
            clearcoat: model.clearcoat,
            clearcoat_roughness: model.clearcoat_roughness,
            sheen_color: model.sheen_color.into(),
            sheen_roughness: model.sheen_roughness,
            anisotropy: model.anisotropy,
            anisotropy_rotation: model.anisotropy_rotation,
            iridescence: model.iridescence,
            iridescence_ior: model.iridescence_ior,
            iridescence_thickness: model.iridescence_thickness,
            dispersion: model.dispersion,
            diffuse_transmission: model.diffuse_transmission,
            diffuse_transmission_color: model.diffuse_transmission_color.into(),
        }
    }
}

fn coverage(coverage: Coverage) -> &'static str {
    match coverage {
        Coverage::Opaque => "opaque",
        Coverage::Mask(_) => "mask",
        Coverage::Blend => "blend",
    }
}

pub fn material_text(out: &mut String, material: &Material) -> fmt::Result {
    let phong = match &material.bsdf {
        Bsdf::Phong(phong) => phong,
        Bsdf::MetallicRoughness(model) => return physical_text(out, material, model),
    };
    write!(
        out,
        "{} diffuse {}, specular {}, shininess {}",
        quoted(&material.name),
        color(phong.diffuse),
        color(phong.specular),
        phong.shininess
    )?;
    for (what, value) in [
        ("reflect", phong.reflect),
        ("transmit", phong.transmit),
        ("absorption", phong.absorption),
        ("emission", material.emission),
    ] {
        if value != Vec3::ZERO {
            write!(out, ", {what} {}", color(value))?;
        }
    }
    match material.thin {
        _ if phong.transmit == Vec3::ZERO => {}
        true => write!(out, ", thin")?,
        false => write!(out, ", ior {}", phong.ior)?,
    }
    Ok(())
}

/// The parameters of a physical material: the main ones, and others that differ from their defaults.
fn physical_text(out: &mut String, material: &Material, model: &MetallicRoughness) -> fmt::Result {
    let plain = MetallicRoughness::default();
    write!(
        out,
        "{} base colour {}, metallic {}, roughness {}",
        quoted(&material.name),
        color(model.base_color * material.tint),
        model.metallic,
        model.roughness
    )?;
    if model.unlit {
        write!(out, ", unlit")?;
    }
    if material.coverage != Coverage::Opaque {
        write!(
            out,
            ", {}, alpha {}",
            coverage(material.coverage),
            material.alpha
        )?;
    }
    for (what, value, usual) in [
        ("ior", model.ior, plain.ior),
        ("specular", model.specular, plain.specular),
        ("transmission", model.transmission, 0.0),
        ("thickness", model.thickness, 0.0),
        (
            "attenuation distance",
            model.attenuation_distance,
            f32::INFINITY,
        ),
        ("clear coat", model.clearcoat, 0.0),
        ("its roughness", model.clearcoat_roughness, 0.0),
        ("sheen roughness", model.sheen_roughness, 0.0),
        ("anisotropy", model.anisotropy, 0.0),
        ("iridescence", model.iridescence, 0.0),
        ("dispersion", model.dispersion, 0.0),
        ("diffuse transmission", model.diffuse_transmission, 0.0),
    ] {
        if value != usual {
            write!(out, ", {what} {value}")?;
        }
    }
    for (what, value, usual) in [
        ("emission", material.emission, Vec3::ZERO),
        ("specular colour", model.specular_color, Vec3::ONE),
        ("attenuation colour", model.attenuation_color, Vec3::ONE),
        ("sheen colour", model.sheen_color, Vec3::ZERO),
        (
            "diffuse transmission colour",
            model.diffuse_transmission_color,
            Vec3::ONE,
        ),
    ] {
        if value != usual {
            write!(out, ", {what} {}", color(value))?;
        }
    }
    Ok(())
}
