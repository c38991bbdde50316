//! Repairs the values of pictures with floats, and counts what was repaired.

use super::Role;
use crate::import::range;
use glam::{Vec3, Vec4};
use glimray_scene::{LARGEST_TEXEL, LUMINANCE, SMALLEST_TEXEL, scale_of};
use std::f64::consts::PI;

/// Changes to the values of a picture.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Repairs {
    /// Number of texels.
    count: usize,
    /// Number of those with a value that was infinite, negative or not a number.
    invalid: usize,
    /// Whether such texels became black, instead of such values 0.
    is_whole: bool,
    /// Number of texels that were brighter than `most`.
    cut: usize,
    /// The largest value that is kept.
    most: f32,
    /// The part of the picture's light that they lost.
    lost: f64,
    /// Number of texels of an environment that are not exact beside the brightest one.
    dark: usize,
    /// Number of texels with colours outside of the gamut of Rec. 709.
    outside: usize,
}

/// Repairs texels, row by row from the top left, of which a row has `width`. So many of them as `outside` were cut to the
/// gamut of Rec. 709 before.
pub(super) fn repair(texels: &mut [Vec4], width: u32, role: Role, outside: usize) -> Repairs {
    let is_whole = role == Role::Environment;
    let mut repairs = Repairs {
        count: texels.len(),
        is_whole,
        most: match role {
            // Texels of an environment are scaled for the GPU.
            Role::Environment => range::SUN,
            _ => LARGEST_TEXEL,
        },
        outside,
        ..Repairs::default()
    };
    let height = texels.len() / (width as usize).max(1);
    let (mut before, mut after) = (0.0, 0.0);
    for (y, row) in texels.chunks_mut((width as usize).max(1)).enumerate() {
        // The part of the sphere that a texel of an environment covers.
        let area = match role {
            Role::Environment => (PI * (y as f64 + 0.5) / height as f64).sin(),
            _ => 1.0,
        };
        for texel in row {
            let is_valid = |value: f32| value.is_finite() && value >= 0.0;
            let mut color = texel.truncate();
            if !color.to_array().into_iter().all(is_valid) {
                repairs.invalid += 1;
                color = match is_whole {
                    true => Vec3::ZERO,
                    false => color.map(|value| if is_valid(value) { value } else { 0.0 }),
                };
            }
            let kept = color.min(Vec3::splat(repairs.most));
            repairs.cut += usize::from(kept != color);
            before += area * LUMINANCE.dot(color.as_dvec3());
            after += area * LUMINANCE.dot(kept.as_dvec3());
            let alpha = if texel.w > 0.0 { texel.w.min(1.0) } else { 0.0 };
            *texel = kept.extend(alpha);
        }
    }
    if role == Role::Environment {
        repairs.dark = dark(texels);
    }
    if repairs.invalid + repairs.cut + repairs.dark + repairs.outside == 0 {
        return Repairs::default();
    }
    if before > 0.0 {
        repairs.lost = 1.0 - after / before;
    }
    repairs
}

/// The number of texels whose colours are more than a sixteenth off as half floats beside the brightest one.
fn dark(texels: &[Vec4]) -> usize {
    /// Nobody sees the difference of this from black.
    const VISIBLE: f32 = 1e-3;
    let values = || texels.iter().map(|texel| texel.truncate().max_element());
    let off = SMALLEST_TEXEL * scale_of(values());
    match off > VISIBLE {
        true => (values().filter(|value| (VISIBLE..16.0 * off).contains(value))).count(),
        false => 0,
    }
}

impl Repairs {
    /// A line for each kind of repair to the picture that messages call `name`.
    pub fn lines(&self, name: &str) -> Vec<String> {
        let mut lines = Vec::new();
        if self.invalid > 0 {
            let (texels, were) = self.texels(self.invalid);
            let what = match self.is_whole {
                true if self.invalid == 1 => "and is black",
                true => "and are black",
                false => "in some channel, which is 0 there",
            };
            lines.push(format!(
                "{texels} of {name} {were} infinite, negative or not a number {what}: check the program that wrote it"
            ));
        }
        if self.cut > 0 {
            let (texels, were) = self.texels(self.cut);
            lines.push(format!(
                "{texels} of {name} {were} cut to {}, the largest value, so that {} of its light is lost: make the picture darker, and what it multiplies brighter",
                number(self.most),
                percent(self.lost)
            ));
        }
        if self.outside > 0 {
            let (texels, were) = self.texels(self.outside);
            lines.push(format!(
                "{texels} of {name} {were} outside of the gamut of Rec. 709 and cut to it"
            ));
        }
        if self.dark > 0 {
            let texels = self.texels(self.dark).0;
            let are = if self.dark == 1 { "is" } else { "are" };
            lines.push(format!(
                "{texels} of {name} {are} too dark to be kept exactly beside the brightest: make that darker"
            ));
        }
        lines
    }

    /// `count` texels in words, and the verb.
    fn texels(&self, count: usize) -> (String, &'static str) {
        match count {
            1 if self.count == 1 => ("the only texel".to_owned(), "was"),
            1 => ("1 texel".to_owned(), "was"),
            _ if count == self.count => (format!("all {count} texels"), "were"),
            _ => (format!("{count} texels"), "were"),
        }
    }
}

fn number(value: f32) -> String {
    match value < 1e6 {
        true => value.to_string(),
        false => format!("{value:e}"),
    }
}

/// A part of something in percent, never rounded up to all of it.
fn percent(part: f64) -> String {
    match 100.0 * part {
        percent if percent > 99.99 => "more than 99.99 %".to_owned(),
        percent if percent < 0.01 => "less than 0.01 %".to_owned(),
        percent => format!("{percent:.2} %"),
    }
}
