//! The materials of a native scene.

use super::Texts;
use super::file::{
    CoverageTable, IOR, MaterialTable, OpticsTable, PhongTable, RefractTable, Spanned,
};
use super::physical;
use super::textures::Textures;
use super::values::or;
use crate::import::error::ImportError;
use crate::import::suggest;
use glam::Vec3;
use glimray_scene::{Coverage, Fresnel, Material, Phong};
use std::collections::HashMap;
use std::ops::Range;

/// The material that `table` describes.
pub(super) fn material(
    name: &str,
    table: &MaterialTable,
    textures: &mut Textures,
) -> Result<Material, ImportError> {
    let (coverage, alpha) = match &table.coverage {
        Some(CoverageTable { alpha, mask, .. }) => match mask {
            Some(least) => (Coverage::Mask(least.0), or(*alpha, 1.0)),
            None => (Coverage::Blend, or(*alpha, 1.0)),
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
        (material.emission, material.textures.emission) =
            textures.color(Some(emission), Vec3::ZERO)?;
        let is_black = (material.emission, material.textures.emission) == (Vec3::ZERO, None);
        if let Some(model) = material.metallic_roughness_mut()
            && model.unlit
            && is_black
        {
            model.base_color = Vec3::ZERO;
        }
    }
    name.clone_into(&mut material.name);
    material.two_sided = table.two_sided.unwrap_or(true);
    material.two_sided_emission = table.two_sided_emission.unwrap_or(true);
    material.thin = table.thin.unwrap_or_default();
    material.shadow_catcher = table.shadow_catcher.unwrap_or_default();
    (material.coverage, material.alpha) = (coverage, alpha);
    let map = table.coverage.as_ref().and_then(|it| it.map.as_ref());
    material.textures.alpha = textures.color(map, Vec3::ONE)?.1;
    if let Some(map) = &table.height_map {
        if table.normal_map.is_some() {
            let why = "a surface has a normal map or a height map";
            return Err(textures.refuse(map.span(), why, "Leave out one of them"));
        }
        material.textures.normal = Some(textures.height_map(map)?);
        material.normal_scale = map.height().abs() as f32;
    }
    if let Some(map) = &table.normal_map {
        material.textures.normal = Some(textures.data_map(map)?);
        material.normal_scale = or(map.strength, 1.0);
    }
    if let Some(map) = &table.occlusion_map {
        material.textures.occlusion = Some(textures.data_map(map)?);
        material.occlusion_strength = or(map.strength, 1.0_f32).min(1.0);
    }
    if let Some(optics) = &table.optics {
        if table.reflect.is_some() || table.refract.is_some() {
            let why = "`optics` replaces `reflect` and `refract`";
            return Err(textures.refuse(optics.span(), why, "Leave out the others"));
        }
        material.priority = or(optics.priority, 0);
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
        mirrored = or(reflect.amount, 1.0);
        let color = textures.color(reflect.color.as_ref(), Vec3::ONE)?;
        phong.reflect = mirrored * color.0;
        phong.textures.reflect = color.1;
        phong.fresnel = or(reflect.fresnel, Fresnel::None);
        phong.ior = or(reflect.ior, IOR);
    }
    if let Some(refract) = &table.refract {
        check(table, refract, mirrored, textures)?;
        let refract = refract.get_ref();
        let amount = or(refract.amount, 1.0);
        let color = textures.color(refract.color.as_ref(), Vec3::ONE)?;
        phong.transmit = amount * color.0;
        phong.textures.transmit = color.1;
        phong.opacity = 1.0 - amount;
        phong.ior = or(refract.ior, IOR);
        phong.absorption = or(refract.absorption, Vec3::ZERO);
        material.priority = or(refract.priority, 0);
        phong.fresnel = or(refract.fresnel, Fresnel::Exact);
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
    let (own, plain) = (&mut phong.textures, PhongTable::plain());
    (phong.diffuse, own.diffuse) = textures.color(table.diffuse.as_ref(), plain.diffuse)?;
    (phong.specular, own.specular) = textures.color(table.specular.as_ref(), plain.specular)?;
    (phong.ambient, own.ambient) = match &table.ambient {
        Some(ambient) => textures.color(Some(ambient), plain.ambient)?,
        None => (phong.diffuse, own.diffuse),
    };
    phong.shininess = or(table.shininess, plain.shininess);
    Ok(())
}

fn with_optics(
    phong: &mut Phong,
    optics: &OpticsTable,
    textures: &mut Textures,
) -> Result<(), ImportError> {
    let (own, plain) = (&mut phong.textures, Phong::default());
    (phong.reflect, own.reflect) = textures.color(optics.reflect.as_ref(), plain.reflect)?;
    (phong.transmit, own.transmit) = textures.color(optics.transmit.as_ref(), plain.transmit)?;
    phong.opacity = or(optics.opacity, plain.opacity);
    phong.ior = optics.ior.map_or(plain.ior, |ior| ior.0 as f32);
    phong.absorption = or(optics.absorption, plain.absorption);
    phong.fresnel = or(optics.fresnel, plain.fresnel);
    phong.mixing = or(optics.mixing, plain.mixing);
    Ok(())
}

/// Refuses a material that specifies reflection twice, or creates energy.
fn check(
    table: &MaterialTable,
    refract: &Spanned<RefractTable>,
    mirrored: f32,
    textures: &Textures,
) -> Result<(), ImportError> {
    let is_split = or(refract.fresnel, Fresnel::Exact) != Fresnel::None;
    let (why, todo) = if table.reflect.is_some() && is_split {
        (
            "Fresnel's equations already determine how much a refracting surface reflects",
            "Leave out `reflect`, or add `fresnel = \"none\"` to `refract`",
        )
    } else if mirrored + or(refract.amount, 1.0_f32) > 1.0 {
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
