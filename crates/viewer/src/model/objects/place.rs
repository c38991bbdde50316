//! Reads and sets the world transform of an object, whatever its parents.

use crate::model::objects::frame::{geometry_in, light_in, of_geometry, of_light};
use crate::model::objects::{EditError, Id, check};
use glam::{DAffine3, DVec3};
use glimray_scene::{
    Frame, Geometry, LightKind, LightProperty, NodeProperty, ObjectRef, Scene, Target,
};

/// Larger numbers overflow on the GPU.
const LARGEST: f64 = f32::MAX as f64;

/// How an object can be scaled.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Scaling {
    /// No scaling.
    None,
    /// By one factor for all axes.
    Even,
    /// By a factor for each axis.
    Uneven,
}

/// The freedoms of an object.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Freedom {
    /// Whether it can be translated.
    pub translate: bool,
    /// Whether it can be rotated.
    pub rotate: bool,
    /// How it can be scaled.
    pub scale: Scaling,
}

/// The freedoms of an object; none for cameras and materials, which have properties of their own.
pub fn freedom(scene: &Scene, id: Id) -> Freedom {
    let drives = |target: Target| (scene.tracks.iter()).any(|t| t.targets.contains(&target));
    freedom_if(scene, id, drives)
}

/// [`freedom`] where `drives` says whether a track sets a property.
pub fn freedom_if(scene: &Scene, id: Id, drives: impl Fn(Target) -> bool) -> Freedom {
    let freedom = |translate, rotate, scale| Freedom {
        translate,
        rotate,
        scale,
    };
    match id {
        Id::Object(ObjectRef::Instance(_)) => freedom(true, true, Scaling::Uneven),
        Id::Object(ObjectRef::Shape(index)) => {
            match scene.shapes.get(index).map(|shape| shape.geometry) {
                Some(Geometry::Plane { .. }) => freedom(true, true, Scaling::None),
                _ => freedom(true, true, Scaling::Uneven),
            }
        }
        Id::Object(ObjectRef::Light(index)) => {
            let Some(light) = scene.lights.get(index) else {
                return freedom(false, false, Scaling::None);
            };
            let stays = !drives(Target::Light(index, LightProperty::Position));
            let aims = !drives(Target::Light(index, LightProperty::Direction));
            match light.kind {
                LightKind::Point { .. } => freedom(stays, false, Scaling::None),
                LightKind::Directional { .. } => freedom(false, aims, Scaling::None),
                LightKind::Spot { .. } => freedom(stays, aims, Scaling::None),
                LightKind::Rectangle { .. } => freedom(stays, true, Scaling::Uneven),
                LightKind::Disc { .. } => freedom(stays, aims, Scaling::Even),
                LightKind::Sphere { .. } => freedom(stays, false, Scaling::Even),
            }
        }
        Id::Node(index) => {
            let drives = |property| drives(Target::Node(index, property));
            let turns = drives(NodeProperty::Rotation) || drives(NodeProperty::Angles);
            let scale = match drives(NodeProperty::Scale) {
                true => Scaling::None,
                false => Scaling::Uneven,
            };
            freedom(!drives(NodeProperty::Translation), !turns, scale)
        }
        Id::Camera(_) | Id::Material(_) => freedom(false, false, Scaling::None),
    }
}

/// The transform from the object's own space to the world at `time` seconds; `None` if it has no transform
/// or is not in the scene. Lights shine along the +y of their own space; shapes are canonical in theirs.
pub fn place(scene: &Scene, id: Id, time: f64) -> Option<DAffine3> {
    place_in(scene, &scene.frame(time), id)
}

/// [`place`] in a frame of the scene.
pub fn place_in(scene: &Scene, frame: &Frame, id: Id) -> Option<DAffine3> {
    let world_from = |node: Option<usize>| match node {
        Some(node) => frame.nodes[node].world_from_node,
        None => DAffine3::IDENTITY,
    };
    match id {
        Id::Object(ObjectRef::Instance(index)) => {
            let instance = scene.instances.get(index)?;
            Some(chain(world_from(instance.node), instance.placement))
        }
        Id::Object(ObjectRef::Shape(index)) => {
            let shape = scene.shapes.get(index)?;
            let own = of_geometry(&shape.geometry);
            Some(match shape.geometry {
                // Planes cannot be animated.
                Geometry::Plane { .. } => own,
                _ => chain(world_from(shape.node), own),
            })
        }
        Id::Object(ObjectRef::Light(index)) => Some(of_light(&frame.lights.get(index)?.kind)),
        Id::Node(index) => Some(frame.nodes.get(index)?.world_from_node),
        Id::Camera(_) | Id::Material(_) => None,
    }
}

/// Sets the world transform of an object to `wanted`, as [`place`] returns it at `time` seconds. Its parent
/// stays the same: if that is animated, the transform relative to it changes.
///
/// # Errors
/// The object lacks the required freedom, an animation sets the property, or the result would be degenerate.
/// The scene then stays unchanged.
pub fn set_place(scene: &mut Scene, id: Id, wanted: DAffine3, time: f64) -> Result<(), EditError> {
    let frame = scene.frame(time);
    set_place_in(scene, &frame, id, wanted)
}

/// [`set_place`] in a frame of the scene, which may be from before changes of things that do not carry this one.
///
/// # Errors
/// As for [`set_place`].
pub fn set_place_in(
    scene: &mut Scene,
    frame: &Frame,
    id: Id,
    wanted: DAffine3,
) -> Result<(), EditError> {
    check(scene, id)?;
    let old = place_in(scene, frame, id).ok_or(EditError::Unable {
        what: "a camera or material",
        done: "transformed",
        todo: "Edit its properties",
    })?;
    if !is_good(wanted) {
        return Err(EditError::Flat);
    }
    refuse_what_is_not_free(scene, id, old, wanted)?;
    let into = |node: Option<usize>| match node {
        Some(node) => chain(frame.nodes[node].world_from_node.inverse(), wanted),
        None => wanted,
    };
    match id {
        Id::Object(ObjectRef::Instance(index)) => {
            let instance = &mut scene.instances[index];
            instance.placement = into(instance.node);
        }
        Id::Object(ObjectRef::Shape(index)) => {
            let shape = &mut scene.shapes[index];
            let own = match shape.geometry {
                Geometry::Plane { .. } => wanted,
                _ => into(shape.node),
            };
            shape.geometry = geometry_in(&shape.geometry, own);
        }
        Id::Object(ObjectRef::Light(index)) => {
            // The change is applied to a light with a parent, because its parent's transform may have
            // rounded its shape.
            let light = &mut scene.lights[index];
            light.kind = match light.node {
                None => light_in(&light.kind, old, wanted),
                Some(node) => {
                    let node_from_world = frame.nodes[node].world_from_node.inverse();
                    let change = node_from_world * wanted * old.inverse();
                    let change = change * frame.nodes[node].world_from_node;
                    let own = of_light(&light.kind);
                    let mut now = change * own;
                    if wanted.matrix3 == old.matrix3 {
                        now.matrix3 = own.matrix3;
                    }
                    light_in(&light.kind, own, now)
                }
            };
        }
        Id::Node(index) => set_node(scene, frame, index, [old, wanted])?,
        Id::Camera(_) | Id::Material(_) => {}
    }
    Ok(())
}

fn set_node(
    scene: &mut Scene,
    frame: &Frame,
    index: usize,
    [old, wanted]: [DAffine3; 2],
) -> Result<(), EditError> {
    let node = &scene.nodes[index];
    let above = match node.parent {
        Some(parent) => frame.nodes[parent].world_from_node * node.placement,
        None => node.placement,
    };
    let local = chain(above.inverse(), wanted);
    let (scale, turn, moved) = local.to_scale_rotation_translation();
    let composed = DAffine3::from_scale_rotation_translation(scale, turn, moved);
    let size = local
        .matrix3
        .to_cols_array()
        .iter()
        .fold(0.0, |a: f64, b| a.max(b.abs()));
    if !composed.matrix3.abs_diff_eq(local.matrix3, 1e-9 * size) {
        return Err(EditError::Unable {
            what: "a node with a rotated, unevenly scaled parent",
            done: "sheared",
            todo: "Transform its objects instead",
        });
    }
    let is_moved_only = wanted.matrix3 == old.matrix3;
    let node = &mut scene.nodes[index];
    if moved.is_finite() {
        node.translation = moved;
    }
    if !is_moved_only {
        node.rotation = turn;
        node.scale = scale;
    }
    Ok(())
}

/// Rejects changes that an object does not support, or that an animation would override.
fn refuse_what_is_not_free(
    scene: &Scene,
    id: Id,
    old: DAffine3,
    wanted: DAffine3,
) -> Result<(), EditError> {
    let free = freedom(scene, id);
    let (old_scale, old_turn, _) = old.to_scale_rotation_translation();
    let (scale, turn, _) = wanted.to_scale_rotation_translation();
    let reach = old
        .translation
        .abs()
        .max_element()
        .max(old_scale.abs().max_element());
    let moves = !(wanted.translation).abs_diff_eq(old.translation, 1e-9 * reach.max(1e-9));
    let turns = turn.dot(old_turn).abs() < 1.0 - 1e-12;
    let factor = scale / old_scale;
    let is_even = (factor - factor.x).abs().max_element() < 1e-9;
    let scales = (factor - 1.0).abs().max_element() > 1e-9;
    let what = name(scene, id);
    let unable = |done, todo| Err(EditError::Unable { what, done, todo });
    let animated = |property| Err(EditError::Animated { property });
    let light = match id {
        Id::Object(ObjectRef::Light(index)) => Some(scene.lights[index].kind),
        _ => None,
    };
    if moves && !free.translate {
        return match light {
            Some(LightKind::Directional { .. }) => {
                unable("moved", "It is infinitely far away. Rotate it")
            }
            Some(_) => animated("position"),
            None => animated("translation"),
        };
    }
    if turns && !free.rotate {
        return match light {
            Some(LightKind::Point { .. } | LightKind::Sphere { .. }) => {
                unable("rotated", "It shines equally in all directions")
            }
            Some(_) => animated("direction"),
            None => animated("rotation"),
        };
    }
    match free.scale {
        Scaling::None if scales => match id {
            Id::Node(_) => animated("scale"),
            _ => unable(
                "scaled",
                "It has no size. Change its intensity or its angles",
            ),
        },
        Scaling::Even if scales && !is_even => {
            unable("scaled unevenly", "Use the same factor for all axes")
        }
        _ => Ok(()),
    }
}

fn name(scene: &Scene, id: Id) -> &'static str {
    match id {
        Id::Object(ObjectRef::Instance(_)) => "a mesh",
        Id::Object(ObjectRef::Shape(index)) => match scene.shapes[index].geometry {
            Geometry::Plane { .. } => "an infinite plane",
            _ => "a surface",
        },
        Id::Object(ObjectRef::Light(index)) => match scene.lights[index].kind {
            LightKind::Point { .. } => "a point light",
            LightKind::Directional { .. } => "a directional light",
            LightKind::Spot { .. } => "a spot light",
            LightKind::Rectangle { .. } => "a rectangle light",
            LightKind::Disc { .. } => "a disc light",
            LightKind::Sphere { .. } => "a sphere light",
        },
        Id::Node(_) => "a node",
        Id::Camera(_) => "a camera",
        Id::Material(_) => "a material",
    }
}

/// Whether the transform is finite and not degenerate.
fn is_good(place: DAffine3) -> bool {
    let columns = [
        place.matrix3.x_axis,
        place.matrix3.y_axis,
        place.matrix3.z_axis,
    ];
    let is_in_range = |v: DVec3| v.is_finite() && v.abs().max_element() <= LARGEST;
    let [x, y, z] = columns.map(DVec3::normalize_or_zero);
    columns
        .into_iter()
        .chain([place.translation])
        .all(is_in_range)
        && columns
            .iter()
            .all(|v| v.length() >= f64::from(f32::MIN_POSITIVE))
        && x.cross(y).dot(z).abs() > 1e-12
}

/// The product; exact where one factor is the identity.
fn chain(outer: DAffine3, inner: DAffine3) -> DAffine3 {
    if outer == DAffine3::IDENTITY {
        inner
    } else {
        outer * inner
    }
}
