//! Luminance of linear Rec. 709.

use glimray_scene::LUMINANCE;

/// The luminance of a linear colour.
pub fn luminance(color: [f64; 3]) -> f64 {
    LUMINANCE.dot(color.into())
}
