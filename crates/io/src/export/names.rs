//! Names for everything that a scene file refers to.

use crate::import::native::file::Spanned;
use glimray_scene::{Scene, Target};
use std::collections::HashSet;

/// Names by index in the scene's lists.
pub(super) struct Names {
    pub materials: Vec<String>,
    pub textures: Vec<String>,
    pub meshes: Vec<String>,
    pub nodes: Vec<String>,
    /// Empty if nothing refers to it and it had none.
    pub cameras: Vec<String>,
    /// Empty if nothing refers to it.
    pub lights: Vec<String>,
}

impl Names {
    pub fn of(scene: &Scene) -> Self {
        let targets = || scene.tracks.iter().flat_map(|track| &track.targets);
        let is_filmed = |i: usize| targets().any(|t| matches!(*t, Target::Camera(j, _) if i == j));
        let is_lit = |i: usize| targets().any(|t| matches!(*t, Target::Light(j, _) if i == j));
        let given = |name: &str| name.to_owned();
        let mut cameras = unique("camera", scene.cameras.iter().map(|c| given(&c.name)));
        for (index, (name, camera)) in cameras.iter_mut().zip(&scene.cameras).enumerate() {
            if camera.name.is_empty() && !is_filmed(index) {
                name.clear();
            }
        }
        let mut lights = unique("light", scene.lights.iter().map(|_| String::new()));
        for (index, name) in lights.iter_mut().enumerate() {
            if !is_lit(index) {
                name.clear();
            }
        }
        let materials = unique("material", scene.materials.iter().map(|m| given(&m.name)));
        // A texture is named after the first material that uses it.
        let mut textures = vec![String::new(); scene.textures.len()];
        for (name, material) in materials.iter().zip(&scene.materials) {
            for texture in material.texture_indices() {
                if textures[texture].is_empty() {
                    textures[texture].clone_from(name);
                }
            }
        }
        Self {
            textures: unique("texture", textures.into_iter()),
            materials,
            meshes: unique("mesh", scene.meshes.iter().map(|m| given(&m.name))),
            nodes: unique("node", scene.nodes.iter().map(|n| given(&n.name))),
            cameras,
            lights,
        }
    }

    /// A material as a value.
    pub fn material(&self, index: usize) -> Spanned<String> {
        self.materials[index].clone().into()
    }

    /// A texture as a value.
    pub fn texture(&self, index: usize) -> Spanned<String> {
        self.textures[index].clone().into()
    }

    /// A node as a value; `None` is the world.
    pub fn node(&self, index: Option<usize>) -> Option<Spanned<String>> {
        index.map(|index| self.nodes[index].clone().into())
    }
}

/// Unique names: the first of several equal names is kept, and missing ones are generated from the kind.
fn unique(kind: &str, names: impl Iterator<Item = String>) -> Vec<String> {
    let mut names: Vec<String> = names.collect();
    let mut taken: HashSet<String> = HashSet::new();
    let mut open = Vec::new();
    for (index, name) in names.iter().enumerate() {
        if name.is_empty() || !taken.insert(name.clone()) {
            open.push(index);
        }
    }
    for index in open {
        let base = match names[index].as_str() {
            "" => kind.to_owned(),
            name => name.to_owned(),
        };
        // Numbers count from 1, so the second of two gets number 2.
        let mut number = if names[index].is_empty() {
            index + 1
        } else {
            2
        };
        names[index] = loop {
            let name = format!("{base} {number}");
            if taken.insert(name.clone()) {
                break name;
            }
            number += 1;
        };
    }
    names
}
