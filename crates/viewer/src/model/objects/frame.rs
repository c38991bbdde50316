//! Canonical frames of shapes and lights: origin, axes and size as one map.

use glam::{DAffine3, DMat3, DQuat, DVec3};
use glimray_scene::{CanonicalShape, Geometry, LightKind};

/// The transform of the canonical surface: a unit sphere, a plane y = 0 that faces +y, or the
/// [`CanonicalShape`].
pub fn of_geometry(geometry: &Geometry) -> DAffine3 {
    match *geometry {
        Geometry::Sphere { center, radius } => {
            DAffine3::from_mat3_translation(DMat3::from_diagonal(DVec3::splat(radius)), center)
        }
        Geometry::Plane { point, normal } => {
            let (u, v) = Geometry::plane_axes(normal);
            DAffine3::from_mat3_translation(DMat3::from_cols(u, normal, -v), point)
        }
        Geometry::Placed {
            world_from_canonical,
            ..
        } => world_from_canonical,
    }
}

/// The surface with another transform. A sphere that is rotated or unevenly scaled becomes an ellipsoid. For
/// a plane, only position and normal are used.
pub(super) fn geometry_in(geometry: &Geometry, place: DAffine3) -> Geometry {
    match *geometry {
        Geometry::Sphere { .. } => {
            let radius = place.matrix3.x_axis.x;
            let even = DMat3::from_diagonal(DVec3::splat(radius));
            if radius > 0.0 && place.matrix3.abs_diff_eq(even, 1e-12 * radius) {
                let center = place.translation;
                return Geometry::Sphere { center, radius };
            }
            Geometry::Placed {
                canonical: CanonicalShape::Ellipsoid,
                world_from_canonical: place,
            }
        }
        Geometry::Plane { normal, .. } => Geometry::Plane {
            point: place.translation,
            normal: place.matrix3.y_axis.normalize_or(normal),
        },
        Geometry::Placed { canonical, .. } => Geometry::Placed {
            canonical,
            world_from_canonical: place,
        },
    }
}

/// The transform of the canonical light, which shines along +y: a point, a unit disc, a unit sphere, or a
/// square |x|, |z| ≤ 1.
pub fn of_light(kind: &LightKind) -> DAffine3 {
    let along = |direction: DVec3| DMat3::from_quat(DQuat::from_rotation_arc(DVec3::Y, direction));
    let at = DAffine3::from_mat3_translation;
    match *kind {
        LightKind::Point { position } => DAffine3::from_translation(position),
        LightKind::Directional { direction } => at(along(direction), DVec3::ZERO),
        LightKind::Spot {
            position,
            direction,
            ..
        } => at(along(direction), position),
        LightKind::Rectangle {
            center,
            edge_u,
            edge_v,
        } => {
            let size = edge_u.cross(edge_v).length().sqrt();
            let normal = edge_u.cross(edge_v).normalize_or(DVec3::Y) * size;
            at(DMat3::from_cols(edge_u, normal, -edge_v), center)
        }
        LightKind::Disc {
            center,
            normal,
            radius,
        } => at(along(normal) * radius, center),
        LightKind::Sphere { center, radius } => {
            at(DMat3::from_diagonal(DVec3::splat(radius)), center)
        }
    }
}

/// The light with another transform. If the axes equal those of `was`, only the position changes.
pub(super) fn light_in(kind: &LightKind, was: DAffine3, place: DAffine3) -> LightKind {
    let is_moved_only = was.matrix3 == place.matrix3;
    let moved = place.translation;
    let axes = place.matrix3;
    let along = |old: DVec3| match is_moved_only {
        true => old,
        false => axes.y_axis.normalize_or(old),
    };
    match *kind {
        LightKind::Point { .. } => LightKind::Point { position: moved },
        LightKind::Directional { direction } => LightKind::Directional {
            direction: along(direction),
        },
        LightKind::Spot {
            direction,
            inner,
            outer,
            ..
        } => LightKind::Spot {
            position: moved,
            direction: along(direction),
            inner,
            outer,
        },
        LightKind::Rectangle { .. } => LightKind::Rectangle {
            center: moved,
            edge_u: axes.x_axis,
            edge_v: -axes.z_axis,
        },
        LightKind::Disc { normal, radius, .. } => LightKind::Disc {
            center: moved,
            normal: along(normal),
            radius: match is_moved_only {
                true => radius,
                false => axes.y_axis.length(),
            },
        },
        LightKind::Sphere { radius, .. } => LightKind::Sphere {
            center: moved,
            radius: match is_moved_only {
                true => radius,
                false => axes.determinant().abs().cbrt(),
            },
        },
    }
}
