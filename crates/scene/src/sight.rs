//! Whether a camera sees anything that is lit, by a few rays on the host. It need not be exact: a camera that sees little
//! through a small hole may be taken for one that sees nothing.

use super::posed::Posed;
use super::{Camera, Coverage, Light, LightKind, Material, Scene};
use glam::{DVec3, Vec3};
use std::cell::Cell;

/// Rays of a camera across and down its picture.
const RAYS: [u32; 2] = [8, 6];

/// Ray–triangle tests after which a camera counts as one that sees something, and triangles with which it does at once.
const MOST_TESTS: usize = 200_000_000;
const MOST_TRIANGLES: usize = 400_000;

/// Distances from a surface below this part of a ray's length are that surface.
const NEAR: f64 = 1e-6;

struct Triangle {
    /// A corner, and both edges from there.
    sides: [DVec3; 3],
    shines: bool,
    stops_light: bool,
}

/// The surfaces that stop light, in world space, and the light around them.
pub struct Sight {
    /// Lights of the scene that are not black.
    lights: Vec<Light>,
    triangles: Vec<Triangle>,
    /// Whether light comes from outside.
    is_open: bool,
    is_large: bool,
    tests: Cell<usize>,
}

impl Sight {
    /// The surfaces of `scene` at time 0; clear and covered ones stop nothing. `is_open` tells whether light comes from
    /// far away, as that of a background does.
    pub fn new(scene: &Scene, is_open: bool) -> Self {
        let is_large = scene.triangle_count() > MOST_TRIANGLES;
        let shown = match is_large {
            true => &[],
            false => &scene.instances[..],
        };
        let posed = Posed::of(scene, 0.0, |_| !is_large);
        let mut triangles = Vec::new();
        for instance in shown {
            let mesh = &scene.meshes[instance.mesh];
            let place = posed.world_from_object(instance);
            let points: Vec<_> = (posed.points(instance.mesh))
                .map(|point| place.transform_point3(point))
                .collect();
            for corners in &mesh.triangles {
                let material = &scene.materials[mesh.materials[corners[0] as usize] as usize];
                let [a, b, c] = corners.map(|corner| points[corner as usize]);
                triangles.push(Triangle {
                    sides: [a, b - a, c - a],
                    shines: material.radiance().0 != Vec3::ZERO,
                    stops_light: stops_light(material),
                });
            }
        }
        let mut lights = scene.lights_at(0.0, 0.0, &posed.nodes);
        lights.retain(|light| light.color != Vec3::ZERO);
        Self {
            lights,
            triangles,
            is_open,
            is_large,
            tests: Cell::new(0),
        }
    }

    /// Whether the camera, in world space, sees something that is lit in a picture of this aspect ratio.
    pub fn sees(&self, camera: &Camera, aspect: f64) -> bool {
        if self.is_large {
            return true;
        }
        self.tests.set(0);
        let forward = (camera.look_at - camera.look_from).normalize_or(DVec3::NEG_Z);
        let right = forward.cross(camera.up).normalize_or(DVec3::X);
        let up = right.cross(forward);
        let high = match camera.orthographic_height {
            Some(height) => height / 2.0,
            None => (camera.fov_y / 2.0).tan(),
        };
        let mut is_enclosed = true;
        for index in 0..RAYS[0] * RAYS[1] {
            let across = [index % RAYS[0], index / RAYS[0]];
            let [x, y] = [0, 1]
                .map(|axis| (2.0 * f64::from(across[axis]) + 1.0) / f64::from(RAYS[axis]) - 1.0);
            let aside = high * (aspect * x * right + y * up);
            let (from, along) = match camera.orthographic_height {
                Some(_) => (camera.look_from + aside, forward),
                None => (camera.look_from, forward + aside),
            };
            // `along` is one unit of depth.
            let (near, far) = camera.clip;
            let from = from + near * along;
            let seen = self.nearest(from, along, |triangle| triangle.stops_light);
            match seen.filter(|(distance, _)| near + distance < far) {
                Some((_, true)) => return true,
                Some((distance, false)) if self.is_lit(from, distance * along) => return true,
                Some(_) => {}
                // Clear surfaces are seen before what is lit behind them.
                None if self.is_open && self.nearest(from, along, |_| true).is_some() => {
                    return true;
                }
                None => is_enclosed = false,
            }
            if self.tests.get() > MOST_TESTS {
                return true;
            }
        }
        // Rays may pass what is small.
        !is_enclosed && self.is_in_view(camera, [right, up, forward], [high * aspect, high])
    }

    /// Whether any corner of a triangle is in the picture.
    fn is_in_view(&self, camera: &Camera, axes: [DVec3; 3], [wide, high]: [f64; 2]) -> bool {
        let mut corners = (self.triangles.iter()).flat_map(|triangle| {
            let [a, b, c] = triangle.sides;
            [a, a + b, a + c]
        });
        corners.any(|corner| {
            let way = corner - camera.look_from;
            let [x, y, z] = axes.map(|axis| way.dot(axis));
            let depth = match camera.orthographic_height {
                Some(_) => 1.0,
                None => z,
            };
            z > 0.0 && x.abs() < wide * depth && y.abs() < high * depth
        })
    }

    /// Whether light may come to where a ray that starts at `from` ends after `way`.
    fn is_lit(&self, from: DVec3, way: DVec3) -> bool {
        let point = from + way * (1.0 - 1e3 * NEAR);
        let is_free = |along: DVec3, most: f64| {
            let nearest = self.nearest(point, along, |triangle| triangle.stops_light);
            nearest.is_none_or(|(distance, _)| distance > most)
        };
        let mut towards = self.lights.iter().map(|light| match light.kind {
            LightKind::Directional { direction } => (-direction, f64::INFINITY),
            kind => {
                let (min, max) = kind.bounds().unwrap_or_default();
                (min.midpoint(max) - point, 1.0)
            }
        });
        if towards.any(|(along, most)| is_free(along, most)) {
            return true;
        }
        // The surface's own side is in the way of others.
        let directions = (0..8).map(|corner| {
            let side = |bit: u8| if corner >> bit & 1 == 0 { -1.0 } else { 1.0 };
            DVec3::new(side(0), side(1), side(2))
        });
        let axes = [DVec3::X, DVec3::Y, DVec3::Z].into_iter();
        let mut all = directions.chain(axes.flat_map(|axis| [axis, -axis]));
        self.is_open && all.any(|along| is_free(along, f64::INFINITY))
    }

    /// The nearest of some triangles along a ray: its distance in lengths of `along`, and whether it shines.
    fn nearest(
        &self,
        from: DVec3,
        along: DVec3,
        counts: fn(&Triangle) -> bool,
    ) -> Option<(f64, bool)> {
        self.tests.set(self.tests.get() + self.triangles.len());
        let mut nearest: Option<(f64, bool)> = None;
        for triangle in self.triangles.iter().filter(|triangle| counts(triangle)) {
            let [corner, b, c] = triangle.sides;
            // Möller and Trumbore 1997.
            let across = along.cross(c);
            let determinant = b.dot(across);
            let from_corner = from - corner;
            let u = from_corner.dot(across) / determinant;
            let other = from_corner.cross(b);
            let v = along.dot(other) / determinant;
            let distance = c.dot(other) / determinant;
            // No ray slips between neighbours.
            let is_inside = u > -NEAR && v > -NEAR && u + v < 1.0 + NEAR;
            let is_hit = is_inside && distance > NEAR;
            if is_hit && nearest.is_none_or(|(best, _)| distance < best) {
                nearest = Some((distance, triangle.shines));
            }
        }
        nearest
    }
}

/// Whether light does not pass through a surface of this material.
fn stops_light(material: &Material) -> bool {
    let phong = material.classical();
    phong.transmit == Vec3::ZERO && phong.opacity == 1.0 && material.coverage == Coverage::Opaque
}
