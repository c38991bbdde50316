//! The materials of a scene in `glimray inspect`: physical ones with their own parameters.

use super::color;
use crate::app::console::quoted;
use crate::scene::{Coverage, Material, MetallicRoughness};
use glam::Vec3;
use serde_json::{Value, json};
use std::fmt::{self, Write};

pub fn material_json(material: &Material) -> Value {
    let mut value = json!({
        "name": material.name,
        "diffuse": material.diffuse.to_array(),
        "specular": material.specular.to_array(),
        "shininess": material.shininess,
        "ambient": material.ambient.to_array(),
        "two_sided": material.two_sided,
        "emission": material.emission.to_array(),
        "two_sided_emission": material.two_sided_emission,
        "reflect": material.reflect.to_array(),
        "transmit": material.transmit.to_array(),
        "ior": material.ior,
        "thin": material.thin,
        "absorption": material.absorption.to_array(),
        "priority": material.priority,
    });
    if let Some(model) = &material.metallic_roughness {
        value["physical"] = physical_json(material, model);
    }
    value
}

fn physical_json(material: &Material, model: &MetallicRoughness) -> Value {
    json!({
        "base_color": (model.base_color * material.tint).to_array(),
        "alpha": model.alpha,
        "coverage": coverage(model.coverage),
        "metallic": model.metallic,
        "roughness": model.roughness,
        "emission": model.emission.to_array(),
        "unlit": model.unlit,
        "ior": model.ior,
        "specular": model.specular,
        "specular_color": model.specular_color.to_array(),
        "transmission": model.transmission,
        "thickness": model.thickness,
        "attenuation_color": model.attenuation_color.to_array(),
        // Infinite for a clear volume, which JSON writes as null.
        "attenuation_distance": model.attenuation_distance,
        "clearcoat": model.clearcoat,
        "clearcoat_roughness": model.clearcoat_roughness,
        "sheen_color": model.sheen_color.to_array(),
        "sheen_roughness": model.sheen_roughness,
        "anisotropy": model.anisotropy,
        "anisotropy_rotation": model.anisotropy_rotation,
        "iridescence": model.iridescence,
        "iridescence_ior": model.iridescence_ior,
        "iridescence_thickness": model.iridescence_thickness,
        "dispersion": model.dispersion,
        "diffuse_transmission": model.diffuse_transmission,
        "diffuse_transmission_color": model.diffuse_transmission_color.to_array(),
    })
}

fn coverage(coverage: Coverage) -> &'static str {
    match coverage {
        Coverage::Opaque => "opaque",
        Coverage::Mask(_) => "mask",
        Coverage::Blend => "blend",
    }
}

pub fn material_text(out: &mut String, material: &Material) -> fmt::Result {
    if let Some(model) = &material.metallic_roughness {
        return physical_text(out, material, model);
    }
    write!(
        out,
        "{} diffuse {}, specular {}, shininess {}",
        quoted(&material.name),
        color(material.diffuse),
        color(material.specular),
        material.shininess
    )?;
    for (what, value) in [
        ("reflect", material.reflect),
        ("transmit", material.transmit),
        ("absorption", material.absorption),
        ("emission", material.emission),
    ] {
        if value != Vec3::ZERO {
            write!(out, ", {what} {}", color(value))?;
        }
    }
    match material.thin {
        _ if material.transmit == Vec3::ZERO => {}
        true => write!(out, ", thin")?,
        false => write!(out, ", ior {}", material.ior)?,
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
    if model.coverage != Coverage::Opaque {
        write!(out, ", {}, alpha {}", coverage(model.coverage), model.alpha)?;
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
        ("emission", model.emission, Vec3::ZERO),
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
