//! Texture coordinates: the `vt` statement, and which vertices keep them.

use super::Reader;
use super::face;
use super::lines::Line;
use crate::import::source::Token;
use glam::Vec2;
use glimray_scene::Material;

impl Reader<'_> {
    /// Reads u and optionally v. Only solid textures use w, so another than 0 is reported.
    pub(super) fn texture_coordinates(&mut self, keyword: Token, line: &mut Line) {
        let mut numbers = [0.0; 3];
        for (i, number) in numbers.iter_mut().enumerate() {
            match line.word() {
                Some(word) => {
                    let read = self.faults.number("vt", self.source, word);
                    *number = read.unwrap_or_default();
                }
                None if i == 0 => {
                    let what = ("vt", "texture coordinates without a number set to 0");
                    self.faults.add(what, self.source, keyword.span(), || {
                        let why = format!("{} needs a number", keyword.quote());
                        (why, "Write `vt U V`")
                    });
                }
                None => break,
            }
        }
        if numbers[2] != 0.0 {
            self.skip("third texture coordinates");
        }
        // Beyond this, f32 has whole numbers only, and all texture coordinates are equivalent.
        let place = |x: f64| x.clamp(-1e9, 1e9) as f32;
        self.uvs
            .push(Vec2::new(place(numbers[0]), place(numbers[1])));
    }

    /// Removes u and v from corners whose material does not use them, so that they do not split vertices.
    pub(super) fn drop_unwanted_uvs(&mut self, materials: &[Material]) {
        for corner in &mut self.corners {
            let material = &materials[corner.material as usize];
            if !self.replaced.unwrap_or_else(|| is_textured(material)) {
                corner.uv = face::NO_UV;
            }
        }
    }

    /// u and v of `vertices`; empty if none has any. Adds a note if `materials` use them.
    pub(super) fn uvs_of(&mut self, vertices: &[u32], materials: &[Material]) -> Vec<Vec2> {
        let uv = |&vertex: &u32| self.corners[vertex as usize].uv;
        if vertices.iter().any(|v| uv(v) != face::NO_UV) {
            let place = |v: &u32| self.uvs.get(uv(v) as usize).copied().unwrap_or_default();
            return vertices.iter().map(place).collect();
        }
        let own = || materials.iter().any(is_textured);
        if self.replaced.unwrap_or_else(own) {
            self.notes.add("meshes without texture coordinates", || {
                "no texture coordinates: each texture shows a single colour".to_owned()
            });
        }
        Vec::new()
    }
}

fn is_textured(material: &Material) -> bool {
    material.has_tangents() || material.texture_indices().next().is_some()
}
