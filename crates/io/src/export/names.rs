//! Names for everything that a scene file refers to.

use crate::import::native::file::Spanned;
use glimray_scene::{Scene, Target};
use std::collections::{HashMap, HashSet};

/// Names by index in the scene's lists.
pub(super) struct Names {
    pub materials: Vec<String>,
    pub textures: Vec<String>,
    pub meshes: Vec<String>,
    pub nodes: Vec<String>,
    /// Empty if nothing refers to it and it had none.
    pub cameras: Vec<String>,
    /// Empty if nothing refers to it and it had none.
    pub lights: Vec<String>,
    /// Whether an animation refers to it, by index of the light.
    pub animated_lights: Vec<bool>,
    /// The names of objects.
    pub objects: ObjectNames,
}

/// The names of objects, which are unique among those of objects and nodes.
pub(super) struct ObjectNames {
    taken: HashSet<String>,
    /// The next number to try for names that are taken.
    numbers: HashMap<String, usize>,
}

impl ObjectNames {
    /// `name` as the name of the next object, with a number if it is taken; `None` if it is empty.
    pub fn next(&mut self, name: &str) -> Option<Spanned<String>> {
        if name.is_empty() {
            return None;
        }
        let mut unique = name.to_owned();
        while !self.taken.insert(unique.clone()) {
            let number = self.numbers.entry(name.to_owned()).or_insert(1);
            *number += 1;
            unique = format!("{name} {number}");
        }
        Some(unique.into())
    }
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
        let animated_lights: Vec<bool> = (0..scene.lights.len()).map(is_lit).collect();
        let mut lights = unique("light", scene.lights.iter().map(|l| given(&l.name)));
        for ((name, light), is_animated) in
            lights.iter_mut().zip(&scene.lights).zip(&animated_lights)
        {
            if light.name.is_empty() && !is_animated {
                name.clear();
            }
        }
        let nodes = unique("node", scene.nodes.iter().map(|n| given(&n.name)));
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
            objects: ObjectNames {
                taken: nodes.iter().cloned().collect(),
                numbers: HashMap::new(),
            },
            nodes,
            cameras,
            lights,
            animated_lights,
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
