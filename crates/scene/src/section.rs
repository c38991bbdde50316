//! Section planes.

use glam::DVec3;

/// A plane that cuts away what lies beyond it: points p with `normal`·p > `offset`. It cuts surfaces, solids and visible
/// lights; lights without a surface stay. Closed meshes and shapes are solid, so the plane shows their inside as a flat face of
/// their material.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Section {
    /// The unit direction towards what is cut away, in world space.
    pub normal: DVec3,
    /// The distance of the plane from the world's origin along `normal`, in scene units.
    pub offset: f64,
}

impl Section {
    /// The point of the plane that is nearest to this one.
    pub fn nearest_to(&self, point: DVec3) -> DVec3 {
        point + self.normal * (self.offset - self.normal.dot(point))
    }

    /// Whether a point in world space is cut away.
    pub fn cuts(&self, point: DVec3) -> bool {
        self.normal.dot(point) > self.offset
    }
}
