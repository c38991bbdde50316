//! Bounding boxes of a scene's contents.

use super::posed::{Bounds, Posed, union};
use super::{Geometry, Mesh, ObjectRef, Scene};
use glam::{DAffine3, DVec3};

impl Mesh {
    /// The smallest axis-aligned box in the target space of `space_from_object`.
    pub fn bounds_in(&self, space_from_object: DAffine3) -> Option<Bounds> {
        let points = self.positions.iter();
        let points = points.map(|p| space_from_object.transform_point3(p.as_dvec3()));
        points.map(|p| (p, p)).reduce(union)
    }

    /// The smallest axis-aligned box (min, max) in object space; `None` without positions.
    pub fn bounds(&self) -> Option<Bounds> {
        let points = self.positions.iter().map(|p| p.as_dvec3());
        points.map(|p| (p, p)).reduce(union)
    }
}

impl Scene {
    /// The bounding box (min, max) of all bounded geometry, visible or not, in world space at time 0;
    /// `None` if there is none.
    ///
    /// The vertices of an instance are only transformed if its own box extends beyond the bounds found so
    /// far.
    pub fn bounds(&self) -> Option<Bounds> {
        self.bounds_at(0.0)
    }

    /// The union of [`Self::bounds`] at many times of the animation.
    pub fn bounds_over_time(&self) -> Option<Bounds> {
        let all = self.moments().into_iter();
        all.filter_map(|time| self.bounds_at(time)).reduce(union)
    }

    fn bounds_at(&self, time: f64) -> Option<Bounds> {
        let posed = Posed::new(self, time);
        let world_from = |node: Option<usize>| posed.world_from(node);
        let shapes = self.shapes.iter().filter_map(|shape| match shape.node {
            Some(_) => shape.geometry.placed(world_from(shape.node)).bounds(),
            None => shape.geometry.bounds(),
        });
        let mut all = shapes.reduce(union);

        let meshes = 0..self.meshes.len();
        let of_meshes: Vec<_> = meshes.map(|mesh| posed.bounds(mesh)).collect();
        let mut open = Vec::with_capacity(self.instances.len());
        for instance in &self.instances {
            if let Some(bounds) = of_meshes[instance.mesh] {
                let world_from_object = posed.world_from_object(instance);
                open.push((
                    instance.mesh,
                    world_from_object,
                    boxed(bounds, world_from_object),
                ));
            }
        }
        // Start with the instances that reach farthest in each direction; most others lie within their
        // bounds.
        for axis in 0..3 {
            for side in [1.0, -1.0] {
                let reach = |(.., (min, max)): &(usize, DAffine3, Bounds)| {
                    if side > 0.0 { max[axis] } else { -min[axis] }
                };
                let farthest = open.iter().max_by(|a, b| reach(a).total_cmp(&reach(b)));
                if let Some(&(mesh, world_from_object, outer)) = farthest {
                    posed.reach(&mut all, mesh, world_from_object, outer);
                }
            }
        }
        for (mesh, world_from_object, outer) in open {
            posed.reach(&mut all, mesh, world_from_object, outer);
        }
        all
    }

    /// The bounding box (min, max) of one object in world space at `time` seconds; for lights without
    /// extent it is their position. `None` for planes, directional lights, and meshes without triangles.
    pub fn bounds_of(&self, object: ObjectRef, time: f64) -> Option<Bounds> {
        match object {
            ObjectRef::Instance(index) => {
                let instance = self.instances.get(index)?;
                let posed = Posed::of(self, time, |mesh| mesh == instance.mesh);
                posed.bounds_in(instance.mesh, posed.world_from_object(instance))
            }
            ObjectRef::Shape(index) => {
                let shape = self.shapes.get(index)?;
                match shape.node {
                    Some(node) => {
                        let world_from_node = self.nodes_at(time, time)[node].world_from_node;
                        shape.geometry.placed(world_from_node).bounds()
                    }
                    None => shape.geometry.bounds(),
                }
            }
            ObjectRef::Light(index) => {
                let nodes = self.nodes_at(time, time);
                let lights = self.lights_at(time, time, &nodes);
                lights.get(index)?.kind.bounds()
            }
        }
    }
}

impl super::LightKind {
    /// The smallest axis-aligned box (min, max) in the light's own space; `None` for directional lights.
    pub fn bounds(&self) -> Option<Bounds> {
        match *self {
            Self::Directional { .. } => None,
            Self::Point { position } | Self::Spot { position, .. } => Some((position, position)),
            Self::Rectangle {
                center,
                edge_u,
                edge_v,
            } => {
                let reach = edge_u.abs() + edge_v.abs();
                Some((center - reach, center + reach))
            }
            Self::Disc {
                center,
                normal,
                radius,
            } => {
                let reach = (DVec3::ONE - normal * normal).max(DVec3::ZERO);
                let reach = radius * DVec3::from(reach.to_array().map(f64::sqrt));
                Some((center - reach, center + reach))
            }
            Self::Sphere { center, radius } => Geometry::Sphere { center, radius }.bounds(),
        }
    }
}

/// A box that contains the image of another box under `place`.
fn boxed(bounds: Bounds, place: DAffine3) -> Bounds {
    let corners = corners(bounds).map(|corner| place.transform_point3(corner));
    corners
        .map(|corner| (corner, corner))
        .into_iter()
        .fold((corners[0], corners[0]), union)
}

/// The corners of a box. Bits 0 to 2 of an index say whether x, y and z are those of the maximum.
pub fn corners((min, max): Bounds) -> [DVec3; 8] {
    std::array::from_fn(|i| {
        let side = |axis: usize| {
            if i >> axis & 1 == 0 {
                min[axis]
            } else {
                max[axis]
            }
        };
        DVec3::new(side(0), side(1), side(2))
    })
}
