//! Moving things to another parent node.

use super::place::{place, set_place};
use super::{EditError, Id, carrier, check, is_visible, set_visible, shown_carrier, slot};
use glam::{DAffine3, DMat3};
use glimray_scene::{Geometry, ObjectRef, Scene, Space};

/// Largest difference from a rotation with even scale, as a fraction of the scale.
const TOLERANCE: f64 = 1e-9;

/// Moves an object, a light or a node to the node `parent`, or to the top level for `None`. Its place in
/// the world at `time` seconds stays the same, and so does whether it is hidden. A sphere stays a sphere where
/// its rotation cannot be seen.
///
/// # Errors
/// `id` is a camera or a material, `parent` is inside it, or its place cannot be expressed in `parent`. The
/// scene may then be changed in part.
pub fn set_parent(
    scene: &mut Scene,
    id: Id,
    parent: Option<usize>,
    time: f64,
) -> Result<(), EditError> {
    check(scene, id)?;
    if let Some(parent) = parent {
        check(scene, Id::Node(parent))?;
    }
    if shown_carrier(scene, carrier(scene, id)) == parent {
        return Ok(());
    }
    let Some(before) = place(scene, id, time) else {
        return Err(EditError::Unable {
            what: "a camera or material",
            done: "moved into a group",
            todo: "Move objects, lights or nodes",
        });
    };
    match id {
        Id::Node(index) => {
            let mut above = std::iter::successors(parent, |&node| scene.nodes[node].parent);
            if above.any(|node| node == index) {
                return Err(EditError::Unable {
                    what: "a node",
                    done: "moved into itself",
                    todo: "Choose a node outside it",
                });
            }
            scene.nodes[index].parent = parent;
        }
        Id::Object(object) => {
            let was_hidden = carrier(scene, id) != shown_carrier(scene, carrier(scene, id));
            *slot(scene, object) = parent;
            if was_hidden && is_visible(scene, id) {
                set_visible(scene, id, false)?;
            }
        }
        Id::Camera(_) | Id::Material(_) => {}
    }
    if place(scene, id, time) == Some(before) {
        return Ok(());
    }
    if let Id::Object(ObjectRef::Shape(index)) = id
        && let Some(sphere) = sphere_in(scene, index, parent, before, time)
    {
        scene.shapes[index].geometry = sphere;
        return Ok(());
    }
    set_place(scene, id, before, time)
}

/// The sphere `index` as a sphere of the node `parent`, with the world transform `place` up to a rotation.
/// `None` if it is another shape, a texture shows its rotation, or it is an ellipsoid in `parent`.
fn sphere_in(
    scene: &Scene,
    index: usize,
    parent: Option<usize>,
    place: DAffine3,
    time: f64,
) -> Option<Geometry> {
    if !looks_alike_turned(scene, index) {
        return None;
    }
    let own = match parent {
        Some(node) => scene.frame(time).nodes[node].world_from_node.inverse() * place,
        None => place,
    };
    let radius = own.matrix3.determinant().abs().cbrt();
    let squared = own.matrix3.transpose() * own.matrix3 * (radius * radius).recip();
    (squared.abs_diff_eq(DMat3::IDENTITY, TOLERANCE)).then_some(Geometry::Sphere {
        center: own.translation,
        radius,
    })
}

/// Whether a shape is a sphere without a texture that would show its rotation.
pub(super) fn looks_alike_turned(scene: &Scene, index: usize) -> bool {
    let shape = &scene.shapes[index];
    let mut textures = scene.materials[shape.material].texture_indices();
    let is_mapped = textures.any(|at| scene.textures[at].space != Space::World);
    !is_mapped && matches!(shape.geometry, Geometry::Sphere { .. })
}
