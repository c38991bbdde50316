//! The contents of a scene as rows, indented by hierarchy.

use crate::model::objects;
use crate::model::objects::Id;
use glimray_scene::{CanonicalShape, Geometry, LightKind, ObjectRef, Scene};
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

/// All of a scene: objects by hierarchy, then lights, cameras and materials. Numbers in labels count from 1
/// within a kind, in the scene's order.
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
            label: labels.of_id(scene, id),
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
    Labels::of(scene).of_id(scene, id)
}

/// The labels of some items; those that are not in the scene have none.
pub fn labels(scene: &Scene, ids: impl IntoIterator<Item = Id>) -> BTreeMap<Id, String> {
    let labels = Labels::of(scene);
    ids.into_iter()
        .filter(|id| objects::is_there(scene, *id))
        .map(|id| (id, labels.of_id(scene, id)))
        .collect()
}

/// The numbers of items within their kinds.
struct Labels {
    shapes: Vec<usize>,
    instances: Vec<usize>,
    lights: Vec<usize>,
}

impl Labels {
    fn of(scene: &Scene) -> Self {
        let shapes = scene.shapes.iter().map(|shape| kind_of(&shape.geometry));
        let instances = scene
            .instances
            .iter()
            .map(|i| kind_of_mesh(&scene.meshes[i.mesh].name));
        let lights = scene.lights.iter().map(|light| kind_of_light(&light.kind));
        Self {
            shapes: numbers(shapes),
            instances: numbers(instances),
            lights: numbers(lights),
        }
    }

    fn of_id(&self, scene: &Scene, id: Id) -> String {
        let named = |name: &str, kind: &str, index: usize| match name {
            "" => format!("{kind} {}", index + 1),
            name => name.to_owned(),
        };
        let material = |index: usize| named(&scene.materials[index].name, "material", index);
        match id {
            Id::Object(ObjectRef::Shape(index)) => {
                let shape = &scene.shapes[index];
                let kind = kind_of(&shape.geometry);
                format!(
                    "{kind} {} ({})",
                    self.shapes[index],
                    material(shape.material)
                )
            }
            Id::Object(ObjectRef::Instance(index)) => {
                let mesh = &scene.meshes[scene.instances[index].mesh];
                let name = kind_of_mesh(&mesh.name);
                let number = self.instances[index];
                let first = mesh.materials.first().copied().unwrap_or(0);
                match mesh.materials.iter().all(|material| *material == first) {
                    true => format!("{name} {number} ({})", material(first as usize)),
                    false => format!("{name} {number} (several materials)"),
                }
            }
            Id::Object(ObjectRef::Light(index)) => {
                let kind = kind_of_light(&scene.lights[index].kind);
                format!("{kind} {}", self.lights[index])
            }
            Id::Node(index) => named(&scene.nodes[index].name, "node", index),
            Id::Camera(index) => named(&scene.cameras[index].name, "camera", index),
            Id::Material(index) => material(index),
        }
    }
}

/// For each entry of `kinds`, how many equal ones there are up to it.
fn numbers<'a>(kinds: impl Iterator<Item = &'a str>) -> Vec<usize> {
    let mut counts: BTreeMap<&str, usize> = BTreeMap::new();
    kinds
        .map(|kind| {
            let count = counts.entry(kind).or_default();
            *count += 1;
            *count
        })
        .collect()
}

/// The label of a mesh instance, without its number. Files store a name for every mesh: unnamed ones are
/// saved as "mesh 2" and the like, which counts as unnamed here so that saving renames nothing.
fn kind_of_mesh(name: &str) -> &str {
    let number = name.strip_prefix("mesh ");
    let is_numbered =
        number.is_some_and(|n| !n.is_empty() && n.bytes().all(|b| b.is_ascii_digit()));
    match name.is_empty() || is_numbered {
        true => "mesh",
        false => name,
    }
}

fn kind_of(geometry: &Geometry) -> &'static str {
    match geometry {
        Geometry::Sphere { .. } => "sphere",
        Geometry::Plane { .. } => "plane",
        Geometry::Placed { canonical, .. } => match *canonical {
            CanonicalShape::Disc { .. } => "disc",
            CanonicalShape::Rectangle => "rectangle",
            CanonicalShape::Box => "box",
            CanonicalShape::Cone { bottom, top, .. } if bottom == top => "cylinder",
            CanonicalShape::Cone { .. } => "cone",
            CanonicalShape::Torus { .. } => "torus",
            CanonicalShape::Ellipsoid => "ellipsoid",
        },
    }
}

fn kind_of_light(kind: &LightKind) -> &'static str {
    match kind {
        LightKind::Point { .. } => "point light",
        LightKind::Directional { .. } => "directional light",
        LightKind::Spot { .. } => "spot light",
        LightKind::Rectangle { .. } => "rectangle light",
        LightKind::Disc { .. } => "disc light",
        LightKind::Sphere { .. } => "sphere light",
    }
}
