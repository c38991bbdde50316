//! Texture coordinates: the `vt` statement, and those of vertices.

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

    /// u and v of `vertices`; empty if none has any. Adds a note if `materials` use them and have none.
    pub(super) fn uvs_of(&mut self, vertices: &[u32], materials: &[Material]) -> Vec<Vec2> {
        let corner = |&vertex: &u32| self.corners[vertex as usize];
        let has_uv = |vertex: &&u32| corner(vertex).uv != face::NO_UV;
        let is_used = |vertex: &u32| {
            let material = &materials[corner(vertex).material as usize];
            self.replaced.unwrap_or_else(|| is_textured(material))
        };
        let are_used = self
            .replaced
            .unwrap_or_else(|| materials.iter().any(is_textured));
        if are_used && !vertices.iter().filter(has_uv).any(is_used) {
            self.notes.add("meshes without texture coordinates", || {
                "no texture coordinates: each texture shows a single colour".to_owned()
            });
        }
        match vertices.iter().any(|vertex| has_uv(&vertex)) {
            true => {
                let uv = |vertex: &u32| self.uvs.get(corner(vertex).uv as usize);
                let uvs = vertices.iter().map(uv);
                uvs.map(|uv| uv.copied().unwrap_or_default()).collect()
            }
            false => Vec::new(),
        }
    }
}

fn is_textured(material: &Material) -> bool {
    material.has_tangents() || material.texture_indices().next().is_some()
}
