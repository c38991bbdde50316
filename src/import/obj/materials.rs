//! The materials that a model uses, from its material libraries, with their images.

use super::lines::Line;
use super::{Reader, mtl};
use crate::import::budget;
use crate::import::error::ImportError;
use crate::import::notes::Notes;
use crate::import::paths::Refusal;
use crate::import::picture::{self, Place, Refused, Role};
use crate::import::source::{Source, Token, quote};
use crate::import::tint;
use crate::scene::{Coverage, LayerTextures, Material, Minify, Pattern, Space, Texture, Wrap};
use glam::{Vec3, Vec4};
use std::path::Path;

/// Size limit of a material file in bytes.
const MAX_MTL_BYTES: u64 = 64 << 20;

impl<'s> Reader<'s> {
    /// The index of the current material, assigned when the first face uses it.
    pub(super) fn material_in_use(&mut self) -> u32 {
        let names = &mut self.material_names;
        let name = self.material;
        *self.material_ids.entry(name).or_insert_with(|| {
            names.push(name);
            names.len() as u32 - 1
        })
    }

    /// Reads the libraries in `line`: one file name with spaces, or several names.
    pub(super) fn material_library(&mut self, line: &mut Line) -> Result<(), ImportError> {
        let whole = line.rest();
        if self.library_file(whole)? {
            return Ok(());
        }
        while let Some(word) = line.word() {
            if word.bytes.len() == whole.bytes.len() || !self.library_file(word)? {
                self.notes.add("missing material files", || {
                    format!("the material file {} does not exist", word.quote())
                });
            }
        }
        Ok(())
    }

    /// Whether the library `name` exists. Its text is validated and kept.
    fn library_file(&mut self, name: Token) -> Result<bool, ImportError> {
        let text = String::from_utf8_lossy(name.bytes);
        let path = match self.files.resolve(&text) {
            Ok(path) => path,
            Err(Refusal::Missing(_)) => return Ok(false),
            Err(refusal) => {
                let malformed = |why, todo: &str| self.source.malformed(name.span(), why, todo);
                return Err(refusal.into_error("material file", malformed));
            }
        };
        if self.libraries.iter().any(|known| known.path == path) {
            return Ok(true);
        }
        let bytes = self.files.read(&path, MAX_MTL_BYTES)?;
        // Exporters do write empty libraries.
        if !bytes.is_empty() {
            let source = Source::new("bad material file", &path, bytes)?;
            mtl::read(&source, &mut self.notes, |_, _| false)?;
            self.libraries.push(source);
        }
        Ok(true)
    }

    /// The materials that corners use, by index.
    pub(super) fn materials(&mut self) -> Result<Vec<Material>, ImportError> {
        let mut found: Vec<Option<Material>> = Vec::new();
        found.resize_with(self.material_names.len(), || None);
        // The last of several libraries wins, but within one library the first of two equal names, as in
        // other viewers.
        for library in std::mem::take(&mut self.libraries).iter().rev() {
            let mut entries = Vec::new();
            let ids = &self.material_ids;
            mtl::read(library, &mut Notes::default(), |name, entry| {
                let id = ids.get(&Some(name)).map(|&id| id as usize);
                let id = id.filter(|&id| found[id].is_none());
                if let (Some(id), Some(entry)) = (id, entry) {
                    found[id] = Some(entry.material);
                    entries.push((id, entry.maps));
                }
                id.is_some()
            })?;
            for (_, maps) in &entries {
                self.plan_pictures(maps, &library.path);
            }
            for (id, maps) in entries {
                if let Some(mut material) = found[id].take() {
                    self.pictures_of(&mut material, maps, &library.path);
                    found[id] = Some(material);
                }
            }
        }
        let names = std::mem::take(&mut self.material_names);
        let notes = &mut self.notes;
        let mut materials: Vec<Material> = (found.into_iter().zip(names))
            .map(|(material, name)| {
                material.unwrap_or_else(|| {
                    let name = name.unwrap_or_default();
                    if !name.is_empty() {
                        notes.add("undefined materials", || {
                            format!(
                                "the material {} is not defined: the default replaces it",
                                quote(name)
                            )
                        });
                    }
                    Material {
                        name: String::from_utf8_lossy(name).into_owned(),
                        ..Material::default()
                    }
                })
            })
            .collect();
        if materials.is_empty() {
            materials.push(Material::default());
        }
        Ok(materials)
    }

    /// Memory in bytes that colours of vertices take.
    pub(super) fn color_memory(&self) -> u64 {
        match self.colors.len() {
            0 => 0,
            count => budget::size::<Vec3>(count) + budget::size::<Vec4>(self.corners.len()),
        }
    }

    /// Makes faces without a material white if vertices have colours, which then show unchanged.
    pub(super) fn whiten(&self, materials: &mut [Material]) {
        if let (false, Some(&id)) = (self.colors.is_empty(), self.material_ids.get(&None)) {
            materials[id as usize] = tint::white();
        }
    }

    /// The colours of `vertices`, which are corners; empty if there are none or another material replaces them.
    pub(super) fn vertex_colors(&self, vertices: &[u32]) -> Vec<Vec4> {
        if self.colors.is_empty() || self.replaced.is_some() {
            return Vec::new();
        }
        let color = |&vertex: &u32| {
            let position = self.corners[vertex as usize].position as usize;
            tint::linear(self.colors.get(position).copied().unwrap_or(Vec3::ONE))
        };
        vertices.iter().map(color).collect()
    }

    /// Announces the pictures of a material, so that they are decoded together.
    fn plan_pictures(&mut self, maps: &mtl::Maps<String>, file: &Path) {
        if self.replaced.is_some() {
            return;
        }
        let colors = [&maps.diffuse, &maps.specular, &maps.ambient, &maps.emission];
        let colors = colors.map(|map| (map.as_ref(), Role::Color));
        // A normal map replaces a height map.
        let bump = maps.bump.as_ref().filter(|_| maps.normal.is_none());
        let others = [
            (maps.normal.as_ref(), Role::Data),
            (bump, bump.map_or(Role::Height, relief)),
            (maps.alpha.as_ref(), Role::Alpha),
        ];
        for (map, role) in colors.into_iter().chain(others) {
            let Some(map) = map else { continue };
            if let Ok(path) = self.files.named_in(file).resolve(&map.name) {
                let name = quote(map.name.as_bytes());
                self.pictures.plan(Place::File(path), &name, role);
            }
        }
    }

    fn pictures_of(&mut self, material: &mut Material, maps: mtl::Maps<String>, file: &Path) {
        if self.replaced.is_some() {
            return;
        }
        material.textures.diffuse = self.picture(maps.diffuse, Role::Color, file);
        if material.metallic_roughness.is_some() && material.textures.diffuse.is_some() {
            material.layer_textures = Some(Box::new(LayerTextures {
                base_color: material.textures.diffuse,
                ..LayerTextures::default()
            }));
        }
        material.textures.specular = self.picture(maps.specular, Role::Color, file);
        // Few exporters write an ambient texture, and all use the diffuse one.
        material.textures.ambient = match maps.ambient {
            None => material.textures.diffuse,
            map => self.picture(map, Role::Color, file),
        };
        material.textures.emission = self.picture(maps.emission, Role::Color, file);
        material.textures.normal = self.picture(maps.normal, Role::Data, file);
        if material.textures.normal.is_none()
            && let Some(map) = maps.bump
        {
            material.normal_scale = map.height.abs().min(1e6) as f32;
            let role = relief(&map);
            material.textures.normal = self.picture(Some(map), role, file);
        }
        material.textures.alpha = self.picture(maps.alpha, Role::Alpha, file);
        if material.textures.alpha.is_some() {
            material.coverage = Coverage::Blend;
            material.alpha *= std::mem::replace(&mut material.opacity, 1.0);
            material.transmit = Vec3::ZERO;
        }
    }

    /// The texture with an image that `file` names; unreadable images are skipped.
    fn picture(&mut self, map: Option<mtl::Map<String>>, role: Role, file: &Path) -> Option<usize> {
        let map = map?;
        let name = quote(map.name.as_bytes());
        let found = match self.files.named_in(file).resolve(&map.name) {
            Ok(path) => {
                let read = picture::reader(self.files);
                self.pictures.index(&Place::File(path), &name, role, &read)
            }
            Err(refusal) => Err(Refused::File(refusal)),
        };
        let picture = match found {
            Ok(picture) => picture,
            Err(refused) => {
                self.notes.add("skipped textures", || {
                    format!("texture skipped: {}", refused.into_note())
                });
                return None;
            }
        };
        let texture = Texture {
            pattern: Pattern::Picture {
                picture,
                nearest: false,
                minify: Minify::default(),
                wrap: [Wrap::Repeat; 2],
            },
            space: Space::Uv,
            pattern_from_space: map.picture_from_uv,
        };
        let known = self.textures.iter().position(|known| *known == texture);
        Some(known.unwrap_or_else(|| {
            self.textures.push(texture);
            self.textures.len() - 1
        }))
    }
}

/// The role of a height map: with a negative factor it holds depths.
fn relief<N>(map: &mtl::Map<N>) -> Role {
    match map.height < 0.0 {
        true => Role::Depth,
        false => Role::Height,
    }
}
