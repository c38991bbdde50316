//! The transform and shape of an object.

use crate::model::objects;
use crate::model::objects::{Id, Scaling};
use crate::ui::panels::properties::fields::{Fields, Limits};
use glam::DVec3;
use glimray_scene::{CanonicalShape, Geometry, ObjectRef, Scene, Transform};

/// Position, rotation and scale in world space.
pub fn show(fields: &mut Fields, id: Id) {
    let moment = fields.moment;
    let Some(place) = moment.place(id) else {
        return;
    };
    let free = moment.freedom(id);
    let (shown, is_whole) = Transform::of(place);
    fields.heading("Transform");
    let set_place = moment.set_place(id);
    let asked = move |scene: &mut Scene, now: Transform| {
        // Unedited numbers keep full precision.
        let mut wanted = now.affine();
        if (now.rotate_deg, now.scale) == (shown.rotate_deg, shown.scale) {
            wanted.matrix3 = place.matrix3;
        }
        set_place(scene, wanted)
    };
    if free.translate {
        let tip = "World-space position in scene units.";
        let label = ("Position", tip);
        let asked = asked.clone();
        fields.try_vector(label, shown.translate, Limits::LENGTH, move |scene, to| {
            let translate = to;
            asked(scene, Transform { translate, ..shown })
        });
    }
    if !is_whole && (free.rotate || free.scale != Scaling::None) {
        fields.note(
            "The transform contains shear, which angles and scale cannot express. Use the handles.",
        );
        return;
    }
    if free.rotate {
        let tip = "Euler angles about x, then y, then z, in degrees, counter-clockwise.";
        let label = ("Rotation", tip);
        let asked = asked.clone();
        fields.try_vector(label, shown.rotate_deg, Limits::ANGLE, move |scene, to| {
            let rotate_deg = to;
            asked(
                scene,
                Transform {
                    rotate_deg,
                    ..shown
                },
            )
        });
    }
    // The scale of a sphere is its radius, which has a row of its own.
    let is_sphere = matches!(id, Id::Object(ObjectRef::Shape(index))
        if matches!(fields.scene.shapes[index].geometry, Geometry::Sphere { .. }));
    match free.scale {
        Scaling::Uneven if !is_sphere => {
            let tip =
                "Factors along the object's own axes. Negative factors mirror; 0 is not allowed.";
            let is_linked = fields.option_value("Uniform scale", false);
            fields.try_vector(
                ("Scale", tip),
                shown.scale,
                Limits::LENGTH,
                move |scene, to| {
                    let scale = if is_linked {
                        linked(shown.scale, to)
                    } else {
                        to
                    };
                    asked(scene, Transform { scale, ..shown })
                },
            );
            let tip = "Change all three factors by the same ratio.";
            fields.option(("Uniform scale", tip), is_linked);
        }
        Scaling::Uneven | Scaling::Even | Scaling::None => {}
    }
    if !free.translate && !free.rotate && free.scale == Scaling::None {
        fields.note("Its position is animated. Edit its keys or its parent node.");
    }
    if fields.is_drawn()
        && objects::carrier(fields.scene, id)
            .and_then(|carrier| objects::shown_carrier(fields.scene, Some(carrier)))
            .is_some_and(|node| fields.scene.moving_nodes()[node])
    {
        fields.note("Its parent is animated. Edits change its transform relative to the parent.");
    }
}

/// The three factors after one of them has changed, with their ratios kept.
fn linked(before: DVec3, after: DVec3) -> DVec3 {
    let axis = (0..3).find(|&axis| before[axis] != after[axis]);
    axis.map_or(after, |axis| before * (after[axis] / before[axis]))
}

/// The properties of a shape except its transform.
pub fn shape(fields: &mut Fields, object: ObjectRef) {
    let ObjectRef::Shape(index) = object else {
        if let ObjectRef::Instance(index) = object {
            let mesh = &fields.scene.meshes[fields.scene.instances[index].mesh];
            let (triangles, vertices) = (mesh.triangles.len(), mesh.positions.len());
            fields.draw(|ui, _| ui.weak(format!("{triangles} triangles, {vertices} vertices")));
        }
        return;
    };
    let fraction = Limits::between(0.0, 1.0);
    match fields.scene.shapes[index].geometry {
        Geometry::Sphere { radius, .. } => {
            let tip = "In the parent's space, in scene units, above 0.";
            let set = with(index, |geometry, to| {
                if let Geometry::Sphere { radius, .. } = geometry {
                    *radius = to;
                }
            });
            fields.number(("Radius", tip), radius, Limits::SIZE, set);
        }
        Geometry::Plane { normal, .. } => {
            let tip = "Facing direction; any length except 0.";
            let set = with(index, |geometry, to: DVec3| {
                if let Geometry::Plane { normal, .. } = geometry {
                    *normal = to.normalize_or(*normal);
                }
            });
            fields.vector(("Normal", tip), normal, Limits::LENGTH, set);
        }
        Geometry::Placed { canonical, .. } => {
            match canonical {
                CanonicalShape::Disc { hole } => {
                    let tip =
                        "Radius of the hole as a fraction of the disc's radius, from 0 to below 1.";
                    let set = with_canonical(index, |canonical, to| {
                        if let CanonicalShape::Disc { hole } = canonical {
                            *hole = to;
                        }
                    });
                    fields.number(("Hole", tip), hole, Limits::between(0.0, 0.999), set);
                }
                CanonicalShape::Torus { minor } => {
                    let tip = "Radius of the tube as a fraction of the ring's radius, above 0 and up to 1.";
                    let set = with_canonical(index, |canonical, to| {
                        if let CanonicalShape::Torus { minor } = canonical {
                            *minor = to;
                        }
                    });
                    fields.number(("Tube", tip), minor, Limits::between(1e-3, 1.0), set);
                }
                CanonicalShape::Cone {
                    bottom,
                    top,
                    capped,
                } => {
                    let tip = "Bottom radius as a fraction of the width. Only one of the two radii may be 0.";
                    let set = with_canonical(index, |canonical, to: f64| {
                        if let CanonicalShape::Cone { bottom, top, .. } = canonical {
                            *bottom = if *top == 0.0 { to.max(1e-3) } else { to };
                        }
                    });
                    fields.number(("Bottom", tip), bottom, fraction, set);
                    let tip = "Top radius as a fraction of the width. Only one of the two radii may be 0.";
                    let set = with_canonical(index, |canonical, to: f64| {
                        if let CanonicalShape::Cone { bottom, top, .. } = canonical {
                            *top = if *bottom == 0.0 { to.max(1e-3) } else { to };
                        }
                    });
                    fields.number(("Top", tip), top, fraction, set);
                    let tip = "Close both ends with discs.";
                    let set = with_canonical(index, |canonical, to| {
                        if let CanonicalShape::Cone { capped, .. } = canonical {
                            *capped = to;
                        }
                    });
                    fields.toggle(("Capped", tip), capped, set);
                }
                CanonicalShape::Rectangle | CanonicalShape::Box | CanonicalShape::Ellipsoid => {}
            }
        }
    }
}

/// A change of a shape's geometry.
fn with<T>(index: usize, change: fn(&mut Geometry, T)) -> impl FnOnce(&mut Scene, T) {
    move |scene, to| change(&mut scene.shapes[index].geometry, to)
}

/// A change of a placed shape's canonical form.
fn with_canonical<T>(
    index: usize,
    change: fn(&mut CanonicalShape, T),
) -> impl FnOnce(&mut Scene, T) {
    move |scene, to| {
        if let Geometry::Placed { canonical, .. } = &mut scene.shapes[index].geometry {
            change(canonical, to);
        }
    }
}
