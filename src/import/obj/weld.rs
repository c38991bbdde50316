//! Corners of faces into vertices: equal corners become one.

use super::face::Corner;

/// A corner of each vertex, and for each corner the index of its vertex.
///
/// By sorting rather than hashing: it takes less memory, and no file can make it slow.
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
