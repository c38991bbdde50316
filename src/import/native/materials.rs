//! The materials of a native scene.

use super::file::MaterialTable;
use super::textures::Textures;
use crate::import::error::ImportError;
use crate::scene::{self, Material};

/// The material that `table` describes.
pub(super) fn material(
    name: &str,
    table: &MaterialTable,
    textures: &mut Textures,
) -> Result<Material, ImportError> {
    let phong = &table.phong;
    let diffuse = textures.color(&phong.diffuse)?;
    let specular = textures.color(&phong.specular)?;
    let ambient = match &phong.ambient {
        Some(ambient) => textures.color(ambient)?,
        None => diffuse,
    };
    Ok(Material {
        name: name.to_owned(),
        diffuse: diffuse.0,
        specular: specular.0,
        shininess: phong.shininess.0,
        ambient: ambient.0,
        two_sided: table.two_sided,
        textures: scene::Textures {
            diffuse: diffuse.1,
            specular: specular.1,
            ambient: ambient.1,
            ..scene::Textures::default()
        },
        ..Material::default()
    })
}
