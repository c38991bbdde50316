//! The materials of a model that are in use, with their pictures.

use super::{Reader, mtl};
use crate::import::source::quote;
use crate::scene::{Material, Pattern, Space, Texture};
use glam::DAffine3;
use std::path::Path;

impl Reader<'_> {
    /// The materials that corners use, and the index of each by its id.
    pub(super) fn materials(&mut self) -> (Vec<Material>, Vec<u32>) {
        let mut is_used = vec![false; self.material_names.len()];
        for corner in &self.corners {
            is_used[corner.material as usize] = true;
        }
        let mut materials = Vec::new();
        let mut index_of_id = vec![0; is_used.len()];
        for id in (0..is_used.len()).filter(|&id| is_used[id]) {
            index_of_id[id] = materials.len() as u32;
            let name = self.material_names[id].clone();
            materials.push(match self.library.get(&name).cloned() {
                Some(entry) => self.with_pictures(entry),
                None => {
                    if id > 0 {
                        let quoted = quote(name.as_bytes());
                        self.skipped.push(format!(
                            "the material {quoted} is not defined: the default takes its place"
                        ));
                    }
                    Material {
                        name,
                        ..Material::default()
                    }
                }
            });
        }
        if materials.is_empty() {
            materials.push(Material::default());
        }
        (materials, index_of_id)
    }

    fn with_pictures(&mut self, entry: mtl::Entry) -> Material {
        let mtl::Entry {
            mut material,
            maps,
            file,
        } = entry;
        if self.replaced.is_some() {
            return material;
        }
        material.textures.diffuse = self.picture(maps.diffuse, &file);
        material.textures.specular = self.picture(maps.specular, &file);
        // Few exporters write an ambient picture, and all mean the diffuse one.
        material.textures.ambient = match maps.ambient {
            None => material.textures.diffuse,
            name => self.picture(name, &file),
        };
        material
    }

    /// The texture that shows the picture called `name` in `file`; what cannot be read is left out.
    fn picture(&mut self, name: Option<String>, file: &Path) -> Option<usize> {
        let picture = match self.pictures.read(&self.files.named_in(file), &name?) {
            Ok(picture) => picture,
            Err(refused) => {
                let note = format!("texture left out: {}", refused.into_note());
                if !self.skipped.contains(&note) {
                    self.skipped.push(note);
                }
                return None;
            }
        };
        let texture = Texture {
            pattern: Pattern::Picture {
                picture,
                nearest: false,
            },
            space: Space::Uv,
            pattern_from_space: DAffine3::IDENTITY,
        };
        let known = self.textures.iter().position(|known| *known == texture);
        Some(known.unwrap_or_else(|| {
            self.textures.push(texture);
            self.textures.len() - 1
        }))
    }
}
