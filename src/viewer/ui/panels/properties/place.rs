//! Where something is, how large, and what shape it has.

use crate::scene::{CanonicalShape, Geometry, ObjectRef, Transform};
use crate::viewer::model::objects;
use crate::viewer::model::objects::{Id, Scaling};
use crate::viewer::ui::panels::properties::fields::{Fields, Limits};
use glam::DVec3;

/// Place, angles and scale in the world.
pub fn show(fields: &mut Fields, id: Id, time: f64) {
    let Some(place) = objects::place(fields.scene, id, time) else {
        return;
    };
    let free = objects::freedom(fields.scene, id);
    let (told, is_whole) = Transform::of(place);
    fields.heading("Place");
    let asked = |now: Transform| {
        move |scene: &mut crate::scene::Scene| {
            // Numbers that were not touched keep all their digits.
            let mut wanted = now.affine();
            if (now.rotate_deg, now.scale) == (told.rotate_deg, told.scale) {
                wanted.matrix3 = place.matrix3;
            }
            objects::set_place(scene, id, wanted, time)
        }
    };
    if free.translate {
        let tip = "In the world, in scene units.";
        let limits = Limits::LENGTH;
        if let Some(translate) = fields.vector_value("Position", tip, told.translate, limits, None)
        {
            fields.change("position", asked(Transform { translate, ..told }));
        }
    }
    if !is_whole && (free.rotate || free.scale != Scaling::None) {
        fields
            .note("It is slanted: angles and scale cannot tell it. Turn and scale it by handles.");
        return;
    }
    if free.rotate {
        let tip =
            "Degrees round x, then y, then z, counter-clockwise where the axis points at you.";
        let limits = Limits::ANGLE;
        if let Some(rotate_deg) =
            fields.vector_value("Rotation", tip, told.rotate_deg, limits, None)
        {
            fields.change("rotation", asked(Transform { rotate_deg, ..told }));
        }
    }
    match free.scale {
        Scaling::Uneven => {
            let tip =
                "Factors along the own axes of the thing; negative ones mirror, 0 is not possible.";
            let limits = Limits::LENGTH;
            let scale = fields.vector_value("Scale", tip, told.scale, limits, None);
            let tip = "Change all three factors by the same ratio.";
            let is_linked = fields.is_kept("Uniform scale", false);
            fields.option("Uniform scale", tip, is_linked);
            if let Some(mut scale) = scale {
                if is_linked {
                    scale = linked(told.scale, scale);
                }
                fields.change("scale", asked(Transform { scale, ..told }));
            }
        }
        Scaling::Even | Scaling::None => {}
    }
    if !free.translate && !free.rotate && free.scale == Scaling::None {
        fields.note("An animation says where it is: edit its keys, or what carries it.");
    }
    if objects::carrier(fields.scene, id)
        .and_then(|carrier| objects::shown_carrier(fields.scene, Some(carrier)))
        .is_some_and(|node| fields.scene.moving_nodes()[node])
    {
        fields.note("What carries it moves: it keeps its new place in that.");
    }
}

/// The three factors after one of them was changed, with the ratios that they had before.
fn linked(before: DVec3, after: DVec3) -> DVec3 {
    let axis = (0..3).find(|&axis| before[axis] != after[axis]);
    axis.map_or(after, |axis| before * (after[axis] / before[axis]))
}

/// What a shape has beside a place.
pub fn shape(fields: &mut Fields, object: ObjectRef) {
    let ObjectRef::Shape(index) = object else {
        if let ObjectRef::Instance(index) = object {
            let mesh = &fields.scene.meshes[fields.scene.instances[index].mesh];
            let (triangles, vertices) = (mesh.triangles.len(), mesh.positions.len());
            fields.note(&format!("{triangles} triangles, {vertices} vertices"));
        }
        return;
    };
    let share = Limits::between(0.0, 1.0);
    match fields.scene.shapes[index].geometry {
        Geometry::Sphere { radius, .. } => {
            let tip = "In the space of what carries it, in scene units; above 0.";
            fields.number(
                "Radius",
                tip,
                radius,
                Limits::SIZE,
                None,
                move |scene, to| {
                    if let Geometry::Sphere { radius, .. } = &mut scene.shapes[index].geometry {
                        *radius = to;
                    }
                },
            );
        }
        Geometry::Plane { normal, .. } => {
            let tip = "Where it faces; of any length but 0.";
            fields.vector(
                "Normal",
                tip,
                normal,
                Limits::LENGTH,
                None,
                move |scene, to: DVec3| {
                    if let Geometry::Plane { normal, .. } = &mut scene.shapes[index].geometry {
                        *normal = to.normalize_or(*normal);
                    }
                },
            );
        }
        Geometry::Placed { canonical, .. } => match canonical {
            CanonicalShape::Disc { hole } => {
                let tip = "Radius of the hole as a share of the disc's, from 0 to below 1.";
                form_number(
                    fields,
                    index,
                    "Hole",
                    tip,
                    hole,
                    Limits::between(0.0, 0.999),
                    |canonical, to| {
                        if let CanonicalShape::Disc { hole } = canonical {
                            *hole = to;
                        }
                    },
                );
            }
            CanonicalShape::Torus { minor } => {
                let tip = "Radius of the tube as a share of the ring's, above 0 and up to 1.";
                form_number(
                    fields,
                    index,
                    "Tube",
                    tip,
                    minor,
                    Limits::between(1e-3, 1.0),
                    |canonical, to| {
                        if let CanonicalShape::Torus { minor } = canonical {
                            *minor = to;
                        }
                    },
                );
            }
            CanonicalShape::Cone {
                bottom,
                top,
                capped,
            } => {
                let tip = "Radius at the lower end, as a share of the width; not 0 where the upper one is.";
                form_number(
                    fields,
                    index,
                    "Bottom",
                    tip,
                    bottom,
                    share,
                    |canonical, to| {
                        if let CanonicalShape::Cone { bottom, top, .. } = canonical {
                            *bottom = if *top == 0.0 { to.max(1e-3) } else { to };
                        }
                    },
                );
                let tip = "Radius at the upper end, as a share of the width; not 0 where the lower one is.";
                form_number(fields, index, "Top", tip, top, share, |canonical, to| {
                    if let CanonicalShape::Cone { bottom, top, .. } = canonical {
                        *top = if *bottom == 0.0 { to.max(1e-3) } else { to };
                    }
                });
                let tip = "Whether discs close its ends.";
                fields.toggle("Capped", tip, capped, move |scene, to| {
                    if let Geometry::Placed {
                        canonical: CanonicalShape::Cone { capped, .. },
                        ..
                    } = &mut scene.shapes[index].geometry
                    {
                        *capped = to;
                    }
                });
            }
            CanonicalShape::Rectangle | CanonicalShape::Box | CanonicalShape::Ellipsoid => {}
        },
    }
}

fn form_number(
    fields: &mut Fields,
    index: usize,
    label: &str,
    tip: &str,
    value: f64,
    limits: Limits,
    set: fn(&mut CanonicalShape, f64),
) {
    fields.number(label, tip, value, limits, None, move |scene, to| {
        if let Geometry::Placed { canonical, .. } = &mut scene.shapes[index].geometry {
            set(canonical, to);
        }
    });
}
