//! Names, and operations on several objects.

use crate::model::objects::{EditError, Id, check, is_visible, set_visible};
use glam::DVec3;
use glimray_scene::{ObjectRef, Scene};

/// Whether something is in the scene.
pub fn is_there(scene: &Scene, id: Id) -> bool {
    check(scene, id).is_ok()
}

/// The name of something; may be empty. Objects have no names of their own.
pub fn name(scene: &Scene, id: Id) -> Option<&str> {
    match id {
        Id::Object(_) => None,
        Id::Node(index) => scene.nodes.get(index).map(|node| node.name.as_str()),
        Id::Camera(index) => scene.cameras.get(index).map(|camera| camera.name.as_str()),
        Id::Material(index) => (scene.materials.get(index)).map(|material| material.name.as_str()),
    }
}

/// Renames something.
///
/// # Errors
/// `id` has no name, or is not in the scene.
pub fn rename(scene: &mut Scene, id: Id, name: &str) -> Result<(), EditError> {
    check(scene, id)?;
    let slot = match id {
        Id::Node(index) => &mut scene.nodes[index].name,
        Id::Camera(index) => &mut scene.cameras[index].name,
        Id::Material(index) => &mut scene.materials[index].name,
        Id::Object(_) => {
            return Err(EditError::Unable {
                what: "an object",
                done: "renamed",
                todo: "Rename its material or its node",
            });
        }
    };
    name.trim().clone_into(slot);
    Ok(())
}

/// Hides all meshes and shapes except this one, or except those below a node. Objects that cannot be hidden
/// stay.
pub fn hide_others(scene: &mut Scene, id: Id) {
    let stays = |scene: &Scene, object: ObjectRef| {
        Id::Object(object) == id
            || matches!(id, Id::Node(node) if is_carried_by(scene, object, node))
    };
    for object in surfaces(scene) {
        let id = Id::Object(object);
        if !stays(scene, object) && is_visible(scene, id) {
            // Only animated visibility is rejected, and the animation may show the object again.
            let _ = set_visible(scene, id, false);
        }
    }
}

/// Shows everything that is hidden at rest, except where visibility is animated.
pub fn show_all(scene: &mut Scene) {
    let lights = (0..scene.lights.len()).map(ObjectRef::Light);
    let objects: Vec<_> = surfaces(scene).into_iter().chain(lights).collect();
    for index in 0..scene.nodes.len() {
        if !crate::model::objects::is_hider(scene, index) {
            let _ = set_visible(scene, Id::Node(index), true);
        }
    }
    for id in objects.into_iter().map(Id::Object) {
        if !is_visible(scene, id) {
            let _ = set_visible(scene, id, true);
        }
    }
}

/// The axis-aligned bounding box (min, max) in the world at `time` seconds, of a node with its descendants;
/// `None` without bounds.
pub fn bounds(scene: &Scene, id: Id, time: f64) -> Option<(DVec3, DVec3)> {
    match id {
        Id::Object(object) => scene.bounds_of(object, time),
        Id::Node(node) => (surfaces(scene).into_iter())
            .filter(|object| is_carried_by(scene, *object, node))
            .filter_map(|object| scene.bounds_of(object, time))
            .reduce(|a, b| (a.0.min(b.0), a.1.max(b.1))),
        Id::Camera(_) | Id::Material(_) => None,
    }
}

/// Bounds of the visible geometry in the world at time 0: all surfaces except area lights, which may be far
/// away. Includes them if there is nothing else.
pub fn subject(scene: &Scene) -> Option<(DVec3, DVec3)> {
    let shines = |material: usize| {
        let material = scene.materials.get(material);
        material.is_some_and(|material| material.emission.max_element() > 0.0)
    };
    let mut lit = scene.clone();
    lit.shapes.retain(|shape| !shines(shape.material));
    lit.instances.retain(|instance| {
        let mut materials = scene.meshes[instance.mesh].materials.iter();
        materials.len() == 0 || !materials.all(|material| shines(*material as usize))
    });
    lit.bounds().or_else(|| scene.bounds())
}

fn surfaces(scene: &Scene) -> Vec<ObjectRef> {
    let instances = (0..scene.instances.len()).map(ObjectRef::Instance);
    let shapes = (0..scene.shapes.len()).map(ObjectRef::Shape);
    instances.chain(shapes).collect()
}

fn is_carried_by(scene: &Scene, object: ObjectRef, node: usize) -> bool {
    let own = crate::model::objects::carrier(scene, Id::Object(object));
    std::iter::successors(own, |&index| scene.nodes[index].parent).any(|index| index == node)
}

/// The counterpart of `id` in a scene that differs by one step. In a list that changed its length, entries
/// before and after the change are matched; `None` if it is gone or ambiguous.
pub fn same(before: &Scene, after: &Scene, id: Id) -> Option<Id> {
    Some(match id {
        Id::Object(ObjectRef::Shape(index)) => {
            let index = index_after(&before.shapes, &after.shapes, index)?;
            Id::Object(ObjectRef::Shape(index))
        }
        Id::Object(ObjectRef::Instance(index)) => {
            let index = index_after(&before.instances, &after.instances, index)?;
            Id::Object(ObjectRef::Instance(index))
        }
        Id::Object(ObjectRef::Light(index)) => {
            let index = index_after(&before.lights, &after.lights, index)?;
            Id::Object(ObjectRef::Light(index))
        }
        Id::Node(index) => Id::Node(index_after(&before.nodes, &after.nodes, index)?),
        Id::Camera(index) => Id::Camera(index_after(&before.cameras, &after.cameras, index)?),
        Id::Material(index) => {
            Id::Material(index_after(&before.materials, &after.materials, index)?)
        }
    })
}

fn index_after<T: PartialEq>(before: &[T], after: &[T], index: usize) -> Option<usize> {
    if before.len() == after.len() {
        return Some(index);
    }
    let same = |pair: &(&T, &T)| pair.0 == pair.1;
    let first = before.iter().zip(after).take_while(same).count();
    if index < first {
        return Some(index);
    }
    let rest = (before[first..].iter().rev()).zip(after[first..].iter().rev());
    let last = rest.take_while(same).count();
    (index + last >= before.len()).then(|| index + after.len() - before.len())
}
