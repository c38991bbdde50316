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
    /// The name of an object: that of the nearest named ancestor node, otherwise that of its mesh,
    /// otherwise empty. Also empty if the index is out of range.
    pub fn object_name(&self, object: ObjectRef) -> &str {
        let (node, mesh) = match object {
            ObjectRef::Instance(index) => match self.instances.get(index) {
                Some(instance) => (instance.node, Some(instance.mesh)),
                None => (None, None),
            },
            ObjectRef::Shape(index) => (self.shapes.get(index).and_then(|shape| shape.node), None),
            ObjectRef::Light(index) => (self.lights.get(index).and_then(|light| light.node), None),
        };
        let above = std::iter::successors(node, |&node| self.nodes[node].parent);
        let mut names = above.map(|node| self.nodes[node].name.as_str());
        let named = names.find(|name| !name.is_empty());
        named.unwrap_or(mesh.map_or("", |mesh| &self.meshes[mesh].name))
    }
}
