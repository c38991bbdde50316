//! Analytic surfaces.

use glam::{DAffine3, DVec3};

/// An analytic surface with one material.
#[derive(Clone, Debug, PartialEq)]
pub struct Shape {
    /// Where it is and how large.
    pub geometry: Geometry,
    /// Index into [`Scene::materials`].
    pub material: usize,
}

/// The surface of a [`Shape`], in world space.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Geometry {
    /// All points at one distance from a centre.
    Sphere {
        /// The centre.
        center: DVec3,
        /// Above 0.
        radius: f64,
    },
    /// An infinite plane.
    Plane {
        /// Any point on it.
        point: DVec3,
        /// Of unit length.
        normal: DVec3,
    },
    /// A surface of canonical size and place, brought into the world.
    Placed {
        /// Which one.
        form: Form,
        /// Invertible; may scale unevenly or mirror.
        world_from_form: DAffine3,
    },
}

/// A surface of canonical size and place. Its axis, where it has one, is y.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Form {
    /// x² + z² ≤ 1 at y = 0, facing +y, less a hole.
    Disc {
        /// Radius of the hole, in [0, 1).
        hole: f64,
    },
    /// |x| ≤ 1, |z| ≤ 1 at y = 0, facing +y.
    Rectangle,
    /// |x|, |y|, |z| ≤ 1.
    Box,
    /// A cylinder, cone or frustum for 0 ≤ y ≤ 1.
    Cone {
        /// Radius at y = 0, 0 or more.
        bottom: f64,
        /// Radius at y = 1, 0 or more; not 0 where `bottom` is.
        top: f64,
        /// Whether it is closed by discs.
        capped: bool,
    },
    /// A tube round the circle of radius 1 at y = 0.
    Torus {
        /// Radius of the tube, in (0, 1].
        minor: f64,
    },
    /// The unit sphere.
    Ellipsoid,
}

impl Form {
    /// The axis-aligned box (min, max) in its own space.
    pub fn bounds(&self) -> (DVec3, DVec3) {
        let symmetric = |x: f64, y: f64, z: f64| (DVec3::new(-x, -y, -z), DVec3::new(x, y, z));
        match *self {
            Self::Disc { .. } | Self::Rectangle => symmetric(1.0, 0.0, 1.0),
            Self::Box | Self::Ellipsoid => symmetric(1.0, 1.0, 1.0),
            Self::Cone { bottom, top, .. } => {
                let r = bottom.max(top);
                (DVec3::new(-r, 0.0, -r), DVec3::new(r, 1.0, r))
            }
            Self::Torus { minor } => symmetric(1.0 + minor, minor, 1.0 + minor),
        }
    }
}

impl Geometry {
    /// The axis-aligned box (min, max) in world space: the smallest for spheres, for others that of
    /// their own box; `None` for planes.
    pub fn bounds(&self) -> Option<(DVec3, DVec3)> {
        match *self {
            Self::Sphere { center, radius } => Some((center - radius, center + radius)),
            Self::Plane { .. } => None,
            Self::Placed {
                form,
                world_from_form,
            } => {
                let (min, max) = form.bounds();
                let center = world_from_form.transform_point3((min + max) / 2.0);
                let half = (max - min) / 2.0;
                let columns = world_from_form.matrix3;
                let reach = columns.x_axis.abs() * half.x
                    + columns.y_axis.abs() * half.y
                    + columns.z_axis.abs() * half.z;
                Some((center - reach, center + reach))
            }
        }
    }
}
