//! Analytic surfaces.

use glam::{DAffine3, DVec3};

/// An analytic surface with one material.
#[derive(Clone, Debug, PartialEq)]
pub struct Shape {
    /// Position, size and kind.
    pub geometry: Geometry,
    /// Index into [`super::Scene::materials`].
    pub material: usize,
    /// Index into [`super::Scene::nodes`] of the parent node; `None` is the world. Planes are always
    /// static.
    pub node: Option<usize>,
    /// May be empty. Copies of one object have the same.
    pub name: String,
}

/// The surface of a [`Shape`], in the space of its node.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Geometry {
    /// A sphere. u and v are those of [`CanonicalShape::Ellipsoid`].
    Sphere {
        /// The centre.
        center: DVec3,
        /// Above 0.
        radius: f64,
    },
    /// An infinite plane.
    Plane {
        /// Any point on the plane; u and v are 0 there.
        point: DVec3,
        /// Unit vector.
        normal: DVec3,
    },
    /// A canonical shape placed by a transform.
    Placed {
        /// The shape in its canonical space.
        canonical: CanonicalShape,
        /// Invertible; may scale unevenly or mirror.
        world_from_canonical: DAffine3,
    },
}

/// A shape of canonical size and position; its axis, if it has one, is y. u and v are in [0, 1]; the
/// longitude runs from −z through −x, +z and +x.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum CanonicalShape {
    /// x² + z² ≤ 1 at y = 0, facing +y, less a hole. u grows along x, v along −z.
    Disc {
        /// Radius of the hole, in [0, 1).
        hole: f64,
    },
    /// |x| ≤ 1, |z| ≤ 1 at y = 0, facing +y. u grows along x, v along −z.
    Rectangle,
    /// |x|, |y|, |z| ≤ 1. On each side, seen from outside, u grows to the right and v upwards. Up is y; on the top it is −z,
    /// on the bottom z.
    Box,
    /// A cylinder, cone or frustum for 0 ≤ y ≤ 1. On its side u is the longitude and v is y; its caps are
    /// mapped like the top and bottom of a box.
    Cone {
        /// Radius at y = 0, 0 or more.
        bottom: f64,
        /// Radius at y = 1, 0 or more; not 0 where `bottom` is.
        top: f64,
        /// Whether it is closed by two discs.
        capped: bool,
    },
    /// A tube around the circle of radius 1 at y = 0. u is the longitude; v runs around the tube, from
    /// the inner equator through the lower side, the outer equator and the upper side.
    Torus {
        /// Radius of the tube, in (0, 1].
        minor: f64,
    },
    /// The unit sphere. u is the longitude; v is the latitude, 0 at −y and 1 at +y.
    Ellipsoid,
}

impl CanonicalShape {
    /// A normal, of any length, at a point of the surface.
    fn normal(self, p: DVec3) -> DVec3 {
        match self {
            Self::Disc { .. } | Self::Rectangle => DVec3::Y,
            Self::Box => {
                let size = p.abs();
                let axis = [DVec3::X, DVec3::Y, DVec3::Z]
                    .into_iter()
                    .max_by(|a, b| size.dot(*a).total_cmp(&size.dot(*b)));
                axis.unwrap_or(DVec3::Y) * p
            }
            Self::Cone {
                bottom,
                top,
                capped,
            } => {
                let radius = bottom + (top - bottom) * p.y;
                let from_axis = p.x.hypot(p.z);
                let from_cap = p.y.abs().min((1.0 - p.y).abs());
                match capped && from_cap < (from_axis - radius).abs() {
                    true => DVec3::Y * (p.y - 0.5),
                    // The gradient of x² + z² − radius².
                    false => DVec3::new(p.x, (bottom - top) * radius, p.z),
                }
            }
            Self::Torus { .. } => p - DVec3::new(p.x, 0.0, p.z).normalize_or_zero(),
            Self::Ellipsoid => p,
        }
    }
}

impl Geometry {
    /// The kind in words, such as "sphere" or "cylinder".
    pub fn title(&self) -> &'static str {
        match self {
            Self::Sphere { .. } => "sphere",
            Self::Plane { .. } => "plane",
            Self::Placed { canonical, .. } => match *canonical {
                CanonicalShape::Disc { .. } => "disc",
                CanonicalShape::Rectangle => "rectangle",
                CanonicalShape::Box => "box",
                CanonicalShape::Cone { bottom, top, .. } if bottom == top => "cylinder",
                CanonicalShape::Cone { .. } => "cone",
                CanonicalShape::Torus { .. } => "torus",
                CanonicalShape::Ellipsoid => "ellipsoid",
            },
        }
    }

    /// The smallest axis-aligned box (min, max) in the space of the geometry; `None` for planes.
    pub fn bounds(&self) -> Option<(DVec3, DVec3)> {
        match *self {
            Self::Sphere { center, radius } => Some((center - radius, center + radius)),
            Self::Plane { .. } => None,
            Self::Placed {
                canonical,
                world_from_canonical,
            } => Some(placed_bounds(canonical, world_from_canonical)),
        }
    }

    /// The unit normal at a point of the surface, pointing out of solids and to the front of others. A point at an edge has
    /// the normal of one of its sides.
    pub fn normal(&self, point: DVec3) -> DVec3 {
        match *self {
            Self::Sphere { center, .. } => (point - center).normalize_or_zero(),
            Self::Plane { normal, .. } => normal,
            Self::Placed {
                canonical,
                world_from_canonical,
            } => {
                let canonical_from_world = world_from_canonical.inverse();
                let normal = canonical.normal(canonical_from_world.transform_point3(point));
                let normal = canonical_from_world.matrix3.transpose() * normal;
                normal.normalize_or_zero()
            }
        }
    }

    /// The surface transformed by `space_from_node`; a sphere becomes an ellipsoid. Planes are static and stay as they
    /// are.
    pub fn placed(&self, space_from_node: DAffine3) -> Self {
        let (canonical, world_from_canonical) = match *self {
            Self::Sphere { center, radius } => {
                let place = DAffine3::from_translation(center);
                (
                    CanonicalShape::Ellipsoid,
                    place * DAffine3::from_scale(DVec3::splat(radius)),
                )
            }
            Self::Plane { .. } => return *self,
            Self::Placed {
                canonical,
                world_from_canonical,
            } => (canonical, world_from_canonical),
        };
        Self::Placed {
            canonical,
            world_from_canonical: space_from_node * world_from_canonical,
        }
    }

    /// The unit vectors along which u and v of a plane increase: to the right and up, seen from its front
    /// with +Y upwards. For a rather level plane, up is −Z seen from above and +Z seen from below.
    pub fn plane_axes(normal: DVec3) -> (DVec3, DVec3) {
        let is_level = normal.y.abs() > std::f64::consts::FRAC_1_SQRT_2;
        let up = if is_level {
            DVec3::NEG_Z * normal.y.signum()
        } else {
            DVec3::Y
        };
        let u = up.cross(normal).normalize();
        (u, normal.cross(u))
    }
}

fn placed_bounds(canonical: CanonicalShape, world_from_canonical: DAffine3) -> (DVec3, DVec3) {
    let columns = world_from_canonical.matrix3;
    let [x, y, z] = [columns.x_axis, columns.y_axis, columns.z_axis];
    let squared = |v: DVec3| v * v;
    let root = |v: DVec3| DVec3::new(v.x.sqrt(), v.y.sqrt(), v.z.sqrt());
    // Half extent of the unit circle at y = 0 and of the unit sphere along each axis.
    let circle = root(squared(x) + squared(z));
    let sphere = root(squared(x) + squared(y) + squared(z));
    let around = |center: DVec3, reach: DVec3| (center - reach, center + reach);
    let center = world_from_canonical.translation;
    match canonical {
        CanonicalShape::Disc { .. } => around(center, circle),
        CanonicalShape::Rectangle => around(center, x.abs() + z.abs()),
        CanonicalShape::Box => around(center, x.abs() + y.abs() + z.abs()),
        CanonicalShape::Ellipsoid => around(center, sphere),
        CanonicalShape::Torus { minor } => around(center, circle + minor * sphere),
        CanonicalShape::Cone { bottom, top, .. } => {
            let (low, high) = around(center, bottom * circle);
            let (other_low, other_high) = around(center + y, top * circle);
            (low.min(other_low), high.max(other_high))
        }
    }
}
