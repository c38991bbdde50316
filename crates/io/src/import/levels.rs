//! Colours of vertices whose format leaves open what their numbers are: from 0 to 1, or levels of 8 or 16 bits.

use super::notes::Notes;
use glam::Vec3;

/// The divisor that brings colours to 0 to 1: 255 or 65,535 if all are whole numbers up to it and one is above 1; otherwise 1.
fn most(colors: &[Vec3]) -> f32 {
    let channels = || colors.iter().flat_map(|color| color.to_array());
    if !channels().all(|c| c.fract() == 0.0) {
        return 1.0;
    }
    match channels().fold(0.0, f32::max) {
        most if most <= 1.0 || most > 65_535.0 => 1.0,
        most if most <= 255.0 => 255.0,
        _ => 65_535.0,
    }
}

/// Brings `colors` into the range from 0 to 1, notes how, and returns what they were divided by. Numbers that are not
/// finite become 1.
pub(super) fn normalize(colors: &mut [Vec3], notes: &mut Notes) -> f32 {
    const WHAT: &str = "colours of vertices";
    let mut lost = 0;
    for color in colors.iter_mut().filter(|color| !color.is_finite()) {
        *color = color.map(|c| if c.is_finite() { c } else { 1.0 });
        lost += 1;
    }
    let most = most(colors);
    let mut clamped = 0;
    for color in colors {
        let unit = *color / most;
        *color = unit.clamp(Vec3::ZERO, Vec3::ONE);
        clamped += usize::from(*color != unit);
    }
    if most > 1.0 {
        notes.add(WHAT, || {
            format!("colours of vertices of 0 to {most} divided by {most}")
        });
    }
    for (count, what) in [
        (lost, "that are not finite set to 1"),
        (clamped, "clamped to 0 to 1"),
    ] {
        if count > 0 {
            notes.add(WHAT, || format!("colours of vertices {what}: {count}"));
        }
    }
    most
}
