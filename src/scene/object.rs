//! Things in a scene that rays can hit.

use super::Scene;
use serde::Serialize;

/// Something in a [`Scene`] that rays can hit, by its place in its list.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize)]
#[serde(tag = "kind", content = "index", rename_all = "lowercase")]
pub enum ObjectRef {
    /// Index into [`Scene::instances`].
    Instance(usize),
    /// Index into [`Scene::shapes`].
    Shape(usize),
    /// Index into [`Scene::lights`]: the surface of a lamp.
    Light(usize),
}

impl Scene {
    /// The name of an object: that of the nearest named node that carries it, else that of its mesh, else
    /// empty; for an index that is out of range too.
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
