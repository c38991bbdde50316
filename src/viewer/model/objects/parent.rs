//! Moving things to another parent node.

use super::place::{place, set_place};
use super::{EditError, Id, carrier, check, is_visible, set_visible, shown_carrier, slot};
use crate::scene::Scene;

/// Moves an object, a light or a node to the node `parent`, or to the top level for `None`. Its place in
/// the world at `time` seconds stays the same, and so does whether it is hidden.
///
/// # Errors
/// It is a camera or a material, `parent` is inside it, or its place cannot be expressed in `parent`. The
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
    match place(scene, id, time) == Some(before) {
        true => Ok(()),
        false => set_place(scene, id, before, time),
    }
}
