//! Operations on several objects.

use crate::model::objects::{
    Id, check, is_visible, remove_idle_hiders, set_one_visible, set_visible,
};
use glam::DVec3;
use glimray_scene::{ObjectRef, Scene};

/// Whether something is in the scene.
pub fn is_there(scene: &Scene, id: Id) -> bool {
    check(scene, id).is_ok()
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
            let _ = set_one_visible(scene, id, true);
        }
    }
    remove_idle_hiders(scene);
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

/// The counterparts of `ids` in a scene that differs by one step. In a list that changed its length, entries
/// before and after the change are matched; those that are gone or ambiguous are left out.
pub fn same(before: &Scene, after: &Scene, ids: &[Id]) -> Vec<Id> {
    let shapes = Kept::of(&before.shapes, &after.shapes, |a, b| {
        (a.geometry, a.material, a.node) == (b.geometry, b.material, b.node)
    });
    let instances = Kept::of(&before.instances, &after.instances, |a, b| {
        (a.mesh, a.placement, a.node) == (b.mesh, b.placement, b.node)
    });
    let lights = Kept::of(&before.lights, &after.lights, |a, b| {
        (a.kind, a.color, a.node) == (b.kind, b.color, b.node)
    });
    let nodes = Kept::of(&before.nodes, &after.nodes, PartialEq::eq);
    let cameras = Kept::of(&before.cameras, &after.cameras, PartialEq::eq);
    let materials = Kept::of(&before.materials, &after.materials, PartialEq::eq);
    let counterpart = |id: &Id| {
        Some(match *id {
            Id::Object(ObjectRef::Shape(index)) => {
                Id::Object(ObjectRef::Shape(shapes.index(index)?))
            }
            Id::Object(ObjectRef::Instance(index)) => {
                Id::Object(ObjectRef::Instance(instances.index(index)?))
            }
            Id::Object(ObjectRef::Light(index)) => {
                Id::Object(ObjectRef::Light(lights.index(index)?))
            }
            Id::Node(index) => Id::Node(nodes.index(index)?),
            Id::Camera(index) => Id::Camera(cameras.index(index)?),
            Id::Material(index) => Id::Material(materials.index(index)?),
        })
    };
    ids.iter().filter_map(counterpart).collect()
}

/// The entries that two versions of a list have in common, at its start and at its end.
struct Kept {
    lengths: [usize; 2],
    first: usize,
    last: usize,
}

impl Kept {
    /// Names do not count: they change where others are removed.
    fn of<T>(before: &[T], after: &[T], is_same: impl Fn(&T, &T) -> bool) -> Self {
        let lengths = [before.len(), after.len()];
        if before.len() == after.len() {
            let first = before.len();
            return Self {
                lengths,
                first,
                last: 0,
            };
        }
        let same = |pair: &(&T, &T)| is_same(pair.0, pair.1);
        let first = before.iter().zip(after).take_while(same).count();
        let rest = (before[first..].iter().rev()).zip(after[first..].iter().rev());
        let last = rest.take_while(same).count();
        Self {
            lengths,
            first,
            last,
        }
    }

    fn index(&self, index: usize) -> Option<usize> {
        let [before, after] = self.lengths;
        match index < self.first {
            true => Some(index),
            false => (index + self.last >= before).then(|| index + after - before),
        }
    }
}
