//! The analytic surfaces of a scene: with corners, radii and ends that represent them exactly, or in
//! canonical position with a transform.

use super::Writer;
use super::exact::{is_same, shortest, transform};
use super::runs::{LEAST, runs};
use crate::import::native::file::{
    BoxTable, ConeTable, CylinderTable, DiscTable, EllipsoidTable, MaterialRef, ObjectTable,
    PlaneTable, RectangleTable, Spanned, SphereTable, TorusTable,
};
use crate::import::native::shapes::{
    box_place, cone_place, disc_place, rectangle_place, torus_place,
};
use crate::import::native::values::{Distance, Positive, Vector, differing};
use glam::{DAffine3, DQuat, DVec3};
use glimray_scene::{CanonicalShape, Geometry, Shape, is_numbered};

/// An object with the table of its surface.
macro_rules! object {
    ($key:ident: $table:expr) => {
        ObjectTable {
            $key: Some($table.into()),
            ..ObjectTable::default()
        }
    };
}

impl Writer<'_> {
    pub fn shapes(&mut self) -> Vec<Spanned<ObjectTable>> {
        let shapes = &self.scene.shapes;
        let mut tables = Vec::new();
        for run in runs(shapes, is_alike) {
            let run = &shapes[run];
            let places: Option<Vec<_>> = run.iter().map(canonical_place).collect();
            let of_run = match places {
                Some(places) if run.len() >= LEAST => {
                    let repeat = self.copies("surface", &places);
                    let (table, _) = in_place(run[0].geometry);
                    vec![(own_name(&run[0]), ObjectTable { repeat, ..table })]
                }
                _ => (run.iter())
                    .map(|shape| (shape.name.as_str(), table(shape.geometry)))
                    .collect(),
            };
            tables.extend(of_run.into_iter().map(|(name, table)| {
                let material = MaterialRef::Name(self.names.materials[run[0].material].clone());
                let object = ObjectTable {
                    name: self.names.objects.next(name),
                    material: Some(material.into()),
                    carried_by: self.names.node(run[0].node),
                    ..table
                };
                object.into()
            }));
        }
        tables
    }
}

/// A surface with the transform that its table lacks.
fn table(geometry: Geometry) -> ObjectTable {
    let (table, place) = match readable(geometry) {
        Some(table) => (table, DAffine3::IDENTITY),
        None => in_place(geometry),
    };
    ObjectTable {
        transform: transform(place).map(Into::into),
        ..table
    }
}

/// Whether one object with copies can represent both.
fn is_alike(a: &Shape, b: &Shape) -> bool {
    let is_same_shape = match (a.geometry, b.geometry) {
        (Geometry::Sphere { .. }, Geometry::Sphere { .. }) => true,
        (Geometry::Placed { canonical: a, .. }, Geometry::Placed { canonical: b, .. }) => a == b,
        _ => false,
    };
    let is_same_name = own_name(a) == own_name(b);
    is_same_shape && is_same_name && a.material == b.material && a.node == b.node
}

/// The name of a shape. One that is a number of its kind is not worth an object of its own among many copies.
fn own_name(shape: &Shape) -> &str {
    match is_numbered(&shape.name, shape.geometry.title()) {
        true => "",
        false => &shape.name,
    }
}

/// The transform of the canonical shape, if that keeps all digits.
fn canonical_place(shape: &Shape) -> Option<DAffine3> {
    match shape.geometry {
        Geometry::Plane { .. } => None,
        Geometry::Sphere { center, radius } => {
            let is_signed = |x: &f64| *x == 0.0 && x.is_sign_negative();
            let is_kept =
                (radius * radius).sqrt() == radius && !center.to_array().iter().any(is_signed);
            let place = DAffine3::from_scale_rotation_translation(
                DVec3::splat(radius),
                DQuat::IDENTITY,
                center,
            );
            is_kept.then_some(place)
        }
        Geometry::Placed {
            world_from_canonical,
            ..
        } => Some(normalized(shape.geometry).map_or(world_from_canonical, |(_, place)| place)),
    }
}

/// A cone scaled so that its larger radius is 1, as the importer does.
fn normalized(geometry: Geometry) -> Option<(CanonicalShape, DAffine3)> {
    let Geometry::Placed {
        canonical:
            CanonicalShape::Cone {
                bottom,
                top,
                capped,
            },
        world_from_canonical,
    } = geometry
    else {
        return None;
    };
    let wide = bottom.max(top);
    if wide == 1.0 {
        return None;
    }
    let canonical = CanonicalShape::Cone {
        bottom: bottom / wide,
        top: top / wide,
        capped,
    };
    let axes = DAffine3::from_scale(DVec3::new(wide, 1.0, wide));
    Some((canonical, world_from_canonical * axes))
}

/// A shape in canonical position, and its transform.
fn in_place(geometry: Geometry) -> (ObjectTable, DAffine3) {
    let (canonical, place) = match geometry {
        Geometry::Sphere { .. } => return (sphere(DVec3::ZERO, 1.0), DAffine3::IDENTITY),
        Geometry::Plane { point, normal } => {
            let plane = PlaneTable {
                point: point.into(),
                normal: differing(normal, DVec3::Y),
            };
            return (object!(plane: plane), DAffine3::IDENTITY);
        }
        Geometry::Placed {
            canonical,
            world_from_canonical,
        } => normalized(geometry).unwrap_or((canonical, world_from_canonical)),
    };
    let table = match canonical {
        CanonicalShape::Disc { hole } => disc_table(DVec3::ZERO, DVec3::Y, [1.0, hole]),
        CanonicalShape::Rectangle => {
            rectangle_table(DVec3::ZERO, 2.0 * DVec3::X, DVec3::new(0.0, 0.0, -2.0))
        }
        CanonicalShape::Box => box_table(DVec3::NEG_ONE, DVec3::ONE),
        CanonicalShape::Cone {
            bottom,
            top,
            capped,
        } => cone_table(DVec3::ZERO, DVec3::Y, [bottom, top], capped),
        CanonicalShape::Torus { minor } => torus_table(DVec3::ZERO, DVec3::Y, [1.0, minor]),
        CanonicalShape::Ellipsoid => object!(ellipsoid: EllipsoidTable::default()),
    };
    (table, place)
}

fn sphere(center: DVec3, radius: f64) -> ObjectTable {
    object!(sphere: SphereTable { center: center.into(), radius: radius.into() })
}

fn box_table(min: DVec3, max: DVec3) -> ObjectTable {
    object!(cuboid: BoxTable { min: min.into(), max: Vector(max).into() })
}

fn rectangle_table(center: DVec3, edge_u: DVec3, edge_v: DVec3) -> ObjectTable {
    object!(rectangle: RectangleTable {
        center: Vector(center).into(),
        edge_u: Some(Vector(edge_u).into()),
        edge_v: Some(Vector(edge_v).into()),
        size: None,
        normal: None,
    })
}

fn disc_table(center: DVec3, normal: DVec3, [radius, hole]: [f64; 2]) -> ObjectTable {
    object!(disc: DiscTable {
        center: center.into(),
        normal: differing(normal, DVec3::Y),
        radius: radius.into(),
        inner_radius: (hole != 0.0).then(|| Distance(hole).into()),
    })
}

fn torus_table(center: DVec3, axis: DVec3, [major, minor]: [f64; 2]) -> ObjectTable {
    object!(torus: TorusTable {
        center: center.into(),
        axis: differing(axis, DVec3::Y),
        major_radius: major.into(),
        minor_radius: Positive(minor).into(),
    })
}

/// Cylinders, cones and frustums.
fn cone_table(from: DVec3, to: DVec3, [bottom, top]: [f64; 2], capped: bool) -> ObjectTable {
    let (from, to) = (from.into(), Vector(to).into());
    let open = (!capped).then_some(true);
    match bottom == top {
        true => object!(cylinder: CylinderTable { from, to, radius: bottom.into(), open }),
        false => object!(cone: ConeTable {
            from,
            to,
            from_radius: Distance(bottom).into(),
            to_radius: differing(top, 0.0),
            open,
        }),
    }
}

/// A surface as written by hand, without a transform.
fn readable(geometry: Geometry) -> Option<ObjectTable> {
    let (canonical, place) = match geometry {
        Geometry::Sphere { center, radius } => return Some(sphere(center, radius)),
        Geometry::Plane { .. } => return None,
        // In canonical position, only the transform keeps the signs of zeros.
        Geometry::Placed {
            world_from_canonical,
            ..
        } if world_from_canonical == DAffine3::IDENTITY => return None,
        Geometry::Placed {
            canonical,
            world_from_canonical,
        } => (canonical, world_from_canonical),
    };
    match canonical {
        CanonicalShape::Box => cuboid(place),
        CanonicalShape::Ellipsoid => ellipsoid(place),
        CanonicalShape::Rectangle => rectangle(place),
        CanonicalShape::Disc { hole } => disc(hole, place),
        CanonicalShape::Torus { minor } => torus(minor, place),
        CanonicalShape::Cone {
            bottom,
            top,
            capped,
        } => cone([bottom, top], capped, place),
    }
}

fn three(n: &[f64]) -> DVec3 {
    DVec3::new(n[0], n[1], n[2])
}

fn six(a: DVec3, b: DVec3) -> [f64; 6] {
    [a.x, a.y, a.z, b.x, b.y, b.z]
}

fn cuboid(place: DAffine3) -> Option<ObjectTable> {
    let half = DVec3::new(
        place.matrix3.x_axis.x,
        place.matrix3.y_axis.y,
        place.matrix3.z_axis.z,
    );
    let near = six(place.translation - half, place.translation + half);
    let found = shortest(near, |n| {
        let (min, max) = (three(&n), three(&n[3..]));
        min.cmplt(max).all() && is_same(box_place(min, max), place)
    })?;
    Some(box_table(three(&found), three(&found[3..])))
}

fn ellipsoid(place: DAffine3) -> Option<ObjectTable> {
    let radii = DVec3::new(
        place.matrix3.x_axis.x,
        place.matrix3.y_axis.y,
        place.matrix3.z_axis.z,
    );
    let of = DAffine3::from_scale_rotation_translation(radii, DQuat::IDENTITY, place.translation);
    let is_exact = radii.min_element() > 0.0 && is_same(of, place);
    is_exact.then(|| {
        object!(ellipsoid: EllipsoidTable {
            center: Some(place.translation.into()),
            radii: Some(radii.into()),
        })
    })
}

fn rectangle(place: DAffine3) -> Option<ObjectTable> {
    let of = |n: [f64; 6]| rectangle_place(place.translation, three(&n), three(&n[3..]));
    let near = six(2.0 * place.matrix3.x_axis, -2.0 * place.matrix3.z_axis);
    let found = shortest(near, |n| is_same(of(n), place))?;
    // Zeros without a sign.
    let found = found.map(|x| x + 0.0);
    let table = rectangle_table(place.translation, three(&found), three(&found[3..]));
    is_same(of(found), place).then_some(table)
}

fn disc(hole: f64, place: DAffine3) -> Option<ObjectTable> {
    let radius = place.matrix3.y_axis.length();
    let normal = place.matrix3.y_axis / radius;
    let of = |n: [f64; 5]| {
        let made = disc_place(place.translation, unit(three(&n))?, n[3]);
        ((n[4] / n[3]).to_bits() == hole.to_bits()).then_some(made)
    };
    let near = [normal.x, normal.y, normal.z, radius, hole * radius];
    let found = shortest(near, |n| of(n).is_some_and(|made| is_same(made, place)))?;
    let radii = [found[3], found[4]];
    Some(disc_table(place.translation, three(&found), radii))
}

fn torus(minor: f64, place: DAffine3) -> Option<ObjectTable> {
    let major = place.matrix3.y_axis.length();
    let axis = place.matrix3.y_axis / major;
    let of = |n: [f64; 5]| {
        let made = torus_place(place.translation, unit(three(&n))?, n[3]);
        ((n[4] / n[3]).to_bits() == minor.to_bits()).then_some(made)
    };
    let near = [axis.x, axis.y, axis.z, major, minor * major];
    let found = shortest(near, |n| of(n).is_some_and(|made| is_same(made, place)))?;
    let radii = [found[3], found[4]];
    Some(torus_table(place.translation, three(&found), radii))
}

fn cone([bottom, top]: [f64; 2], capped: bool, place: DAffine3) -> Option<ObjectTable> {
    let from = place.translation;
    let wide = place.matrix3.x_axis.length();
    let of = |n: [f64; 5]| {
        let greater = n[3].max(n[4]);
        let made = cone_place(from, three(&n), greater)?;
        let radii = [n[3] / greater, n[4] / greater].map(f64::to_bits);
        (radii == [bottom, top].map(f64::to_bits)).then_some(made)
    };
    let to = from + place.matrix3.y_axis;
    let near = [to.x, to.y, to.z, bottom * wide, top * wide];
    let found = shortest(near, |n| of(n).is_some_and(|made| is_same(made, place)))?;
    Some(cone_table(
        from,
        three(&found),
        [found[3], found[4]],
        capped,
    ))
}

/// A direction as the importer reads it: normalised vectors stay as they are.
fn unit(direction: DVec3) -> Option<DVec3> {
    if (direction.length_squared() - 1.0).abs() <= 8.0 * f64::EPSILON {
        return Some(direction);
    }
    direction.try_normalize()
}
