//! The materials of a native scene.

use super::Texts;
use super::file::{MaterialTable, OpticsTable, RefractTable};
use super::textures::Textures;
use crate::import::error::ImportError;
use crate::import::suggest;
use crate::scene::{self, Coverage, Fresnel, Material};
use glam::Vec3;
use std::collections::HashMap;
use std::ops::Range;
use toml::Spanned;

/// The material that `table` describes.
pub(super) fn material(
    name: &str,
    table: &MaterialTable,
    textures: &mut Textures,
) -> Result<Material, ImportError> {
    let phong = &table.phong;
    let diffuse = textures.color(&phong.diffuse)?;
    let specular = textures.color(&phong.specular)?;
    let ambient = match &phong.ambient {
        Some(ambient) => textures.color(ambient)?,
        None => diffuse,
    };
    let emission = textures.color(&table.emission)?;
    let mut material = Material {
        name: name.to_owned(),
        diffuse: diffuse.0,
        specular: specular.0,
        shininess: phong.shininess.0,
        ambient: ambient.0,
        two_sided: table.two_sided,
        thin: table.thin,
        emission: emission.0,
        textures: scene::Textures {
            diffuse: diffuse.1,
            specular: specular.1,
            ambient: ambient.1,
            emission: emission.1,
            ..scene::Textures::default()
        },
        ..Material::default()
    };
    if let Some(map) = &table.normal_map {
        material.textures.normal = Some(textures.data_map(map)?);
        material.normal_scale = map.get_ref().strength.0;
    }
    if let Some(map) = &table.occlusion_map {
        material.textures.occlusion = Some(textures.data_map(map)?);
        material.occlusion_strength = map.get_ref().strength.0.min(1.0);
    }
    if let Some(coverage) = &table.coverage {
        material.coverage = match coverage.mask {
            Some(least) => Coverage::Mask(least.0),
            None => Coverage::Blend,
        };
        material.alpha = coverage.alpha.0;
        if let Some(map) = &coverage.map {
            material.textures.alpha = textures.color(map)?.1;
        }
    }
    if let Some(optics) = &table.optics {
        if table.reflect.is_some() || table.refract.is_some() {
            let why = "`optics` replaces `reflect` and `refract`";
            return Err(textures.refuse(optics.span(), why, "Leave out the others"));
        }
        return with_optics(material, optics.get_ref(), textures);
    }
    let mut mirrored = 0.0;
    if let Some(reflect) = &table.reflect {
        mirrored = reflect.amount.0;
        let color = textures.color(&reflect.color)?;
        material.reflect = mirrored * color.0;
        material.textures.reflect = color.1;
        material.fresnel = reflect.fresnel.into();
        material.ior = reflect.ior.0;
    }
    if let Some(refract) = &table.refract {
        check(table, refract, mirrored, textures)?;
        let refract = refract.get_ref();
        let amount = refract.amount.0;
        let color = textures.color(&refract.color)?;
        material.transmit = amount * color.0;
        material.textures.transmit = color.1;
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

fn with_optics(
    material: Material,
    optics: &OpticsTable,
    textures: &mut Textures,
) -> Result<Material, ImportError> {
    let reflect = textures.color(&optics.reflect)?;
    let transmit = textures.color(&optics.transmit)?;
    Ok(Material {
        reflect: reflect.0,
        transmit: transmit.0,
        opacity: optics.opacity.0,
        ior: optics.ior.0 as f32,
        absorption: optics.absorption.0,
        priority: optics.priority.0,
        fresnel: optics.fresnel.into(),
        mixing: optics.mixing.into(),
        textures: scene::Textures {
            reflect: reflect.1,
            transmit: transmit.1,
            ..material.textures
        },
        ..material
    })
}

/// Refuses a material that specifies reflection twice, or creates energy.
fn check(
    table: &MaterialTable,
    refract: &Spanned<RefractTable>,
    mirrored: f32,
    textures: &Textures,
) -> Result<(), ImportError> {
    let is_split = Fresnel::from(refract.get_ref().fresnel) != Fresnel::None;
    let (why, todo) = if table.reflect.is_some() && is_split {
        (
            "Fresnel's equations already determine how much a refracting surface reflects",
            "Leave out `reflect`, or add `fresnel = \"none\"` to `refract`",
        )
    } else if mirrored + refract.get_ref().amount.0 > 1.0 {
        (
            "the sum of `amount` and that of `reflect` exceeds 1",
            "Lower one of them",
        )
    } else {
        return Ok(());
    };
    Err(textures.refuse(refract.span(), why, todo))
}

/// The index of the material `name`.
pub(super) fn named(
    names: &HashMap<String, usize>,
    name: &str,
    span: Range<usize>,
    texts: &Texts,
) -> Result<usize, ImportError> {
    names.get(name).copied().ok_or_else(|| {
        let mut known: Vec<&str> = names.keys().map(String::as_str).collect();
        known.sort_unstable();
        let why = suggest::unknown("material", name, known);
        let todo = "Add it under [materials], or use an existing one";
        texts.malformed(span, why, todo)
    })
}
