//! The pivot of a camera whose file names no point to look at.

use super::forward;
use glam::DVec3;
use glimray_scene::Camera;

/// The distance from the eye to the middle of the part of the bounds that the viewing direction crosses, or else to where it
/// passes their centre; of `look_at`, if all of them are behind the eye or there are none.
pub(super) fn reach(camera: &Camera, bounds: Option<(DVec3, DVec3)>) -> f64 {
    let usual = camera.look_from.distance(camera.look_at);
    let Some((min, max)) = bounds else {
        return usual;
    };
    let direction = forward(camera);
    let (mut enters, mut leaves) = (0.0_f64, f64::INFINITY);
    for axis in 0..3 {
        // Parallel to a side, both are infinite, or not a number on it, which `min` and `max` pass over.
        let [a, b] = [min, max].map(|side| (side - camera.look_from)[axis] / direction[axis]);
        enters = enters.max(a.min(b));
        leaves = leaves.min(a.max(b));
    }
    let passes = (min.midpoint(max) - camera.look_from).dot(direction);
    let reach = match enters < leaves {
        true => enters.midpoint(leaves),
        false => passes,
    };
    match reach.is_finite() && reach > 0.0 {
        true => reach,
        false => usual,
    }
}

/// The distance along the viewing direction of the farthest corner of the bounds; infinite without bounds.
pub(super) fn farthest(camera: &Camera, bounds: Option<(DVec3, DVec3)>) -> f64 {
    let Some((min, max)) = bounds else {
        return f64::INFINITY;
    };
    let direction = forward(camera);
    let ahead = (max - camera.look_from) * direction;
    ahead
        .max((min - camera.look_from) * direction)
        .element_sum()
}
