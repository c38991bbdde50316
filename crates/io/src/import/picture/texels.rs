//! The texels of an image in a role.

use super::opened::{Opened, Values};
use super::repair::{self, Repairs};
use super::{Role, linear_from_srgb};
use bytemuck::allocation::try_cast_vec;
use glam::{Vec3, Vec4};
use glimray_scene::{LUMINANCE, Texels};
use image::DynamicImage;

/// The part of a colour's largest value that another may be below 0 without being outside of the gamut: the precision of
/// Radiance HDR.
const GAMUT_TOLERANCE: f32 = 1.0 / 128.0;

/// The texels of an image, row by row from the top left, and what was repaired. Floats are finite and 0 or more. After the
/// last role the image has no values.
pub(super) fn of(opened: &mut Opened, role: Role, is_last: bool) -> (Texels, Repairs) {
    let mut light = match &mut opened.values {
        Values::Codes(image) => {
            let texels = match role {
                Role::Alpha => mask(image, opened.has_alpha),
                _ => codes(image, role, is_last),
            };
            return (texels, Repairs::default());
        }
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

/// Texels of codes: 8 bits stay as they are. After the last role the image may be empty.
fn codes(image: &mut DynamicImage, role: Role, is_last: bool) -> Texels {
    let is_color = matches!(role, Role::Color | Role::Environment);
    let channels = usize::from(image.color().channel_count());
    if let Some(words) = image.as_flat_samples_u16() {
        return Texels::Float(wide(words.samples, channels, is_color));
    }
    let texel = |p: &[u8]| match *p {
        [r, g, b, a] => [r, g, b, a],
        [r, g, b] => [r, g, b, u8::MAX],
        [grey, alpha] => [grey, grey, grey, alpha],
        _ => [p[0], p[0], p[0], u8::MAX],
    };
    let spread = |bytes: &[u8]| bytes.chunks_exact(channels).map(texel).collect();
    let texels = match image {
        DynamicImage::ImageRgba8(own) if is_last => {
            let bytes = std::mem::take(own).into_raw();
            try_cast_vec(bytes).unwrap_or_else(|(_, bytes)| spread(&bytes))
        }
        _ => spread(image.as_bytes()),
    };
    match is_color {
        true => Texels::Srgb8(texels),
        false => Texels::Linear8(texels),
    }
}

/// White with the image's alpha, or else its brightness, as alpha.
fn mask(image: &DynamicImage, has_alpha: bool) -> Texels {
    let channels = usize::from(image.color().channel_count());
    let white = |alpha: &u8| [u8::MAX, u8::MAX, u8::MAX, *alpha];
    let wide_white = |alpha: &u16| Vec3::ONE.extend(value(*alpha) as f32);
    let alphas = channels - 1;
    match image.as_flat_samples_u16() {
        Some(words) if has_alpha => {
            let alphas = words.samples.iter().skip(alphas).step_by(channels);
            Texels::Float(alphas.map(wide_white).collect())
        }
        Some(_) => Texels::Float(image.to_luma16().iter().map(wide_white).collect()),
        None if has_alpha => {
            let alphas = image.as_bytes().iter().skip(alphas).step_by(channels);
            Texels::Linear8(alphas.map(white).collect())
        }
        None => Texels::Linear8(image.to_luma8().iter().map(white).collect()),
    }
}

/// The number from 0 to 1 that a code of 16 bits stands for.
fn value(code: u16) -> f64 {
    f64::from(code) / f64::from(u16::MAX)
}

/// Texels of codes of 16 bits.
fn wide(words: &[u16], channels: usize, is_color: bool) -> Vec<Vec4> {
    let curve: Vec<f32> = (0..=u16::MAX)
        .map(|code| match is_color {
            true => linear_from_srgb(value(code)) as f32,
            false => value(code) as f32,
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
