//! Corners of faces into vertices: equal corners become one.

use super::face::Corner;

/// The distinct corners in order, and for each corner the index of its own.
///
/// By sorting rather than hashing: it takes less memory, and no file can make it slow.
pub(super) fn weld(corners: &[Corner]) -> (Vec<Corner>, Vec<u32>) {
    let mut order: Vec<u32> = (0..corners.len() as u32).collect();
    order.sort_unstable_by_key(|&i| corners[i as usize]);
    let mut vertices = Vec::new();
    let mut vertex_of_corner = vec![0; corners.len()];
    for i in order {
        let corner = corners[i as usize];
        if vertices.last() != Some(&corner) {
            vertices.push(corner);
        }
        vertex_of_corner[i as usize] = vertices.len() as u32 - 1;
    }
    (vertices, vertex_of_corner)
}
