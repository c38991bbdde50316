//! Welds equal corners of faces into vertices.

use super::face::Corner;

/// One corner for each vertex, and for each corner the index of its vertex.
///
/// Sorts instead of hashing: it takes less memory, and no input makes it slow.
pub(super) fn weld(corners: &[Corner]) -> (Vec<u32>, Vec<u32>) {
    let corner = |i: u32| corners[i as usize];
    let mut order: Vec<u32> = (0..corners.len() as u32).collect();
    order.sort_unstable_by_key(|&i| corner(i));
    let mut vertices: Vec<u32> = Vec::new();
    let mut vertex_of_corner = vec![0; corners.len()];
    for i in order {
        if vertices.last().map(|&last| corner(last)) != Some(corner(i)) {
            vertices.push(i);
        }
        vertex_of_corner[i as usize] = vertices.len() as u32 - 1;
    }
    (vertices, vertex_of_corner)
}
