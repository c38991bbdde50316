//! References to objects that rays can hit.

use super::Scene;
use schemars::JsonSchema;
use serde::Serialize;

/// An object in a [`Scene`] that rays can hit, by its index.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, JsonSchema)]
#[serde(tag = "kind", content = "index", rename_all = "lowercase")]
pub enum ObjectRef {
    /// Index into [`Scene::instances`].
    Instance(usize),
    /// Index into [`Scene::shapes`].
    Shape(usize),
    /// Index into [`Scene::lights`]: the surface of an area light.
    Light(usize),
}

impl Scene {
    /// The name of an object: its own, otherwise that of the nearest named ancestor node, otherwise that of its mesh,
    /// otherwise empty. Also empty if the index is out of range.
    pub fn object_name(&self, object: ObjectRef) -> &str {
        let (own, node, mesh) = match object {
            ObjectRef::Instance(index) => match self.instances.get(index) {
                Some(instance) => (Some(&instance.name), instance.node, Some(instance.mesh)),
                None => (None, None, None),
            },
            ObjectRef::Shape(index) => match self.shapes.get(index) {
                Some(shape) => (Some(&shape.name), shape.node, None),
                None => (None, None, None),
            },
            ObjectRef::Light(index) => match self.lights.get(index) {
                Some(light) => (Some(&light.name), light.node, None),
                None => (None, None, None),
            },
        };
        let above = std::iter::successors(node, |&node| self.nodes[node].parent);
        let names = own
            .into_iter()
            .chain(above.map(|node| &self.nodes[node].name));
        let mut named = names.filter(|name| !name.is_empty());
        let mesh = mesh.map(|mesh| &self.meshes[mesh].name);
        named.next().or(mesh).map_or("", String::as_str)
    }
}

/// Whether a name is a kind with a number, such as "sphere 3", as things without a name are called.
pub fn is_numbered(name: &str, kind: &str) -> bool {
    let number = name
        .strip_prefix(kind)
        .and_then(|rest| rest.strip_prefix(' '));
    number.is_some_and(|n| !n.is_empty() && n.bytes().all(|b| b.is_ascii_digit()))
}
