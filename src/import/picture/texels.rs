//! The texels of an image in a role.

use super::opened::{Opened, Values};
use super::repair::{self, Repairs};
use super::{Role, linear_from_srgb};
use crate::scene::{LUMINANCE, Texels};
use glam::{Vec3, Vec4};
use image::DynamicImage;

/// The part of a colour's largest value that another may be below 0 without being outside of the gamut: the precision of
/// Radiance HDR.
const GAMUT_TOLERANCE: f32 = 1.0 / 128.0;

/// The texels of an image, row by row from the top left, and what was repaired. Floats are finite and 0 or more. After the
/// last role the image has no values.
pub(super) fn of(opened: &mut Opened, role: Role, is_last: bool) -> (Texels, Repairs) {
    let mut light = match &mut opened.values {
        Values::Codes(image) => return (coded(image, role), Repairs::default()),
        Values::Floats(light) if is_last => std::mem::take(light),
        Values::Floats(light) => light.clone(),
    };
    let outside = convert(&mut light, opened, role);
    let repairs = repair::repair(&mut light, opened.width, role, outside);
    (Texels::Float(light), repairs)
}

/// Turns light as a file has it into what the role needs: linear Rec. 709. Returns the number of texels that were cut to
/// its gamut.
fn convert(light: &mut [Vec4], opened: &Opened, role: Role) -> usize {
    let mut outside = 0;
    for texel in &mut *light {
        let own = *texel;
        let mut converted = match role {
            Role::Color => opened.straight(own),
            // Light in front of nothing is light multiplied by alpha.
            Role::Environment => opened.rec709(own.truncate()).extend(own.w),
            Role::Alpha if opened.has_alpha => Vec3::ONE.extend(own.w),
            Role::Alpha => Vec3::ONE.extend(own.truncate().dot(LUMINANCE.as_vec3())),
            Role::Data | Role::Height | Role::Depth => own,
        };
        let color = converted.truncate();
        if own.truncate().min_element() >= 0.0 && color.min_element() < 0.0 {
            let is_outside = color.min_element() < -GAMUT_TOLERANCE * color.max_element();
            outside += usize::from(is_outside);
            converted = color.max(Vec3::ZERO).extend(converted.w);
        }
        *texel = converted;
    }
    if role == Role::Color && opened.is_premultiplied {
        spread(light, opened.width as usize);
    }
    outside
}

/// Gives texels without alpha, and so without a colour, the mean colour of those around them, so that interpolated edges do
/// not darken.
fn spread(texels: &mut [Vec4], width: usize) {
    let height = texels.len() / width.max(1);
    let around = |index: usize| {
        let (x, y) = (index % width, index / width);
        let columns = x.saturating_sub(1)..(x + 2).min(width);
        let rows = y.saturating_sub(1)..(y + 2).min(height);
        let texels = &*texels;
        let near = rows.flat_map(|y| columns.clone().map(move |x| texels[y * width + x]));
        let (sum, count) = near
            .filter(|texel| texel.w > 0.0 && texel.is_finite())
            .fold((Vec3::ZERO, 0.0), |(sum, count), texel| {
                (sum + texel.truncate(), count + 1.0)
            });
        (count > 0.0).then(|| (index, (sum / count).extend(0.0)))
    };
    let filled: Vec<(usize, Vec4)> = (0..texels.len())
        .filter(|&index| texels[index] == Vec4::ZERO)
        .filter_map(around)
        .collect();
    for (index, texel) in filled {
        texels[index] = texel;
    }
}

/// Texels of codes: 8 bits stay as they are.
fn coded(image: &DynamicImage, role: Role) -> Texels {
    let channels = usize::from(image.color().channel_count());
    let has_alpha = image.color().has_alpha();
    if let Some(words) = image.as_flat_samples_u16() {
        return Texels::Float(wide(image, words.samples, channels, role));
    }
    let bytes = image.as_bytes().chunks_exact(channels);
    let texel = |p: &[u8]| match *p {
        [r, g, b, a] => [r, g, b, a],
        [r, g, b] => [r, g, b, u8::MAX],
        [grey, alpha] => [grey, grey, grey, alpha],
        _ => [p[0], p[0], p[0], u8::MAX],
    };
    let white = |alpha| [u8::MAX, u8::MAX, u8::MAX, alpha];
    match role {
        Role::Color | Role::Environment => Texels::Srgb8(bytes.map(texel).collect()),
        Role::Data | Role::Height | Role::Depth => Texels::Linear8(bytes.map(texel).collect()),
        Role::Alpha if has_alpha => {
            Texels::Linear8(bytes.map(|p| white(p[channels - 1])).collect())
        }
        Role::Alpha => {
            let grey = image.to_luma8();
            Texels::Linear8(grey.pixels().map(|p| white(p.0[0])).collect())
        }
    }
}

/// Texels of codes of 16 bits.
fn wide(image: &DynamicImage, words: &[u16], channels: usize, role: Role) -> Vec<Vec4> {
    let value = |code: u16| f64::from(code) / f64::from(u16::MAX);
    if role == Role::Alpha && !image.color().has_alpha() {
        let grey = image.to_luma16();
        let texel = |p: &image::Luma<u16>| Vec3::ONE.extend(value(p.0[0]) as f32);
        return grey.pixels().map(texel).collect();
    }
    let curve: Vec<f32> = (0..=u16::MAX)
        .map(|code| match role {
            Role::Color | Role::Environment => linear_from_srgb(value(code)) as f32,
            Role::Alpha => 1.0,
            Role::Data | Role::Height | Role::Depth => value(code) as f32,
        })
        .collect();
    let texel = |p: &[u16]| {
        let (color, alpha) = match *p {
            [r, g, b, a] => ([r, g, b], a),
            [r, g, b] => ([r, g, b], u16::MAX),
            [grey, alpha] => ([grey; 3], alpha),
            _ => ([p[0]; 3], u16::MAX),
        };
        Vec3::from(color.map(|code| curve[usize::from(code)])).extend(value(alpha) as f32)
    };
    words.chunks_exact(channels).map(texel).collect()
}
