//! The names of objects, and the labels by which the window calls things.
//!
//! Something without a name goes by its kind and its number within the kind, counted from 1 in the scene's order.

use super::{EditError, Id, check};
use glimray_scene::{ObjectRef, Scene, is_numbered};
use std::collections::{BTreeMap, BTreeSet};

/// The name of something; may be empty.
pub fn name(scene: &Scene, id: Id) -> Option<&str> {
    let name = match id {
        Id::Object(ObjectRef::Instance(index)) => &scene.instances.get(index)?.name,
        Id::Object(ObjectRef::Shape(index)) => &scene.shapes.get(index)?.name,
        Id::Object(ObjectRef::Light(index)) => &scene.lights.get(index)?.name,
        Id::Node(index) => &scene.nodes.get(index)?.name,
        Id::Camera(index) => &scene.cameras.get(index)?.name,
        Id::Material(index) => &scene.materials.get(index)?.name,
    };
    Some(name)
}

/// Renames something. An empty name removes it.
///
/// # Errors
/// `id` is not in the scene.
pub fn rename(scene: &mut Scene, id: Id, name: &str) -> Result<(), EditError> {
    check(scene, id)?;
    name.trim().clone_into(slot(scene, id));
    Ok(())
}

fn slot(scene: &mut Scene, id: Id) -> &mut String {
    match id {
        Id::Object(ObjectRef::Instance(index)) => &mut scene.instances[index].name,
        Id::Object(ObjectRef::Shape(index)) => &mut scene.shapes[index].name,
        Id::Object(ObjectRef::Light(index)) => &mut scene.lights[index].name,
        Id::Node(index) => &mut scene.nodes[index].name,
        Id::Camera(index) => &mut scene.cameras[index].name,
        Id::Material(index) => &mut scene.materials[index].name,
    }
}

/// A name that nothing in the scene has: `wanted`, or the same with the lowest free number from 2 on. A number at the
/// end of `wanted` is replaced.
pub fn unused_name(scene: &Scene, wanted: &str) -> String {
    let names = (scene.instances.iter().map(|it| &it.name))
        .chain(scene.shapes.iter().map(|it| &it.name))
        .chain(scene.lights.iter().map(|it| &it.name))
        .chain(scene.nodes.iter().map(|it| &it.name))
        .chain(scene.cameras.iter().map(|it| &it.name))
        .chain(scene.materials.iter().map(|it| &it.name));
    let taken: BTreeSet<&str> = names.map(String::as_str).collect();
    let base = match wanted.rsplit_once(' ') {
        Some((base, _)) if is_numbered(wanted, base) => base,
        _ => wanted,
    };
    let numbered = (2..).map(|number| format!("{base} {number}"));
    let mut names = std::iter::once(base.to_owned()).chain(numbered);
    let is_free = |name: &String| !taken.contains(name.as_str());
    names.find(is_free).unwrap_or_default()
}

/// Gives names to objects whose numbers would change when those in `removed` are gone, so that they keep their labels.
pub(super) fn keep_numbers(scene: &mut Scene, removed: &BTreeSet<Id>) {
    let labels = Labels::of(scene);
    let mut gone: BTreeSet<&str> = BTreeSet::new();
    let mut kept = Vec::new();
    for id in objects(scene) {
        let (kind, _) = labels.parts(id);
        if removed.contains(&id) {
            gone.insert(kind);
        } else if gone.contains(kind) && name(scene, id).is_some_and(str::is_empty) {
            kept.push((id, labels.short(scene, id)));
        }
    }
    for (id, label) in kept {
        *slot(scene, id) = label;
    }
}

fn objects(scene: &Scene) -> impl Iterator<Item = Id> + use<> {
    let instances = (0..scene.instances.len()).map(ObjectRef::Instance);
    let shapes = (0..scene.shapes.len()).map(ObjectRef::Shape);
    let lights = (0..scene.lights.len()).map(ObjectRef::Light);
    instances.chain(shapes).chain(lights).map(Id::Object)
}

/// The kinds of the objects of a scene, and their numbers within them.
pub struct Labels {
    instances: Vec<(String, usize)>,
    shapes: Vec<(&'static str, usize)>,
    lights: Vec<(&'static str, usize)>,
    /// Names that several objects have, with the indices of these.
    shared: BTreeMap<String, Vec<Id>>,
}

impl Labels {
    /// The names in a scene.
    pub fn of(scene: &Scene) -> Self {
        let meshes = scene.instances.iter();
        let meshes = meshes.map(|it| kind_of_mesh(&scene.meshes[it.mesh].name).to_owned());
        let mut named: BTreeMap<&str, Vec<Id>> = BTreeMap::new();
        for id in objects(scene) {
            if let Some(name) = name(scene, id).filter(|name| !name.is_empty()) {
                named.entry(name).or_default().push(id);
            }
        }
        named.retain(|_, ids| ids.len() > 1);
        Self {
            instances: numbers(meshes),
            shapes: numbers(scene.shapes.iter().map(|it| it.geometry.title())),
            lights: numbers(scene.lights.iter().map(|it| it.kind.title())),
            shared: (named.into_iter())
                .map(|(name, ids)| (name.to_owned(), ids))
                .collect(),
        }
    }

    /// The kind of an object and its number.
    fn parts(&self, id: Id) -> (&str, usize) {
        match id {
            Id::Object(ObjectRef::Instance(index)) => {
                let (kind, number) = &self.instances[index];
                (kind, *number)
            }
            Id::Object(ObjectRef::Shape(index)) => self.shapes[index],
            Id::Object(ObjectRef::Light(index)) => self.lights[index],
            Id::Node(index) => ("node", index + 1),
            Id::Camera(index) => ("camera", index + 1),
            Id::Material(index) => ("material", index + 1),
        }
    }

    /// The label of something that is in the scene, without its material.
    pub fn short(&self, scene: &Scene, id: Id) -> String {
        let name = name(scene, id).unwrap_or_default();
        if name.is_empty() {
            let (kind, number) = self.parts(id);
            return format!("{kind} {number}");
        }
        let same = self.shared.get(name);
        match same.and_then(|ids| ids.binary_search(&id).ok()) {
            Some(index) => format!("{name} {}", index + 1),
            None => name.to_owned(),
        }
    }

    /// The label of something that is in the scene, such as "sphere 3 (glass)".
    pub fn whole(&self, scene: &Scene, id: Id) -> String {
        let own = self.short(scene, id);
        let material = match id {
            Id::Object(ObjectRef::Shape(index)) => Some(scene.shapes[index].material),
            Id::Object(ObjectRef::Instance(index)) => {
                let materials = &scene.meshes[scene.instances[index].mesh].materials;
                let first = materials.first().copied().unwrap_or(0);
                if materials.iter().any(|material| *material != first) {
                    return format!("{own} (several materials)");
                }
                Some(first as usize)
            }
            _ => None,
        };
        let material = material.map(|index| self.short(scene, Id::Material(index)));
        match material.filter(|material| *material != own) {
            Some(material) => format!("{own} ({material})"),
            None => own,
        }
    }
}

/// Each kind with how many equal ones there are up to it.
fn numbers<K: Clone + Ord>(kinds: impl Iterator<Item = K>) -> Vec<(K, usize)> {
    let mut counts: BTreeMap<K, usize> = BTreeMap::new();
    kinds
        .map(|kind| {
            let count = counts.entry(kind.clone()).or_default();
            *count += 1;
            (kind, *count)
        })
        .collect()
}

/// The label of a mesh instance, without its number. Files store a name for every mesh: unnamed ones are
/// saved as "mesh 2" and the like, which counts as unnamed here so that saving renames nothing.
fn kind_of_mesh(name: &str) -> &str {
    match name.is_empty() || is_numbered(name, "mesh") {
        true => "mesh",
        false => name,
    }
}
