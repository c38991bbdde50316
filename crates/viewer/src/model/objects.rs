//! Edits of one object: transform, visibility, removal, duplication and material.

mod frame;
mod names;
mod parent;
mod place;
mod scope;
mod several;

pub use frame::{of_geometry, of_light};
pub use names::{Labels, name, rename, unused_name};
pub use parent::set_parent;
pub use place::{Freedom, Scaling, freedom, freedom_if, place, place_in, set_place, set_place_in};
pub use scope::{bounds, hide_others, is_there, same, show_all, subject};
pub use several::{common_place, movable, transform};

use glimray_scene::{Node, ObjectRef, Scene, Target, is_numbered};
use std::collections::{BTreeMap, BTreeSet, HashMap};
use std::sync::Arc;

/// A selectable part of a scene. Indices are those of the scene's lists.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Id {
    /// An instance, shape or light.
    Object(ObjectRef),
    /// A node, the parent of other objects.
    Node(usize),
    /// A camera.
    Camera(usize),
    /// A material.
    Material(usize),
}

/// Why an edit is not possible: a clause, and how to proceed.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum EditError {
    /// The object is no longer in the scene.
    #[error("it is no longer in the scene. Select another object.")]
    Gone,
    /// An animation sets the property.
    #[error("its {property} is animated. Edit the keys or its parent node.")]
    Animated {
        /// The property, such as "translation".
        property: &'static str,
    },
    /// The object does not support this edit.
    #[error("{what} cannot be {done}. {todo}.")]
    Unable {
        /// The kind of object, such as "a point light".
        what: &'static str,
        /// The edit, such as "turned".
        done: &'static str,
        /// A suggested alternative.
        todo: &'static str,
    },
    /// A hidden parent decides.
    #[error("its parent {carrier} is hidden. Show the parent.")]
    CarrierHidden {
        /// The name of the node.
        carrier: String,
    },
    /// The result would be degenerate.
    #[error("the scale must not be 0 and the result must stay in range.")]
    Flat,
    /// A list must not become empty.
    #[error("a scene needs at least one {what}. Add another one first.")]
    Last {
        /// The kind of object, such as "camera".
        what: &'static str,
    },
}

/// The name of nodes that only hide their children.
const HIDER: &str = "hidden";

/// Whether a node exists only to hide its children.
pub fn is_hider(scene: &Scene, index: usize) -> bool {
    let node = &scene.nodes[index];
    let plain = Node {
        name: node.name.clone(),
        parent: node.parent,
        visible: false,
        ..Node::default()
    };
    let is_named = node.name == HIDER || is_numbered(&node.name, HIDER);
    is_named && *node == plain && !is_animated(scene, index)
}

fn is_animated(scene: &Scene, node: usize) -> bool {
    let mut targets = scene.tracks.iter().flat_map(|track| &track.targets);
    targets.any(|target| matches!(*target, Target::Node(index, _) if index == node))
}

/// The parent of something, skipping nodes that only hide.
pub fn shown_carrier(scene: &Scene, mut node: Option<usize>) -> Option<usize> {
    while let Some(index) = node.filter(|&index| is_hider(scene, index)) {
        node = scene.nodes[index].parent;
    }
    node
}

/// Index of the parent node.
pub fn carrier(scene: &Scene, id: Id) -> Option<usize> {
    match id {
        Id::Object(ObjectRef::Instance(index)) => scene.instances.get(index)?.node,
        Id::Object(ObjectRef::Shape(index)) => scene.shapes.get(index)?.node,
        Id::Object(ObjectRef::Light(index)) => scene.lights.get(index)?.node,
        Id::Node(index) => scene.nodes.get(index)?.parent,
        Id::Camera(index) => scene.cameras.get(index)?.node,
        Id::Material(_) => None,
    }
}

/// Whether something is visible at rest: no node hides it.
pub fn is_visible(scene: &Scene, id: Id) -> bool {
    if matches!(id, Id::Camera(_) | Id::Material(_)) {
        return true;
    }
    let own = match id {
        Id::Node(index) => Some(index),
        _ => carrier(scene, id),
    };
    std::iter::successors(own, |&index| scene.nodes[index].parent)
        .all(|index| scene.nodes[index].visible)
}

/// Shows or hides something at rest. Instances, shapes and lights have no visibility of their own: they
/// become children of a hiding node, which a scene file stores.
///
/// # Errors
/// The parent is hidden, the visibility is animated, or `id` can never be visible.
pub fn set_visible(scene: &mut Scene, id: Id, visible: bool) -> Result<(), EditError> {
    set_all_visible(scene, &[id], visible)
}

/// Shows or hides several things as [`set_visible`] does.
///
/// # Errors
/// As for [`set_visible`], of one of them. The scene may then be changed in part.
pub fn set_all_visible(scene: &mut Scene, ids: &[Id], visible: bool) -> Result<(), EditError> {
    let done = (ids.iter()).try_for_each(|id| set_one_visible(scene, *id, visible));
    if visible {
        remove_idle_hiders(scene);
    }
    done
}

/// [`set_visible`], without removing nodes that hide nothing any more.
fn set_one_visible(scene: &mut Scene, id: Id, visible: bool) -> Result<(), EditError> {
    check(scene, id)?;
    if let Id::Node(index) = id {
        let property = glimray_scene::NodeProperty::Visible;
        let mut targets = scene.tracks.iter().flat_map(|track| &track.targets);
        if targets.any(|target| *target == Target::Node(index, property)) {
            let property = "visibility";
            return Err(EditError::Animated { property });
        }
        scene.nodes[index].visible = visible;
        return Ok(());
    }
    let Id::Object(object) = id else {
        return Err(EditError::Unable {
            what: "a camera or material",
            done: "hidden",
            todo: "Hide an object instead",
        });
    };
    let now = carrier(scene, id);
    let carrier = shown_carrier(scene, now);
    if visible {
        *slot(scene, object) = carrier;
        let mut above = std::iter::successors(carrier, |&index| scene.nodes[index].parent);
        if let Some(index) = above.find(|&index| !scene.nodes[index].visible) {
            *slot(scene, object) = now;
            let carrier = scene.nodes[index].name.clone();
            return Err(EditError::CarrierHidden { carrier });
        }
    } else if now == carrier {
        let hides =
            |index: &usize| scene.nodes[*index].parent == carrier && is_hider(scene, *index);
        let hider = (0..scene.nodes.len()).find(hides).unwrap_or_else(|| {
            let name = unused_hider_name(scene);
            scene.nodes.push(Node {
                name,
                parent: carrier,
                visible: false,
                ..Node::default()
            });
            scene.nodes.len() - 1
        });
        *slot(scene, object) = Some(hider);
    }
    Ok(())
}

fn unused_hider_name(scene: &Scene) -> String {
    let is_free = |name: &String| scene.nodes.iter().all(|node| node.name != *name);
    let numbered = (2..).map(|number| format!("{HIDER} {number}"));
    let mut names = std::iter::once(HIDER.to_owned()).chain(numbered);
    names.find(is_free).unwrap_or_default()
}

/// Removes hiding nodes without children from the end of the list, so that no index changes.
fn remove_idle_hiders(scene: &mut Scene) {
    while let Some(last) = scene.nodes.len().checked_sub(1) {
        let carries = |node: Option<usize>| node == Some(last);
        let is_idle = is_hider(scene, last)
            && !scene
                .instances
                .iter()
                .any(|instance| carries(instance.node))
            && !scene.shapes.iter().any(|shape| carries(shape.node))
            && !scene.lights.iter().any(|light| carries(light.node))
            && !(scene.cameras.iter()).any(|c| carries(c.node) || carries(c.target));
        if !is_idle {
            return;
        }
        scene.nodes.pop();
    }
}

/// The field that holds an object's parent.
fn slot(scene: &mut Scene, object: ObjectRef) -> &mut Option<usize> {
    match object {
        ObjectRef::Instance(index) => &mut scene.instances[index].node,
        ObjectRef::Shape(index) => &mut scene.shapes[index].node,
        ObjectRef::Light(index) => &mut scene.lights[index].node,
    }
}

/// Rejects what is not in the scene.
fn check(scene: &Scene, id: Id) -> Result<(), EditError> {
    let (index, count) = match id {
        Id::Object(ObjectRef::Instance(index)) => (index, scene.instances.len()),
        Id::Object(ObjectRef::Shape(index)) => (index, scene.shapes.len()),
        Id::Object(ObjectRef::Light(index)) => (index, scene.lights.len()),
        Id::Node(index) => (index, scene.nodes.len()),
        Id::Camera(index) => (index, scene.cameras.len()),
        Id::Material(index) => (index, scene.materials.len()),
    };
    match index < count {
        true => Ok(()),
        false => Err(EditError::Gone),
    }
}

/// Removes objects, and cameras if others stay. Later entries of the lists move up; the labels of objects stay.
///
/// # Errors
/// One of them is the last camera, or a node or material, which others use. The scene may then be changed in part.
pub fn remove(scene: &mut Scene, ids: &[Id]) -> Result<(), EditError> {
    let removed: BTreeSet<Id> = ids.iter().copied().collect();
    for id in &removed {
        check(scene, *id)?;
        if matches!(id, Id::Node(_) | Id::Material(_)) {
            return Err(EditError::Unable {
                what: "a node or material in use",
                done: "removed",
                todo: "Remove or change the objects that use it",
            });
        }
    }
    names::keep_numbers(scene, &removed);
    let is_object = |of: fn(usize) -> ObjectRef| {
        let removed = &removed;
        move |index| removed.contains(&Id::Object(of(index)))
    };
    retain(&mut scene.instances, is_object(ObjectRef::Instance));
    retain(&mut scene.shapes, is_object(ObjectRef::Shape));
    let lights = retain(&mut scene.lights, is_object(ObjectRef::Light));
    let is_camera = |index| removed.contains(&Id::Camera(index));
    if (0..scene.cameras.len()).all(is_camera) {
        return Err(EditError::Last { what: "camera" });
    }
    let cameras = retain(&mut scene.cameras, is_camera);
    scene.camera_index = cameras
        .get(scene.camera_index)
        .copied()
        .flatten()
        .unwrap_or(0);
    retarget(scene, |target| match target {
        Target::Light(at, property) => Some(Target::Light(lights[at]?, property)),
        Target::Camera(at, property) => Some(Target::Camera(cameras[at]?, property)),
        other => Some(other),
    });
    remove_idle_hiders(scene);
    Ok(())
}

/// Removes entries of a list. Returns the index that each of the former ones has now; `None` for those removed.
fn retain<T>(list: &mut Vec<T>, is_removed: impl Fn(usize) -> bool) -> Vec<Option<usize>> {
    let mut kept = 0;
    let now: Vec<Option<usize>> = (0..list.len())
        .map(|index| {
            let place = (!is_removed(index)).then_some(kept);
            kept += usize::from(place.is_some());
            place
        })
        .collect();
    let mut places = now.iter();
    list.retain(|_| places.next().is_some_and(Option::is_some));
    now
}

/// Renumbers the targets of tracks; tracks without a target are removed.
fn retarget(scene: &mut Scene, rename: impl Fn(Target) -> Option<Target>) {
    for track in &mut scene.tracks {
        let targets = std::mem::take(&mut track.targets);
        track.targets = targets.into_iter().filter_map(&rename).collect();
    }
    scene.tracks.retain(|track| !track.targets.is_empty());
}

/// Duplicates an object, camera or material in place, including its animation.
///
/// # Errors
/// `id` is a node.
pub fn duplicate(scene: &mut Scene, id: Id) -> Result<Id, EditError> {
    check(scene, id)?;
    fn push<T: Clone>(list: &mut Vec<T>, index: usize) -> usize {
        list.push(list[index].clone());
        list.len() - 1
    }
    let copy = match id {
        Id::Object(ObjectRef::Instance(index)) => {
            Id::Object(ObjectRef::Instance(push(&mut scene.instances, index)))
        }
        Id::Object(ObjectRef::Shape(index)) => {
            Id::Object(ObjectRef::Shape(push(&mut scene.shapes, index)))
        }
        Id::Object(ObjectRef::Light(index)) => {
            Id::Object(ObjectRef::Light(push(&mut scene.lights, index)))
        }
        Id::Camera(index) => {
            let copy = push(&mut scene.cameras, index);
            Id::Camera(copy)
        }
        Id::Material(index) => {
            let copy = push(&mut scene.materials, index);
            Id::Material(copy)
        }
        Id::Node(_) => {
            return Err(EditError::Unable {
                what: "a node",
                done: "duplicated",
                todo: "Duplicate its objects",
            });
        }
    };
    let name = name(scene, id).unwrap_or_default().to_owned();
    if !name.is_empty() {
        let name = unused_name(scene, &name);
        rename(scene, copy, &name)?;
    }
    let same = |target: &Target| match (*target, id, copy) {
        (
            Target::Light(at, property),
            Id::Object(ObjectRef::Light(of)),
            Id::Object(ObjectRef::Light(copy)),
        ) if at == of => Some(Target::Light(copy, property)),
        (Target::Camera(at, property), Id::Camera(of), Id::Camera(copy)) if at == of => {
            Some(Target::Camera(copy, property))
        }
        (Target::Material(at, property), Id::Material(of), Id::Material(copy)) if at == of => {
            Some(Target::Material(copy, property))
        }
        _ => None,
    };
    for track in &mut scene.tracks {
        let more: Vec<_> = track.targets.iter().filter_map(same).collect();
        track.targets.extend(more);
    }
    Ok(copy)
}

/// The materials of an object, each once; none of a light.
pub fn materials_of(scene: &Scene, object: ObjectRef) -> Vec<usize> {
    match object {
        ObjectRef::Shape(index) => vec![scene.shapes[index].material],
        ObjectRef::Instance(index) => {
            let mesh = &scene.meshes[scene.instances[index].mesh];
            let mut used: Vec<usize> = Vec::new();
            let mut last = None;
            for &material in &mesh.materials {
                if last.replace(material) != Some(material) && !used.contains(&(material as usize))
                {
                    used.push(material as usize);
                }
            }
            used
        }
        ObjectRef::Light(_) => Vec::new(),
    }
}

/// Assigns a material to a whole object, as [`assign_all`] does.
///
/// # Errors
/// As for [`assign_all`].
pub fn assign(scene: &mut Scene, object: ObjectRef, material: usize) -> Result<(), EditError> {
    assign_all(scene, &[object], material)
}

/// Assigns a material to whole objects. A mesh that others have too is copied, once for all that get the material.
///
/// # Errors
/// One of them is a light, or it or the material does not exist. The scene may then be changed in part.
pub fn assign_all(
    scene: &mut Scene,
    objects: &[ObjectRef],
    material: usize,
) -> Result<(), EditError> {
    check(scene, Id::Material(material))?;
    let mut takers = BTreeMap::<usize, BTreeSet<usize>>::new();
    for object in objects {
        check(scene, Id::Object(*object))?;
        match *object {
            ObjectRef::Shape(index) => scene.shapes[index].material = material,
            ObjectRef::Instance(index) => {
                let mesh = scene.instances[index].mesh;
                takers.entry(mesh).or_default().insert(index);
            }
            ObjectRef::Light(_) => {
                return Err(EditError::Unable {
                    what: "a light",
                    done: "given a material",
                    todo: "Change its colour instead",
                });
            }
        }
    }
    let is_same = |used: &u32| *used as usize == material;
    takers.retain(|mesh, _| !scene.meshes[*mesh].materials.iter().all(is_same));
    let mut users = HashMap::<usize, usize>::new();
    for instance in &scene.instances {
        *users.entry(instance.mesh).or_default() += 1;
    }
    // Several entries of the list may hold one mesh.
    let mut filled = HashMap::<_, usize>::new();
    for (mesh, takers) in takers {
        let own = match takers.len() < users[&mesh] {
            true => scene.copy_mesh(mesh),
            false => mesh,
        };
        for taker in takers {
            scene.instances[taker].mesh = own;
        }
        match filled.get(&Arc::as_ptr(&scene.meshes[own])) {
            Some(known) => scene.meshes[own] = scene.meshes[*known].clone(),
            None => {
                filled.insert(Arc::as_ptr(&scene.meshes[own]), own);
                let mesh = Arc::make_mut(&mut scene.meshes[own]);
                mesh.materials.fill(material as u32);
            }
        }
    }
    Ok(())
}
