//! A camera that shows the whole scene from a given side, as large as the picture allows.
//!
//! In axes with x to the right of the image, y up and z towards the camera, a point (x, y, z) is left of the
//! image's right edge if x − cx ≤ w (cz − z), where (cx, cy, cz) is the camera and w the tangent of half the
//! field of view. So only the largest x + w z and −x + w z over all points matter, and the same with y: each
//! pair gives the camera's place across the image and its least distance, and the larger distance holds.

use super::posed::Posed;
use super::{Camera, Geometry, Scene, corners};
use glam::{DAffine3, DMat3, DVec3};

/// Beyond this number of vertices in all instances, the boxes of meshes stand for their vertices.
const MOST_VERTICES: usize = 1 << 23;

/// Options of [`Scene::framed`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Framing {
    /// From the scene to the camera, in world space; not parallel to +Y, of any length but 0.
    pub towards: DVec3,
    /// Vertical field of view in radians, in (0, π).
    pub fov_y: f64,
    /// Width of the image over its height, above 0.
    pub aspect: f64,
    /// Margin on each side as a fraction of half the image's width and height, in [0, 1).
    pub margin: f64,
}

/// The largest values over all points of the four expressions above: to the right, left, up and down.
struct Reach {
    camera_from_world: DMat3,
    /// The tangents of half the horizontal and vertical fields of view, less the margin.
    tangents: [f64; 2],
    /// The lengths of (1, tangent).
    slants: [f64; 4],
    most: [f64; 4],
}

impl Reach {
    fn add(&mut self, point: DVec3, radius: f64) {
        let p = self.camera_from_world * point;
        let [wide, high] = self.tangents;
        let sides = [
            p.x + wide * p.z,
            wide * p.z - p.x,
            p.y + high * p.z,
            high * p.z - p.y,
        ];
        for (i, side) in sides.into_iter().enumerate() {
            self.most[i] = self.most[i].max(side + radius * self.slants[i]);
        }
    }

    fn add_box(&mut self, bounds: (DVec3, DVec3), place: DAffine3) {
        for corner in corners(bounds) {
            self.add(place.transform_point3(corner), 0.0);
        }
    }
}

impl Scene {
    /// A perspective camera that has all bounded geometry, visible or not, in its image from the smallest
    /// distance: at many times of the animation, if there is one. `None` if nothing is bounded.
    pub fn framed(&self, framing: &Framing) -> Option<Camera> {
        let (min, max) = self.bounds_over_time()?;
        let backward = framing.towards.normalize();
        let right = DVec3::Y.cross(backward).normalize();
        let world_from_camera = DMat3::from_cols(right, backward.cross(right), backward);
        let high = (framing.fov_y / 2.0).tan() * (1.0 - framing.margin);
        let tangents = [high * framing.aspect, high];
        let center = min.midpoint(max);
        let mut reach = Reach {
            camera_from_world: world_from_camera.transpose(),
            tangents,
            slants: [tangents[0], tangents[0], high, high].map(|t| 1.0_f64.hypot(t)),
            most: [f64::NEG_INFINITY; 4],
        };
        self.visit(&mut reach, center);
        let [right, left, up, down] = reach.most;
        let [wide, high] = tangents;
        let distance = f64::max((right + left) / (2.0 * wide), (up + down) / (2.0 * high));
        let from = DVec3::new((right - left) / 2.0, (up - down) / 2.0, distance);
        // Never 0, not even for a single point far from the origin.
        let extent = (max - min).max_element();
        let least = 1e-3 * extent.max(1e-6 * center.abs().max_element().max(1e-6));
        // The camera looks at the depth of the centre.
        let ahead = from.z.max(least);
        let look_from = center + world_from_camera * from.with_z(ahead);
        Some(Camera {
            look_from,
            look_at: look_from - ahead * backward,
            fov_y: framing.fov_y,
            ..Camera::default()
        })
    }

    /// Adds all points, relative to `center`; those that move at many times.
    fn visit(&self, reach: &mut Reach, center: DVec3) {
        let relative = DAffine3::from_translation(-center);
        let counts = self
            .instances
            .iter()
            .map(|i| self.meshes[i.mesh].positions.len());
        let is_large = counts.sum::<usize>() > MOST_VERTICES;
        let (moving, nodes) = (self.moving_instances(), self.moving_nodes());
        for (index, time) in self.moments().into_iter().enumerate() {
            let posed = Posed::new(self, time);
            let counts = |moves: bool| moves || index == 0;
            let boxes: Vec<_> = match is_large {
                true => (0..self.meshes.len())
                    .map(|mesh| posed.bounds(mesh))
                    .collect(),
                false => Vec::new(),
            };
            let instances = self.instances.iter().zip(&moving);
            for (instance, _) in instances.filter(|(_, moves)| counts(**moves)) {
                let place = relative * posed.world_from_object(instance);
                if let Some(Some(bounds)) = boxes.get(instance.mesh) {
                    reach.add_box(*bounds, place);
                } else if !is_large {
                    for position in posed.points(instance.mesh) {
                        reach.add(place.transform_point3(position), 0.0);
                    }
                }
            }
            for shape in &self.shapes {
                if !counts(shape.node.is_some_and(|node| nodes[node])) {
                    continue;
                }
                match (shape.geometry, shape.node) {
                    (Geometry::Plane { .. }, _) => {}
                    (
                        Geometry::Sphere {
                            center: own,
                            radius,
                        },
                        None,
                    ) => {
                        reach.add(own - center, radius);
                    }
                    (geometry, node) => {
                        let place = relative * posed.world_from(node);
                        if let Some(bounds) = geometry.placed(place).bounds() {
                            reach.add_box(bounds, DAffine3::IDENTITY);
                        }
                    }
                }
            }
        }
    }
}
