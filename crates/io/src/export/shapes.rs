//! The analytic surfaces of a scene: with corners, radii and ends that represent them exactly, or in
//! canonical position with a transform.

use super::Writer;
use super::exact::{is_same, shortest, transform};
use super::runs::{LEAST, runs};
use super::text::{Table, number, string, vector};
use glam::{DAffine3, DMat3, DQuat, DVec3};
use glimray_scene::{CanonicalShape, Geometry, Shape};

impl Writer<'_> {
    pub fn shapes(&mut self) {
        let shapes = &self.scene.shapes;
        if !shapes.is_empty() {
            self.text.section("Surfaces");
        }
        for run in runs(shapes, is_alike) {
            let first = &shapes[run.start];
            let places: Option<Vec<_>> = shapes[run.clone()].iter().map(canonical_place).collect();
            match places {
                Some(places) if run.len() >= LEAST => {
                    let (key, canonical, _) = in_place(first.geometry);
                    let mut table = Table::default();
                    table.put(key, canonical.inline());
                    table.put("material", string(&self.names.materials[first.material]));
                    if let Some(node) = first.node {
                        table.put("carried_by", string(&self.names.nodes[node]));
                    }
                    self.copies(table, key, &places);
                }
                _ => shapes[run].iter().for_each(|shape| self.shape(shape)),
            }
        }
    }

    fn shape(&mut self, shape: &Shape) {
        let (key, own, place) = readable(shape.geometry);
        let mut table = Table::default();
        table.put(key, own.inline());
        table.put("material", string(&self.names.materials[shape.material]));
        self.object(table, shape.node, transform(place));
    }
}

/// Whether one object with copies can represent both.
fn is_alike(a: &Shape, b: &Shape) -> bool {
    let is_same_shape = match (a.geometry, b.geometry) {
        (Geometry::Sphere { .. }, Geometry::Sphere { .. }) => true,
        (Geometry::Placed { canonical: a, .. }, Geometry::Placed { canonical: b, .. }) => a == b,
        _ => false,
    };
    is_same_shape && a.material == b.material && a.node == b.node
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

/// The key and table of a shape in canonical position, and its transform.
fn in_place(geometry: Geometry) -> (&'static str, Table, DAffine3) {
    let mut table = Table::default();
    let (canonical, place) = match geometry {
        Geometry::Sphere { .. } => {
            table.put("center", vector(DVec3::ZERO));
            table.put("radius", "1");
            return ("sphere", table, DAffine3::IDENTITY);
        }
        Geometry::Plane { point, normal } => {
            table.put("point", vector(point));
            let is_level =
                normal.to_array().map(f64::to_bits) == DVec3::Y.to_array().map(f64::to_bits);
            table.put_if(!is_level, "normal", vector(normal));
            return ("plane", table, DAffine3::IDENTITY);
        }
        Geometry::Placed {
            canonical,
            world_from_canonical,
        } => normalized(geometry).unwrap_or((canonical, world_from_canonical)),
    };
    let center = || vector(DVec3::ZERO);
    let key = match canonical {
        CanonicalShape::Disc { hole } => {
            table.put("center", center());
            table.put("radius", "1");
            table.put_if(hole != 0.0, "inner_radius", number(hole));
            "disc"
        }
        CanonicalShape::Rectangle => {
            table.put("center", center());
            table.put("edge_u", "[2, 0, 0]");
            table.put("edge_v", "[0, 0, -2]");
            "rectangle"
        }
        CanonicalShape::Box => {
            table.put("min", vector(DVec3::NEG_ONE));
            table.put("max", vector(DVec3::ONE));
            "box"
        }
        CanonicalShape::Cone {
            bottom,
            top,
            capped,
        } => {
            table.put("from", center());
            table.put("to", "[0, 1, 0]");
            let is_cylinder = bottom == 1.0 && top == 1.0;
            put_radii(&mut table, [bottom, top], capped);
            if is_cylinder { "cylinder" } else { "cone" }
        }
        CanonicalShape::Torus { minor } => {
            table.put("center", center());
            table.put("major_radius", "1");
            table.put("minor_radius", number(minor));
            "torus"
        }
        CanonicalShape::Ellipsoid => "ellipsoid",
    };
    (key, table, place)
}

fn put_radii(table: &mut Table, [bottom, top]: [f64; 2], capped: bool) {
    if bottom == top {
        table.put("radius", number(bottom));
    } else {
        table.put("from_radius", number(bottom));
        table.put_if(top != 0.0, "to_radius", number(top));
    }
    table.put_if(!capped, "open", "true");
}

/// The key and table of a surface as written by hand, and the remaining transform.
fn readable(geometry: Geometry) -> (&'static str, Table, DAffine3) {
    let found = match geometry {
        Geometry::Sphere { center, radius } => {
            let mut table = Table::default();
            table.put("center", vector(center));
            table.put("radius", number(radius));
            return ("sphere", table, DAffine3::IDENTITY);
        }
        Geometry::Plane { .. } => None,
        // In canonical position, only the transform keeps the signs of zeros.
        Geometry::Placed {
            world_from_canonical,
            ..
        } if world_from_canonical == DAffine3::IDENTITY => None,
        Geometry::Placed {
            canonical,
            world_from_canonical,
        } => match canonical {
            CanonicalShape::Box => cuboid(world_from_canonical).map(|table| ("box", table)),
            CanonicalShape::Ellipsoid => {
                ellipsoid(world_from_canonical).map(|table| ("ellipsoid", table))
            }
            CanonicalShape::Rectangle => {
                rectangle(world_from_canonical).map(|table| ("rectangle", table))
            }
            CanonicalShape::Disc { hole } => {
                disc(hole, world_from_canonical).map(|table| ("disc", table))
            }
            CanonicalShape::Torus { minor } => {
                torus(minor, world_from_canonical).map(|table| ("torus", table))
            }
            CanonicalShape::Cone {
                bottom,
                top,
                capped,
            } => {
                let is_cylinder = bottom == 1.0 && top == 1.0;
                let table = cone([bottom, top], capped, world_from_canonical);
                table.map(|table| (if is_cylinder { "cylinder" } else { "cone" }, table))
            }
        },
    };
    match found {
        Some((key, table)) => (key, table, DAffine3::IDENTITY),
        None => in_place(geometry),
    }
}

fn three(n: &[f64]) -> DVec3 {
    DVec3::new(n[0], n[1], n[2])
}

fn six(a: DVec3, b: DVec3) -> [f64; 6] {
    [a.x, a.y, a.z, b.x, b.y, b.z]
}

fn cuboid(place: DAffine3) -> Option<Table> {
    let half = DVec3::new(
        place.matrix3.x_axis.x,
        place.matrix3.y_axis.y,
        place.matrix3.z_axis.z,
    );
    let of = |n: [f64; 6]| {
        let (min, max) = (three(&n), three(&n[3..]));
        let (size, middle) = ((max - min) / 2.0, (max + min) / 2.0);
        DAffine3::from_scale_rotation_translation(size, DQuat::IDENTITY, middle)
    };
    let near = six(place.translation - half, place.translation + half);
    let found = shortest(near, |n| {
        three(&n).cmplt(three(&n[3..])).all() && is_same(of(n), place)
    })?;
    let mut table = Table::default();
    table.put("min", vector(three(&found)));
    table.put("max", vector(three(&found[3..])));
    Some(table)
}

fn ellipsoid(place: DAffine3) -> Option<Table> {
    let radii = DVec3::new(
        place.matrix3.x_axis.x,
        place.matrix3.y_axis.y,
        place.matrix3.z_axis.z,
    );
    let of = DAffine3::from_scale_rotation_translation(radii, DQuat::IDENTITY, place.translation);
    if radii.min_element() <= 0.0 || !is_same(of, place) {
        return None;
    }
    let mut table = Table::default();
    table.put("center", vector(place.translation));
    table.put("radii", vector(radii));
    Some(table)
}

fn rectangle(place: DAffine3) -> Option<Table> {
    let of = |n: [f64; 6]| {
        let (u, v) = (three(&n), three(&n[3..]));
        let height = u.length().max(v.length());
        let normal = u.normalize().cross(v.normalize()).normalize() * height;
        DAffine3::from_mat3_translation(DMat3::from_cols(u, normal, -v) * 0.5, place.translation)
    };
    let near = six(2.0 * place.matrix3.x_axis, -2.0 * place.matrix3.z_axis);
    let found = shortest(near, |n| is_same(of(n), place))?;
    let mut table = Table::default();
    table.put("center", vector(place.translation));
    table.put("edge_u", vector(three(&found) + 0.0));
    table.put("edge_v", vector(three(&found[3..]) + 0.0));
    let plain = |v: &[f64]| [v[0] + 0.0, v[1] + 0.0, v[2] + 0.0];
    let [a, b, c] = plain(&found);
    let [d, e, f] = plain(&found[3..]);
    is_same(of([a, b, c, d, e, f]), place).then_some(table)
}

fn disc(hole: f64, place: DAffine3) -> Option<Table> {
    let radius = place.matrix3.y_axis.length();
    let normal = place.matrix3.y_axis / radius;
    let of = |n: [f64; 5]| {
        let given = DVec3::new(n[0], n[1], n[2]);
        let (normal, radius) = (unit(given)?, n[3]);
        let (u, v) = Geometry::plane_axes(normal);
        let axes = DMat3::from_cols(radius * u, radius * normal, -radius * v);
        let inner = n[4] / radius;
        (inner.to_bits() == hole.to_bits())
            .then(|| DAffine3::from_mat3_translation(axes, place.translation))
    };
    let near = [normal.x, normal.y, normal.z, radius, hole * radius];
    let found = shortest(near, |n| of(n).is_some_and(|made| is_same(made, place)))?;
    let mut table = Table::default();
    table.put("center", vector(place.translation));
    let normal = three(&found);
    table.put_if(
        six(normal, normal) != six(DVec3::Y, DVec3::Y),
        "normal",
        vector(normal),
    );
    table.put("radius", number(found[3]));
    table.put_if(found[4] != 0.0, "inner_radius", number(found[4]));
    Some(table)
}

fn torus(minor: f64, place: DAffine3) -> Option<Table> {
    let major = place.matrix3.y_axis.length();
    let axis = place.matrix3.y_axis / major;
    let of = |n: [f64; 5]| {
        let axis = unit(three(&n))?;
        let axes = DMat3::from_quat(DQuat::from_rotation_arc(DVec3::Y, axis)) * n[3];
        ((n[4] / n[3]).to_bits() == minor.to_bits())
            .then(|| DAffine3::from_mat3_translation(axes, place.translation))
    };
    let near = [axis.x, axis.y, axis.z, major, minor * major];
    let found = shortest(near, |n| of(n).is_some_and(|made| is_same(made, place)))?;
    let mut table = Table::default();
    table.put("center", vector(place.translation));
    let axis = three(&found);
    table.put_if(
        six(axis, axis) != six(DVec3::Y, DVec3::Y),
        "axis",
        vector(axis),
    );
    table.put("major_radius", number(found[3]));
    table.put("minor_radius", number(found[4]));
    Some(table)
}

/// Cylinders, cones and frustums.
fn cone([bottom, top]: [f64; 2], capped: bool, place: DAffine3) -> Option<Table> {
    let from = place.translation;
    let wide = place.matrix3.x_axis.length();
    let of = |n: [f64; 5]| {
        let axis = three(&n) - from;
        let greater = n[3].max(n[4]);
        let turned = DMat3::from_quat(DQuat::from_rotation_arc(DVec3::Y, axis.try_normalize()?));
        let axes = DMat3::from_cols(greater * turned.x_axis, axis, greater * turned.z_axis);
        let radii = [n[3] / greater, n[4] / greater].map(f64::to_bits);
        (radii == [bottom, top].map(f64::to_bits))
            .then(|| DAffine3::from_mat3_translation(axes, from))
    };
    let to = from + place.matrix3.y_axis;
    let near = [to.x, to.y, to.z, bottom * wide, top * wide];
    let found = shortest(near, |n| of(n).is_some_and(|made| is_same(made, place)))?;
    let mut table = Table::default();
    table.put("from", vector(from));
    table.put("to", vector(three(&found)));
    put_radii(&mut table, [found[3], found[4]], capped);
    Some(table)
}

/// A direction as the importer reads it: normalised vectors stay as they are.
fn unit(direction: DVec3) -> Option<DVec3> {
    if (direction.length_squared() - 1.0).abs() <= 8.0 * f64::EPSILON {
        return Some(direction);
    }
    direction.try_normalize()
}
