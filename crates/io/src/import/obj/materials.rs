//! The materials that a model uses, from its material libraries, with their images.

use super::lines::Line;
use super::{Reader, mtl};
use crate::import::budget;
use crate::import::paths::Refusal;
use crate::import::picture::{self, Place, Refused, Role};
use crate::import::source::{Source, Token, quote};
use crate::import::tint;
use glam::{Vec3, Vec4};
use glimray_scene::{
    Bsdf, Coverage, LayerTextures, Material, Minify, Pattern, PhongTextures, Space, Texture, Wrap,
};
use std::path::Path;
use std::sync::Arc;

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

    /// Reads the libraries in `line`: one file name with spaces, or several names. A name that leads nowhere, such as
    /// the path of another machine, stands for the file of that name beside the model.
    pub(super) fn material_libraries(&mut self, keyword: Token, line: &mut Line) {
        let whole = line.rest();
        let mut words: Vec<Token> = std::iter::from_fn(|| line.word()).collect();
        if words.is_empty() {
            let what = ("mtllib", "without a name skipped");
            self.faults.add(what, self.source, keyword.span(), || {
                ("`mtllib` has no name".to_owned(), "Add the name of a file")
            });
            return;
        }
        let is_found = |name: &Token| self.files.resolve(&library_name(name)).is_ok();
        if is_found(&whole) || !words.iter().any(is_found) {
            let beside = self.files.resolve_or_beside(&library_name(&whole));
            if words.len() == 1 || beside.is_ok() {
                words = vec![whole];
            }
        }
        for word in words {
            self.material_library(word);
        }
    }

    /// Reads the library `name` if it exists.
    fn material_library(&mut self, name: Token) {
        let quoted = name.quote();
        let (path, is_beside) = match self.files.resolve_or_beside(&library_name(&name)) {
            Ok(found) => found,
            Err(Refusal::Missing(why) | Refusal::Outside(why) | Refusal::Unfit(why)) => {
                let note = || format!("the material file {why}");
                self.notes.add("missing material files", note);
                return;
            }
        };
        if is_beside {
            self.notes.add("material files beside the model", || {
                format!(
                    "the material file {quoted} replaced by the file of that name beside the model"
                )
            });
        }
        if (self.libraries.iter()).any(|known| known.source.path == path) {
            return;
        }
        let bytes = self.files.read(&path, MAX_MTL_BYTES);
        // Exporters do write empty libraries.
        let bytes = bytes.map(|bytes| (!bytes.is_empty()).then_some(bytes));
        let source = bytes.and_then(|bytes| {
            let source =
                bytes.map(|bytes| Source::of_any_encoding("bad material file", &path, bytes));
            source.transpose()
        });
        match source {
            Ok(Some(source)) => {
                let library = mtl::Library::new(source, &mut self.notes);
                self.libraries.push(library);
            }
            Ok(None) => {}
            Err(error) => self.notes.add("unreadable material files", || {
                format!(
                    "the material file {quoted} skipped: {}",
                    error.into_fault().why
                )
            }),
        }
    }

    /// The materials that corners use, by index.
    pub(super) fn materials(&mut self) -> Vec<Material> {
        let mut found: Vec<Option<Material>> = Vec::new();
        found.resize_with(self.material_names.len(), || None);
        let (mut panes, mut repeated) = (0, 0);
        // The last of several libraries wins, but within one library the first of two equal names, as in
        // other viewers.
        for library in std::mem::take(&mut self.libraries).iter().rev() {
            let mut entries: Vec<(usize, mtl::Maps<String>)> = Vec::new();
            let ids = &self.material_ids;
            library.materials(|name, entry| {
                let id = ids.get(&Some(name)).map(|&id| id as usize);
                let is_new = id.is_some_and(|id| found[id].is_none());
                match (id.filter(|_| is_new), entry) {
                    (Some(id), Some(entry)) => {
                        panes += usize::from(entry.is_clear_pane);
                        found[id] = Some(entry.material);
                        entries.push((id, entry.maps));
                    }
                    (None, None) => {
                        let is_known = |(known, _): &(usize, _)| Some(*known) == id;
                        repeated += usize::from(entries.iter().any(is_known));
                    }
                    _ => {}
                }
                is_new
            });
            for (_, maps) in &entries {
                self.plan_pictures(maps, &library.source.path);
            }
            for (id, maps) in entries {
                if let Some(mut material) = found[id].take() {
                    self.pictures_of(&mut material, maps, &library.source.path);
                    found[id] = Some(material);
                }
            }
        }
        let mut note = |count: usize, what: &str| {
            if count > 0 {
                (self.notes).add("materials", || format!("{what}: {count}"));
            }
        };
        note(
            panes,
            "black glass without `d` but with `Tf` (`illum` 4 or 9) read as clear",
        );
        note(repeated, "materials of a name that came before skipped");
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
        materials
    }

    /// Memory in bytes that colours of vertices take.
    pub(super) fn color_memory(&self) -> u64 {
        match self.colors.is_empty() {
            true => 0,
            false => self.colors.memory() + budget::size::<Vec4>(self.corners.len()),
        }
    }

    /// Makes faces without a material white if vertices have colours, which then show unchanged.
    pub(super) fn whiten(&self, materials: &mut [Material]) {
        if let (false, Some(&id)) = (self.colors.is_empty(), self.material_ids.get(&None)) {
            materials[id as usize] = tint::white();
        }
    }

    /// The colours of vertices; empty if there are none or another material replaces them. If one is not opaque, the
    /// materials are covered by alpha.
    pub(super) fn vertex_colors(&mut self, materials: &mut [Material]) -> Vec<Vec4> {
        let colors = std::mem::take(&mut self.colors);
        if colors.is_empty() || self.replaced.is_some() {
            return Vec::new();
        }
        let colors = colors.finish(&mut self.notes);
        if colors.iter().any(|color| color.w < 1.0) {
            materials.iter_mut().for_each(cover);
        }
        colors
    }

    /// The entries of `vertices` at these corners.
    pub(super) fn corner_colors(&self, vertices: &[u32], colors: &[Vec4]) -> Vec<Vec4> {
        let color = |&vertex: &u32| {
            let position = self.corners[vertex as usize].position as usize;
            colors.get(position).copied().unwrap_or(Vec4::ONE)
        };
        match colors.is_empty() {
            true => Vec::new(),
            false => vertices.iter().map(color).collect(),
        }
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
            (maps.roughness.as_ref(), Role::Data),
            (maps.metallic.as_ref(), Role::Data),
            (maps.sheen.as_ref(), Role::Color),
            (maps.coat.as_ref(), Role::Data),
            (maps.coat_roughness.as_ref(), Role::Data),
        ];
        for (map, role) in colors.into_iter().chain(others) {
            let Some(map) = map else { continue };
            if let Ok((path, _)) = self.files.named_in(file).resolve_or_beside(&map.name) {
                let name = quote(map.name.as_bytes());
                self.pictures.plan(Place::File(path), &name, role);
            }
        }
    }

    fn pictures_of(&mut self, material: &mut Material, maps: mtl::Maps<String>, file: &Path) {
        if self.replaced.is_some() {
            return;
        }
        let diffuse = self.picture(maps.diffuse, Role::Color, file);
        let mut phong = material.classical().into_owned();
        if let Bsdf::MetallicRoughness(model) = &mut material.bsdf {
            Arc::make_mut(model).textures = LayerTextures {
                base_color: diffuse,
                roughness: self.picture(maps.roughness, Role::Data, file),
                metallic: self.picture(maps.metallic, Role::Data, file),
                sheen_color: self.picture(maps.sheen, Role::Color, file),
                clearcoat: self.picture(maps.coat, Role::Data, file),
                clearcoat_roughness: self.picture(maps.coat_roughness, Role::Data, file),
                ..LayerTextures::default()
            };
        }
        let specular = self.picture(maps.specular, Role::Color, file);
        phong.textures = PhongTextures {
            diffuse,
            specular,
            // Few exporters write an ambient texture, and all use the diffuse one.
            ambient: match maps.ambient {
                None => diffuse,
                map => self.picture(map, Role::Color, file),
            },
            ..PhongTextures::default()
        };
        material.set_classical(phong);
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
            cover(material);
        }
    }

    /// The texture with an image that `file` names; unreadable images are skipped.
    fn picture(&mut self, map: Option<mtl::Map<String>>, role: Role, file: &Path) -> Option<usize> {
        let map = map?;
        let name = quote(map.name.as_bytes());
        let found = match self.files.named_in(file).resolve_or_beside(&map.name) {
            Ok((path, is_beside)) => {
                if is_beside {
                    self.notes.add("textures beside the model", || {
                        format!("the texture {name} replaced by the file of that name beside the materials")
                    });
                }
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
                wrap: [if map.is_clamped {
                    Wrap::Clamp
                } else {
                    Wrap::Repeat
                }; 2],
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

/// The file name of a library, without quotes around it.
fn library_name(name: &Token) -> String {
    String::from_utf8_lossy(mtl::unquoted(name.bytes)).into_owned()
}

/// Lets alpha decide how much of a surface is there, instead of its opacity.
fn cover(material: &mut Material) {
    if material.coverage == Coverage::Opaque {
        material.coverage = Coverage::Blend;
        if let Bsdf::Phong(phong) = &mut material.bsdf {
            material.alpha *= std::mem::replace(&mut phong.opacity, 1.0);
            phong.transmit = Vec3::ZERO;
        }
    }
}

/// The role of a height map: with a negative factor it holds depths.
fn relief<N>(map: &mtl::Map<N>) -> Role {
    match map.height < 0.0 {
        true => Role::Depth,
        false => Role::Height,
    }
}
