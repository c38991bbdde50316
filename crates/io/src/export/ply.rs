//! Meshes and transforms of copies as binary PLY files, which preserve every bit.

use glam::{DAffine3, DMat3};
use glimray_scene::Mesh;

/// A mesh; `number_of` gives the numbers of its materials.
pub(super) fn mesh(mesh: &Mesh, number_of: impl Fn(u32) -> u32, has_numbers: bool) -> Vec<u8> {
    let mut header = format!(
        "ply\nformat binary_little_endian 1.0\nelement vertex {}\n",
        mesh.positions.len()
    );
    let mut names = vec!["x", "y", "z", "nx", "ny", "nz"];
    let has_uvs = !mesh.uvs.is_empty();
    if has_uvs {
        names.extend(["s", "t"]);
    }
    let has_second = !mesh.second_uvs.is_empty();
    if has_second {
        names.extend(["s2", "t2"]);
    }
    let has_tangents = !mesh.tangents.is_empty();
    if has_tangents {
        names.extend(["tx", "ty", "tz", "tw"]);
    }
    let has_colors = !mesh.colors.is_empty();
    if has_colors {
        names.extend(["linear_red", "linear_green", "linear_blue", "linear_alpha"]);
    }
    for name in &names {
        header += &format!("property float {name}\n");
    }
    if has_numbers {
        header += "property uint material\n";
    }
    header += &format!(
        "element face {}\nproperty list uchar uint vertex_indices\nend_header\n",
        mesh.triangles.len()
    );
    let mut bytes = header.into_bytes();
    bytes.reserve(mesh.positions.len() * (4 * names.len() + 4) + 13 * mesh.triangles.len());
    for (i, position) in mesh.positions.iter().enumerate() {
        let mut put = |value: f32| bytes.extend(value.to_le_bytes());
        position.to_array().into_iter().for_each(&mut put);
        mesh.normals[i].to_array().into_iter().for_each(&mut put);
        if has_uvs {
            mesh.uvs[i].to_array().into_iter().for_each(&mut put);
        }
        if has_second {
            mesh.second_uvs[i].to_array().into_iter().for_each(&mut put);
        }
        if has_tangents {
            mesh.tangents[i].to_array().into_iter().for_each(&mut put);
        }
        if has_colors {
            mesh.colors[i].to_array().into_iter().for_each(&mut put);
        }
        if has_numbers {
            bytes.extend(number_of(mesh.materials[i]).to_le_bytes());
        }
    }
    for triangle in &mesh.triangles {
        bytes.push(3);
        for index in triangle {
            bytes.extend(index.to_le_bytes());
        }
    }
    bytes
}

/// Transforms of copies.
pub(super) fn places(places: &[DAffine3]) -> Vec<u8> {
    let bits = |m: DMat3| m.to_cols_array().map(f64::to_bits);
    let are_moved_only = places
        .iter()
        .all(|p| bits(p.matrix3) == bits(DMat3::IDENTITY));
    let mut names = vec!["x", "y", "z"];
    if !are_moved_only {
        names.extend(["xx", "xy", "xz", "yx", "yy", "yz", "zx", "zy", "zz"]);
    }
    let mut header = format!(
        "ply\nformat binary_little_endian 1.0\nelement vertex {}\n",
        places.len()
    );
    for name in names {
        header += &format!("property double {name}\n");
    }
    header += "end_header\n";
    let mut bytes = header.into_bytes();
    for place in places {
        let mut put = |value: f64| bytes.extend(value.to_le_bytes());
        place.translation.to_array().into_iter().for_each(&mut put);
        if !are_moved_only {
            place.matrix3.to_cols_array().into_iter().for_each(&mut put);
        }
    }
    bytes
}
