//! The contents of a scene as rows, indented by hierarchy.

use crate::model::objects;
use crate::model::objects::{Id, Labels};
use glimray_scene::{ObjectRef, Scene};
use std::collections::BTreeMap;

/// The heading of the objects.
pub const OBJECTS: &str = "Objects";

/// A row of an [`Outline`].
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Entry {
    /// The item; `None` for headings.
    pub id: Option<Id>,
    /// Text of the line, such as "sphere 3 (glass)".
    pub label: String,
    /// How far it is indented: 0 for headings.
    pub depth: usize,
    /// Whether it is visible at rest; true for items without visibility.
    pub visible: bool,
}

/// All of a scene: objects by hierarchy, then lights, cameras and materials.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Outline {
    /// From top to bottom; children below their parent.
    pub entries: Vec<Entry>,
}

impl Outline {
    /// The outline of a scene.
    pub fn of(scene: &Scene) -> Self {
        let mut outline = Self::default();
        let labels = Labels::of(scene);
        let mut carried: BTreeMap<Option<usize>, Vec<Id>> = BTreeMap::new();
        let mut hang = |node: Option<usize>, id| {
            carried
                .entry(objects::shown_carrier(scene, node))
                .or_default()
                .push(id);
        };
        for (index, node) in scene.nodes.iter().enumerate() {
            if !objects::is_hider(scene, index) {
                hang(node.parent, Id::Node(index));
            }
        }
        for (index, instance) in scene.instances.iter().enumerate() {
            hang(instance.node, Id::Object(ObjectRef::Instance(index)));
        }
        for (index, shape) in scene.shapes.iter().enumerate() {
            hang(shape.node, Id::Object(ObjectRef::Shape(index)));
        }
        outline.heading(OBJECTS);
        // With an explicit stack, because nodes may be nested deeply.
        let mut open: Vec<(usize, Id)> = Vec::new();
        let mut put = |open: &mut Vec<(usize, Id)>, depth, node| {
            let below = carried.remove(&node).unwrap_or_default();
            open.extend(below.into_iter().rev().map(|id| (depth, id)));
        };
        put(&mut open, 1, None);
        while let Some((depth, id)) = open.pop() {
            outline.entry(scene, &labels, id, depth);
            if let Id::Node(index) = id {
                put(&mut open, depth + 1, Some(index));
            }
        }
        let lists = [
            ("Lights", scene.lights.len(), light as fn(usize) -> Id),
            ("Cameras", scene.cameras.len(), Id::Camera),
            ("Materials", scene.materials.len(), Id::Material),
        ];
        for (heading, count, id) in lists {
            outline.heading(heading);
            (0..count).for_each(|index| outline.entry(scene, &labels, id(index), 1));
        }
        outline
    }

    /// Indices of the rows whose labels contain all words of `query`, ignoring case, and of their ancestors.
    /// All rows if there are no words.
    pub fn search(&self, query: &str) -> Vec<usize> {
        let words: Vec<String> = query.split_whitespace().map(str::to_lowercase).collect();
        let mut found = Vec::new();
        // The last row of each depth while it is an ancestor of the next one.
        let mut above: Vec<usize> = Vec::new();
        for (index, entry) in self.entries.iter().enumerate() {
            above.truncate(entry.depth);
            above.push(index);
            let label = entry.label.to_lowercase();
            let is_found = entry.id.is_some() && words.iter().all(|word| label.contains(word));
            if is_found || words.is_empty() {
                let last = found.last().copied();
                found.extend(
                    above
                        .iter()
                        .filter(|&&index| last.is_none_or(|last| index > last)),
                );
            }
        }
        found
    }

    /// Index of the row of an item.
    pub fn position(&self, id: Id) -> Option<usize> {
        self.entries.iter().position(|entry| entry.id == Some(id))
    }

    fn heading(&mut self, label: &str) {
        self.entries.push(Entry {
            id: None,
            label: label.to_owned(),
            depth: 0,
            visible: true,
        });
    }

    fn entry(&mut self, scene: &Scene, labels: &Labels, id: Id, depth: usize) {
        self.entries.push(Entry {
            id: Some(id),
            label: labels.whole(scene, id),
            depth,
            visible: objects::is_visible(scene, id),
        });
    }
}

fn light(index: usize) -> Id {
    Id::Object(ObjectRef::Light(index))
}

/// The label of one item; for many, [`Outline::of`] is faster.
pub fn label(scene: &Scene, id: Id) -> String {
    Labels::of(scene).whole(scene, id)
}

/// The labels of some items; those that are not in the scene have none.
pub fn labels(scene: &Scene, ids: impl IntoIterator<Item = Id>) -> BTreeMap<Id, String> {
    let labels = Labels::of(scene);
    ids.into_iter()
        .filter(|id| objects::is_there(scene, *id))
        .map(|id| (id, labels.whole(scene, id)))
        .collect()
}
