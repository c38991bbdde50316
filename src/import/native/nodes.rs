//! The nodes of a native scene: those that it lists, and one for every copy of an object that moves, is
//! looked at, or carries something.

use super::Texts;
use super::file::{NodeTable, SceneFile, TransformTable};
use super::objects::{Object, Objects};
use super::transforms::{chain, check, is_invertible};
use crate::import::error::ImportError;
use crate::import::source::quote;
use crate::import::suggest;
use crate::scene::Node;
use glam::DAffine3;
use std::collections::HashMap;
use std::ops::Range;
use toml::Spanned;

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
    /// Those that the file lists, by name.
    declared: HashMap<&'a str, [usize; 1]>,
    /// Which of those are where the world is, and stay there.
    fixed: Vec<bool>,
}

impl<'a> Nodes<'a> {
    /// Those that `file` lists.
    pub fn new(
        objects: &'a Objects<'a>,
        file: &'a SceneFile,
        texts: &Texts,
    ) -> Result<Self, ImportError> {
        let mut nodes = Self {
            objects,
            nodes: Vec::with_capacity(file.nodes.len()),
            world_from_node: Vec::with_capacity(file.nodes.len()),
            of_objects: vec![Vec::new(); objects.len()],
            declared: HashMap::new(),
            fixed: Vec::new(),
        };
        for table in &file.nodes {
            nodes.declare(table, texts)?;
        }
        Ok(nodes)
    }

    fn declare(
        &mut self,
        spanned: &'a Spanned<NodeTable>,
        texts: &Texts,
    ) -> Result<(), ImportError> {
        let table = spanned.get_ref();
        let place = match &table.carried_by {
            Some(name) => self.declared(name, texts)?,
            None => Place::default(),
        };
        for transform in table.transform.iter().chain(&table.placement) {
            check(transform, texts)?;
        }
        let transform = table.transform.as_ref().map(Spanned::get_ref);
        let placement = table.placement.as_ref().map(|p| p.get_ref().affine());
        let placement = placement.unwrap_or(DAffine3::IDENTITY);
        let name = table.name.get_ref();
        let is_fixed = place.node.is_none_or(|parent| self.fixed[parent]);
        let index = self.push(name.clone(), table.visible, transform, placement, place);
        let world_from_node = self.world_from_node[index];
        if !is_invertible(world_from_node.matrix3) {
            let why = "nothing is left of what the node carries, or all of it is out of range";
            let todo = "Check its scale, and those of the nodes that carry it";
            return Err(texts.malformed(spanned.span(), why.to_owned(), todo));
        }
        self.declared.insert(name, [index]);
        let stays = is_fixed && !self.objects.is_animated(name);
        self.fixed
            .push(stays && world_from_node == DAffine3::IDENTITY);
        Ok(())
    }

    /// The place that the listed node of this name carries.
    pub fn declared(&self, name: &Spanned<String>, texts: &Texts) -> Result<Place, ImportError> {
        if let Some(&[node]) = self.declared.get(name.get_ref().as_str()) {
            return Ok(Place {
                node: Some(node),
                node_from_here: DAffine3::IDENTITY,
                world_from_node: self.world_from_node[node],
            });
        }
        let mut known: Vec<&str> = self.declared.keys().copied().collect();
        known.sort_unstable();
        let why = suggest::unknown("node", name.get_ref(), known);
        let todo = "Add it under [[nodes]], in front of the nodes that it carries";
        Err(texts.malformed(name.span(), why, todo))
    }

    /// Whether a node is one of those listed, is where the world is, and stays there.
    pub fn is_fixed(&self, node: usize) -> bool {
        self.fixed.get(node).copied().unwrap_or(false)
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
        let name = name.unwrap_or_default();
        let node = self.push(name, table.visible, transform, placement, place);
        self.of_objects[index].push(node);
        Place {
            node: Some(node),
            node_from_here: DAffine3::IDENTITY,
            world_from_node: self.world_from_node[node],
        }
    }

    fn push(
        &mut self,
        name: String,
        visible: bool,
        transform: Option<&TransformTable>,
        placement: DAffine3,
        place: Place,
    ) -> usize {
        let mut node = Node {
            name,
            parent: place.node,
            placement,
            visible,
            ..Node::default()
        };
        match transform {
            // It stands still: animations know nothing of it.
            Some(table) if table.matrix.is_some() => {
                node.placement = chain(placement, table.affine());
            }
            Some(table) => {
                node.translation = table.translate.0;
                node.rotation = table.turn();
                node.scale = table.scale.0;
            }
            None => {}
        }
        let world_from_node = place.world_from_node * node.parent_from_node();
        self.nodes.push(node);
        self.world_from_node.push(world_from_node);
        self.nodes.len() - 1
    }

    /// Those of all copies of the object of this name.
    pub fn all(
        &self,
        name: &str,
        span: Range<usize>,
        texts: &Texts,
    ) -> Result<&[usize], ImportError> {
        if let Some(node) = self.declared.get(name) {
            return Ok(node);
        }
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
