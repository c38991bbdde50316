//! The nodes of a native scene: every copy of an object that moves, is looked at, or carries something.

use super::Texts;
use super::build::rotation;
use super::objects::{Object, Objects};
use crate::import::error::ImportError;
use crate::import::source::quote;
use crate::scene::Node;
use glam::{DAffine3, DQuat, DVec3};
use std::ops::Range;

/// Where objects are placed.
#[derive(Clone, Copy, Default)]
pub(super) struct Place {
    /// The node that carries them; `None` is the world.
    pub node: Option<usize>,
    /// What stands still between them and the node.
    pub node_from_here: DAffine3,
    /// Where the node is at rest.
    pub world_from_node: DAffine3,
}

impl Place {
    /// At rest.
    pub fn world_from_here(&self) -> DAffine3 {
        self.world_from_node * self.node_from_here
    }
}

/// All nodes, and the objects that they are of.
pub(super) struct Nodes<'a> {
    objects: &'a Objects<'a>,
    /// For the scene, once all are there.
    pub nodes: Vec<Node>,
    /// At rest.
    world_from_node: Vec<DAffine3>,
    /// The nodes of an object's copies, by its index.
    of_objects: Vec<Vec<usize>>,
}

impl<'a> Nodes<'a> {
    /// None yet.
    pub fn new(objects: &'a Objects<'a>) -> Self {
        Self {
            objects,
            nodes: Vec::new(),
            world_from_node: Vec::new(),
            of_objects: vec![Vec::new(); objects.len()],
        }
    }

    /// Adds one for a copy of `object`, whose index this is. `placement` is all that stands still above
    /// it. Returns the place inside it.
    pub fn add(
        &mut self,
        index: usize,
        object: &Object,
        placement: DAffine3,
        place: Place,
    ) -> Place {
        let table = object.table.get_ref();
        let transform = table
            .transform
            .as_ref()
            .map(|transform| transform.get_ref());
        let name = table.name.as_ref().map(|name| name.get_ref().clone());
        let node = Node {
            name: name.unwrap_or_default(),
            parent: place.node,
            placement,
            translation: transform.map_or(DVec3::ZERO, |t| t.translate.0),
            rotation: transform.map_or(DQuat::IDENTITY, |t| rotation(t.rotate_deg.0)),
            scale: transform.map_or(DVec3::ONE, |t| t.scale.0),
            visible: table.visible,
        };
        let world_from_node = place.world_from_node * node.parent_from_node();
        self.of_objects[index].push(self.nodes.len());
        self.nodes.push(node);
        self.world_from_node.push(world_from_node);
        Place {
            node: Some(self.nodes.len() - 1),
            node_from_here: DAffine3::IDENTITY,
            world_from_node,
        }
    }

    /// Those of all copies of the object of this name.
    pub fn all(
        &self,
        name: &str,
        span: Range<usize>,
        texts: &Texts,
    ) -> Result<&[usize], ImportError> {
        Ok(&self.of_objects[self.objects.named(name, span, texts)?])
    }

    /// That of the object of this name, which has no copies.
    pub fn one(&self, name: &str, span: Range<usize>, texts: &Texts) -> Result<usize, ImportError> {
        let nodes = self.all(name, span.clone(), texts)?;
        if let &[node] = nodes {
            return Ok(node);
        }
        let quoted = quote(name.as_bytes());
        let (why, todo) = match nodes.len() {
            0 => (
                format!(
                    "{quoted} is in no part of the scene: its group is hidden, or placed nowhere"
                ),
                "Place it, or name another object",
            ),
            count => (
                format!("{quoted} is in the scene {count} times"),
                "Name an object that is not repeated and in no group that is placed more than once",
            ),
        };
        Err(texts.malformed(span, why, todo))
    }

    /// Where a node is at rest; `None` is the world.
    pub fn world_from(&self, node: Option<usize>) -> DAffine3 {
        node.map_or(DAffine3::IDENTITY, |node| self.world_from_node[node])
    }
}
