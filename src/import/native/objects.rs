//! The objects of a native scene before any of them is placed: their names, the groups that they are
//! in, how many there will be, and which of them need a node because they move or something else
//! hangs on them.

use super::Texts;
use super::file::{LookAt, ObjectTable, PropertyName, SceneFile};
use super::repeat::Repeat;
use super::shapes;
use super::transforms;
use crate::import::error::ImportError;
use crate::import::paths::Files;
use crate::import::source::quote;
use crate::import::suggest;
use std::collections::{BTreeMap, HashMap};
use std::ops::Range;
use toml::Spanned;

/// How many surfaces, and how many groups, a scene may have once all are placed.
const MAX_PLACED: u128 = (1 << 20) - 1;

/// How deep groups may lie in groups.
const MAX_NESTING: usize = 64;

/// An object or group that is placed.
pub(super) struct Object<'a> {
    pub table: &'a Spanned<ObjectTable>,
    pub repeat: Repeat<'a>,
    /// Index of the group whose members it places.
    pub group: Option<usize>,
    /// Whether each copy gets a node.
    pub has_node: bool,
    /// Whether it may become visible.
    pub is_switched: bool,
}

impl Object<'_> {
    /// Whether its surface is ever in the scene.
    pub fn is_shown(&self) -> bool {
        self.table.get_ref().visible || self.is_switched
    }
}

/// All objects of a scene file.
pub(super) struct Objects<'a> {
    all: Vec<Object<'a>>,
    /// Those that are in the scene itself; indices.
    pub roots: Range<usize>,
    groups: Vec<Group<'a>>,
    names: HashMap<&'a str, usize>,
    /// The names of listed nodes, and whether they are animated.
    nodes: HashMap<&'a str, bool>,
}

struct Group<'a> {
    name: &'a str,
    /// Indices.
    members: Range<usize>,
    /// How many groups lie in each other here, itself counted; 0 before that is known.
    height: usize,
}

/// How many there are once all is placed.
#[derive(Clone, Copy, Default)]
struct Count {
    surfaces: u128,
    groups: u128,
}

impl<'a> Objects<'a> {
    /// The objects of `file`, whose groups are known to end.
    pub fn new(file: &'a SceneFile, texts: &Texts, files: &Files) -> Result<Self, ImportError> {
        let numbers: BTreeMap<&str, usize> =
            file.groups.keys().map(String::as_str).zip(0..).collect();
        let mut objects = Self {
            all: Vec::new(),
            roots: 0..0,
            groups: Vec::new(),
            names: HashMap::new(),
            nodes: HashMap::new(),
        };
        for node in &file.nodes {
            let name = &node.get_ref().name;
            if objects.nodes.insert(name.get_ref(), false).is_some() {
                return Err(second(name, texts));
            }
        }
        objects.roots = objects.list(&file.objects, &numbers, texts, files)?;
        for (name, list) in &file.groups {
            let members = objects.list(list, &numbers, texts, files)?;
            let carried = list
                .iter()
                .find_map(|table| table.get_ref().carried_by.as_ref());
            if let Some(node) = carried {
                let why = "what is in a group is carried by the group".to_owned();
                let todo = "Have the object that places the group carried";
                return Err(texts.malformed(node.span(), why, todo));
            }
            objects.groups.push(Group {
                name,
                members,
                height: 0,
            });
        }
        objects.mark(file, texts)?;
        let mut order = Vec::new();
        for group in 0..objects.groups.len() {
            if objects.groups[group].height == 0 {
                objects.follow(group, &mut Vec::new(), &mut order, texts)?;
            }
        }
        objects.count(&order, texts)?;
        Ok(objects)
    }

    /// The object with this index.
    pub fn get(&self, index: usize) -> &Object<'a> {
        &self.all[index]
    }

    /// How many tables of objects there are.
    pub fn len(&self) -> usize {
        self.all.len()
    }

    /// Whether a listed node of this name is animated.
    pub fn is_animated(&self, node: &str) -> bool {
        self.nodes.get(node).copied().unwrap_or(false)
    }

    /// The indices of what is in a group.
    pub fn members(&self, group: usize) -> Range<usize> {
        self.groups[group].members.clone()
    }

    /// The index of the object of this name.
    pub fn named(
        &self,
        name: &str,
        span: Range<usize>,
        texts: &Texts,
    ) -> Result<usize, ImportError> {
        self.names.get(name).copied().ok_or_else(|| {
            let known = self.names.keys().chain(self.nodes.keys()).copied();
            let mut known: Vec<&str> = known.collect();
            known.sort_unstable();
            let why = suggest::unknown("object", name, known);
            texts.malformed(
                span,
                why,
                "Give an object that `name`, or name one that has it",
            )
        })
    }

    fn list(
        &mut self,
        list: &'a [Spanned<ObjectTable>],
        groups: &BTreeMap<&str, usize>,
        texts: &Texts,
        files: &Files,
    ) -> Result<Range<usize>, ImportError> {
        let first = self.all.len();
        for object in list {
            let table = object.get_ref();
            check(object, texts)?;
            if let Some(name) = &table.name
                && (self.nodes.contains_key(name.get_ref().as_str())
                    || self.names.insert(name.get_ref(), self.all.len()).is_some())
            {
                return Err(second(name, texts));
            }
            let group = table.group.as_ref().map(|name| {
                groups.get(name.get_ref().as_str()).copied().ok_or_else(|| {
                    let why = suggest::unknown("group", name.get_ref(), groups.keys().copied());
                    let todo = "Add it under [groups], or name one that is there";
                    texts.malformed(name.span(), why, todo)
                })
            });
            self.all.push(Object {
                table: object,
                repeat: Repeat::new(table.repeat.as_ref(), texts, files)?,
                group: group.transpose()?,
                has_node: false,
                is_switched: false,
            });
        }
        Ok(first..self.all.len())
    }

    /// Gives a node to whatever is animated, looked at, or carries something.
    fn mark(&mut self, file: &SceneFile, texts: &Texts) -> Result<(), ImportError> {
        for table in &file.animation {
            let table = table.get_ref();
            for name in table.object.iter().chain(table.objects.iter().flatten()) {
                if let Some(is_animated) = self.nodes.get_mut(name.get_ref().as_str()) {
                    *is_animated = true;
                    continue;
                }
                let object = self.named(name.get_ref(), name.span(), texts)?;
                self.all[object].has_node = true;
                self.all[object].is_switched |= *table.property.get_ref() == PropertyName::Visible;
            }
        }
        for camera in file.camera.iter().chain(&file.cameras) {
            let table = camera.get_ref();
            if let LookAt::Object(name) = table.look_at.get_ref()
                && !self.nodes.contains_key(name.as_str())
            {
                let object = self.named(name, table.look_at.span(), texts)?;
                self.all[object].has_node = true;
            }
        }
        let cameras = file.camera.iter().chain(&file.cameras);
        let cameras = cameras.map(|camera| &camera.get_ref().carried_by);
        let lights = file.lights.iter().map(|light| &light.get_ref().carried_by);
        for name in cameras.chain(lights).flatten() {
            if self.nodes.contains_key(name.get_ref().as_str()) {
                continue;
            }
            let object = self.named(name.get_ref(), name.span(), texts)?;
            self.all[object].has_node = true;
        }
        Ok(())
    }

    /// Follows the groups in `group`, which is in those of `path`, and adds each to `order` behind
    /// those that are in it.
    fn follow(
        &mut self,
        group: usize,
        path: &mut Vec<usize>,
        order: &mut Vec<usize>,
        texts: &Texts,
    ) -> Result<(), ImportError> {
        path.push(group);
        let mut height = 1;
        for member in self.members(group) {
            let object = &self.all[member];
            let (Some(inner), Some(name)) = (object.group, &object.table.get_ref().group) else {
                continue;
            };
            let span = name.span();
            if let Some(at) = path.iter().position(|&outer| outer == inner) {
                let chain = path[at..].iter().chain([&inner]);
                let chain: Vec<_> = chain
                    .map(|&group| quote(self.groups[group].name.as_bytes()))
                    .collect();
                let why = format!("a group is in itself: {}", chain.join(" places "));
                return Err(texts.malformed(span, why, "Take one out of the other"));
            }
            if self.groups[inner].height == 0 && path.len() < MAX_NESTING {
                self.follow(inner, path, order, texts)?;
            }
            height = height.max(self.groups[inner].height + 1);
            if self.groups[inner].height == 0 || height > MAX_NESTING {
                let why = format!("groups lie in groups more than {MAX_NESTING} deep");
                return Err(texts.malformed(span, why, "Put the inner objects further out"));
            }
        }
        path.pop();
        order.push(group);
        self.groups[group].height = height;
        Ok(())
    }

    /// Refuses more than can be placed, before any is. `order` has every group behind those in it.
    fn count(&self, order: &[usize], texts: &Texts) -> Result<(), ImportError> {
        let mut of_groups = vec![Count::default(); self.groups.len()];
        for &group in order {
            let members = self.groups[group].members.clone();
            of_groups[group] = members
                .map(|member| self.copies(member, &of_groups))
                .fold(Count::default(), Count::plus);
        }
        let counts: Vec<Count> = (self.roots.clone())
            .map(|root| self.copies(root, &of_groups))
            .collect();
        let total = counts.iter().copied().fold(Count::default(), Count::plus);
        let (what, total, of): (_, _, fn(&Count) -> u128) = if total.surfaces > MAX_PLACED {
            ("objects", total.surfaces, |count| count.surfaces)
        } else if total.groups > MAX_PLACED {
            ("groups", total.groups, |count| count.groups)
        } else {
            return Ok(());
        };
        let most = (self.roots.clone().zip(&counts)).max_by_key(|(_, count)| of(count));
        let span = most.map_or(0..0, |(root, _)| {
            let object = self.all[root].table;
            let table = object.get_ref();
            let repeat = table.repeat.as_ref().map(Spanned::span);
            let group = table.group.as_ref().map(Spanned::span);
            repeat.or(group).unwrap_or(object.span())
        });
        let total = match total {
            u128::MAX => "more than 1e38".to_owned(),
            total => total.to_string(),
        };
        let why = format!(
            "the scene has {total} {what} with all their copies, but at most {MAX_PLACED} can be placed"
        );
        let error = texts.malformed(span, why, "Repeat fewer of them");
        Err(ImportError::TooBig(error.into_fault()))
    }

    /// What the object with this index comes to.
    fn copies(&self, index: usize, of_groups: &[Count]) -> Count {
        let object = &self.all[index];
        if !object.is_shown() && !object.has_node {
            return Count::default();
        }
        let copies = object.repeat.count();
        let (surfaces, groups) = match object.group {
            Some(group) => (
                of_groups[group].surfaces,
                of_groups[group].groups.saturating_add(1),
            ),
            None => (1, 0),
        };
        Count {
            surfaces: copies.saturating_mul(surfaces),
            groups: copies.saturating_mul(groups),
        }
    }
}

impl Count {
    fn plus(self, other: Self) -> Self {
        Self {
            surfaces: self.surfaces.saturating_add(other.surfaces),
            groups: self.groups.saturating_add(other.groups),
        }
    }
}

fn second(name: &Spanned<String>, texts: &Texts) -> ImportError {
    let quoted = quote(name.get_ref().as_bytes());
    let why = format!("a second object is called {quoted}");
    texts.malformed(name.span(), why, "Rename one of them")
}

/// Refuses an object that is not exactly one thing.
fn check(object: &Spanned<ObjectTable>, texts: &Texts) -> Result<(), ImportError> {
    let table = object.get_ref();
    let others = [
        table.triangle.is_some(),
        table.mesh.is_some(),
        table.group.is_some(),
    ];
    let others = others.into_iter().filter(|&given| given).count();
    if shapes::count(table) + others != 1 {
        let why = "an object is one surface, or one group".to_owned();
        let todo = "Give it exactly one of `sphere`, `ellipsoid`, `plane`, `disc`, `rectangle`, `box`, `cylinder`, `cone`, `torus`, `triangle`, `mesh` and `group`";
        return Err(texts.malformed(object.span(), why, todo));
    }
    if let Some(transform) = &table.transform {
        transforms::check(transform, texts)?;
    }
    if let (Some(material), Some(_)) = (&table.material, &table.group) {
        let why = "a group has no material".to_owned();
        let todo = "Give one to each of its objects";
        return Err(texts.malformed(material.span(), why, todo));
    }
    Ok(())
}
