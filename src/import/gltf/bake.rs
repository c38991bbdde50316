//! Pictures of the classical model's colours, computed texel by texel from the maps of a
//! metallic-roughness material.

use crate::scene::{MetallicRoughness, Picture, SurfacePoint, Texels, linear_from_srgb};
use glam::{Vec3, Vec4};
use image::RgbaImage;

/// Differences of colours below this are not worth a picture.
const VISIBLE: f32 = 1.0 / 512.0;

/// The maps of a material that belong to the same texture coordinates.
#[derive(Clone, Default)]
pub(super) struct Sheets<'a> {
    /// sRGB, and alpha.
    pub base_color: Option<&'a RgbaImage>,
    /// Roughness in green, metalness in blue.
    pub metallic_roughness: Option<&'a RgbaImage>,
    /// In red.
    pub transmission: Option<&'a RgbaImage>,
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

/// The linear values of the 256 codes of sRGB.
fn srgb_curve() -> [f32; 256] {
    std::array::from_fn(|code| linear_from_srgb(code as f64 / 255.0) as f32)
}

/// The colours of `model` with `sheets`, in pictures of the size of the largest sheet; others are sampled at
/// the nearest texel. At least one sheet must be there.
pub(super) fn bake(model: &MetallicRoughness, sheets: &Sheets) -> Baked {
    let all = [
        sheets.base_color,
        sheets.metallic_roughness,
        sheets.transmission,
    ];
    let size = all.iter().flatten().map(|sheet| sheet.dimensions());
    let (width, height) = size.fold((1, 1), |most, size| {
        (most.0.max(size.0), most.1.max(size.1))
    });
    let curve = srgb_curve();
    let texel = |sheet: Option<&RgbaImage>, x: u32, y: u32| {
        sheet.map(|sheet| {
            let (w, h) = sheet.dimensions();
            let along =
                |i: u32, n: u32, of: u32| (u64::from(i) * u64::from(n) / u64::from(of)) as u32;
            sheet.get_pixel(along(x, w, width), along(y, h, height)).0
        })
    };
    let part = |code: u8| f32::from(code) / 255.0;
    let point = |x: u32, y: u32| {
        let mut point: SurfacePoint = model.point();
        if let Some([r, g, b, _]) = texel(sheets.base_color, x, y) {
            point.base_color *= Vec3::from([r, g, b].map(|code| curve[usize::from(code)]));
        }
        if let Some([_, g, b, _]) = texel(sheets.metallic_roughness, x, y) {
            point.roughness *= part(g);
            point.metallic *= part(b);
        }
        if let Some([r, ..]) = texel(sheets.transmission, x, y) {
            point.transmission *= part(r);
        }
        point
    };
    let roughness = match sheets.metallic_roughness {
        None => model.roughness,
        Some(sheet) => {
            let sum: u64 = sheet.pixels().map(|p| u64::from(p.0[1])).sum();
            let count = u64::from(sheet.width()) * u64::from(sheet.height());
            model.roughness * (sum as f64 / (255 * count) as f64) as f32
        }
    };
    let count = width as usize * height as usize;
    // What is transmitted is a part, and most others are colours: each keeps its precision in 8 bits.
    let linear = |color: Vec3| {
        let [r, g, b] = color.to_array().map(|x| (x * 255.0).round() as u8);
        [r, g, b, u8::MAX]
    };
    let srgb = |color: Vec3| {
        let [r, g, b] = color.to_array().map(|x| code(&curve, x));
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

/// `picture` at half its size, each texel the mean of four.
pub(super) fn halved(picture: &Picture) -> Picture {
    let (width, height) = (picture.width, picture.height);
    let (half_width, half_height) = ((width / 2).max(1), (height / 2).max(1));
    let curve = srgb_curve();
    let place = |x: u32, y: u32| {
        let (x, y) = (x.min(width - 1), y.min(height - 1));
        y as usize * width as usize + x as usize
    };
    let four = |i: u32| {
        let (x, y) = (2 * (i % half_width), 2 * (i / half_width));
        [(x, y), (x + 1, y), (x, y + 1), (x + 1, y + 1)].map(|(x, y)| place(x, y))
    };
    let all = || (0..half_width * half_height).map(four);
    let mean = |texels: &[[u8; 4]], at: [usize; 4], channel: usize| {
        let sum: u32 = at.iter().map(|&i| u32::from(texels[i][channel])).sum();
        ((sum + 2) / 4) as u8
    };
    let texels = match &picture.texels {
        Texels::Srgb8(texels) => Texels::Srgb8(
            all()
                .map(|at| {
                    let linear = |i: usize, c: usize| curve[usize::from(texels[i][c])];
                    let color = |c| at.iter().map(|&i| linear(i, c)).sum::<f32>() / 4.0;
                    let [r, g, b] = [0, 1, 2].map(|c| code(&curve, color(c)));
                    [r, g, b, mean(texels, at, 3)]
                })
                .collect(),
        ),
        Texels::Linear8(texels) => Texels::Linear8(
            all()
                .map(|at| [0, 1, 2, 3].map(|channel| mean(texels, at, channel)))
                .collect(),
        ),
        Texels::Float(texels) => Texels::Float(
            all()
                .map(|at| at.iter().map(|&i| texels[i]).sum::<Vec4>() / 4.0)
                .collect(),
        ),
    };
    Picture {
        width: half_width,
        height: half_height,
        texels,
    }
}

/// The code of sRGB whose linear value is nearest to `value`.
fn code(curve: &[f32; 256], value: f32) -> u8 {
    let above = curve.partition_point(|known| *known < value).min(255);
    let below = above.saturating_sub(1);
    match value - curve[below] < curve[above] - value {
        true => below as u8,
        false => above as u8,
    }
}
