//! The nodes of a native scene: those that it lists, and one for every copy of an object that moves, is a
//! camera's target, or has children.

use super::Texts;
use super::file::Spanned;
use super::file::{NodeTable, SceneFile, TransformTable};
use super::objects::{Object, Objects};
use super::transforms::{chain, check, is_invertible};
use crate::import::error::ImportError;
use crate::import::source::quote;
use crate::import::suggest;
use glam::DAffine3;
use glimray_scene::Node;
use std::collections::HashMap;
use std::ops::Range;

/// The coordinate frame in which objects are placed.
#[derive(Clone, Copy, Default)]
pub(super) struct NodePlacement {
    /// The parent node; `None` is the world.
    pub node: Option<usize>,
    /// The static transform from the frame to the node.
    pub node_from_here: DAffine3,
    /// The node's transform to the world at rest.
    pub world_from_node: DAffine3,
}

impl NodePlacement {
    /// From the frame to the world, at rest.
    pub fn world_from_here(&self) -> DAffine3 {
        self.world_from_node * self.node_from_here
    }
}

/// All nodes, and the objects that they belong to.
pub(super) struct Nodes<'a> {
    objects: &'a Objects<'a>,
    /// The nodes for the scene.
    pub nodes: Vec<Node>,
    /// Their transforms to the world at rest.
    world_from_node: Vec<DAffine3>,
    /// The nodes of an object's copies, by object index.
    of_objects: Vec<Vec<usize>>,
    /// The listed nodes by name.
    declared: HashMap<&'a str, [usize; 1]>,
    /// Whether each of them is static and coincides with the world.
    fixed: Vec<bool>,
}

impl<'a> Nodes<'a> {
    /// Adds the nodes that `file` lists.
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
            None => NodePlacement::default(),
        };
        for transform in table.transform.iter().chain(&table.placement) {
            check(transform, texts)?;
        }
        let transform = table.transform.as_ref().map(Spanned::get_ref);
        let placement = table.placement.as_ref().map(|p| p.affine());
        let placement = placement.unwrap_or(DAffine3::IDENTITY);
        let name = table.name.get_ref();
        let is_fixed = place.node.is_none_or(|parent| self.fixed[parent]);
        let index = self.push(name.clone(), table.visible, transform, placement, place);
        let world_from_node = self.world_from_node[index];
        if !is_invertible(world_from_node.matrix3) {
            let why =
                "the node's scale, combined with those of its parents, is zero or out of range";
            let todo = "Check these scales";
            return Err(texts.malformed(spanned.span(), why.to_owned(), todo));
        }
        self.declared.insert(name, [index]);
        let stays = is_fixed && !self.objects.is_animated(name);
        self.fixed
            .push(stays && world_from_node == DAffine3::IDENTITY);
        Ok(())
    }

    /// The frame of the listed node `name`.
    pub fn declared(
        &self,
        name: &Spanned<String>,
        texts: &Texts,
    ) -> Result<NodePlacement, ImportError> {
        if let Some(&[node]) = self.declared.get(name.as_str()) {
            return Ok(NodePlacement {
                node: Some(node),
                node_from_here: DAffine3::IDENTITY,
                world_from_node: self.world_from_node[node],
            });
        }
        let mut known: Vec<&str> = self.declared.keys().copied().collect();
        known.sort_unstable();
        let why = suggest::unknown("node", name.get_ref(), known);
        let todo = "Add it under [[nodes]], before its children";
        Err(texts.malformed(name.span(), why, todo))
    }

    /// Whether a node is listed, static, and coincides with the world.
    pub fn is_fixed(&self, node: usize) -> bool {
        self.fixed.get(node).copied().unwrap_or(false)
    }

    /// Adds a node for a copy of `object`, which has this index. `placement` is the static transform
    /// above it. Returns the frame inside it.
    pub fn add(
        &mut self,
        index: usize,
        object: &Object,
        placement: DAffine3,
        place: NodePlacement,
    ) -> NodePlacement {
        let table = object.table.get_ref();
        let transform = table
            .transform
            .as_ref()
            .map(|transform| transform.get_ref());
        let name = table.name.as_ref().map(|name| name.get_ref().clone());
        let name = name.unwrap_or_default();
        let node = self.push(name, table.visible, transform, placement, place);
        self.of_objects[index].push(node);
        NodePlacement {
            node: Some(node),
            node_from_here: DAffine3::IDENTITY,
            world_from_node: self.world_from_node[node],
        }
    }

    fn push(
        &mut self,
        name: String,
        visible: Option<bool>,
        transform: Option<&TransformTable>,
        placement: DAffine3,
        place: NodePlacement,
    ) -> usize {
        let mut node = Node {
            name,
            parent: place.node,
            placement,
            visible: visible.unwrap_or(true),
            ..Node::default()
        };
        match transform {
            // A node with a matrix is static: no animation refers to it.
            Some(table) if table.matrix.is_some() => {
                node.placement = chain(placement, table.affine());
            }
            Some(table) => {
                (node.scale, node.rotation, node.translation) = table.parts();
            }
            None => {}
        }
        let world_from_node = place.world_from_node * node.parent_from_node();
        self.nodes.push(node);
        self.world_from_node.push(world_from_node);
        self.nodes.len() - 1
    }

    /// The nodes of all copies of the object `name`.
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

    /// The node of the object `name`, which must not have copies.
    pub fn one(&self, name: &str, span: Range<usize>, texts: &Texts) -> Result<usize, ImportError> {
        let nodes = self.all(name, span.clone(), texts)?;
        if let &[node] = nodes {
            return Ok(node);
        }
        let quoted = quote(name.as_bytes());
        let (why, todo) = match nodes.len() {
            0 => (
                format!("{quoted} is nowhere in the scene: its group is hidden or never placed"),
                "Place it, or name another object",
            ),
            count => (
                format!("{quoted} is in the scene {count} times"),
                "Name an object that is not repeated and not in a group that is placed more than once",
            ),
        };
        Err(texts.malformed(span, why, todo))
    }

    /// The transform of a node to the world at rest; `None` is the world.
    pub fn world_from(&self, node: Option<usize>) -> DAffine3 {
        node.map_or(DAffine3::IDENTITY, |node| self.world_from_node[node])
    }
}
