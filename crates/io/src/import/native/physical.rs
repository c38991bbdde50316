//! The metallic-roughness materials of a native scene.

use super::file::{ColorOrTexture, FractionOrTexture, NumberTable, PbrTable, Spanned};
use super::textures::Textures;
use super::values::{Color, or};
use crate::import::error::ImportError;
use glam::Vec3;
use glimray_scene::{LayerTextures, Material, MetallicRoughness};
use std::ops::Range;

/// The material that `table` describes.
pub(super) fn material(table: &PbrTable, textures: &mut Textures) -> Result<Material, ImportError> {
    let mut layers = LayerTextures::default();
    let plain = PbrTable::plain();
    let rotation = table.anisotropy_rotation_deg;
    let mut model = MetallicRoughness {
        unlit: table.unlit.unwrap_or_default(),
        ior: or(table.ior, plain.ior),
        thickness: or(table.thickness, plain.thickness),
        attenuation_color: unit(table.attenuation_color.as_ref(), textures)?,
        attenuation_distance: table
            .attenuation_distance
            .map_or(f32::INFINITY, |d| d.0 as f32),
        anisotropy_rotation: rotation.map_or(0.0, |angle| angle.0.to_radians() as f32),
        iridescence_ior: or(table.iridescence_ior, plain.iridescence_ior),
        iridescence_thickness: (table.iridescence_thickness.as_ref())
            .map_or(plain.iridescence_thickness, |range| range.0),
        dispersion: or(table.dispersion, plain.dispersion),
        ..plain
    };
    let tint = unit(table.tint.as_ref(), textures)?;
    macro_rules! colors {
        ($($name:ident)*) => {
            $((model.$name, layers.$name) = unit_color(table.$name.as_ref(), model.$name, textures)?;)*
        };
    }
    macro_rules! numbers {
        ($($name:ident)*) => {
            $((model.$name, layers.$name) = number(table.$name.as_ref(), model.$name, textures)?;)*
        };
    }
    // Where a texture is used first, it gets its index.
    colors!(base_color);
    numbers!(metallic roughness transmission specular);
    (model.specular_color, layers.specular_color) =
        textures.color(table.specular_color.as_ref(), model.specular_color)?;
    numbers!(clearcoat clearcoat_roughness);
    if let Some(map) = &table.clearcoat_normal_map {
        layers.clearcoat_normal = Some(textures.data_map(map)?);
        model.clearcoat_normal_scale = or(map.strength, 1.0);
    }
    colors!(sheen_color);
    numbers!(sheen_roughness anisotropy iridescence);
    if let Some(map) = &table.iridescence_thickness_map {
        if map.value.is_some() {
            let why = "a map between two thicknesses has no `value`";
            return Err(textures.refuse(map.span(), why, "Change the thicknesses instead"));
        }
        layers.iridescence_thickness = Some(texture(map.get_ref(), map.span(), textures)?);
    } else if model.iridescence_thickness[0] > model.iridescence_thickness[1] {
        let why = "the thinnest part is thicker than the thickest, and there is no map";
        let todo = "Give the smaller number first, or an `iridescence_thickness_map`";
        let span = table.iridescence_thickness.as_ref().map(Spanned::span);
        return Err(textures.refuse(span.unwrap_or_default(), why, todo));
    }
    numbers!(diffuse_transmission);
    colors!(diffuse_transmission_color);
    for (value, map) in [
        (&table.specular, layers.specular),
        (&table.sheen_roughness, layers.sheen_roughness),
        (&table.diffuse_transmission, layers.diffuse_transmission),
    ] {
        if let (Some(value), Some(map)) = (value, map)
            && !textures.has_alpha(map)
        {
            let why = "this number is read from the alpha of a texture, which only pictures have";
            return Err(textures.refuse(value.span(), why, "Give it a picture, or a number"));
        }
    }
    model.textures = layers;
    Ok(Material {
        tint,
        priority: or(table.priority, 0),
        ..model.into()
    })
}

/// A colour from 0 to 1.
fn unit(color: Option<&Spanned<Color>>, textures: &Textures) -> Result<Vec3, ImportError> {
    let Some(color) = color else {
        return Ok(Vec3::ONE);
    };
    let value = color.0;
    match value.max_element() <= 1.0 {
        true => Ok(value),
        false => Err(too_bright(color.span(), textures)),
    }
}

/// A colour from 0 to 1, and the texture that multiplies it.
fn unit_color(
    color: Option<&Spanned<ColorOrTexture>>,
    default: Vec3,
    textures: &mut Textures,
) -> Result<(Vec3, Option<usize>), ImportError> {
    let (value, texture) = textures.color(color, default)?;
    let largest = texture.map_or(Vec3::ONE, |texture| textures.largest(texture));
    match color {
        Some(color) if (value * largest).max_element() > 1.0 => {
            Err(too_bright(color.span(), textures))
        }
        _ => Ok((value, texture)),
    }
}

fn too_bright(span: Range<usize>, textures: &Textures) -> ImportError {
    let why = "a channel of this colour is above 1, so the surface would create light";
    textures.refuse(span, why, "Lower it, or use `emission`")
}

/// A number from 0 to 1, and the texture that multiplies it.
fn number(
    value: Option<&Spanned<FractionOrTexture>>,
    default: f32,
    textures: &mut Textures,
) -> Result<(f32, Option<usize>), ImportError> {
    let Some(value) = value else {
        return Ok((default, None));
    };
    let table = match value.get_ref() {
        FractionOrTexture::Fraction(value) => return Ok((value.0, None)),
        FractionOrTexture::Table(table) => table,
    };
    let index = texture(table, value.span(), textures)?;
    Ok((or(table.value, 1.0), Some(index)))
}

/// A texture of numbers from 0 to 1.
fn texture(
    table: &NumberTable,
    span: Range<usize>,
    textures: &mut Textures,
) -> Result<usize, ImportError> {
    let index = textures.number(table, span.clone())?;
    match textures.largest(index).max_element() <= 1.0 {
        true => Ok(index),
        false => {
            let why = "this texture has numbers above 1";
            Err(textures.refuse(span, why, "Lower its colours"))
        }
    }
}
