//! Analytic surfaces.

use glam::{DAffine3, DVec3};

/// An analytic surface with one material.
#[derive(Clone, Debug, PartialEq)]
pub struct Shape {
    /// Where it is and how large.
    pub geometry: Geometry,
    /// Index into [`super::Scene::materials`].
    pub material: usize,
    /// Index into [`super::Scene::nodes`] of what carries it; `None` is the world. Planes stand still.
    pub node: Option<usize>,
}

/// The surface of a [`Shape`], in the space of its node.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Geometry {
    /// All points at one distance from a centre. u and v are those of [`CanonicalShape::Ellipsoid`].
    Sphere {
        /// The centre.
        center: DVec3,
        /// Above 0.
        radius: f64,
    },
    /// An infinite plane.
    Plane {
        /// Any point on it; where u and v are 0.
        point: DVec3,
        /// Of unit length.
        normal: DVec3,
    },
    /// A surface of canonical size and place, brought into the world.
    Placed {
        /// Which one.
        canonical: CanonicalShape,
        /// Invertible; may scale unevenly or mirror.
        world_from_canonical: DAffine3,
    },
}

/// A surface of canonical size and place. Its axis, where it has one, is y. u and v are in [0, 1]; the
/// longitude goes from −z by −x, +z and +x.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum CanonicalShape {
    /// x² + z² ≤ 1 at y = 0, facing +y, less a hole. u grows along x, v along −z.
    Disc {
        /// Radius of the hole, in [0, 1).
        hole: f64,
    },
    /// |x| ≤ 1, |z| ≤ 1 at y = 0, facing +y. u grows along x, v along −z.
    Rectangle,
    /// |x|, |y|, |z| ≤ 1. On each side u grows to the right and v up for one who looks at it from
    /// outside, where up is y, on top −z and at the bottom z.
    Box,
    /// A cylinder, cone or frustum for 0 ≤ y ≤ 1. On its side u is the longitude and v is y; its ends
    /// are like the top and bottom of a box.
    Cone {
        /// Radius at y = 0, 0 or more.
        bottom: f64,
        /// Radius at y = 1, 0 or more; not 0 where `bottom` is.
        top: f64,
        /// Whether it is closed by discs.
        capped: bool,
    },
    /// A tube round the circle of radius 1 at y = 0. u is the longitude; v goes round the tube, from
    /// the inner equator by the lower side, the outer equator and the upper side.
    Torus {
        /// Radius of the tube, in (0, 1].
        minor: f64,
    },
    /// The unit sphere. u is the longitude; v is the latitude, 0 at −y and 1 at y.
    Ellipsoid,
}

impl Geometry {
    /// The smallest axis-aligned box (min, max) in its own space; `None` for planes.
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

    /// The same surface in the space that `space_from_node` leads to; a sphere becomes an ellipsoid.
    /// Planes stand still.
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

    /// The unit vectors along which u and v of a plane grow with the distance from its point: to the
    /// right and up for one who looks at its front with +Y upwards. Where it is rather level, seen
    /// from above −Z is upwards instead, and seen from below +Z.
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
    // How far the unit circle at y = 0 and the unit sphere reach along each axis.
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
