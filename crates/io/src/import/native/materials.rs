//! The materials of a native scene.

use super::Texts;
use super::file::{CoverageTable, MaterialTable, OpticsTable, PhongTable, RefractTable};
use super::physical;
use super::textures::Textures;
use crate::import::error::ImportError;
use crate::import::suggest;
use glam::Vec3;
use glimray_scene::{Coverage, Fresnel, Material, Phong};
use std::collections::HashMap;
use std::ops::Range;
use toml::Spanned;

/// The material that `table` describes.
pub(super) fn material(
    name: &str,
    table: &MaterialTable,
    textures: &mut Textures,
) -> Result<Material, ImportError> {
    let (coverage, alpha) = match &table.coverage {
        Some(CoverageTable { alpha, mask, .. }) => match mask {
            Some(least) => (Coverage::Mask(least.0), alpha.0),
            None => (Coverage::Blend, alpha.0),
        },
        None => (Coverage::Opaque, 1.0),
    };
    let mut material = match &table.pbr {
        Some(pbr) => physical::material(pbr.get_ref(), textures)?,
        None => Material::default(),
    };
    // Beside `pbr`, `phong` and `optics` say what the classical integrators show instead.
    let mut phong = material.classical().into_owned();
    match &table.phong {
        Some(own) => with_phong(&mut phong, own, textures)?,
        None if table.pbr.is_none() => {
            with_phong(&mut phong, &PhongTable::default(), textures)?;
        }
        None => {}
    }
    if let Some(emission) = &table.emission {
        (material.emission, material.textures.emission) = textures.color(emission)?;
        let is_black = (material.emission, material.textures.emission) == (Vec3::ZERO, None);
        if let Some(model) = material.metallic_roughness_mut()
            && model.unlit
            && is_black
        {
            model.base_color = Vec3::ZERO;
        }
    }
    name.clone_into(&mut material.name);
    material.two_sided = table.two_sided;
    material.two_sided_emission = table.two_sided_emission;
    material.thin = table.thin;
    material.shadow_catcher = table.shadow_catcher;
    (material.coverage, material.alpha) = (coverage, alpha);
    if let Some(map) = table.coverage.as_ref().and_then(|it| it.map.as_ref()) {
        material.textures.alpha = textures.color(map)?.1;
    }
    if let Some(map) = &table.height_map {
        if table.normal_map.is_some() {
            let why = "a surface has a normal map or a height map";
            return Err(textures.refuse(map.span(), why, "Leave out one of them"));
        }
        material.textures.normal = Some(textures.height_map(map)?);
        material.normal_scale = map.get_ref().height().abs() as f32;
    }
    if let Some(map) = &table.normal_map {
        material.textures.normal = Some(textures.data_map(map)?);
        material.normal_scale = map.get_ref().strength.0;
    }
    if let Some(map) = &table.occlusion_map {
        material.textures.occlusion = Some(textures.data_map(map)?);
        material.occlusion_strength = map.get_ref().strength.0.min(1.0);
    }
    if let Some(optics) = &table.optics {
        if table.reflect.is_some() || table.refract.is_some() {
            let why = "`optics` replaces `reflect` and `refract`";
            return Err(textures.refuse(optics.span(), why, "Leave out the others"));
        }
        material.priority = optics.get_ref().priority.0;
        with_optics(&mut phong, optics.get_ref(), textures)?;
        material.set_classical(phong);
        return Ok(material);
    }
    if let (Some(pbr), true) = (
        &table.pbr,
        table.reflect.is_some() || table.refract.is_some(),
    ) {
        let why = "`pbr` determines reflection and transmission";
        let todo =
            "Leave out `reflect` and `refract`, or write `optics` for the classical integrators";
        return Err(textures.refuse(pbr.span(), why, todo));
    }
    let mut mirrored = 0.0;
    if let Some(reflect) = &table.reflect {
        mirrored = reflect.amount.0;
        let color = textures.color(&reflect.color)?;
        phong.reflect = mirrored * color.0;
        phong.textures.reflect = color.1;
        phong.fresnel = reflect.fresnel.into();
        phong.ior = reflect.ior.0;
    }
    if let Some(refract) = &table.refract {
        check(table, refract, mirrored, textures)?;
        let refract = refract.get_ref();
        let amount = refract.amount.0;
        let color = textures.color(&refract.color)?;
        phong.transmit = amount * color.0;
        phong.textures.transmit = color.1;
        phong.opacity = 1.0 - amount;
        phong.ior = refract.ior.0;
        phong.absorption = refract.absorption.0;
        material.priority = refract.priority.0;
        phong.fresnel = refract.fresnel.into();
        if phong.fresnel != Fresnel::None {
            phong.reflect = Vec3::splat(amount);
        }
    }
    material.set_classical(phong);
    Ok(material)
}

fn with_phong(
    phong: &mut Phong,
    table: &PhongTable,
    textures: &mut Textures,
) -> Result<(), ImportError> {
    let own = &mut phong.textures;
    (phong.diffuse, own.diffuse) = textures.color(&table.diffuse)?;
    (phong.specular, own.specular) = textures.color(&table.specular)?;
    (phong.ambient, own.ambient) = match &table.ambient {
        Some(ambient) => textures.color(ambient)?,
        None => (phong.diffuse, own.diffuse),
    };
    phong.shininess = table.shininess.0;
    Ok(())
}

fn with_optics(
    phong: &mut Phong,
    optics: &OpticsTable,
    textures: &mut Textures,
) -> Result<(), ImportError> {
    (phong.reflect, phong.textures.reflect) = textures.color(&optics.reflect)?;
    (phong.transmit, phong.textures.transmit) = textures.color(&optics.transmit)?;
    phong.opacity = optics.opacity.0;
    phong.ior = optics.ior.0 as f32;
    phong.absorption = optics.absorption.0;
    phong.fresnel = optics.fresnel.into();
    phong.mixing = optics.mixing.into();
    Ok(())
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
