//! Colours of vertices, points and facets. Meshes have colours at their vertices; points are shapes and facets are even,
//! so each of their distinct colours becomes a material.

use super::budget;
use glam::{Vec3, Vec4};
use glimray_scene::{Bsdf, Material, Phong, linear_from_srgb};
use std::collections::HashMap;
use std::sync::Arc;

/// Limit of the number of materials. If there are more, colours keep fewer bits.
const MOST: usize = 32_768;

/// An sRGB colour in 8 bits a channel.
pub(super) type Rgb = [u8; 3];

/// Bytes of memory that [`tint`] takes.
pub(super) fn bytes() -> u64 {
    // The table has spare capacity, and names are short.
    budget::size::<(Material, [u64; 4], [u8; 32])>(MOST)
}

/// Gives each item the material of its colour. `ids` are indices into `materials` and become indices into
/// the result; items without a colour keep their material. A colour multiplies the diffuse and ambient
/// colours of the material. Also returns how many bits of each channel were kept: 8 unless there are too many
/// distinct colours.
pub(super) fn tint(
    materials: &[Material],
    ids: &mut [u32],
    colors: &[Option<Rgb>],
) -> (Vec<Material>, u32) {
    for bits in (0..=8).rev() {
        let key = |id: u32, color: Option<Rgb>| {
            let color = color.map_or(1 << 24, |color| {
                let [r, g, b] = color.map(|c| u64::from(kept(c, bits)));
                r << 16 | g << 8 | b
            });
            u64::from(id) << 32 | color
        };
        let mut indices: HashMap<u64, u32> = HashMap::new();
        for (&id, &color) in ids.iter().zip(colors) {
            let next = indices.len() as u32;
            indices.entry(key(id, color)).or_insert(next);
            if indices.len() > MOST && bits > 0 {
                break;
            }
        }
        if indices.len() > MOST && bits > 0 {
            continue;
        }
        for (id, &color) in ids.iter_mut().zip(colors) {
            *id = indices.get(&key(*id, color)).copied().unwrap_or_default();
        }
        let mut keys: Vec<(u64, u32)> = indices.into_iter().collect();
        keys.sort_unstable_by_key(|&(_, index)| index);
        let tinted = keys.into_iter().map(|(key, _)| {
            let material = &materials[(key >> 32) as usize];
            match key as u32 {
                color if color >> 24 == 0 => tinted(material, color),
                _ => material.clone(),
            }
        });
        return (tinted.collect(), bits);
    }
    (materials.to_vec(), 0)
}

/// `material` in the colour 0xrrggbb.
fn tinted(material: &Material, color: u32) -> Material {
    let [_, r, g, b] = color.to_be_bytes();
    let linear = Vec3::from([r, g, b].map(|c| linear_from_srgb(f64::from(c) / 255.0) as f32));
    let separator = if material.name.is_empty() { "" } else { " " };
    let mut tinted = Material {
        name: format!("{}{separator}#{color:06x}", material.name),
        ..material.clone()
    };
    let own = match &mut tinted.bsdf {
        Bsdf::Phong(phong) => Some(phong),
        Bsdf::MetallicRoughness(model) => {
            tinted.tint = linear;
            // Materials share what needs no change.
            (model.phong.is_some())
                .then(|| Arc::make_mut(model).phong.as_deref_mut())
                .flatten()
        }
    };
    if let Some(phong) = own {
        phong.diffuse *= linear;
        phong.ambient *= linear;
    }
    tinted
}

/// The upper bits of a channel, spread over its range so that white stays white.
fn kept(channel: u8, bits: u32) -> u8 {
    if bits == 0 {
        return u8::MAX;
    }
    let most = (1 << bits) - 1;
    let level = u32::from(channel) >> (8 - bits);
    ((level * 255 + most / 2) / most) as u8
}

/// The linear colour of a vertex for one in sRGB.
pub(super) fn linear(color: Vec3) -> Vec4 {
    let channel = |c: f32| linear_from_srgb(f64::from(c).clamp(0.0, 1.0)) as f32;
    color.map(channel).extend(1.0)
}

/// An sRGB colour from 0 to 1, rounded.
pub(super) fn rgb(color: Vec3) -> Rgb {
    color.to_array().map(|c| (c * 255.0).round() as u8)
}

/// A white material, which shows a colour unchanged.
pub(super) fn white() -> Material {
    Material::from(Phong {
        diffuse: Vec3::ONE,
        ambient: Vec3::ONE,
        ..Phong::default()
    })
}
