//! The objects of a native scene before they are placed: their names, their groups, how many copies there
//! will be, and which of them need a node because they are animated or have something attached to them.

use super::Texts;
use super::file::Spanned;
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

/// Limits of the number of surfaces and of the number of groups, counting all copies.
const MAX_PLACED: u128 = (1 << 20) - 1;

/// Limit of the nesting depth of groups.
const MAX_NESTING: usize = 64;

/// An object or a placement of a group.
pub(super) struct Object<'a> {
    pub table: &'a Spanned<ObjectTable>,
    pub repeat: Repeat<'a>,
    /// Index of the group that it places.
    pub group: Option<usize>,
    /// Whether each copy gets a node.
    pub has_node: bool,
    /// Whether it may become visible.
    pub is_switched: bool,
}

impl Object<'_> {
    /// Whether its surface is ever in the scene.
    pub fn is_shown(&self) -> bool {
        self.table.visible.unwrap_or(true) || self.is_switched
    }
}

/// All objects of a scene file.
pub(super) struct Objects<'a> {
    all: Vec<Object<'a>>,
    /// Indices of objects at the top level.
    pub roots: Range<usize>,
    groups: Vec<Group<'a>>,
    names: HashMap<&'a str, usize>,
    /// The names of listed nodes, and whether they are animated.
    nodes: HashMap<&'a str, bool>,
}

struct Group<'a> {
    name: &'a str,
    /// Indices of its members.
    members: Range<usize>,
    /// Height of the group in the hierarchy of groups, 1 for a group without groups; 0 if not yet known.
    height: usize,
}

/// Numbers of copies once everything is placed.
#[derive(Clone, Copy, Default)]
struct Count {
    surfaces: u128,
    groups: u128,
}

impl<'a> Objects<'a> {
    /// The objects of `file`, whose groups are checked for cycles.
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
            let name = &node.name;
            if objects.nodes.insert(name.get_ref(), false).is_some() {
                return Err(second(name, texts));
            }
        }
        objects.roots = objects.list(&file.objects, &numbers, texts, files)?;
        for (name, list) in &file.groups {
            let members = objects.list(list, &numbers, texts, files)?;
            let carried = list.iter().find_map(|table| table.carried_by.as_ref());
            if let Some(node) = carried {
                let why = "a member of a group cannot have `carried_by`".to_owned();
                let todo = "Use `carried_by` in the object that places the group";
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
                objects.visit(group, &mut Vec::new(), &mut order, texts)?;
            }
        }
        objects.count(&order, texts)?;
        Ok(objects)
    }

    /// The object with this index.
    pub fn get(&self, index: usize) -> &Object<'a> {
        &self.all[index]
    }

    /// Number of object tables.
    pub fn len(&self) -> usize {
        self.all.len()
    }

    /// Whether a listed node of this name is animated.
    pub fn is_animated(&self, node: &str) -> bool {
        self.nodes.get(node).copied().unwrap_or(false)
    }

    /// The indices of the members of a group.
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
                "Add that `name` to an object, or use an existing one",
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
                && (self.nodes.contains_key(name.as_str())
                    || self.names.insert(name.get_ref(), self.all.len()).is_some())
            {
                return Err(second(name, texts));
            }
            let group = table.group.as_ref().map(|name| {
                groups.get(name.as_str()).copied().ok_or_else(|| {
                    let why = suggest::unknown("group", name.get_ref(), groups.keys().copied());
                    let todo = "Add it under [groups], or use an existing one";
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

    /// Gives a node to every object that is animated, a camera's target, or has children.
    fn mark(&mut self, file: &SceneFile, texts: &Texts) -> Result<(), ImportError> {
        for table in &file.animation {
            let table = table.get_ref();
            for name in table.object.iter().chain(table.objects.iter().flatten()) {
                if let Some(is_animated) = self.nodes.get_mut(name.as_str()) {
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
        let cameras = cameras.map(|camera| &camera.carried_by);
        let lights = file.lights.iter().map(|light| &light.carried_by);
        for name in cameras.chain(lights).flatten() {
            if self.nodes.contains_key(name.as_str()) {
                continue;
            }
            let object = self.named(name.get_ref(), name.span(), texts)?;
            self.all[object].has_node = true;
        }
        Ok(())
    }

    /// Visits the groups in `group`, which lies in those of `path`, and adds each to `order` after the
    /// groups in it.
    fn visit(
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
            let (Some(inner), Some(name)) = (object.group, &object.table.group) else {
                continue;
            };
            let span = name.span();
            if let Some(at) = path.iter().position(|&outer| outer == inner) {
                let chain = path[at..].iter().chain([&inner]);
                let chain: Vec<_> = chain
                    .map(|&group| quote(self.groups[group].name.as_bytes()))
                    .collect();
                let why = format!("a group contains itself: {}", chain.join(" places "));
                return Err(texts.malformed(span, why, "Remove one of them"));
            }
            if self.groups[inner].height == 0 && path.len() < MAX_NESTING {
                self.visit(inner, path, order, texts)?;
            }
            height = height.max(self.groups[inner].height + 1);
            if self.groups[inner].height == 0 || height > MAX_NESTING {
                let why = format!("groups are nested more than {MAX_NESTING} deep");
                return Err(texts.malformed(span, why, "Reduce the nesting"));
            }
        }
        path.pop();
        order.push(group);
        self.groups[group].height = height;
        Ok(())
    }

    /// Refuses scenes with too many objects before any is placed. In `order`, every group follows those
    /// in it.
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
            "the scene has {total} {what}, counting all copies, but at most {MAX_PLACED} are allowed"
        );
        let error = texts.malformed(span, why, "Repeat fewer of them");
        Err(ImportError::TooBig(error.into_fault()))
    }

    /// Numbers of surfaces and groups in the object with this index.
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
    let quoted = quote(name.as_bytes());
    let why = format!("duplicate object name {quoted}");
    texts.malformed(name.span(), why, "Rename one of them")
}

/// Refuses an object that does not have exactly one kind.
fn check(object: &Spanned<ObjectTable>, texts: &Texts) -> Result<(), ImportError> {
    let table = object.get_ref();
    let others = [
        table.triangle.is_some(),
        table.mesh.is_some(),
        table.group.is_some(),
    ];
    let others = others.into_iter().filter(|&given| given).count();
    if shapes::count(table) + others != 1 {
        let why = "an object needs exactly one surface or group".to_owned();
        let todo = "Give it one of `sphere`, `ellipsoid`, `plane`, `disc`, `rectangle`, `box`, `cylinder`, `cone`, `torus`, `triangle`, `mesh` and `group`";
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
