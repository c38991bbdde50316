//! Texture coordinates of any file: what is not a number is repaired.

use super::notes::Notes;

/// A texture coordinate that f32 can hold: `uv`, or 0 if it is not a number, of which `lost` counts how many there are.
pub(super) fn in_range(uv: f64, lost: &mut usize) -> f64 {
    if uv.is_nan() {
        *lost += 1;
        return 0.0;
    }
    // Beyond this, f32 has whole numbers only, and all texture coordinates are equivalent.
    uv.clamp(-1e9, 1e9)
}

/// Notes how many texture coordinates were lost.
pub(super) fn note(lost: usize, notes: &mut Notes) {
    if lost > 0 {
        notes.add("repaired texture coordinates", || {
            format!("texture coordinates that are not numbers, set to 0: {lost}")
        });
    }
}
