//! Several objects that are moved, rotated and scaled as one.

use super::parent::looks_alike_turned;
use super::place::{place_in, set_place_in};
use super::{EditError, Freedom, Id, Scaling, carrier, freedom, is_there};
use glam::{DAffine3, DMat3, DVec3};
use glimray_scene::{ObjectRef, Scene};
use std::collections::BTreeSet;

/// The parts of a selection that are moved with it: all that have a place, less those that another part carries. `ids` may
/// contain some that are no longer there.
pub fn movable(scene: &Scene, ids: &[Id]) -> Vec<Id> {
    let all: BTreeSet<Id> = ids.iter().copied().collect();
    let is_carried = |id: Id| {
        let above = carrier(scene, id);
        std::iter::successors(above, |&node| scene.nodes[node].parent)
            .any(|node| all.contains(&Id::Node(node)))
    };
    let has_place = |id: &Id| matches!(id, Id::Object(_) | Id::Node(_)) && is_there(scene, *id);
    let ids = ids.iter().copied().filter(has_place);
    ids.filter(|id| !is_carried(*id)).collect()
}

/// The place in world space of what is moved as one, and its freedoms: those of a single thing are its own; several are
/// turned and scaled about the mean of their positions. `None` if there is nothing.
pub fn common_place(scene: &Scene, ids: &[Id], time: f64) -> Option<(DAffine3, Freedom)> {
    let frame = scene.frame(time);
    if let [id] = ids {
        return Some((place_in(scene, &frame, *id)?, freedom(scene, *id)));
    }
    let stands = ids.iter().filter(|id| freedom(scene, **id).translate);
    let places: Vec<DVec3> = stands
        .filter_map(|id| Some(place_in(scene, &frame, *id)?.translation))
        .collect();
    let count = places.len();
    if count == 0 {
        return None;
    }
    let center = places.into_iter().sum::<DVec3>() / count as f64;
    let free = Freedom {
        translate: true,
        rotate: true,
        scale: Scaling::Even,
    };
    Some((DAffine3::from_translation(center), free))
}

/// Moves things from their places at `time` seconds, as [`movable`] lists them: `change` is a motion, a rotation or an even
/// scaling in world space. Each follows as far as it is free: a point light is not turned, but goes round the centre.
///
/// # Errors
/// As for [`super::set_place`]. The scene may then be changed in part.
pub fn transform(
    scene: &mut Scene,
    ids: &[Id],
    change: DAffine3,
    time: f64,
) -> Result<(), EditError> {
    let frame = scene.frame(time);
    let factor = change.matrix3.determinant().cbrt();
    let turn = change.matrix3 * factor.recip();
    for &id in ids {
        let Some(place) = place_in(scene, &frame, id) else {
            continue;
        };
        let free = freedom(scene, id);
        let is_round =
            matches!(id, Id::Object(ObjectRef::Shape(index)) if looks_alike_turned(scene, index));
        let mut wanted = place;
        if free.translate {
            wanted.translation = change.transform_point3(place.translation);
        }
        if free.rotate && !is_round && turn != DMat3::IDENTITY {
            wanted.matrix3 = turn * wanted.matrix3;
        }
        if free.scale != Scaling::None && factor != 1.0 {
            wanted.matrix3 *= factor;
        }
        set_place_in(scene, &frame, id, wanted)?;
    }
    Ok(())
}
