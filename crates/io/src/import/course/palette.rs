//! Deduplicates the materials of a format that repeats them at every vertex.

use crate::import::budget;
use glam::Vec3;
use glimray_scene::{Material, Mixing, Phong};
use std::collections::HashMap;

/// Distinct materials, in order of appearance.
#[derive(Default)]
pub(super) struct Palette {
    materials: Vec<Material>,
    /// Indices by the bits of diffuse, specular and shininess.
    indices: HashMap<[u32; 7], u32>,
}

impl Palette {
    /// The index of the material with these coefficients, completed by the rules of the course.
    pub fn index(&mut self, diffuse: Vec3, specular: Vec3, shininess: f32) -> u32 {
        let [[a, b, c], [d, e, f]] = [diffuse.to_array(), specular.to_array()];
        // Adding 0 turns -0 into 0.
        let key = [a, b, c, d, e, f, shininess].map(|value| (value + 0.0).to_bits());
        *self.indices.entry(key).or_insert_with(|| {
            self.materials.push(Material {
                two_sided: false,
                bsdf: Phong {
                    diffuse,
                    specular,
                    shininess,
                    ambient: Vec3::ONE,
                    reflect: specular,
                    mixing: Mixing::Blend,
                    ..Phong::default()
                }
                .into(),
                ..Material::default()
            });
            self.materials.len() as u32 - 1
        })
    }

    /// The memory that the palette takes.
    pub fn memory(&self) -> u64 {
        // An index and its key are stored in a hash table with spare capacity.
        budget::size::<(Material, [[u32; 8]; 2])>(self.materials.len())
    }

    /// The materials, at least one.
    pub fn into_materials(mut self) -> Vec<Material> {
        if self.materials.is_empty() {
            self.index(Vec3::splat(0.8), Vec3::ZERO, 1.0);
        }
        self.materials
    }
}
