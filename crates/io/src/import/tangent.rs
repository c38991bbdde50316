//! Tangents of vertices in files.

use glam::{DVec3, Vec4};

/// The tangent with these numbers, the last of which says whether u and v are mirrored; zero if they have no direction.
pub(super) fn tangent([x, y, z, w]: [f64; 4]) -> Vec4 {
    let given = DVec3::new(x, y, z);
    // As near to 1 as f32 allows, it stays as it is, so that a file that we wrote gives the same again.
    let direction = match (given.length() - 1.0).abs() <= f64::from(f32::EPSILON) {
        true => Some(given),
        false => given.try_normalize(),
    };
    match direction {
        Some(direction) => direction.as_vec3().extend(1f32.copysign(w as f32)),
        None => Vec4::ZERO,
    }
}
