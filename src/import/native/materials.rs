//! The materials of a native scene.

use super::file::MaterialTable;
use crate::scene::Material;

/// The material that `table` describes.
pub(super) fn material(name: &str, table: &MaterialTable) -> Material {
    let phong = &table.phong;
    Material {
        name: name.to_owned(),
        diffuse: phong.diffuse.0,
        specular: phong.specular.0,
        shininess: phong.shininess.0,
        ambient: phong.ambient.unwrap_or(phong.diffuse).0,
        two_sided: table.two_sided,
        ..Material::default()
    }
}
