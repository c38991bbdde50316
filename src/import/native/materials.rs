//! The materials of a native scene.

use super::Texts;
use super::file::{MaterialTable, RefractTable};
use crate::import::error::ImportError;
use crate::scene::{Fresnel, Material};
use glam::Vec3;
use toml::Spanned;

/// The material that `table` describes.
pub(super) fn material(
    name: &str,
    table: &MaterialTable,
    texts: &Texts,
) -> Result<Material, ImportError> {
    let phong = &table.phong;
    let mut material = Material {
        name: name.to_owned(),
        diffuse: phong.diffuse.0,
        specular: phong.specular.0,
        shininess: phong.shininess.0,
        ambient: phong.ambient.unwrap_or(phong.diffuse).0,
        two_sided: table.two_sided,
        emission: table.emission.0,
        ..Material::default()
    };
    let mut mirrored = 0.0;
    if let Some(reflect) = &table.reflect {
        mirrored = reflect.amount.0;
        material.reflect = mirrored * reflect.color.0;
        material.fresnel = reflect.fresnel.into();
        material.ior = reflect.ior.0;
    }
    if let Some(refract) = &table.refract {
        check(table, refract, mirrored, texts)?;
        let refract = refract.get_ref();
        let amount = refract.amount.0;
        material.transmit = amount * refract.color.0;
        material.opacity = 1.0 - amount;
        material.ior = refract.ior.0;
        material.absorption = refract.absorption.0;
        material.priority = refract.priority.0;
        material.fresnel = refract.fresnel.into();
        if material.fresnel != Fresnel::None {
            material.reflect = Vec3::splat(amount);
        }
    }
    Ok(material)
}

/// Refuses a material that asks for mirrored light in two ways, or makes light.
fn check(
    table: &MaterialTable,
    refract: &Spanned<RefractTable>,
    mirrored: f32,
    texts: &Texts,
) -> Result<(), ImportError> {
    let is_split = Fresnel::from(refract.get_ref().fresnel) != Fresnel::None;
    let (why, todo) = if table.reflect.is_some() && is_split {
        (
            "Fresnel's equations say already how much a refracting surface mirrors".to_owned(),
            "Leave out `reflect`, or add `fresnel = \"none\"` to `refract`",
        )
    } else if mirrored + refract.get_ref().amount.0 > 1.0 {
        (
            "`amount` and that of `reflect` are more than 1 together".to_owned(),
            "Lower one of them",
        )
    } else {
        return Ok(());
    };
    Err(texts.malformed(refract.span(), why, todo))
}
