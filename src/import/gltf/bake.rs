//! Pictures of the classical model's colours, computed texel by texel from the maps of a
//! metallic-roughness material.

use crate::scene::{MetallicRoughness, Picture, SrgbCurve, SurfacePoint, Texels};
use glam::{DVec4, Vec3, Vec4Swizzles};

/// Differences of colours below this are not worth a picture.
const VISIBLE: f32 = 1.0 / 512.0;

/// The maps of a material that belong to the same texture coordinates.
#[derive(Clone, Default)]
pub(super) struct Sheets<'a> {
    /// sRGB, and alpha.
    pub base_color: Option<&'a Picture>,
    /// Roughness in green, metalness in blue.
    pub metallic_roughness: Option<&'a Picture>,
    /// In red.
    pub transmission: Option<&'a Picture>,
}

/// A colour, or a picture of it.
pub(super) enum Shade {
    Constant(Vec3),
    Picture(Picture),
}

/// The colours of the classical model.
pub(super) struct Baked {
    pub diffuse: Shade,
    pub specular: Shade,
    pub reflect: Shade,
    pub transmit: Shade,
    /// The mean, for the width of the highlight.
    pub roughness: f32,
}

/// Multiplies a parameter of `model` by the mean of a map that is not aligned with the others: its metallic-roughness
/// map (1) or its transmission map (2).
pub(super) fn with_mean(model: &mut MetallicRoughness, index: usize, sheet: &Picture) {
    let sum: DVec4 = sheet.linear().map(|texel| texel.as_dvec4()).sum();
    let mean = (sum / sheet.texels.len() as f64).as_vec4();
    match index {
        1 => {
            model.roughness *= mean.y;
            model.metallic *= mean.z;
        }
        _ => model.transmission *= mean.x,
    }
}

/// The colours of `model` with `sheets`, in pictures of the size of the largest sheet; others are sampled at
/// the nearest texel. At least one sheet must be there.
pub(super) fn bake(model: &MetallicRoughness, sheets: &Sheets) -> Baked {
    let all = [
        sheets.base_color,
        sheets.metallic_roughness,
        sheets.transmission,
    ];
    let size = all
        .iter()
        .flatten()
        .map(|sheet| (sheet.width, sheet.height));
    let (width, height) = size.fold((1, 1), |most, size| {
        (most.0.max(size.0), most.1.max(size.1))
    });
    let curve = SrgbCurve::default();
    let texel = |sheet: Option<&Picture>, x: u32, y: u32| {
        sheet.map(|sheet| {
            let (w, h) = (sheet.width, sheet.height);
            let along =
                |i: u32, n: u32, of: u32| (u64::from(i) * u64::from(n) / u64::from(of)) as usize;
            let row = along(y, h, height) * w as usize;
            sheet.texels.linear(&curve, row + along(x, w, width))
        })
    };
    let point = |x: u32, y: u32| {
        let mut point: SurfacePoint = model.point();
        if let Some(texel) = texel(sheets.base_color, x, y) {
            point.base_color *= texel.xyz();
        }
        if let Some(texel) = texel(sheets.metallic_roughness, x, y) {
            point.roughness *= texel.y;
            point.metallic *= texel.z;
        }
        if let Some(texel) = texel(sheets.transmission, x, y) {
            point.transmission *= texel.x;
        }
        point
    };
    let roughness = match sheets.metallic_roughness {
        None => model.roughness,
        Some(sheet) => {
            let sum: f64 = sheet.linear().map(|texel| f64::from(texel.y)).sum();
            model.roughness * (sum / sheet.texels.len() as f64) as f32
        }
    };
    let count = width as usize * height as usize;
    // What is transmitted is a part, and most others are colours: each keeps its precision in 8 bits.
    let linear = |color: Vec3| {
        let [r, g, b] = color.to_array().map(|x| (x * 255.0).round() as u8);
        [r, g, b, u8::MAX]
    };
    let srgb = |color: Vec3| {
        let [r, g, b] = color.to_array().map(|x| curve.code(x));
        [r, g, b, u8::MAX]
    };
    let mut layers: [Vec<[u8; 4]>; 4] = Default::default();
    // A layer stays empty while it has one colour only.
    let mut first = None;
    for i in 0..count {
        let (x, y) = ((i % width as usize) as u32, (i / width as usize) as u32);
        let lobes = model.lobes(&point(x, y), roughness);
        let colors = [lobes.diffuse, lobes.specular, lobes.reflect, lobes.transmit];
        let first = *first.get_or_insert(colors);
        for (k, layer) in layers.iter_mut().enumerate() {
            let encoded = |color| match k {
                3 => linear(color),
                _ => srgb(color),
            };
            let differs = (colors[k] - first[k]).abs().max_element() > VISIBLE;
            if layer.is_empty() && differs {
                layer.reserve_exact(count);
                layer.resize(i, encoded(first[k]));
            }
            if !layer.is_empty() || differs {
                layer.push(encoded(colors[k]));
            }
        }
    }
    let first = first.unwrap_or_default();
    let mut shades =
        layers
            .into_iter()
            .enumerate()
            .map(|(k, texels)| match (texels.is_empty(), k) {
                (true, _) => Shade::Constant(first[k]),
                (false, 3) => Shade::Picture(Picture {
                    width,
                    height,
                    texels: Texels::Linear8(texels),
                }),
                (false, _) => Shade::Picture(Picture {
                    width,
                    height,
                    texels: Texels::Srgb8(texels),
                }),
            });
    let mut next = || shades.next().unwrap_or(Shade::Constant(Vec3::ZERO));
    Baked {
        diffuse: next(),
        specular: next(),
        reflect: next(),
        transmit: next(),
        roughness,
    }
}
