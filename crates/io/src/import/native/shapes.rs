//! The analytic surfaces of a native scene.

use super::Texts;
use super::file::{
    BoxTable, ConeTable, CylinderTable, DiscTable, EllipsoidTable, ObjectTable, PlaneTable,
    RectangleTable, Spanned, SphereTable, TorusTable,
};
use super::transforms::{chain, normal_matrix};
use super::values::{Extent, Vector, or};
use crate::import::error::ImportError;
use glam::{DAffine3, DMat3, DVec3};
use glimray_scene::{CanonicalShape, Geometry};

/// Edges are parallel if the sine of the angle between them is at most this.
const PARALLEL: f64 = 1e-9;

/// Number of analytic surfaces in `table`.
pub(super) fn count(table: &ObjectTable) -> usize {
    let given = [
        table.sphere.is_some(),
        table.ellipsoid.is_some(),
        table.plane.is_some(),
        table.disc.is_some(),
        table.rectangle.is_some(),
        table.cuboid.is_some(),
        table.cylinder.is_some(),
        table.cone.is_some(),
        table.torus.is_some(),
    ];
    given.into_iter().filter(|&given| given).count()
}

/// The analytic surface in `table`, transformed by `placed`. `textured` tells whether its u and v are
/// used, and `moves` whether it is attached to a node.
pub(super) fn geometry(
    table: &ObjectTable,
    placed: DAffine3,
    (textured, moves): (bool, bool),
    texts: &Texts,
) -> Result<Option<Geometry>, ImportError> {
    let (canonical, object_from_canonical) = if let Some(ellipsoid) = &table.ellipsoid {
        (CanonicalShape::Ellipsoid, self::ellipsoid(ellipsoid))
    } else if let Some(plane) = &table.plane {
        return Ok(Some(self::plane(plane, placed)));
    } else if let Some(sphere) = &table.sphere {
        return Ok(Some(self::sphere(sphere, placed, (textured, moves))));
    } else if let Some(disc) = &table.disc {
        self::disc(disc, texts)?
    } else if let Some(rectangle) = &table.rectangle {
        (
            CanonicalShape::Rectangle,
            self::rectangle(rectangle, texts)?,
        )
    } else if let Some(cuboid) = &table.cuboid {
        (CanonicalShape::Box, self::cuboid(cuboid, texts)?)
    } else if let Some(cylinder) = &table.cylinder {
        self::cylinder(cylinder, texts)?
    } else if let Some(cone) = &table.cone {
        self::cone(cone, texts)?
    } else if let Some(torus) = &table.torus {
        self::torus(torus, texts)?
    } else {
        return Ok(None);
    };
    // Ignores the signs of zeros; then only the translation matters.
    let object_from_canonical = match object_from_canonical {
        same if same == DAffine3::IDENTITY => DAffine3::IDENTITY,
        other => other,
    };
    Ok(Some(Geometry::Placed {
        canonical,
        world_from_canonical: chain(placed, object_from_canonical),
    }))
}

fn ellipsoid(ellipsoid: &EllipsoidTable) -> DAffine3 {
    let (radii, center) = (
        or(ellipsoid.radii, DVec3::ONE),
        or(ellipsoid.center, DVec3::ZERO),
    );
    DAffine3::from_scale_rotation_translation(radii, Default::default(), center)
}

fn plane(plane: &PlaneTable, placed: DAffine3) -> Geometry {
    let (point, normal) = (plane.point.0, or(plane.normal, DVec3::Y));
    if placed == DAffine3::IDENTITY {
        return Geometry::Plane { point, normal };
    }
    Geometry::Plane {
        point: placed.transform_point3(point),
        normal: (normal_matrix(placed) * normal).normalize_or(normal),
    }
}

/// A sphere as long as the transform keeps it one. An ellipsoid if it is scaled unevenly, or if a texture
/// would show a rotation.
fn sphere(sphere: &SphereTable, placed: DAffine3, (textured, moves): (bool, bool)) -> Geometry {
    let (center, radius) = (sphere.center.0, sphere.radius.0);
    if placed == DAffine3::IDENTITY && !(textured && moves) {
        return Geometry::Sphere { center, radius };
    }
    let matrix = placed.matrix3;
    let lengths = [matrix.x_axis, matrix.y_axis, matrix.z_axis].map(DVec3::length);
    let (least, most) = (
        lengths.into_iter().fold(f64::INFINITY, f64::min),
        lengths.into_iter().fold(0.0, f64::max),
    );
    // If groups rotate scaled objects, axes do not stay perpendicular.
    let slant = [
        matrix.x_axis.dot(matrix.y_axis),
        matrix.y_axis.dot(matrix.z_axis),
        matrix.z_axis.dot(matrix.x_axis),
    ];
    let is_straight = slant.into_iter().all(|dot| dot.abs() <= 1e-9 * most * most);
    let is_sphere = most - least <= 1e-9 * most && is_straight;
    let is_turned = matrix != DMat3::from_diagonal(DVec3::splat(lengths[0]));
    if is_sphere && !(textured && (is_turned || moves)) {
        return Geometry::Sphere {
            center: placed.transform_point3(center),
            radius: lengths[0] * radius,
        };
    }
    let object_from_canonical =
        DAffine3::from_scale_rotation_translation(DVec3::splat(radius), Default::default(), center);
    Geometry::Placed {
        canonical: CanonicalShape::Ellipsoid,
        world_from_canonical: chain(placed, object_from_canonical),
    }
}

fn disc(disc: &DiscTable, texts: &Texts) -> Result<(CanonicalShape, DAffine3), ImportError> {
    let radius = disc.radius.0;
    let hole = match &disc.inner_radius {
        Some(inner) if inner.0 >= radius => {
            let why = format!("`inner_radius` is not less than `radius`, which is {radius}");
            return Err(texts.malformed(inner.span(), why, "Make the hole smaller"));
        }
        Some(inner) => inner.0 / radius,
        None => 0.0,
    };
    let normal = or(disc.normal, DVec3::Y);
    let place = disc_place(disc.center.0, normal, radius);
    Ok((CanonicalShape::Disc { hole }, place))
}

/// The transform of a disc that faces the unit vector `normal`.
pub(crate) fn disc_place(center: DVec3, normal: DVec3, radius: f64) -> DAffine3 {
    let (u, v) = Geometry::plane_axes(normal);
    let axes = DMat3::from_cols(radius * u, radius * normal, -radius * v);
    DAffine3::from_mat3_translation(axes, center)
}

fn rectangle(rectangle: &RectangleTable, texts: &Texts) -> Result<DAffine3, ImportError> {
    let (u, v) = match rectangle {
        RectangleTable {
            edge_u: Some(edge_u),
            edge_v: Some(edge_v),
            size: None,
            normal: None,
            ..
        } => {
            let (u, v) = (edge_u.0, edge_v.0);
            for (edge, vector) in [(edge_u, u), (edge_v, v)] {
                if vector == DVec3::ZERO {
                    let todo = "Give the whole edge, as [x, y, z]";
                    let why = "an edge cannot be [0, 0, 0]".to_owned();
                    return Err(texts.malformed(edge.span(), why, todo));
                }
            }
            if u.normalize().cross(v.normalize()).length() <= PARALLEL {
                let why = "`edge_v` is parallel to `edge_u`".to_owned();
                return Err(texts.malformed(edge_v.span(), why, "Turn one of them"));
            }
            (u, v)
        }
        RectangleTable {
            edge_u: None,
            edge_v: None,
            size: Some(Extent([width, height])),
            normal,
            ..
        } => {
            let normal = normal.as_ref().map_or(DVec3::Y, |n| n.0);
            let (u, v) = Geometry::plane_axes(normal);
            (*width * u, *height * v)
        }
        _ => {
            let edge = [&rectangle.edge_u, &rectangle.edge_v];
            let edge = edge.into_iter().flatten().next();
            let place = edge.map(|edge| edge.span()).or_else(|| {
                let normal = rectangle.normal.as_ref();
                normal.map(|normal| normal.span())
            });
            let why = "a rectangle needs two edges or a size".to_owned();
            let todo = "Give it either `edge_u` and `edge_v`, or `size` and, unless it faces \
                        upwards, `normal`";
            return Err(texts.malformed(place.unwrap_or(rectangle.center.span()), why, todo));
        }
    };
    Ok(rectangle_place(rectangle.center.0, u, v))
}

/// The transform of a rectangle with these whole edges.
pub(crate) fn rectangle_place(center: DVec3, u: DVec3, v: DVec3) -> DAffine3 {
    // The height equals the width, so that the matrix is well conditioned.
    let height = u.length().max(v.length());
    let normal = u.normalize().cross(v.normalize()).normalize() * height;
    DAffine3::from_mat3_translation(DMat3::from_cols(u, normal, -v) * 0.5, center)
}

fn cuboid(cuboid: &BoxTable, texts: &Texts) -> Result<DAffine3, ImportError> {
    let (min, max) = (cuboid.min.0, cuboid.max.0);
    for (axis, name) in ["x", "y", "z"].into_iter().enumerate() {
        if max[axis] <= min[axis] {
            let why = format!("{name} of `max` is not greater than {name} of `min`");
            let todo = "Give a box a width, a height and a depth, or use a rectangle";
            return Err(texts.malformed(cuboid.max.span(), why, todo));
        }
    }
    Ok(box_place(min, max))
}

/// The transform of a box with these corners.
pub(crate) fn box_place(min: DVec3, max: DVec3) -> DAffine3 {
    let (size, middle) = ((max - min) / 2.0, (max + min) / 2.0);
    DAffine3::from_scale_rotation_translation(size, Default::default(), middle)
}

fn cylinder(
    cylinder: &CylinderTable,
    texts: &Texts,
) -> Result<(CanonicalShape, DAffine3), ImportError> {
    let canonical = CanonicalShape::Cone {
        bottom: 1.0,
        top: 1.0,
        capped: cylinder.open != Some(true),
    };
    let radius = cylinder.radius.0;
    let place = around(cylinder.from.0, &cylinder.to, radius, texts)?;
    Ok((canonical, place))
}

fn cone(cone: &ConeTable, texts: &Texts) -> Result<(CanonicalShape, DAffine3), ImportError> {
    let [bottom, top] = [cone.from_radius.0, or(cone.to_radius, 0.0)];
    let wide = bottom.max(top);
    if wide < f64::from(f32::MIN_POSITIVE) {
        let why = "both radii of the cone are 0".to_owned();
        let todo = "Make one of them greater than 0";
        return Err(texts.malformed(cone.from_radius.span(), why, todo));
    }
    let canonical = CanonicalShape::Cone {
        bottom: bottom / wide,
        top: top / wide,
        capped: cone.open != Some(true),
    };
    let place = around(cone.from.0, &cone.to, wide, texts)?;
    Ok((canonical, place))
}

fn torus(torus: &TorusTable, texts: &Texts) -> Result<(CanonicalShape, DAffine3), ImportError> {
    let (major, minor) = (torus.major_radius.0, torus.minor_radius.0);
    if minor > major {
        let why = format!("`minor_radius` is greater than `major_radius`, which is {major}");
        let todo = "Make the tube thinner";
        return Err(texts.malformed(torus.minor_radius.span(), why, todo));
    }
    let canonical = CanonicalShape::Torus {
        minor: minor / major,
    };
    let place = torus_place(torus.center.0, or(torus.axis, DVec3::Y), major);
    Ok((canonical, place))
}

/// The transform of a torus about the unit vector `axis`.
pub(crate) fn torus_place(center: DVec3, axis: DVec3, major: f64) -> DAffine3 {
    DAffine3::from_mat3_translation(turned_to(axis) * major, center)
}

/// The transform of a cone or cylinder whose wider end has this radius, unless both ends are at one point.
pub(crate) fn cone_place(from: DVec3, to: DVec3, radius: f64) -> Option<DAffine3> {
    let axis = to - from;
    let turned = turned_to(axis.try_normalize()?);
    let axes = DMat3::from_cols(radius * turned.x_axis, axis, radius * turned.z_axis);
    Some(DAffine3::from_mat3_translation(axes, from))
}

fn around(
    from: DVec3,
    to: &Spanned<Vector>,
    radius: f64,
    texts: &Texts,
) -> Result<DAffine3, ImportError> {
    cone_place(from, to.0, radius).ok_or_else(|| {
        let why = "`to` is the same point as `from`".to_owned();
        texts.malformed(to.span(), why, "Move one of them")
    })
}

/// The shortest rotation from +y to `axis`, which has unit length.
fn turned_to(axis: DVec3) -> DMat3 {
    DMat3::from_quat(glam::DQuat::from_rotation_arc(DVec3::Y, axis))
}
